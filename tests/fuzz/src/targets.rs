//! One function a fuzz target. Each takes any bytes and panics where a promise of the tool is broken: tokens are the
//! text, findings lie inside their files, tables that are read can be written, no page runs what a comment says.

use std::io::Write as _;
use std::sync::LazyLock;

use rungbook::config::{ConfigFile, Settings};
use rungbook::diagnostic::Finding;
use rungbook::pipeline::{self, Project, Stamp};
use rungbook::source::Memory;
use rungbook::syntax::{Entry, Options, parse};
use rungbook::table::automaton::Automaton;
use rungbook::table::read::{self, Read};
use rungbook::table::{Piece, explain, layout, lint, write};
use rungbook::text::{FileId, Files};

use super::crawl;

/// A target by its name.
pub type Target = (&'static str, fn(&[u8]));

/// All targets.
pub const ALL: &[Target] = &[
    ("syntax", syntax),
    ("twincat", twincat),
    ("plcopen", plcopen),
    ("codesys_export", codesys_export),
    ("codesys_v23", codesys_v23),
    ("codesys_text", codesys_text),
    ("siemens", siemens),
    ("simatic_ax", simatic_ax),
    ("automation_studio", automation_studio),
    ("four_diac", four_diac),
    ("logi_cad", logi_cad),
    ("plain_text", plain_text),
    ("projects", projects),
    ("pipe_table", pipe_table),
    ("gtt", gtt),
    ("table_xml", table_xml),
    ("csv", csv),
    ("workbook", workbook),
    ("docs", docs),
    ("chain", chain),
];

static SETTINGS: LazyLock<Settings> = LazyLock::new(|| {
    let file = ConfigFile::parse("").expect("an empty configuration is one");
    Settings::new(file).expect("the default settings are settings")
});

/// The first byte, which chooses, and the rest.
fn chosen(data: &[u8]) -> (usize, &[u8]) {
    data.split_first().map_or((0, data), |(first, rest)| (usize::from(*first), rest))
}

fn project(fs: &Memory) -> Project {
    let project = pipeline::read(fs, "tree", &SETTINGS, &|_| {});
    inside(&project.findings, &project.files);
    project
}

/// Findings lie inside their files and between characters.
fn inside(findings: &[Finding], files: &Files) {
    for finding in findings {
        let labels = finding.labels.iter().map(|label| label.place);
        for place in std::iter::once(finding.place).chain(labels) {
            let text = &files.get(place.file).text;
            assert!(text.get(place.span.range()).is_some(), "outside of its file: {finding:?}");
        }
    }
}

/// One file of a tree that holds nothing else but `beside`.
fn one(path: &str, data: &[u8], beside: &[(&str, &str)]) {
    let fs = beside.iter().fold(Memory::new().with(path, data), |fs, (path, text)| fs.with(path, text));
    let _ = project(&fs);
}

/// The lexer and the parser: nothing is lost, and nothing is skipped in silence.
pub fn syntax(data: &[u8]) {
    const ENTRIES: [Entry; 5] =
        [Entry::File, Entry::Declaration, Entry::Body, Entry::InstructionList, Entry::Expression];
    let (first, rest) = chosen(data);
    let text = String::from_utf8_lossy(rest);
    let options =
        Options { nested_comments: [None, Some(true), Some(false)][first / 16 % 3], quoted_names: first > 127 };
    let parse = parse(text.as_ref(), ENTRIES[first % 5], &options);
    let joined: String = parse.tree.tokens().map(|token| token.text()).collect();
    assert_eq!(joined, text, "the tokens are the text");
    assert_eq!(parse.tree.root().descendants().count(), parse.tree.node_count(), "the root holds every node");
    for error in &parse.errors {
        assert!(text.get(error.span.range()).is_some(), "outside of the text: {error:?}");
    }
}

/// TwinCAT 3.
pub fn twincat(data: &[u8]) {
    let (first, rest) = chosen(data);
    let name = ["a.TcPOU", "a.TcDUT", "a.TcGVL", "a.TcIO", "a.TcTTO"][first % 5];
    one(name, rest, &[]);
}

/// PLCopen XML.
pub fn plcopen(data: &[u8]) {
    one("a.xml", data, &[]);
}

/// CODESYS exports.
pub fn codesys_export(data: &[u8]) {
    one("a.export", data, &[]);
}

/// CODESYS V2.3 exports.
pub fn codesys_v23(data: &[u8]) {
    one("a.EXP", data, &[]);
}

/// CODESYS text exports.
pub fn codesys_text(data: &[u8]) {
    let (first, rest) = chosen(data);
    one(["a.pou", "a.dut", "a.gvl", "a.itf"][first % 4], rest, &[]);
}

/// Siemens SCL and its relatives.
pub fn siemens(data: &[u8]) {
    let (first, rest) = chosen(data);
    one(["a.scl", "a.udt", "a.db", "a.s7dcl", "a.awl"][first % 5], rest, &[]);
}

/// SIMATIC AX.
pub fn simatic_ax(data: &[u8]) {
    one("src/a.st", data, &[("apax.yml", "name: \"a\"\nversion: 1.0.0\n")]);
}

/// B&R Automation Studio.
pub fn automation_studio(data: &[u8]) {
    let (first, rest) = chosen(data);
    one(["a.st", "a.fun", "a.typ", "a.var", "a.lby", "a.prg"][first % 6], rest, &[("a.apj", "<AutomationStudio/>")]);
}

/// 4diac.
pub fn four_diac(data: &[u8]) {
    let (first, rest) = chosen(data);
    one(["a.fbt", "a.adp", "a.sub", "a.dtp", "a.gcf", "a.fct"][first % 6], rest, &[]);
}

/// logi.CAD and Neuron.
pub fn logi_cad(data: &[u8]) {
    let (first, rest) = chosen(data);
    one(["a.iecst", "a.stu"][first % 2], rest, &[]);
}

/// Plain text.
pub fn plain_text(data: &[u8]) {
    one("a.st", data, &[]);
}

/// Project files, each beside a file that it may name.
pub fn projects(data: &[u8]) {
    let (first, rest) = chosen(data);
    let name = ["p/a.plcproj", "apax.yml", "a.apj", "p/a.pkg", "p/a.lby"][first % 5];
    one(name, rest, &[("p/a.st", "FUNCTION_BLOCK A END_FUNCTION_BLOCK")]);
}

/// What is read can be laid out, linted, explained, unrolled and written, and its findings lie inside the text.
fn tables(read: &Read, length: usize) {
    for finding in &read.findings {
        let span = finding.place.span;
        assert!(span.start <= span.end && span.end as usize <= length, "outside of the text: {finding:?}");
    }
    for table in &read.tables {
        let _ = (layout::layout(table), lint::lint(table), explain::sentences(table), Automaton::build(table));
        let _ = (write::pipe(table), write::gtt(table), write::exteta(table), write::stvs(table), write::csv(table));
    }
}

fn table(data: &[u8], reader: fn(&Piece<'_>, &read::Options) -> Read) {
    let text = String::from_utf8_lossy(data);
    let piece = Piece::verbatim(FileId(0), &text, 0);
    tables(&reader(&piece, &read::Options { headless: true, ..read::Options::default() }), text.len());
}

/// Pipe tables.
pub fn pipe_table(data: &[u8]) {
    table(data, read::pipe::read);
    let text = String::from_utf8_lossy(data);
    let once = write::format_in_place(&text);
    assert_eq!(write::format_in_place(&once), once, "formatting is done at once");
}

/// The language of geteta.
pub fn gtt(data: &[u8]) {
    table(data, read::gtt::read);
}

/// exteta, STVS and the CODESYS Test Manager.
pub fn table_xml(data: &[u8]) {
    table(data, read::xml::read);
}

/// Comma-separated values.
pub fn csv(data: &[u8]) {
    table(data, |piece, options| read::sheet::csv(piece, "S", options));
}

/// Workbooks: the bytes as they are, and what an archive of files headed by lines `=== path` is.
pub fn workbook(data: &[u8]) {
    let parts = parts(data);
    if parts.iter().any(|(name, _)| name.is_some()) {
        let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
        let stored = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
        for (name, rest) in &parts {
            let Some(name) = name else { continue };
            if archive.start_file(name, stored).is_ok() {
                let _ = archive.write_all(rest);
            }
        }
        if let Ok(bytes) = archive.finish() {
            tables(&read::sheet::workbook(FileId(0), bytes.get_ref(), &read::Options::default()), 0);
        }
    } else {
        tables(&read::sheet::workbook(FileId(0), data, &read::Options::default()), 0);
    }
}

/// Comments in every style, above a header, behind a variable and as a page, up to the book.
pub fn docs(data: &[u8]) {
    let (first, rest) = chosen(data);
    let text = String::from_utf8_lossy(rest);
    let (open, line, close) = [
        ("(*", "\n", "*)"),
        ("///", "\n///", "\n"),
        ("(*!", "\n", "*)"),
        ("/**", "\n * ", "*/"),
        ("//!", "\n//! ", "\n"),
    ][first % 5];
    let comment = format!("{open}{}{close}", text.replace('\n', line));
    let source = format!(
        "{comment}\nFUNCTION_BLOCK A EXTENDS B\nVAR_INPUT\n  x : INT; {comment}\n{comment}\n  y, z : B;\nEND_VAR\n{comment}\n\
         x := 1;\nEND_FUNCTION_BLOCK\nFUNCTION_BLOCK B END_FUNCTION_BLOCK\n"
    );
    let fs = Memory::new().with("a.st", source).with("README.md", text.as_bytes());
    let project = project(&fs);
    let _ = pipeline::book(&project, &SETTINGS, &Stamp::default());
}

/// A tree of files, each headed by a line `=== path`, up to the site. No page runs or loads what the tree says.
pub fn chain(data: &[u8]) {
    let mut fs = Memory::new();
    for (name, rest) in parts(data) {
        fs = fs.with(&name.unwrap_or_else(|| "a.st".to_owned()), rest);
    }
    let project = project(&fs);
    let book = pipeline::book(&project, &SETTINGS, &Stamp::default());
    let _ = pipeline::model(&book);
    let pages = match pipeline::html(&project, &book, &|_| {}) {
        Ok(pages) => pages,
        // A tree may bring templates of its own, and those may be wrong.
        Err(error) if !project.overrides.is_empty() => return drop(error),
        Err(error) => panic!("{error}"),
    };
    if project.overrides.is_empty() {
        let faults = crawl::faults(pages.iter().map(|page| (page.path.as_str(), page.bytes.as_slice())));
        assert!(faults.is_empty(), "{}", faults.join("\n"));
        for page in pages.iter().filter(|page| page.path.ends_with(".html")) {
            harmless(&page.path, &String::from_utf8_lossy(&page.bytes));
        }
    }
}

/// The files in `data`, each headed by a line `=== path`.
fn parts(data: &[u8]) -> Vec<(Option<String>, Vec<u8>)> {
    let lines: Vec<&[u8]> = data.split_inclusive(|byte| *byte == b'\n').collect();
    let part = |lines: &[&[u8]]| {
        let (head, rest) = lines.split_first().map_or((&[][..], &[][..]), |(head, rest)| (*head, rest));
        let name = head.strip_prefix(b"=== ").map(|name| String::from_utf8_lossy(name).trim().to_owned());
        (name.filter(|name| possible(name)), rest.concat())
    };
    lines.chunk_by(|_, line| !line.starts_with(b"=== ")).map(part).collect()
}

/// Whether a file system could give this name.
fn possible(name: &str) -> bool {
    name.len() < 200 && name.split('/').all(|part| !matches!(part, "" | "." | "..") && !part.contains('\0'))
}

/// The only scripts are our own files, and nothing is embedded.
fn harmless(path: &str, page: &str) {
    let lower = page.to_ascii_lowercase();
    for (at, _) in lower.match_indices("<script") {
        let own = ["<script src=\"", "<script defer src=\""].iter().any(|own| lower[at..].starts_with(own));
        assert!(own, "{path}: a script that is not ours at {at}");
    }
    for tag in ["<iframe", "<object", "<embed", "<base", "<style", "<img onerror"] {
        assert!(!lower.contains(tag), "{path}: {tag}");
    }
}
