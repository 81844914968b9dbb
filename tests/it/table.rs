//! Tests of `table`.

mod aids;
mod automaton;
mod automaton_terms;
mod bind;
mod cells;
mod corpora;
mod fuzz;
mod gtt;
mod instances;
mod layout;
mod papers;
mod pipe;
mod workbook;
mod write;
mod xml;

use rungbook::diagnostic::Finding;
use rungbook::table::piece::Piece;
use rungbook::table::read::{self, Options, Read};
use rungbook::text::FileId;

/// Reads `text` as Markdown or a comment that holds pipe tables.
fn pipe(text: &str) -> Read {
    read::pipe::read(&Piece::verbatim(FileId(0), text, 0), &Options::default())
}

/// Reads `text` as a `.gtt` file.
fn gtt(text: &str) -> Read {
    read::gtt::read(&Piece::verbatim(FileId(0), text, 0), &Options::default())
}

/// Each finding as `code at "text": message`.
fn shown(text: &str, findings: &[Finding]) -> Vec<String> {
    let one = |f: &Finding| format!("{} at {:?}: {}", f.code.name, f.place.span.of(text), f.message);
    findings.iter().map(one).collect()
}

/// Reads `text` as a table file, whatever it is.
fn any(text: &str) -> Read {
    read::text(&Piece::verbatim(FileId(0), text, 0), &Options::default())
}
