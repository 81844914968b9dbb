//! Column widths, planned from the lengths of texts.
//!
//! The typesetter can find widths by itself, but has to lay out every cell for it; fixed widths make
//! long tables three times as fast. Code is monospaced, so a count of characters is exact. A test table
//! that does not fit is set smaller, then on a landscape page, then in several parts.

use serde_json::{Value, json};

use super::Paper;
use crate::book::view::entity::{SectionView, TypePart, VariableView};
use crate::book::view::prose::Inline;
use crate::book::view::table::TableView;

/// The margin at the left and the right of a page, in points.
pub(super) const MARGIN: f64 = 62.0;
/// The advance of a monospaced character in em.
const ADVANCE: f64 = 0.6021;
/// The size of code in parameter tables.
const CODE: f64 = 8.0;
/// The space left and right of a cell's text.
const INSET: f64 = 9.0;

/// The space on a page.
#[derive(Clone, Copy, Debug)]
pub(super) struct Space {
    /// The width of the text.
    pub(super) portrait: f64,
    /// The width of the text on a landscape page.
    pub(super) landscape: f64,
    /// The height of the text.
    pub(super) height: f64,
}

impl Space {
    pub(super) fn of(paper: Paper) -> Self {
        let (width, height) = paper.size();
        Self { portrait: width - 2.0 * MARGIN, landscape: height - 2.0 * MARGIN, height: height - 150.0 }
    }
}

/// The columns of a parameter table: `{ name, type, initial, address, brief }`, null for those that are empty.
pub(super) fn section(view: &SectionView, space: Space) -> Value {
    let longest = |length: fn(&VariableView) -> usize| view.variables.iter().map(length).max().unwrap_or(0);
    let name = column(longest(|variable| variable.name.chars().count()), 64.0, 172.0);
    let type_ = column(longest(|variable| type_length(&variable.type_)), 46.0, 132.0);
    let initial = column(longest(|variable| variable.initial.chars().count()), 48.0, 86.0);
    let address = column(longest(|variable| variable.address.chars().count()), 48.0, 70.0);
    let used = [name, type_, initial, address].into_iter().flatten().sum::<f64>();
    let rest = (space.portrait - used).max(90.0);
    json!({ "name": name, "type": type_, "initial": initial, "address": address, "brief": rest })
}

/// The width of a column of code; `None` if there is none.
fn column(characters: usize, least: f64, most: f64) -> Option<f64> {
    (characters > 0).then(|| (width(characters, CODE)).clamp(least, most))
}

/// The width of a cell of code.
#[expect(clippy::cast_precision_loss, reason = "cells have fewer than 2^52 characters")]
fn width(characters: usize, size: f64) -> f64 {
    (characters as f64 * ADVANCE * size + INSET + 0.5).ceil()
}

/// How many characters of code a planned column holds.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "widths are those of a page")]
fn fitting(columns: &Value, key: &str) -> usize {
    let width = columns.get(key).and_then(Value::as_f64);
    width.map_or(usize::MAX, |width| ((width - INSET) / (ADVANCE * CODE)).floor().max(1.0) as usize)
}

fn type_length(parts: &[TypePart]) -> usize {
    parts.iter().map(|part| part.text.chars().count()).sum()
}

/// Lets the words of a parameter table be broken where they are longer than their column holds.
pub(super) fn fit_section(section: &mut Value) {
    let columns = section.get("columns").cloned().unwrap_or_default();
    let limit = |key| fitting(&columns, key);
    let (name, type_, initial, address) = (limit("name"), limit("type"), limit("initial"), limit("address"));
    each(section, "variables", &mut |variable| {
        soften_field(variable, "name", name);
        soften_field(variable, "initial", initial);
        soften_field(variable, "address", address);
        each(variable, "type_", &mut |part| soften_field(part, "text", type_));
    });
}

/// Does something with each element of a list in a field.
fn each(value: &mut Value, key: &str, f: &mut dyn FnMut(&mut Value)) {
    if let Some(Value::Array(list)) = value.get_mut(key) {
        list.iter_mut().for_each(f);
    }
}

/// Lets the words of a field be broken.
fn soften_field(value: &mut Value, key: &str, limit: usize) {
    if let Some(Value::String(text)) = value.get_mut(key) {
        *text = soften(text, limit);
    }
}

