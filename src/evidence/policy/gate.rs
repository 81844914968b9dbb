//! The gate: the numbers that a release has to reach.

use std::collections::BTreeMap;

/// The bar. What is `None` or `false` is not asked for.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// At least so many percent of the entities are documented.
    pub documented: Option<u8>,
    /// At least so many percent of the test tables are verified.
    pub verified: Option<u8>,
    /// No table is violated.
    pub no_violated: bool,
    /// No verdict is stale.
    pub no_stale: bool,
    /// No verified table proves nothing.
    pub no_vacuous: bool,
    /// Every allowance names who answers for it and until when.
    pub no_suppressed_without_owner: bool,
    /// No incompatible change against the compared release.
    pub no_breaking: bool,
    /// No evidence was lost against the compared release.
    pub no_lost_evidence: bool,
}

/// What is measured.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Numbers {
    /// Entities, members included.
    pub entities: usize,
    /// Those with documentation.
    pub documented: usize,
    /// Test tables.
    pub tables: usize,
    /// Test tables by verdict.
    pub verdicts: BTreeMap<String, usize>,
    /// Verified tables that prove nothing.
    pub vacuous: usize,
    /// Where allowances stand that let findings pass although they lack an owner or a day.
    pub allowed_without_owner: Vec<String>,
    /// Incompatible changes, where releases are compared.
    pub breaking: Option<usize>,
    /// Tables whose evidence was lost, where releases are compared.
    pub lost: Option<usize>,
}

/// One line of the gate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// The key in `rungbook.toml`.
    pub key: &'static str,
    /// What is asked for.
    pub wanted: String,
    /// What is there.
    pub found: String,
    /// Whether it is reached.
    pub passed: bool,
}

/// Every line that `options` asks for, in a fixed order.
#[must_use]
pub fn judge(options: &Options, numbers: &Numbers) -> Vec<Line> {
    let count = |word: &str| numbers.verdicts.get(word).copied().unwrap_or(0);
    let mut lines = Vec::new();
    let mut percent = |key, wanted: Option<u8>, part: usize, whole: usize| {
        if let Some(wanted) = wanted {
            // Compared without rounding: 99.6 % of the tables are not 100 %.
            let passed = part * 100 >= usize::from(wanted) * whole;
            let found = if whole == 0 { "there is none".to_owned() } else { format!("{part} of {whole}") };
            lines.push(Line { key, wanted: format!(">= {wanted} %"), found, passed });
        }
    };
    percent("documented", options.documented, numbers.documented, numbers.entities);
    percent("verified", options.verified, count("verified"), numbers.tables);
    let none = |key, asked: bool, found: Option<usize>| found.filter(|_| asked).map(|found| nothing(key, found));
    let owners = options.no_suppressed_without_owner.then(|| without_owner(&numbers.allowed_without_owner));
    let others = [
        none("no-violated", options.no_violated, Some(count("violated"))),
        none("no-stale", options.no_stale, Some(count("stale"))),
        none("no-vacuous", options.no_vacuous, Some(numbers.vacuous)),
        owners,
        none("no-breaking", options.no_breaking, numbers.breaking),
        none("no-lost-evidence", options.no_lost_evidence, numbers.lost),
    ];
    lines.extend(others.into_iter().flatten());
    lines
}

fn nothing(key: &'static str, found: usize) -> Line {
    Line { key, wanted: "none".to_owned(), found: found.to_string(), passed: found == 0 }
}

/// So many places are named; the others are counted.
const NAMED: usize = 5;

fn without_owner(places: &[String]) -> Line {
    let mut line = nothing("no-suppressed-without-owner", places.len());
    if !places.is_empty() {
        let named = places[..places.len().min(NAMED)].join(", ");
        let more = places.len().saturating_sub(NAMED);
        let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
        line.found = format!("{}: {named}{rest}", places.len());
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(verified: usize, tables: usize) -> Numbers {
        let verdicts = [("verified".to_owned(), verified), ("violated".to_owned(), tables - verified)].into();
        Numbers { tables, verdicts, ..Numbers::default() }
    }

    #[test]
    fn percentages_are_not_rounded_up() {
        let options = Options { verified: Some(100), ..Options::default() };
        assert!(!judge(&options, &numbers(999, 1000))[0].passed);
        assert!(judge(&options, &numbers(1000, 1000))[0].passed);
    }

    #[test]
    fn allowances_without_an_owner_are_named() {
        let options = Options { no_suppressed_without_owner: true, ..Options::default() };
        let places: Vec<String> = (1..=7).map(|line| format!("a.st:{line}")).collect();
        let found = |count: usize| {
            let numbers = Numbers { allowed_without_owner: places[..count].to_vec(), ..Numbers::default() };
            let line = judge(&options, &numbers).remove(0);
            (line.passed, line.found)
        };
        assert_eq!(found(0), (true, "0".to_owned()));
        assert_eq!(found(1), (false, "1: a.st:1".to_owned()));
        assert_eq!(found(7), (false, "7: a.st:1, a.st:2, a.st:3, a.st:4, a.st:5 and 2 more".to_owned()));
    }

    #[test]
    fn only_what_is_asked_for_is_judged() {
        assert!(judge(&Options::default(), &numbers(0, 5)).is_empty());
        let options = Options { no_violated: true, no_breaking: true, ..Options::default() };
        let lines = judge(&options, &numbers(4, 5));
        assert_eq!(lines.len(), 1, "nothing is compared, so nothing breaks");
        assert!(!lines[0].passed);
    }
}
