//! How fast each stage is, in files and bytes a second.
//!
//! `RUNGBOOK_CORPUS` names a tree; without it, `samples/pick-and-place` is read. The bytes are those of the files
//! that are read as source.

use std::path::PathBuf;

use divan::Bencher;
use divan::counter::{BytesCount, ItemsCount};
use rungbook::book::view::Book;
use rungbook::config::{ConfigFile, Settings};
use rungbook::library::{Library, LibraryId, lower};
use rungbook::pipeline::{self, Project, Stamp};
use rungbook::source::{Disk, Options, Tree, read_tree};

fn main() {
    divan::main();
}

fn root() -> PathBuf {
    let sample = || PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("samples/pick-and-place");
    std::env::var_os("RUNGBOOK_CORPUS").map_or_else(sample, PathBuf::from)
}

fn disk() -> Disk {
    Disk::new(root()).expect("the tree is there")
}

fn settings() -> Settings {
    Settings::new(ConfigFile::default()).expect("the defaults are valid")
}

fn tree() -> Tree {
    read_tree(&disk(), &Options::default(), &|_| {})
}

fn project() -> Project {
    pipeline::read(&disk(), "tree", &settings(), &|_| {})
}

fn book(project: &Project) -> Book {
    pipeline::book(project, &settings(), &Stamp::default())
}

fn size(tree: &Tree) -> (BytesCount, ItemsCount) {
    let bytes: usize = tree.units.iter().map(|unit| tree.files.get(unit.file).text.len()).sum();
    (BytesCount::new(bytes), ItemsCount::new(tree.units.len()))
}

fn counted<'a, 'b>(bencher: Bencher<'a, 'b>) -> Bencher<'a, 'b> {
    let (bytes, files) = size(&tree());
    bencher.counter(bytes).counter(files)
}

/// Walks, decodes, takes containers off.
#[divan::bench(sample_count = 10)]
fn crawl(bencher: Bencher<'_, '_>) {
    counted(bencher).bench_local(tree);
}

/// Parses declarations and bodies, and takes out what is declared.
#[divan::bench(sample_count = 10)]
fn parse(bencher: Bencher<'_, '_>) {
    let tree = tree();
    let units: Vec<_> = tree.units.iter().map(|unit| (unit, LibraryId(0))).collect();
    counted(bencher).bench_local(|| lower::units(&units, vec![Library::default()], &tree.files, &|_| {}));
}

/// All from the disk to the findings: crawl, parse, resolve, comments, tables, audit.
#[divan::bench(sample_count = 10)]
fn read(bencher: Bencher<'_, '_>) {
    counted(bencher).bench_local(project);
}

/// The pages' contents.
#[divan::bench(sample_count = 10)]
fn make_book(bencher: Bencher<'_, '_>) {
    let project = project();
    counted(bencher).bench_local(|| book(&project));
}

/// The site's bytes.
#[divan::bench(sample_count = 10)]
fn render_html(bencher: Bencher<'_, '_>) {
    let project = project();
    let book = book(&project);
    counted(bencher).bench_local(|| pipeline::html(&project, &book, &|_| {}).expect("our own templates"));
}

/// The PDF's bytes.
#[cfg(feature = "pdf")]
#[divan::bench(sample_count = 2, sample_size = 1)]
fn render_pdf(bencher: Bencher<'_, '_>) {
    let project = project();
    let book = book(&project);
    let settings = settings();
    counted(bencher).bench_local(|| pipeline::pdf(&project, &book, &settings, &|_| {}).expect("our own templates"));
}
