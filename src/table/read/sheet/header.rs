//! The headers of sheets, and the text of pipe tables that is made of what stands below them.

use super::{Grid, GridCell, Made, guessed, saturate, unmerged};
use crate::table::read::{Mapping, pipe};

/// What a heading of the upper line stands for, as the header of a pipe table spells it.
fn group(text: &str) -> Option<&'static str> {
    Some(match text.trim().trim_end_matches('.').to_lowercase().as_str() {
        "input" | "inputs" | "in" | "eingang" | "eingänge" | "entrées" => "in",
        "output" | "outputs" | "out" | "ausgang" | "ausgänge" | "sorties" => "out",
        "state" | "states" => "state",
        "state!" => "state!",
        "duration" | "dur" | "dauer" | "time" => "dur",
        "remark" | "remarks" | "comment" | "bemerkung" | "purpose" => "remark",
        "repeat" | "block" => "repeat",
        "seq" | "#" | "no" | "nr" | "row" | "step" => "#",
        _ => return None,
    })
}

/// What each column of a table is, and how many lines its header takes.
struct Header {
    /// The header cell of a pipe table for each column; `None` for a column that is left out.
    columns: Vec<Option<String>>,
    lines: usize,
}

pub(super) fn make(grid: &Grid, name: &str, mapping: Option<&Mapping>) -> Made {
    let mut made = Made::default();
    let mut heading: Option<GridCell> = None;
    let mut at = 0;
    while at < grid.len() {
        if let Some(cell) = grid[at].iter().find(|cell| cell.text.starts_with("@gtt")) {
            heading = Some(cell.clone());
            at += 1;
            continue;
        }
        let found = match mapping {
            Some(mapping) => mapped(mapping, grid, at),
            None => header(&grid[at..]),
        };
        let Some(header) = found else {
            at += 1;
            continue;
        };
        let plain = GridCell { text: format!("@gtt {name}"), ..grid[at].first().cloned().unwrap_or_default() };
        made.cell(&heading.take().unwrap_or(GridCell { notes: Vec::new(), ..plain }), false);
        made.glue("\n", made.end);
        at = made.table(grid, at, &header);
    }
    made
}

/// The header that a mapping says, if it is the line `at`.
fn mapped(mapping: &Mapping, grid: &Grid, at: usize) -> Option<Header> {
    let line = grid.get(at)?;
    if mapping.header.is_some_and(|wanted| wanted != at + 1) {
        return None;
    }
    let width = grid[at..].iter().map(Vec::len).max().unwrap_or(0);
    let mut columns = vec![None; width];
    for (key, title) in &mapping.columns {
        let named = line.iter().position(|cell| cell.text.trim().eq_ignore_ascii_case(key.trim()));
        let lettered = || column_number(key).filter(|_| mapping.header.is_some());
        match named.or_else(lettered) {
            Some(column) if column < width => columns[column] = Some(title.clone()),
            _ if mapping.header.is_none() => return None,
            _ => {}
        }
    }
    columns.iter().any(Option::is_some).then_some(Header { columns, lines: 1 })
}

/// The number of the column that a sheet calls so: `A` is 0.
fn column_number(letters: &str) -> Option<usize> {
    let valid = (1..=3).contains(&letters.len()) && letters.bytes().all(|b| b.is_ascii_uppercase());
    valid.then(|| letters.bytes().fold(0, |sum, b| sum * 26 + usize::from(b - b'A') + 1) - 1)
}

fn header(lines: &[Vec<GridCell>]) -> Option<Header> {
    library_workbook(lines).or_else(|| two_lines(lines)).or_else(|| one_line(lines))
}

/// A line of groups above a line of names.
fn two_lines(lines: &[Vec<GridCell>]) -> Option<Header> {
    let (above, below) = (lines.first()?, lines.get(1)?);
    let words: Vec<Option<&str>> = above.iter().map(|cell| group(&cell.text)).collect();
    if !words.contains(&Some("in")) && !words.contains(&Some("out")) {
        return None;
    }
    let mut columns = Vec::new();
    let mut current = None;
    let width = above.len().max(below.len());
    let stated = above.iter().map(|cell| !cell.text.is_empty()).chain(std::iter::repeat(false));
    let words = words.into_iter().chain(std::iter::repeat(None));
    for (at, (stated, word)) in stated.zip(words).enumerate().take(width) {
        if stated {
            current = word;
        }
        let name = below.get(at).map_or("", |cell| cell.text.trim());
        columns.push(match current {
            Some(kind @ ("in" | "out" | "state" | "state!")) if !name.is_empty() => Some(format!("{kind} {name}")),
            Some(kind @ ("dur" | "remark" | "repeat" | "#")) if stated => {
                let unit = if kind == "dur" { name } else { "" };
                Some(format!("{kind} {unit}").trim_end().to_owned())
            }
            _ => None,
        });
    }
    Some(Header { columns, lines: 2 })
}

