//! `rungbook explain`: the page of a code, or how an entity's documentation was chosen.

use std::path::Path;

use crate::audit;
use crate::cli::args::{ExplainArgs, TreeArgs};
use crate::cli::report::progress::Progress;
use crate::cli::{Exit, Failure, print, tree};
use crate::docs::{Considered, Entry, Verdict};
use crate::pipeline::Project;

pub(crate) fn run(args: &ExplainArgs) -> Result<Exit, Failure> {
    let Some(what) = &args.what else {
        let line =
            |code: &&crate::diagnostic::Code| format!("{:28} {:8} {}\n", code.name, code.severity.name(), code.title());
        print(&audit::codes().iter().map(line).collect::<String>());
        return Ok(Exit::Ok);
    };
    if let Some(code) = audit::code(what) {
        print(&code.text());
        return Ok(Exit::Ok);
    }
    entity(what, &args.dir)
}

/// Which comment documents `name` and why the others do not.
fn entity(name: &str, dir: &Path) -> Result<Exit, Failure> {
    let args = TreeArgs { dir: dir.to_owned(), config: None, quiet: false };
    let progress = Progress::new(false);
    let (project, _) = tree::read(&args, None, &progress)?;
    progress.event(crate::pipeline::Event::Done);
    let wanted = name.to_lowercase();
    let mut out = String::new();
    for (id, item) in project.catalogue.iter().filter(|(_, item)| !item.kind.is_accessor()) {
        let qualified = project.catalogue.qualified_name(id);
        if qualified.to_lowercase() != wanted && item.name.to_lowercase() != wanted {
            continue;
        }
        let at = project.files.line_column(item.place);
        let file = &project.files.get(item.place.file).path;
        out.push_str(&format!("{} {qualified}\n  {file}:{}:{}\n", item.kind.label(), at.line, at.column));
        out.push_str(&story(&project, project.docs.item(id)));
    }
    if out.is_empty() {
        let message = format!("`{name}` is neither a finding's code nor an entity of `{}`", dir.display());
        return Err(Failure(format!("{message}; `rungbook explain` lists the codes")));
    }
    print(&out);
    Ok(Exit::Ok)
}

fn story(project: &Project, entry: &Entry) -> String {
    let mut out = String::new();
    if let Some(from) = entry.inherited_from {
        out.push_str(&format!("  documented by `{}`\n", project.catalogue.qualified_name(from)));
    }
    for considered in &entry.considered {
        out.push_str(&line(project, considered));
    }
    if entry.considered.is_empty() {
        out.push_str("  no comment stands where documentation is looked for\n");
    }
    if entry.doc.is_none() {
        out.push_str("  not documented\n");
    }
    out
}

fn line(project: &Project, considered: &Considered) -> String {
    let at = project.files.line_column(considered.place);
    let end = crate::text::Place::new(
        considered.place.file,
        crate::text::Span::at(considered.place.span.end.saturating_sub(1)),
    );
    let last = project.files.line_column(end).line;
    let lines = if last > at.line { format!("lines {} to {last}", at.line) } else { format!("line {}", at.line) };
    match considered.verdict {
        Verdict::Taken(convention) => format!("  taken: {lines}, read as {}\n", convention.key()),
        Verdict::Rejected(reason) => format!("  not taken: {lines}, {}\n", reason.text()),
    }
}
