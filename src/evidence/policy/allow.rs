//! Allowances: a comment or pragma in the source that lets a finding pass, with a reason.
//!
//! ```text
//! // @allow CODE, CODE: reason (owner NAME, until 2027-06-30)
//! {attribute 'rungbook.allow' := 'CODE: reason (owner NAME, until 2027-06-30)'}
//! ```
//!
//! Behind code, it speaks of its own line. On a line of its own it speaks of the next line with code, and where a
//! declaration begins there, of that declaration with its body and its members.

use crate::diagnostic::Finding;
use crate::evidence::codes::{EXPIRED_ALLOWANCE, MALFORMED_ALLOWANCE, UNUSED_ALLOWANCE};
use crate::library::{Catalogue, FragmentId, Item, ItemBody};
use crate::syntax::{Token, TokenKind, Tree};
use crate::text::{Files, Place, Span};

/// What an allowance says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Allowance {
    /// The codes that it lets pass.
    pub codes: Vec<String>,
    /// Why.
    pub reason: String,
    /// Who answers for it; empty if it does not say.
    pub owner: String,
    /// The last day on which it holds, `2027-06-30`; empty if it does not say.
    pub until: String,
    /// Where it stands.
    pub place: Place,
    /// What it speaks of.
    pub scope: Vec<Place>,
}

/// A finding that an allowance lets pass.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Allowed {
    /// The finding.
    pub finding: Finding,
    /// The allowance.
    pub allowance: Allowance,
}

/// Findings, sorted into those that stay and those that pass.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sorted {
    /// Those that stay, with what is wrong with the allowances themselves.
    pub findings: Vec<Finding>,
    /// Those that pass.
    pub allowed: Vec<Allowed>,
}

/// Lets `findings` pass where an allowance that holds on the day `today` says so.
///
/// `known` tells whether a code exists. Where `today` is empty, nothing expires.
#[must_use]
pub fn apply(
    findings: Vec<Finding>,
    catalogue: &Catalogue,
    files: &Files,
    today: &str,
    known: &dyn Fn(&str) -> bool,
) -> Sorted {
    let mut sorted = Sorted::default();
    let mut allowances = Vec::new();
    for found in collect(catalogue, files) {
        match found.and_then(|allowance| check_codes(allowance, known)) {
            Ok(allowance) if expired(&allowance, today) => {
                let message =
                    format!("the allowance of `{}` ran out on {}", allowance.codes.join("`, `"), allowance.until);
                sorted.findings.push(Finding::new(&EXPIRED_ALLOWANCE, allowance.place, message));
            }
            Ok(allowance) => allowances.push((allowance, false)),
            Err((place, message)) => sorted.findings.push(Finding::new(&MALFORMED_ALLOWANCE, place, message)),
        }
    }
    for finding in findings {
        let lets = |(allowance, _): &&mut (Allowance, bool)| {
            let inside = |scope: &Place| scope.file == finding.place.file && covers(scope.span, finding.place.span);
            allowance.codes.iter().any(|code| code == finding.code.name) && allowance.scope.iter().any(inside)
        };
        match allowances.iter_mut().find(lets) {
            Some((allowance, used)) => {
                *used = true;
                sorted.allowed.push(Allowed { finding, allowance: allowance.clone() });
            }
            None => sorted.findings.push(finding),
        }
    }
    for (allowance, _) in allowances.into_iter().filter(|(_, used)| !used) {
        let message = format!("there is no finding `{}` here to allow", allowance.codes.join("`, `"));
        sorted.findings.push(Finding::new(&UNUSED_ALLOWANCE, allowance.place, message));
    }
    sorted
}

fn covers(scope: Span, span: Span) -> bool {
    scope.start <= span.start && span.start <= scope.end
}

fn expired(allowance: &Allowance, today: &str) -> bool {
    !allowance.until.is_empty() && !today.is_empty() && allowance.until.as_str() < today
}

fn check_codes(allowance: Allowance, known: &dyn Fn(&str) -> bool) -> Result<Allowance, (Place, String)> {
    match allowance.codes.iter().find(|code| !known(code)) {
        Some(code) => Err((allowance.place, format!("`{code}` is no finding's code; `rungbook explain` lists them"))),
        None => Ok(allowance),
    }
}

