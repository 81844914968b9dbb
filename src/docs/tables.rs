//! Test tables in comments.
//!
//! A table is a line `@gtt NAME (…)` with the lines of a pipe table below it, or a fenced block
//! whose language is `gtt`. It is cut out of the prose (the prose keeps no mark of it) and handed on
//! as text. `@gtt path` without a table below names a file.

use std::ops::Range;

use super::mapped::{Mapped, trim};
use super::model::TableText;
use crate::text::Place;

/// What was cut out of a comment.
#[derive(Default)]
pub(super) struct Tables {
    pub(super) tables: Vec<TableText>,
    pub(super) paths: Vec<(String, Place)>,
}

/// Cuts the tables out of `text`.
pub(super) fn cut(text: &Mapped, out: &mut Tables) -> Mapped {
    let lines = text.lines();
    let mut kept = Mapped::beside(text);
    let mut i = 0;
    while i < lines.len() {
        let line = &text.as_str()[lines[i].clone()];
        let end = match fence(line) {
            Some((mark, "gtt", name)) => {
                let end = fence_end(text, &lines, i, mark);
                fenced(text, &lines[i..end], mark, name, out);
                end
            }
            Some((mark, _, _)) => {
                let end = fence_end(text, &lines, i, mark);
                keep(&mut kept, text, lines[i].start..lines[end - 1].end);
                i = end;
                continue;
            }
            None => match heading(line) {
                Some(at) => tagged(text, &lines, i, lines[i].start + at, out),
                None => {
                    keep(&mut kept, text, lines[i].clone());
                    i + 1
                }
            },
        };
        if end > i + 1 || heading(line).is_some() {
            keep(&mut kept, text, lines[i].start..lines[i].start);
        }
        i = end;
    }
    kept
}

fn keep(kept: &mut Mapped, text: &Mapped, range: Range<usize>) {
    if !kept.as_str().is_empty() {
        kept.add("\n");
    }
    kept.append(text, range);
}

/// The offset behind `@gtt` if the line begins with it.
fn heading(line: &str) -> Option<usize> {
    let space = line.len() - line.trim_start().len();
    let rest = line[space..].strip_prefix("@gtt")?;
    (rest.is_empty() || rest.starts_with([' ', '\t', ':'])).then_some(space + "@gtt".len())
}

/// The mark, the language and the rest of the line that opens a fence.
fn fence(line: &str) -> Option<(&str, &str, &str)> {
    let line = line.trim();
    let mark = line.chars().next().filter(|c| matches!(c, '`' | '~'))?;
    let len = line.chars().take_while(|c| *c == mark).count();
    let info = line[len..].trim();
    if len < 3 || info.contains('`') {
        return None;
    }
    let (language, rest) = info.split_once(char::is_whitespace).unwrap_or((info, ""));
    Some((&line[..len], language, rest))
}

/// The line after the one that closes the fence opened on line `i`.
fn fence_end(text: &Mapped, lines: &[Range<usize>], i: usize, mark: &str) -> usize {
    let closes = |line: &Range<usize>| {
        let line = text.as_str()[line.clone()].trim();
        line.starts_with(mark) && line.chars().all(|c| mark.starts_with(c))
    };
    lines[i + 1..].iter().position(closes).map_or(lines.len(), |at| i + 1 + at + 1)
}

fn is_row(text: &Mapped, line: &Range<usize>) -> bool {
    text.as_str()[line.clone()].trim_start().starts_with('|')
}