/// `State | testtime | outputs | # | inputs | # | Purpose`.
fn library_workbook(lines: &[Vec<GridCell>]) -> Option<Header> {
    let line = lines.first()?;
    let is = |at: usize, wanted: &str| line.get(at).is_some_and(|cell| cell.text.eq_ignore_ascii_case(wanted));
    if !is(0, "State") || !is(1, "testtime") {
        return None;
    }
    let mut kind = "out";
    let columns = line.iter().enumerate().map(|(at, cell)| match (at, cell.text.as_str()) {
        (0, _) => Some("#".to_owned()),
        (1, _) => Some("dur ms".to_owned()),
        (_, "#") => {
            kind = "in";
            None
        }
        (_, text) if text.eq_ignore_ascii_case("Purpose") => Some("remark".to_owned()),
        (_, "") => None,
        (_, text) => Some(format!("{kind} {text}")),
    });
    Some(Header { columns: columns.collect(), lines: 1 })
}

/// The header of a pipe table.
fn one_line(lines: &[Vec<GridCell>]) -> Option<Header> {
    let line = lines.first()?;
    let bound = |cell: &GridCell| matches!(pipe::header_kind(cell.text.trim()), pipe::Header::Bound(..));
    if !line.iter().any(bound) {
        return None;
    }
    let columns = line.iter().map(|cell| (!cell.text.is_empty()).then(|| cell.text.clone())).collect();
    Some(Header { columns, lines: 1 })
}

impl Made {
    /// Writes a table from the line `at` on; gives the line behind it.
    fn table(&mut self, grid: &Grid, at: usize, header: &Header) -> usize {
        for (column, title) in header.columns.iter().enumerate() {
            let Some(title) = title else { continue };
            let below = grid[at + header.lines - 1].get(column).filter(|cell| !cell.text.is_empty());
            let source = below.or_else(|| grid[at].get(column)).cloned().unwrap_or_default();
            let runs = source.runs.first().map(|run| (0, run.1)).into_iter().collect();
            self.bar(&source);
            self.cell(&GridCell { text: title.clone(), notes: Vec::new(), runs, ..source }, true);
        }
        self.line_end();
        let mut row = at + header.lines;
        while row < grid.len() {
            let line = &grid[row];
            let blank = line.iter().all(|cell| cell.text.is_empty() && cell.notes.is_empty());
            if blank || line.iter().any(|cell| cell.text.starts_with("@gtt")) {
                break;
            }
            for (column, title) in header.columns.iter().enumerate() {
                let Some(title) = title else { continue };
                let cell = line.get(column).cloned().unwrap_or_default();
                let bound = matches!(pipe::header_kind(title), pipe::Header::Bound(..));
                self.bar(&cell);
                self.cell(&if bound { guessed(unmerged(cell)) } else { cell }, true);
            }
            self.line_end();
            row += 1;
        }
        row
    }

    /// Text that stands nowhere: all of it at one place of the piece.
    fn glue(&mut self, text: &str, at: usize) {
        for c in text.chars() {
            self.runs.push((saturate(self.text.len()), saturate(at)));
            self.text.push(c);
        }
    }

    /// The bar in front of a cell, at its beginning.
    fn bar(&mut self, cell: &GridCell) {
        self.glue("| ", cell.span.start.max(self.end));
    }

    /// The last bar of a line, at the last byte of its last cell, so that a line ends where that cell does.
    fn line_end(&mut self) {
        self.glue("|", self.end.saturating_sub(1));
        self.glue("\n", self.end);
    }

    fn cell(&mut self, cell: &GridCell, escape: bool) {
        let start = self.text.len();
        let mut runs = cell.runs.iter().peekable();
        let mut there = self.end;
        for (at, c) in cell.text.char_indices() {
            if let Some((_, to)) = runs.next_if(|(from, _)| *from as usize <= at) {
                there = *to as usize;
            }
            let here = there.min(cell.span.end.max(self.end));
            if c == '|' && escape {
                self.runs.push((saturate(self.text.len()), saturate(here)));
                self.text.push('\\');
            }
            self.runs.push((saturate(self.text.len()), saturate(here)));
            self.text.push(c);
            there += c.len_utf8();
        }
        self.end = cell.span.end.max(self.end);
        self.cells.push((start..self.text.len(), cell.clone()));
        self.glue(" ", self.end);
    }
}
