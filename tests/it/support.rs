//! Trees in memory, and what the tool says of them.

use rungbook::book::view::Book;
use rungbook::config::{ConfigFile, Settings};
use rungbook::pipeline::{self, Project, Stamp};
use rungbook::source::Memory;

/// A tree of files, read with the configuration `config`.
pub(crate) fn project(files: &[(&str, &str)], config: &str) -> Project {
    let fs = files.iter().fold(Memory::new(), |fs, (path, text)| fs.with(path, text));
    let settings = settings(config);
    pipeline::read(&fs, "tree", &settings, &|_| {})
}

/// Settings from the text of a `rungbook.toml`.
pub(crate) fn settings(config: &str) -> Settings {
    Settings::new(ConfigFile::parse(config).expect("a configuration of ours")).expect("a configuration of ours")
}

/// The book of a tree, with a stamp that never changes.
pub(crate) fn book(project: &Project) -> Book {
    let stamp = Stamp {
        date: "2026-01-31".to_owned(),
        commit: "0123abc".to_owned(),
        tool: "rungbook test".to_owned(),
        ..Stamp::default()
    };
    pipeline::book(project, &settings(""), &stamp)
}

/// The findings of `code` in a tree: `file:line:column message`.
pub(crate) fn findings(code: &str, files: &[(&str, &str)], config: &str) -> Vec<String> {
    let project = project(files, config);
    let own = project.findings.iter().filter(|finding| finding.code.name == code);
    own.map(|finding| {
        let at = project.files.line_column(finding.place);
        let file = &project.files.get(finding.place.file).path;
        format!("{file}:{}:{} {}", at.line, at.column, finding.message)
    })
    .collect()
}

/// The findings of `code` in one plain text.
pub(crate) fn in_text(code: &str, text: &str) -> Vec<String> {
    findings(code, &[("a.st", text)], "")
}

/// How many cases a property test runs: 1,000, or what `RUNGBOOK_CASES` says (10,000 in CI).
pub(crate) fn cases() -> u32 {
    cases_or(1_000)
}

/// The same, with another number where nothing is said.
pub(crate) fn cases_or(usual: u32) -> u32 {
    std::env::var("RUNGBOOK_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(usual)
}
