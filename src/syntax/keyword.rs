//! Keyword lookup without allocation: a hash table that the compiler fills.
//!
//! The hash looks at the length and four bytes with their case bit cleared; collisions go to the next free
//! slot. Most names hit an empty slot and cost one look.

use super::kind::{KEYWORDS, TokenKind};

const SLOTS: usize = 1024;
const EMPTY: u8 = u8::MAX;

static TABLE: [u8; SLOTS] = table();

const LONGEST: usize = longest();

/// The keyword that `word` is, in any mix of upper and lower case.
pub(super) fn keyword(word: &str) -> Option<TokenKind> {
    let bytes = word.as_bytes();
    if bytes.is_empty() || bytes.len() > LONGEST {
        return None;
    }
    let mut slot = hash(bytes);
    loop {
        let (text, kind) = *KEYWORDS.get(usize::from(TABLE[slot]))?;
        if text.eq_ignore_ascii_case(word) {
            return Some(kind);
        }
        slot = (slot + 1) % SLOTS;
    }
}

const fn hash(bytes: &[u8]) -> usize {
    let n = bytes.len();
    let mut hash = n as u32;
    hash = hash.wrapping_mul(31).wrapping_add(fold(bytes[0]));
    hash = hash.wrapping_mul(31).wrapping_add(fold(bytes[n / 3]));
    hash = hash.wrapping_mul(31).wrapping_add(fold(bytes[n * 2 / 3]));
    hash = hash.wrapping_mul(31).wrapping_add(fold(bytes[n - 1]));
    (hash ^ (hash >> 9)) as usize % SLOTS
}

const fn fold(byte: u8) -> u32 {
    (byte & 0xDF) as u32
}

const fn table() -> [u8; SLOTS] {
    assert!(KEYWORDS.len() < EMPTY as usize, "a slot holds a keyword's index in one byte");
    let mut table = [EMPTY; SLOTS];
    let mut i = 0;
    while i < KEYWORDS.len() {
        let mut slot = hash(KEYWORDS[i].0.as_bytes());
        while table[slot] != EMPTY {
            slot = (slot + 1) % SLOTS;
        }
        table[slot] = i as u8;
        i += 1;
    }
    table
}

const fn longest() -> usize {
    let mut longest = 0;
    let mut i = 0;
    while i < KEYWORDS.len() {
        let n = KEYWORDS[i].0.len();
        longest = if n > longest { n } else { longest };
        i += 1;
    }
    longest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_keyword_is_found_in_any_case() {
        for (text, kind) in KEYWORDS {
            assert_eq!(keyword(text), Some(*kind), "{text}");
            assert_eq!(keyword(&text.to_lowercase()), Some(*kind), "{text}");
        }
    }

    #[test]
    fn a_longer_or_shorter_word_is_a_name() {
        for (text, _) in KEYWORDS {
            assert_eq!(keyword(&format!("{text}_x")), None, "{text}");
        }
        assert_eq!(keyword(""), None);
        assert_eq!(keyword("ELSIFF"), None);
    }
}
