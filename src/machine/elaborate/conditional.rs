//! Conditional pragmas, `{IF defined (X)} … {ELSE} … {END_IF}`: which tokens they leave out.
//!
//! A condition is `defined (…)` with `NOT`, `AND`, `OR` and parentheses; `defined (variable: …)` and its relatives, and
//! `hasvalue`, do not hold. A symbol is defined if the options say so.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use crate::syntax::ast::pragma_text;
use crate::syntax::{Node, TokenKind, Tree};

/// Half-open ranges of tokens.
type Ranges = Vec<(u32, u32)>;

/// The ranges of tokens that are left out, for each tree that was asked for.
pub(super) struct Excluded {
    symbols: BTreeSet<String>,
    known: RefCell<BTreeMap<usize, Rc<Ranges>>>,
}

impl Excluded {
    pub(super) fn new(symbols: &BTreeSet<String>) -> Self {
        let symbols = symbols.iter().map(|symbol| symbol.to_ascii_lowercase()).collect();
        Self { symbols, known: RefCell::default() }
    }

    pub(super) fn holds(&self, key: usize, node: Node<'_>) -> bool {
        let known = self.known.borrow().get(&key).cloned();
        let ranges = known.unwrap_or_else(|| {
            let ranges = Rc::new(ranges(node.tree(), &self.symbols));
            self.known.borrow_mut().insert(key, Rc::clone(&ranges));
            ranges
        });
        let at = node.first_token();
        ranges.iter().any(|(from, to)| *from <= at && at < *to)
    }
}

/// An open `IF`: whether a branch was taken, and where the part that is left out begins.
struct Open {
    taken: bool,
    from: Option<u32>,
}

fn ranges(tree: &Tree, symbols: &BTreeSet<String>) -> Ranges {
    let mut out = Vec::new();
    let mut open: Vec<Open> = Vec::new();
    for token in tree.tokens().filter(|token| token.kind() == TokenKind::Pragma) {
        let text = pragma_text(token);
        let (word, rest) =
            text.split_at(text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len()));
        let at = token.index();
        match word.to_ascii_uppercase().as_str() {
            "IF" => {
                let taken = condition(rest, symbols);
                open.push(Open { taken, from: (!taken).then_some(at) });
            }
            "ELSIF" | "ELSE" => {
                let Some(last) = open.last_mut() else { continue };
                out.extend(last.from.take().map(|from| (from, at)));
                let holds = !last.taken && (word.eq_ignore_ascii_case("ELSE") || condition(rest, symbols));
                last.from = (!holds).then_some(at);
                last.taken |= holds;
            }
            "END_IF" => {
                let last = open.pop();
                out.extend(last.and_then(|last| last.from).map(|from| (from, at)));
            }
            _ => {}
        }
    }
    out
}

/// The words and signs of a condition.
fn words(text: &str) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    let mut word = String::new();
    for c in text.chars().chain([' ']) {
        if c.is_alphanumeric() || matches!(c, '_' | '.') {
            word.push(c.to_ascii_lowercase());
            continue;
        }
        if !word.is_empty() {
            out.push(std::mem::take(&mut word));
        }
        if !c.is_whitespace() {
            out.push(c.to_string());
        }
    }
    out
}

fn condition(text: &str, symbols: &BTreeSet<String>) -> bool {
    let words = words(text);
    let mut at = 0;
    disjunction(&words, &mut at, symbols)
}

fn eat(words: &[String], at: &mut usize, word: &str) -> bool {
    let found = words.get(*at).is_some_and(|next| next == word);
    *at += usize::from(found);
    found
}

fn disjunction(words: &[String], at: &mut usize, symbols: &BTreeSet<String>) -> bool {
    let mut value = conjunction(words, at, symbols);
    while eat(words, at, "or") {
        value |= conjunction(words, at, symbols);
    }
    value
}

fn conjunction(words: &[String], at: &mut usize, symbols: &BTreeSet<String>) -> bool {
    let mut value = factor(words, at, symbols);
    while eat(words, at, "and") {
        value &= factor(words, at, symbols);
    }
    value
}

fn factor(words: &[String], at: &mut usize, symbols: &BTreeSet<String>) -> bool {
    if eat(words, at, "not") {
        return *at < words.len() && !factor(words, at, symbols);
    }
    if eat(words, at, "defined") {
        eat(words, at, "(");
        let start = *at;
        while *at < words.len() && !eat(words, at, ")") {
            *at += 1;
        }
        let inner = words.get(start..at.saturating_sub(1)).unwrap_or_default();
        return matches!(inner, [symbol] if symbols.contains(symbol));
    }
    if eat(words, at, "(") {
        let value = disjunction(words, at, symbols);
        eat(words, at, ")");
        return value;
    }
    *at += 1;
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conditions() {
        let symbols: BTreeSet<String> = ["debug".to_owned()].into();
        for (text, expected) in [
            ("defined (DEBUG)", true),
            ("defined(Release)", false),
            ("NOT defined (Release) AND defined (DEBUG)", true),
            ("(defined (A) OR defined (Debug))", true),
            ("defined (variable: x)", false),
            ("hasvalue (X, '1')", false),
            ("", false),
            ("not", false),
        ] {
            assert_eq!(condition(text, &symbols), expected, "{text}");
        }
    }
}
