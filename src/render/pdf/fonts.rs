//! The fonts, and which characters they have.

use std::collections::BTreeMap;

use typst::foundations::Bytes;
use typst::text::Font;
use typst_kit::fonts::FontStore;

use super::Error;

/// Stands for a character that no font has.
const REPLACEMENT: char = '\u{fffd}';

/// The fonts: the user's first, then the embedded ones.
pub(super) struct Fonts {
    /// For the typesetter.
    pub(super) store: FontStore,
    /// A bit for every code point that some font has.
    covered: Vec<u64>,
}

impl Fonts {
    pub(super) fn new(users: &[Vec<u8>]) -> Result<Self, Error> {
        let mut out = Self { store: FontStore::new(), covered: vec![0; 0x11_0000 / 64] };
        for (index, file) in users.iter().enumerate() {
            let fonts: Vec<Font> = Font::iter(Bytes::new(file.clone())).collect();
            if fonts.is_empty() {
                return Err(Error::Font(index));
            }
            fonts.into_iter().for_each(|font| out.push(font));
        }
        typst_kit::fonts::embedded().for_each(|(font, _)| out.push(font));
        Ok(out)
    }

    fn push(&mut self, font: Font) {
        let info = font.info().clone();
        for code in info.coverage.iter() {
            if let Some(word) = self.covered.get_mut(code as usize / 64) {
                *word |= 1 << (code % 64);
            }
        }
        self.store.push((font, info));
    }

    /// Whether some font has the character.
    fn covers(&self, character: char) -> bool {
        let code = u32::from(character);
        self.covered.get(code as usize / 64).is_some_and(|word| word & (1 << (code % 64)) != 0)
    }
}

/// Makes text printable and counts what it had to replace.
pub(super) struct Printable<'a> {
    fonts: &'a Fonts,
    /// Characters that no font has and how often each was replaced.
    pub(super) replaced: BTreeMap<char, usize>,
}

impl<'a> Printable<'a> {
    pub(super) fn new(fonts: &'a Fonts) -> Self {
        Self { fonts, replaced: BTreeMap::new() }
    }

    /// The text with only characters that can be printed.
    ///
    /// Line breaks and tabs stay. Characters that steer the direction or the form of others are dropped:
    /// unseen, they could make code read as what it is not.
    pub(super) fn text(&mut self, text: &str) -> String {
        if text.bytes().all(|byte| matches!(byte, b' '..=b'~' | b'\n' | b'\t')) {
            return text.to_owned();
        }
        text.chars().filter(|character| !is_dropped(*character)).map(|character| self.character(character)).collect()
    }

    fn character(&mut self, character: char) -> char {
        if matches!(character, '\n' | '\t') || character.is_whitespace() && !character.is_control() {
            return character;
        }
        if !character.is_control() && self.fonts.covers(character) {
            return character;
        }
        *self.replaced.entry(character).or_default() += 1;
        if self.fonts.covers(REPLACEMENT) { REPLACEMENT } else { '?' }
    }
}

/// Whether a character is left out without a trace.
fn is_dropped(character: char) -> bool {
    matches!(
        character,
        '\r' | '\u{ad}'
            | '\u{200b}'..='\u{200f}'
            | '\u{202a}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{fe00}'..='\u{fe0f}'
            | '\u{feff}'
            | '\u{e0000}'..='\u{e0fff}'
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_no_font_has_is_replaced_and_counted() {
        let fonts = Fonts::new(&[]).expect("the embedded fonts are fonts");
        let mut printable = Printable::new(&fonts);
        assert_eq!(printable.text("größer ≤ ω ∞ «»\tx\r\n"), "größer ≤ ω ∞ «»\tx\n");
        assert_eq!(printable.text("温\u{1}温"), "\u{fffd}\u{fffd}\u{fffd}");
        assert_eq!(printable.text("a\u{202e}b\u{200b}c"), "abc");
        let counted: Vec<_> = printable.replaced.into_iter().collect();
        assert_eq!(counted, [('\u{1}', 1), ('温', 2)]);
    }

    #[test]
    fn a_file_that_is_no_font_is_an_error() {
        assert_eq!(Fonts::new(&[b"no font".to_vec()]).err(), Some(Error::Font(0)));
    }
}
