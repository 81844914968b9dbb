//! The summary at the end of a build.

use crate::book::view::{Book, Totals};

/// The lines of the summary.
pub(crate) fn summary(book: &Book, written: &[String]) -> String {
    let totals = &book.totals;
    let mut out = String::new();
    let mut line = |name: &str, text: String| out.push_str(&format!("{name:>12}  {text}\n"));
    line("entities", format!("{} in {}", totals.entities, libraries(totals)));
    line("documented", format!("{} ({} %)", totals.documented, book.coverage.total.documented_percent));
    line("undocumented", totals.undocumented.to_string());
    line("tables", tables(totals));
    line("findings", format!("{} errors, {} warnings, {} infos", totals.errors, totals.warnings, totals.infos));
    line(
        "files",
        format!("{} read, {} skipped, {} not PLC source", totals.files, totals.files_skipped, totals.files_other),
    );
    for (reason, count) in reasons(book) {
        line("", format!("{count} skipped: {reason}"));
    }
    for path in written {
        line("written", path.clone());
    }
    out
}

fn libraries(totals: &Totals) -> String {
    match totals.libraries {
        1 => "1 library".to_owned(),
        n => format!("{n} libraries"),
    }
}

fn tables(totals: &Totals) -> String {
    if totals.tables == 0 {
        return "none".to_owned();
    }
    let verdicts: Vec<String> = totals.verdicts.iter().map(|(name, n)| format!("{n} {name}")).collect();
    format!("{}: {}", totals.tables, verdicts.join(", "))
}

/// The reasons for skipping, the most frequent first.
fn reasons(book: &Book) -> Vec<(&str, usize)> {
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for skipped in &book.skipped {
        match counts.iter_mut().find(|(reason, _)| *reason == skipped.reason) {
            Some((_, n)) => *n += 1,
            None => counts.push((&skipped.reason, 1)),
        }
    }
    counts.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(b.0)));
    counts
}
