//! Findings as pages see them.

use std::collections::BTreeMap;

use crate::book::view::finding::{CodeCount, FindingView, SkippedView};
use crate::diagnostic::{Finding, Severity};
use crate::text::Files;

/// One finding.
pub(crate) fn view(finding: &Finding, files: &Files) -> FindingView {
    let at = files.line_column(finding.place);
    FindingView {
        code: finding.code.name.to_owned(),
        severity: finding.severity.name(),
        message: finding.message.clone(),
        file: files.get(finding.place.file).path.clone(),
        line: at.line,
        column: at.column,
        help: finding.help.clone(),
    }
}

/// The codes that occur, the worst first, then by name.
pub(crate) fn codes(findings: &[Finding]) -> Vec<CodeCount> {
    let mut counts: BTreeMap<(std::cmp::Reverse<Severity>, &str), (String, usize)> = BTreeMap::new();
    for finding in findings {
        let key = (std::cmp::Reverse(finding.severity), finding.code.name);
        counts.entry(key).or_insert_with(|| (finding.code.title(), 0)).1 += 1;
    }
    let view = |((severity, code), (title, count)): ((std::cmp::Reverse<Severity>, &str), (String, usize))| CodeCount {
        code: code.to_owned(),
        title,
        severity: severity.0.name(),
        count,
    };
    counts.into_iter().map(view).collect()
}

/// The files that should be here.
pub(crate) fn skipped(skipped: &[(String, String)]) -> Vec<SkippedView> {
    skipped.iter().map(|(file, reason)| SkippedView { file: file.clone(), reason: reason.clone() }).collect()
}