/// Lets words longer than this be broken, by zero-width spaces: after `_`, `.`, `/` and before a
/// capital, and anywhere else if such a place does not come in time.
pub(super) fn soften(text: &str, limit: usize) -> String {
    let text = &text.replace('\u{200b}', "");
    if text.split_whitespace().all(|word| word.len() <= limit || word.chars().count() <= limit) {
        return text.clone();
    }
    let mut out = String::with_capacity(text.len() + 16);
    for piece in text.split_inclusive(char::is_whitespace) {
        if piece.chars().count() > limit { break_word(&mut out, piece, limit) } else { out.push_str(piece) }
    }
    out
}

/// Appends a long word with the places where it may be broken.
fn break_word(out: &mut String, word: &str, limit: usize) {
    let mut before = ' ';
    let mut since = 0;
    for character in word.chars() {
        let natural =
            matches!(before, '_' | '.' | '/' | '-' | ',' | ':') || before.is_lowercase() && character.is_uppercase();
        if since >= limit || (natural && since >= 3) {
            out.push('\u{200b}');
            since = 0;
        }
        out.push(character);
        (before, since) = (character, since + 1);
    }
}

/// The longest cell text that is set on one line even if it could be broken.
const ONE_LINE: usize = 16;
/// The longest word that is not broken.
const WORD: usize = 14;

/// How a test table is set: `{ size, landscape, seq, duration, remark, brackets, parts: [{ columns, widths }] }`.
pub(super) fn table(view: &TableView, space: Space) -> Value {
    let tries = [(8.0, false), (7.0, false), (6.2, false), (7.5, true), (6.5, true), (5.6, true)];
    let whole = tries.into_iter().find_map(|(size, landscape)| {
        let frame = Frame::new(view, size, if landscape { space.landscape } else { space.portrait });
        let columns = frame.columns(view);
        (columns.iter().sum::<f64>() <= frame.room()).then(|| frame.plan(landscape, vec![(0, columns)]))
    });
    whole.unwrap_or_else(|| {
        let frame = Frame::new(view, 7.0, space.landscape);
        frame.plan(true, split(&frame.columns(view), frame.room()))
    })
}

/// Cuts columns into parts that fit, about equally wide.
fn split(columns: &[f64], room: f64) -> Vec<(usize, Vec<f64>)> {
    let parts = cut(columns, room).len();
    #[expect(clippy::cast_precision_loss, reason = "a table has few parts")]
    let even = columns.iter().sum::<f64>() / parts.max(1) as f64;
    let widest = columns.iter().copied().fold(0.0, f64::max);
    let balanced = cut(columns, (even + widest).min(room));
    if balanced.len() == parts { balanced } else { cut(columns, room) }
}

/// Cuts columns as late as the room allows.
fn cut(columns: &[f64], room: f64) -> Vec<(usize, Vec<f64>)> {
    let mut parts: Vec<(usize, Vec<f64>)> = Vec::new();
    let mut used = f64::INFINITY;
    for (index, &width) in columns.iter().enumerate() {
        if used + width > room {
            parts.push((index, Vec::new()));
            used = 0.0;
        }
        used += width;
        if let Some((_, part)) = parts.last_mut() {
            part.push(width.min(room));
        }
    }
    parts
}

/// What surrounds the columns of a test table.
struct Frame {
    size: f64,
    total: f64,
    seq: f64,
    duration: f64,
    remark: f64,
    brackets: Vec<f64>,
}

impl Frame {
    fn new(view: &TableView, size: f64, total: f64) -> Self {
        let rows = || view.rows.iter();
        let seq = rows().map(|row| row.seq.chars().count()).chain([4]).max().unwrap_or(4).min(12);
        let duration = rows().map(|row| row.duration.chars().count()).chain([8]).max().unwrap_or(8).min(14);
        let remark = rows().map(|row| Inline::plain(&row.remark).chars().count()).max().unwrap_or(0);
        let depth = view.brackets.iter().map(|bracket| bracket.depth as usize + 1).max().unwrap_or(0).min(12);
        let label = |depth: usize| {
            let labels = view.brackets.iter().filter(|bracket| bracket.depth as usize == depth);
            labels.map(|bracket| bracket.label.chars().count()).max().unwrap_or(1).clamp(1, 10)
        };
        let brackets = (0..depth).rev().map(|depth| width(label(depth), size) + 2.0).collect();
        let remark = if remark == 0 { 0.0 } else { width(remark, size * 0.8).clamp(60.0, total * 0.3) };
        Self { size, total, seq: width(seq, size), duration: width(duration, size), remark, brackets }
    }

