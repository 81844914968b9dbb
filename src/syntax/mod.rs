//! From text to tree: IEC 61131-3, third edition, with the extensions of the dialects.
//!
//! [`parse`] takes any text and gives a [`Tree`] without loss, and what was wrong with the text as
//! [`SyntaxError`]s. It never fails and never panics; its time is linear in the length of the text, and the depth
//! of the tree is bounded. A broken construct costs itself and nothing else.
//!
//! The way through this room: [`lexer`] splits the text; [`parser`] holds the tokens without their trivia and
//! collects nodes; [`grammar`] says what follows what, one file an area; [`tree`] is the result; [`ast`] gives its
//! nodes types. The grammar accepts all dialects at once: the options only decide what is ambiguous. What a
//! construct means, and whether a dialect allows it, is for later rooms to say.

pub mod ast;
pub mod codes;
pub mod dump;
mod grammar;
mod keyword;
pub mod kind;
mod lexer;
mod parser;
mod scan;
mod set;
pub mod tree;

use std::sync::Arc;

pub use kind::{NodeKind, TokenKind};
pub use tree::{Node, NodeId, Token, Tree};

use crate::diagnostic::{Code, Finding};
use crate::text::{Place, Span};

/// What a text is to be read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Entry {
    /// Any number of declarations, each with its `END_…`; statements and sections of variables may stand bare.
    #[default]
    File,
    /// A declaration as an XML container holds it: its header and its variables, without `END_…`. A body may follow.
    Declaration,
    /// Statements; the steps of a chart; or instructions, where the first line looks like one.
    Body,
    /// Instructions, whatever they look like.
    InstructionList,
    /// One expression.
    Expression,
}

/// How ambiguous text is read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Options {
    /// Whether `(* … *)` nests; `None` guesses.
    pub nested_comments: Option<bool>,
    /// Whether text in double quotes is a name even where it could be a string (Siemens).
    pub quoted_names: bool,
}

/// A tree and what was wrong with its text.
#[derive(Clone, Debug)]
pub struct Parse {
    /// The tree.
    pub tree: Tree,
    /// What was wrong, in the order of the text.
    pub errors: Vec<SyntaxError>,
}

/// One thing that is wrong with a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SyntaxError {
    /// Where, in the text that was parsed.
    pub span: Span,
    /// What is wrong, in one line.
    pub message: String,
    /// What would help.
    pub help: Option<String>,
    /// What kind of finding it is.
    pub code: &'static Code,
}

impl SyntaxError {
    /// The finding, once it is known where in a file the text stands.
    #[must_use]
    pub fn finding(&self, place: Place) -> Finding {
        let finding = Finding::new(self.code, place, self.message.clone());
        match &self.help {
            Some(help) => finding.help(help.clone()),
            None => finding,
        }
    }
}

/// Reads `text` as `entry`.
///
/// A text of 4 GiB or more is not read at all: its tree is empty, and an error says so.
#[must_use]
pub fn parse(text: impl Into<Arc<str>>, entry: Entry, options: &Options) -> Parse {
    let text: Arc<str> = text.into();
    if u32::try_from(text.len()).is_err() {
        let mut empty = parser::parse(Arc::from(""), entry, options);
        empty.errors = vec![SyntaxError {
            span: Span::at(0),
            message: "text of 4 GiB or more".to_owned(),
            help: None,
            code: &codes::UNREADABLE_CONSTRUCT,
        }];
        return empty;
    }
    parser::parse(text, entry, options)
}
