//! `rungbook build`: writes the manual.

use std::path::{Path, PathBuf};

use crate::book::view::Book;
use crate::cli::args::BuildArgs;
use crate::cli::commands::verify;
use crate::cli::report::{progress::Progress, summary::summary};
use crate::cli::{Exit, Failure, release, say, stamp, store, tree, write};
use crate::config::Settings;
use crate::evidence::record::{Answer, Record};
use crate::pipeline::{self, Project};

/// What is to be written.
struct Outputs {
    html: bool,
    pdf: bool,
    json: bool,
}

impl Outputs {
    /// Those that were asked for; without any, those that the configuration enables.
    const fn new(args: &BuildArgs, settings: &Settings) -> Self {
        if args.html || args.pdf || args.json {
            return Self { html: args.html, pdf: args.pdf, json: args.json };
        }
        Self { html: settings.html, pdf: settings.pdf && cfg!(feature = "pdf"), json: false }
    }
}

pub(crate) fn run(args: &BuildArgs) -> Result<Exit, Failure> {
    let dir = tree::folder(&args.tree.dir)?;
    let output = args.output.clone().unwrap_or_else(|| dir.join("target").join("rungbook"));
    let output = std::path::absolute(&output).map_err(|error| Failure(error.to_string()))?;
    let progress = Progress::new(args.tree.quiet);
    let mut read = tree::read(&args.tree, Some(&output), &progress)?;
    if args.verify {
        read = verify::settle(&dir, read, &progress)?;
    }
    let (mut project, settings) = read;
    let outputs = Outputs::new(args, &settings);
    let stamp = stamp::stamp(&dir);
    let known = store::known(&dir, &project, &settings, &stamp)?;
    pipeline::know(&mut project, &settings, known.iter().map(|(_, answer)| answer.clone()).collect());
    add_pages(args, &dir, &mut project, &settings, &stamp, &known)?;
    progress.event(pipeline::Event::Stage { name: "book", total: 0 });
    let book = pipeline::book(&project, &settings, &stamp);
    let written = write_all(&outputs, &output, &project, &book, &settings, &progress)?;
    progress.event(pipeline::Event::Done);
    if !args.tree.quiet {
        let shown: Vec<String> = written.iter().map(|path| shorten(path)).collect();
        say(&summary(&book, &shown));
    }
    Ok(Exit::Ok)
}

/// Adds the pages of evidence and changes, where they are asked for.
fn add_pages(
    args: &BuildArgs,
    dir: &Path,
    project: &mut Project,
    settings: &Settings,
    stamp: &pipeline::Stamp,
    records: &[(Record, Answer)],
) -> Result<(), Failure> {
    if !args.evidence && args.previous.is_none() {
        return Ok(());
    }
    let changes = args.previous.as_deref().map(|old| {
        let new = pipeline::snapshot::snapshot(project, settings, stamp, records);
        release::snapshot(old, dir).map(|old| crate::evidence::diff::compare(&old, &new))
    });
    let changes = changes.transpose()?;
    let mut pages = pipeline::evidence::pages(project, settings, stamp, records, changes.as_ref());
    if !args.evidence {
        pages.remove(0);
    }
    project.narratives.append(&mut pages);
    Ok(())
}

fn write_all(
    outputs: &Outputs,
    output: &Path,
    project: &Project,
    book: &Book,
    settings: &Settings,
    progress: &Progress,
) -> Result<Vec<PathBuf>, Failure> {
    let events = |event| progress.event(event);
    let mut written = Vec::new();
    if outputs.html {
        let pages = pipeline::html(project, book, &events).map_err(|error| Failure(error.to_string()))?;
        let folder = output.join("html");
        write::folder(&folder, pages.iter().map(|page| (page.path.as_str(), page.bytes.as_slice())))?;
        written.push(folder.join("index.html"));
    }
    if outputs.json {
        let path = output.join("model.json");
        write::file(&path, pipeline::model(book).as_bytes())?;
        written.push(path);
    }
    if outputs.pdf {
        let bytes = pipeline::pdf(project, book, settings, &events).map_err(Failure)?;
        let path = output.join("manual.pdf");
        write::file(&path, &bytes)?;
        written.push(path);
    }
    Ok(written)
}

/// Relative to the current folder where that is shorter.
fn shorten(path: &Path) -> String {
    let here = std::env::current_dir().unwrap_or_default();
    path.strip_prefix(here).unwrap_or(path).display().to_string()
}