/// All allowances of a tree, or what is wrong with one.
fn collect(catalogue: &Catalogue, files: &Files) -> Vec<Result<Allowance, (Place, String)>> {
    let mut out = Vec::new();
    for (index, source) in catalogue.sources.iter().enumerate() {
        let Some(tree) = source.tree.as_deref() else { continue };
        if !tree.text().contains("allow") {
            continue;
        }
        let fragment = FragmentId(u32::try_from(index).unwrap_or(u32::MAX));
        let mut items: Option<Vec<&Item>> = None;
        for token in tree.tokens().filter(|token| token.kind().is_comment() || token.kind() == TokenKind::Pragma) {
            for (text, at) in texts(token) {
                let span = Span::from(at..at + text.len()).shifted(token.span().start);
                let place = catalogue.place(fragment, span);
                let own = items.get_or_insert_with(|| declared_in(catalogue, fragment));
                let scope = || scope(catalogue, files, fragment, own, tree, token);
                out.push(parse(text).map_err(|message| (place, message)).map(|(codes, reason, owner, until)| {
                    Allowance { codes, reason, owner, until, place, scope: scope() }
                }));
            }
        }
    }
    out
}

fn declared_in(catalogue: &Catalogue, fragment: FragmentId) -> Vec<&Item> {
    let here = |item: &&Item| item.declaration.is_some_and(|declaration| declaration.fragment == fragment);
    catalogue.items.iter().filter(here).collect()
}

/// The texts behind `@allow` in a comment, or in the attribute of a pragma, with their offsets in the token.
fn texts(token: Token<'_>) -> Vec<(&str, usize)> {
    let text = token.text();
    if token.kind() == TokenKind::Pragma {
        let value = text.find("rungbook.allow").and_then(|at| {
            let open = at + text[at..].find(":=")?;
            let from = open + text[open..].find('\'')? + 1;
            let to = text.rfind('\'').filter(|to| *to > from)?;
            Some((&text[from..to], from))
        });
        return value.into_iter().collect();
    }
    let mut out = Vec::new();
    let mut at = 0;
    for line in text.split_inclusive('\n') {
        let inner = line.trim_start_matches([' ', '\t', '/', '*', '(', '!', '#']);
        if let Some(rest) = inner.strip_prefix("@allow").filter(|rest| rest.starts_with([' ', '\t', ':'])) {
            let from = at + line.len() - rest.len();
            let rest = rest.trim_end().trim_end_matches("*)").trim_end_matches("*/").trim_end();
            out.push((rest, from));
        }
        at += line.len();
    }
    out
}

type Parts = (Vec<String>, String, String, String);

/// `CODE, CODE: reason (owner NAME, until DATE)`
fn parse(text: &str) -> Result<Parts, String> {
    let (codes, rest) = text.split_once(':').ok_or("an allowance gives no reason: `@allow CODE: reason`")?;
    let codes: Vec<String> =
        codes.split(',').map(|code| code.trim().to_owned()).filter(|code| !code.is_empty()).collect();
    let (reason, terms) = match rest.trim_end().strip_suffix(')').and_then(|rest| rest.rsplit_once('(')) {
        Some((reason, terms)) if is_terms(terms) => (reason, terms),
        _ => (rest, ""),
    };
    let (mut owner, mut until) = (String::new(), String::new());
    for term in terms.split(',').map(str::trim).filter(|term| !term.is_empty()) {
        match term.split_once(' ') {
            Some(("owner", name)) => name.trim().clone_into(&mut owner),
            Some(("until", day)) if is_day(day.trim()) => day.trim().clone_into(&mut until),
            Some(("until", day)) => return Err(format!("`{}` is no date; write `until 2027-06-30`", day.trim())),
            _ => return Err(format!("`{term}` is neither `owner NAME` nor `until DATE`")),
        }
    }
    let reason = reason.trim().to_owned();
    match (codes.is_empty(), reason.is_empty()) {
        (true, _) => Err("an allowance names no finding: `@allow CODE: reason`".to_owned()),
        (_, true) => Err("an allowance gives no reason: `@allow CODE: reason`".to_owned()),
        _ => Ok((codes, reason, owner, until)),
    }
}

fn is_terms(text: &str) -> bool {
    ["owner ", "until "].iter().any(|word| text.trim_start().starts_with(word))
}