    /// The width that is left for the columns.
    fn room(&self) -> f64 {
        let brackets: f64 = self.brackets.iter().map(|label| label + 6.0).sum();
        self.total - self.seq - self.duration - self.remark - brackets
    }

    /// The widths of the columns.
    fn columns(&self, view: &TableView) -> Vec<f64> {
        let longest = |index: usize| {
            let cells = view.rows.iter().filter_map(|row| row.cells.get(index)).map(|cell| cell.text.as_str());
            let column = view.columns.get(index);
            let texts = cells
                .chain(column.map(|column| column.name.as_str()))
                .chain(column.map(|column| column.type_.as_str()));
            texts.map(needed).max().unwrap_or(1).max(2)
        };
        (0..view.columns.len()).map(|index| width(longest(index), self.size)).collect()
    }

    fn plan(&self, landscape: bool, parts: Vec<(usize, Vec<f64>)>) -> Value {
        let part = |(first, widths): (usize, Vec<f64>)| {
            let columns: Vec<usize> = (first..first + widths.len()).collect();
            json!({ "columns": columns, "widths": widths })
        };
        json!({
            "size": self.size,
            "landscape": landscape,
            "seq": self.seq,
            "duration": self.duration,
            "remark": self.remark,
            "brackets": self.brackets,
            "parts": parts.into_iter().map(part).collect::<Vec<Value>>(),
        })
    }
}

/// The characters that a cell needs beside each other.
fn needed(text: &str) -> usize {
    let length = text.chars().count();
    let word = text.split_whitespace().map(|word| word.chars().count()).max().unwrap_or(0);
    if length <= ONE_LINE { length.min(word.max(WORD)) } else { ONE_LINE }
}

/// The longest name of a column that its header shows whole: a header is repeated on every page.
const HEAD: usize = 96;

/// Cuts a column's name if it is long; the whole goes to `full`, for a legend.
fn clip_head(column: &mut Value) {
    let Value::Object(column) = column else { return };
    let name = column.get("name").and_then(Value::as_str).unwrap_or_default().replace('\u{200b}', "");
    if name.chars().count() > HEAD {
        let short: String = name.chars().take(HEAD - 1).chain(['…']).collect();
        column.insert("name".to_owned(), short.into());
        column.insert("full".to_owned(), name.into());
    }
}

/// Lets the long words of a test table be broken.
pub(super) fn fit_table(table: &mut Value) {
    each(table, "columns", &mut |column| {
        clip_head(column);
        ["name", "type_"].iter().for_each(|key| soften_field(column, key, WORD));
        soften_field(column, "full", 60);
    });
    each(table, "rows", &mut |row| {
        ["seq", "duration"].iter().for_each(|key| soften_field(row, key, WORD));
        each(row, "cells", &mut |cell| soften_field(cell, "text", WORD));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_words_stay_and_long_ones_get_places_to_break() {
        assert_eq!(soften("short words", 8), "short words");
        assert_eq!(soften("fb_LongNameHere x", 8), "fb_\u{200b}Long\u{200b}Name\u{200b}Here x");
        assert_eq!(soften("aaaaaaaaaa", 4), "aaaa\u{200b}aaaa\u{200b}aa");
    }

    #[test]
    fn softening_only_adds_breaks() {
        for limit in 1..20 {
            let text = "Pkg.FB_VeryLongName  and\nother/things-here größer";
            assert_eq!(soften(text, limit).replace('\u{200b}', ""), text);
        }
    }

    #[test]
    fn columns_are_cut_where_they_no_longer_fit_and_evenly() {
        let widths = |parts: Vec<(usize, Vec<f64>)>| {
            parts.into_iter().map(|(first, list)| (first, list.len())).collect::<Vec<_>>()
        };
        assert_eq!(widths(cut(&[40.0, 40.0, 40.0, 200.0, 10.0], 100.0)), [(0, 2), (2, 1), (3, 1), (4, 1)]);
        assert_eq!(widths(cut(&[10.0; 11], 100.0)), [(0, 10), (10, 1)]);
        assert_eq!(widths(split(&[10.0; 11], 100.0)), [(0, 6), (6, 5)]);
        assert_eq!(cut(&[200.0], 100.0), [(0, vec![100.0])]);
    }
}
