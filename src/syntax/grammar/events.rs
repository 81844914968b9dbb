//! What only the textual form of IEC 61499-1 (annex B) writes: sections of events, and the control chart of a block.
//!
//! They have no counterpart in IEC 61131-3 and are kept as tokens.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::Parser;
use super::names::nth_is_name;
use super::{DECLARATION_ENDS, VAR_KEYWORDS, declarations};

/// How a section begins and ends.
const SECTIONS: [(&str, &str); 6] = [
    ("EVENT_INPUT", "END_EVENT"),
    ("EVENT_OUTPUT", "END_EVENT"),
    ("EC_STATES", "END_STATES"),
    ("EC_TRANSITIONS", "END_TRANSITIONS"),
    ("FBS", "END_FBS"),
    ("EVENT_CONNECTIONS", "END_CONNECTIONS"),
];

/// The word that closes the section that begins here.
fn end_of_section(p: &Parser<'_>) -> Option<&'static str> {
    if !p.at(TokenKind::Ident) || !p.begins_line() || !nth_is_name(p, 1) {
        return None;
    }
    SECTIONS.iter().find(|(begin, _)| p.nth_is_word(0, begin)).map(|(_, end)| *end)
}

/// Whether a section begins here.
pub(super) fn at_section(p: &Parser<'_>) -> bool {
    end_of_section(p).is_some()
}

/// A section, up to the word that closes it or to what cannot stand in it.
pub(super) fn opt_section(p: &mut Parser<'_>) -> bool {
    let Some(end) = end_of_section(p) else { return false };
    let marker = p.start();
    p.bump();
    loop {
        if p.nth_is_word(0, end) {
            p.bump();
            p.eat(TokenKind::Semicolon);
            break;
        }
        let outside = p.at(TokenKind::Eof) || p.at_any(DECLARATION_ENDS) || p.at_any(VAR_KEYWORDS);
        if outside || (p.begins_line() && declarations::declaration_at(p).is_some()) {
            p.expected(&format!("`{end}`"));
            break;
        }
        p.bump();
    }
    p.complete(marker, NodeKind::EventSection);
    true
}
