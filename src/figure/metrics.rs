//! How wide a text is, without a font at hand.
//!
//! Figures are set in a monospaced font whose advance is 0.602 em (DejaVu Sans Mono; the system fonts
//! that `ui-monospace` stands for are as wide or narrower). A character takes one cell, East Asian
//! wide ones two, combining marks none: enough of Unicode's annex 11 to keep boxes around their text.

use super::TextStyle;

/// The advance of a cell in em.
const ADVANCE: f64 = 0.602;

/// Ranges of characters that take no cell: controls, combining marks, joiners, variation selectors.
const ZERO: &[(u32, u32)] = &[
    (0x0300, 0x036F),
    (0x0483, 0x0489),
    (0x0591, 0x05BD),
    (0x0610, 0x061A),
    (0x064B, 0x065F),
    (0x200B, 0x200F),
    (0x202A, 0x202E),
    (0x2060, 0x2064),
    (0x20D0, 0x20F0),
    (0xFE00, 0xFE0F),
    (0xFE20, 0xFE2F),
];

/// Ranges of characters that take two cells.
const WIDE: &[(u32, u32)] = &[
    (0x1100, 0x115F),
    (0x2E80, 0x303E),
    (0x3041, 0x33FF),
    (0x3400, 0x4DBF),
    (0x4E00, 0x9FFF),
    (0xA000, 0xA4CF),
    (0xAC00, 0xD7A3),
    (0xF900, 0xFAFF),
    (0xFE30, 0xFE6F),
    (0xFF00, 0xFF60),
    (0xFFE0, 0xFFE6),
    (0x1F300, 0x1F64F),
    (0x1F900, 0x1F9FF),
    (0x20000, 0x3FFFD),
];

/// How many cells a character takes.
fn cells_of(character: char) -> usize {
    let code = u32::from(character);
    let within = |ranges: &[(u32, u32)]| ranges.iter().any(|&(low, high)| (low..=high).contains(&code));
    if within(ZERO) {
        0
    } else if within(WIDE) {
        2
    } else {
        1
    }
}

/// How many cells a text takes.
pub(super) fn cells(text: &str) -> usize {
    text.chars().map(cells_of).sum()
}

/// How wide a text is in user units.
#[expect(clippy::cast_precision_loss, reason = "a text of 2^52 cells is not drawn")]
pub(super) fn width(text: &str, style: TextStyle) -> f64 {
    cells(text) as f64 * ADVANCE * style.size
}

/// The text in at most `limit` cells: whole, or cut with an ellipsis.
pub(super) fn clip(text: &str, limit: usize) -> String {
    if cells(text) <= limit {
        return text.to_owned();
    }
    let mut out = String::new();
    let mut used = 0;
    for character in text.chars() {
        used += cells_of(character);
        if used >= limit {
            break;
        }
        out.push(character);
    }
    out.push('…');
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::Paint;

    #[test]
    fn wide_and_combining_characters_are_counted() {
        assert_eq!(cells("bStart"), 6);
        assert_eq!(cells("温度"), 4);
        assert_eq!(cells("e\u{301}"), 1);
    }

    #[test]
    fn a_clipped_text_fits_and_says_so() {
        assert_eq!(clip("nCounter", 8), "nCounter");
        assert_eq!(clip("nCounter", 5), "nCou…");
        assert_eq!(clip("温度温度", 5), "温度…");
        assert!((0..20).all(|limit| cells(&clip("温度nCounter温度", limit)) <= limit.max(1)));
    }

    #[test]
    fn width_scales_with_the_font() {
        let style = TextStyle::new(10.0, Paint::Ink);
        assert!((width("abcd", style) - 24.08).abs() < 1e-9);
    }
}