/// Whether `text` is a day of the calendar as ISO 8601 writes it.
fn is_day(text: &str) -> bool {
    let mut parts = text.split('-');
    let mut number = |digits: usize| parts.next().filter(|part| part.len() == digits)?.parse::<u32>().ok();
    let (year, month, day) = (number(4), number(2), number(2));
    let (Some(year), Some(month), Some(day)) = (year, month, day) else { return false };
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let last = match month {
        2 => 28 + u32::from(leap),
        4 | 6 | 9 | 11 => 30,
        1..=12 => 31,
        _ => 0,
    };
    parts.next().is_none() && (1..=last).contains(&day)
}

/// What an allowance in `token` speaks of.
fn scope(
    catalogue: &Catalogue,
    files: &Files,
    fragment: FragmentId,
    items: &[&Item],
    tree: &Tree,
    token: Token<'_>,
) -> Vec<Place> {
    let line = |span: Span| {
        let place = catalogue.place(fragment, span);
        let file = files.get(place.file);
        let line = file.lines.line(place.span.start);
        let end = if (line as usize) < file.lines.lines() { file.lines.line_start(line + 1) } else { u32::MAX };
        Place::new(place.file, Span::new(file.lines.line_start(line), end.saturating_sub(1)))
    };
    let same_line = |a: Span, b: Span| !Span::new(a.end, b.start).of(tree.text()).contains('\n');
    let before = tree.trivia_before(token.index()).last().map_or_else(|| token.previous(), |first| first.previous());
    let before = std::iter::successors(before.or_else(|| token.previous()), |t| t.previous());
    let before = before.into_iter().find(|t| !t.kind().is_trivia());
    if before.is_some_and(|before| same_line(before.span(), token.span())) {
        return vec![line(token.span())];
    }
    let Some(next) = std::iter::successors(token.next(), |t| t.next()).find(|t| !t.kind().is_trivia()) else {
        return vec![line(token.span())];
    };
    let begins = |item: &&&Item| {
        item.declaration.is_some_and(|declaration| {
            let first = first_token(tree, declaration.span);
            first.is_some_and(|first| first.index() == next.index())
        })
    };
    match items.iter().find(begins) {
        Some(item) => extent(catalogue, item),
        None => vec![line(token.span()), line(next.span())],
    }
}

fn first_token(tree: &Tree, span: Span) -> Option<Token<'_>> {
    let at = tree.token_at(span.start)?;
    std::iter::successors(Some(at), |t| t.next()).find(|t| !t.kind().is_trivia())
}

/// The places of an item, its body and its members.
fn extent(catalogue: &Catalogue, item: &Item) -> Vec<Place> {
    let body = match item.body {
        ItemBody::None => None,
        ItemBody::St(excerpt) | ItemBody::Il(excerpt) | ItemBody::Drawn(_, excerpt) => Some(excerpt),
    };
    let own = item.declaration.into_iter().chain(body).map(|excerpt| catalogue.place(excerpt.fragment, excerpt.span));
    let members = item.children.iter().flat_map(|child| extent(catalogue, catalogue.item(*child)));
    own.chain(std::iter::once(item.place)).chain(members).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_allowance_has_codes_reason_owner_and_day() {
        let parsed = parse(" undocumented, missing-brief: made by a tool (v2) (owner R. Vogel, until 2028-02-29)");
        let codes = vec!["undocumented".to_owned(), "missing-brief".to_owned()];
        let expected = (codes, "made by a tool (v2)".to_owned(), "R. Vogel".to_owned(), "2028-02-29".to_owned());
        assert_eq!(parsed, Ok(expected));
        assert_eq!(parse("undocumented: old (see the wiki)").map(|parts| parts.1), Ok("old (see the wiki)".to_owned()));
    }

    #[test]
    fn what_is_missing_is_said() {
        for (text, part) in [
            (" undocumented", "no reason"),
            (" undocumented:  ", "no reason"),
            (" : because", "names no finding"),
            (" undocumented: x (owner A, until 2027-02-29)", "no date"),
            (" undocumented: x (owner A, for ever)", "neither"),
        ] {
            let message = parse(text).expect_err(text);
            assert!(message.contains(part), "{text}: {message}");
        }
    }
}