/// Reads the table under `@gtt` on line `i`, whose heading begins at `at`; gives the line after it.
fn tagged(text: &Mapped, lines: &[Range<usize>], i: usize, at: usize, out: &mut Tables) -> usize {
    let blank = |line: &Range<usize>| text.as_str()[line.clone()].trim().is_empty();
    let mut first = i + 1;
    if lines.get(first).is_some_and(blank) && lines.get(first + 1).is_some_and(|line| is_row(text, line)) {
        first += 1;
    }
    let count = lines[first.min(lines.len())..].iter().take_while(|line| is_row(text, line)).count();
    let name = trim(text.as_str(), at..lines[i].end);
    let name = name.end - text.as_str()[name.clone()].trim_start_matches(':').trim_start().len()..name.end;
    let heading = &text.as_str()[name.clone()];
    if count == 0 && is_path(heading) {
        out.paths.push((heading.to_owned(), text.place(name)));
        return i + 1;
    }
    let head = trim(text.as_str(), lines[i].clone());
    let mut table = text.slice(head.clone());
    for row in &lines[first.min(lines.len())..first.min(lines.len()) + count] {
        table.add("\n");
        table.append(text, trim(text.as_str(), row.clone()));
    }
    let end = if count == 0 { i + 1 } else { first + count };
    let place = text.place(head.start..lines[end - 1].end);
    out.tables.push(TableText {
        heading: heading.to_owned(),
        map: table.map(),
        text: table.as_str().to_owned(),
        place,
    });
    end
}

/// Whether the words after `@gtt` name a file.
fn is_path(text: &str) -> bool {
    let name = text.rsplit(['/', '\\']).next().unwrap_or(text);
    let extension = name.rsplit_once('.').map_or("", |(_, extension)| extension);
    let known = ["gtt", "md", "xlsx", "ods", "csv", "xml"].contains(&extension.to_lowercase().as_str());
    !text.is_empty() && (known || !text.contains(char::is_whitespace) && text.contains(['/', '\\', '.']))
}

/// Reads a fenced block, whose lines are `lines` with both fences.
fn fenced(text: &Mapped, lines: &[Range<usize>], mark: &str, name: &str, out: &mut Tables) {
    let closed =
        lines.len() > 1 && lines.last().is_some_and(|line| text.as_str()[line.clone()].trim().starts_with(mark));
    let body = &lines[1..lines.len() - usize::from(closed)];
    let mut i = 0;
    let before = out.tables.len() + out.paths.len();
    while i < body.len() {
        i = match heading(&text.as_str()[body[i].clone()]) {
            Some(at) => tagged(text, body, i, body[i].start + at, out),
            None => i + 1,
        };
    }
    if out.tables.len() + out.paths.len() > before {
        return;
    }
    let mut table = Mapped::beside(text);
    for (i, line) in body.iter().enumerate() {
        if i > 0 {
            table.add("\n");
        }
        table.append(text, line.clone());
    }
    let place = text.place(lines[0].start..lines[lines.len() - 1].end);
    out.tables.push(TableText { heading: name.to_owned(), map: table.map(), text: table.as_str().to_owned(), place });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::{FileId, Span};

    fn read(source: &str) -> (String, Tables) {
        let mut text = Mapped::new(FileId(0));
        text.push(source, 100);
        let mut out = Tables::default();
        let rest = cut(&text, &mut out);
        (rest.as_str().to_owned(), out)
    }

    #[test]
    fn a_table_is_cut_out_with_its_way_back() {
        let (rest, out) = read("Brief.\n\n  @gtt Runs (cycle 10ms)\n  | in A |\n  |------|\nMore.");
        assert_eq!(rest, "Brief.\n\n\nMore.");
        let table = &out.tables[0];
        assert_eq!(table.heading, "Runs (cycle 10ms)");
        assert_eq!(table.text, "@gtt Runs (cycle 10ms)\n| in A |\n|------|");
        assert_eq!(table.map.span(Span::new(23, 31)), Span::new(135, 143));
    }

    #[test]
    fn a_path_is_a_path() {
        let (_, out) = read("@gtt tables/fb cylinder.gtt");
        assert_eq!(out.paths[0].0, "tables/fb cylinder.gtt");
        assert!(out.tables.is_empty());
    }

    #[test]
    fn a_heading_without_rows_is_a_table_that_its_reader_will_refuse() {
        let (_, out) = read("@gtt Extends in time");
        assert_eq!(out.tables[0].text, "@gtt Extends in time");
    }

    #[test]
    fn a_fence_is_a_table_and_another_fence_is_none() {
        let (rest, out) = read("```gtt Runs\n| in A |\n```\n```\n@gtt x\n```");
        assert_eq!(out.tables[0].heading, "Runs");
        assert_eq!(out.tables[0].text, "| in A |");
        assert_eq!(out.tables.len(), 1);
        assert!(rest.contains("@gtt x"));
    }
}
