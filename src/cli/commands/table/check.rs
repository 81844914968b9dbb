//! `rungbook table check`: reads tables and reports what is wrong with them.

use super::CheckArgs;
use crate::cli::report::{json, text};
use crate::cli::{Exit, Failure, commands::check, print, say};
use crate::table::lint;
use crate::text::Files;

pub(super) fn run(args: &CheckArgs) -> Result<Exit, Failure> {
    let reading = args.read.reading()?;
    let mut files = Files::default();
    let (mut all, mut count) = (Vec::new(), 0);
    for path in &args.files {
        let read = super::tables(path, &reading, &mut files)?;
        count += read.tables.len();
        let mut own = read.findings;
        own.extend(read.tables.iter().filter(|table| !table.has_errors()).flat_map(lint::lint));
        own.sort_by_key(|finding| finding.place);
        all.append(&mut own);
    }
    let deny = check::severity(args.deny);
    let failed = all.iter().any(|finding| finding.severity >= deny);
    match args.format {
        crate::cli::args::Output::Json => print(&json::findings(&all, &files, failed)),
        crate::cli::args::Output::Text => text::findings(all.iter(), &files),
    }
    let of = |severity| all.iter().filter(|finding| finding.severity == severity).count();
    say(&format!("{count} tables, {}", text::counts(of)));
    Ok(if failed { Exit::Findings } else { Exit::Ok })
}
