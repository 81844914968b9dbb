//! The `repeat` column of a pipe table: `{` where a block begins, `} x [1,3]` where it ends, several of them in one
//! cell where blocks nest; a block without a duration is repeated for ever.

use super::build::Builder;
use crate::table::codes;
use crate::table::duration::Duration;
use crate::table::model::{Block, Node, Row};
use crate::table::piece::Piece;
use crate::text::Place;

/// A tree in the making.
#[derive(Default)]
pub(super) struct Tree {
    done: Vec<Node>,
    open: Vec<Open>,
}

struct Open {
    id: Option<String>,
    place: Place,
    children: Vec<Node>,
}

impl Tree {
    fn push(&mut self, node: Node) {
        match self.open.last_mut() {
            Some(open) => open.children.push(node),
            None => self.done.push(node),
        }
    }

    /// Adds a row, with what its `repeat` cell opens in front of it and closes behind it.
    pub(super) fn row(&mut self, builder: &mut Builder<'_>, row: Row, repeat: Option<&Piece<'_>>) {
        let mut row = Some(row);
        if let Some(repeat) = repeat {
            for mark in marks(repeat) {
                match mark {
                    Mark::Open(piece) => {
                        if row.is_none() {
                            let message = "a block begins here behind the end of another; it begins with a row";
                            builder.wrong(&codes::TABLE_BLOCK, piece.whole(), message);
                            continue;
                        }
                        let name = piece.part(1..piece.text.len()).trimmed();
                        let id = (!name.text.is_empty()).then(|| name.text.to_owned());
                        self.open.push(Open { id, place: piece.part(0..1).whole(), children: Vec::new() });
                    }
                    Mark::Close(piece) => {
                        if let Some(row) = row.take() {
                            self.push(Node::Row(Box::new(row)));
                        }
                        self.close(builder, &piece);
                    }
                    Mark::Other(piece) => {
                        let message = format!("`{}` is neither `{{` nor `}} x [1,3]`", piece.text);
                        builder.wrong(&codes::TABLE_BLOCK, piece.whole(), message);
                    }
                }
            }
        }
        if let Some(row) = row {
            self.push(Node::Row(Box::new(row)));
        }
    }

    fn close(&mut self, builder: &mut Builder<'_>, piece: &Piece<'_>) {
        let Some(open) = self.open.pop() else {
            builder.wrong(&codes::TABLE_BLOCK, piece.whole(), "no block is open that could end here");
            return;
        };
        let behind = piece.part(1..piece.text.len()).trimmed();
        let times = behind.text.starts_with(['x', 'X', '×']);
        let skip = if times { behind.text.chars().next().map_or(0, char::len_utf8) } else { 0 };
        let duration = builder.duration(&behind.part(skip..behind.text.len()), Duration::omega(), None);
        self.push(Node::Block(Box::new(Block { id: open.id, children: open.children, duration, place: open.place })));
    }

    /// Everything that was read; a block that is still open is an error and ends here.
    pub(super) fn finish(mut self, builder: &mut Builder<'_>) -> Vec<Node> {
        while let Some(open) = self.open.pop() {
            builder.wrong(&codes::TABLE_BLOCK, open.place, "this block never ends");
            open.children.into_iter().for_each(|node| self.push(node));
        }
        self.done
    }
}

enum Mark<'a> {
    Open(Piece<'a>),
    Close(Piece<'a>),
    Other(Piece<'a>),
}

/// The braces of a cell, each with the text up to the next one.
fn marks<'a>(piece: &Piece<'a>) -> Vec<Mark<'a>> {
    let mut starts: Vec<usize> = piece.text.match_indices(['{', '}']).map(|(at, _)| at).collect();
    if starts.first() != Some(&0) {
        starts.insert(0, 0);
    }
    starts.push(piece.text.len());
    let parts = starts.windows(2).map(|pair| piece.part(pair[0]..pair[1]).trimmed());
    parts
        .filter(|part| !part.text.is_empty())
        .map(|part| match part.text.as_bytes()[0] {
            b'{' => Mark::Open(part),
            b'}' => Mark::Close(part),
            _ => Mark::Other(part),
        })
        .collect()
}
