//! What the grammar works with: the significant tokens, and the nodes that are finished.
//!
//! A finished node is pushed behind its children (postorder) with the size of its subtree, so that wrapping a
//! finished node in a new one (the left side of an operator) needs no patching: the new node just begins where the
//! old one did. At the end the postorder is turned into the preorder of the [`Tree`].
//!
//! Two counters bound the depth. `depth` counts the rules that are running; each [`Done`] node knows its
//! height. A node is wrapped only while both together stay below [`MAX_HEIGHT`].

use std::sync::Arc;

use super::kind::{NodeKind, TokenKind};
use super::lexer::{self, Tokens};
use super::set::TokenSet;
use super::tree::{NodeData, Tree};
use super::{Entry, Options, Parse, SyntaxError, codes, grammar};
use crate::diagnostic::Code;
use crate::text::Span;

/// How deep rules may nest.
const MAX_DEPTH: u32 = 200;

/// How many errors are kept; a text with more is no program.
const MAX_ERRORS: usize = 1000;

/// How high an expression may grow by operators in a row.
const MAX_HEIGHT: u32 = 500;

/// Reads `text`, which is shorter than 4 GiB.
pub(super) fn parse(text: Arc<str>, entry: Entry, options: &Options) -> Parse {
    let tokens = lexer::lex(&text, options);
    let mut parser = Parser::new(&text, tokens, *options);
    grammar::root(&mut parser, entry);
    let Parser { tokens, nodes, mut errors, .. } = parser;
    errors.sort_by_key(|error| error.span.start);
    let nodes = preorder(&nodes, tokens.kinds.len());
    Parse { tree: Tree::new(text, tokens.kinds, tokens.starts, nodes), errors }
}

/// Where a node begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Marker {
    position: u32,
    nodes: u32,
}

/// A finished node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Done {
    marker: Marker,
    index: u32,
    height: u32,
}

impl Done {
    /// How many nodes the longest way down from this one has.
    pub(super) const fn height(self) -> u32 {
        self.height
    }
}

struct Finished {
    kind: NodeKind,
    first_token: u32,
    end_token: u32,
    size: u32,
}

pub(super) struct Parser<'t> {
    text: &'t str,
    tokens: Tokens,
    /// The significant tokens: their kinds, and their indices among all tokens. Two sentinels follow.
    kinds: Vec<TokenKind>,
    indices: Vec<u32>,
    position: u32,
    nodes: Vec<Finished>,
    errors: Vec<SyntaxError>,
    /// How many constructs wait for each closing keyword.
    open: [u16; 256],
    depth: u32,
    /// Up to where a search for the colon of a case label is known to fail.
    pub(super) no_label_before: u32,
    pub(super) options: Options,
    /// Whether a declaration needs its `END_…`.
    pub(super) needs_end: bool,
}

impl<'t> Parser<'t> {
    fn new(text: &'t str, mut tokens: Tokens, options: Options) -> Self {
        let mut kinds = Vec::with_capacity(tokens.kinds.len() / 2 + 8);
        let mut indices = Vec::with_capacity(tokens.kinds.len() / 2 + 8);
        for (index, kind) in tokens.kinds.iter().enumerate() {
            if !kind.is_trivia() {
                kinds.push(*kind);
                indices.push(index as u32);
            }
        }
        indices.push(tokens.kinds.len() as u32);
        kinds.push(TokenKind::Eof);
        Self {
            text,
            errors: std::mem::take(&mut tokens.errors),
            nodes: Vec::with_capacity(kinds.len()),
            tokens,
            kinds,
            indices,
            position: 0,
            open: [0; 256],
            depth: 0,
            no_label_before: 0,
            options,
            needs_end: true,
        }
    }

    /// The kind of the current token.
    pub(super) fn current(&self) -> TokenKind {
        self.kinds[self.position as usize]
    }

    /// The kind of the token `n` after the current one.
    pub(super) fn nth(&self, n: u32) -> TokenKind {
        self.kinds.get((self.position + n) as usize).copied().unwrap_or(TokenKind::Eof)
    }

    pub(super) fn at(&self, kind: TokenKind) -> bool {
        self.current() == kind
    }

    pub(super) fn at_any(&self, set: TokenSet) -> bool {
        set.contains(self.current())
    }

    /// The position among the significant tokens.
    pub(super) const fn position(&self) -> u32 {
        self.position
    }

    /// Takes the current token.
    pub(super) fn bump(&mut self) {
        if (self.position as usize) + 1 < self.kinds.len() {
            self.position += 1;
        }
    }

    /// Takes the current token as a name, whatever keyword it looks like.
    pub(super) fn bump_as(&mut self, kind: TokenKind) {
        let position = self.position as usize;
        if self.kinds[position] != TokenKind::Eof {
            self.kinds[position] = kind;
            let index = self.indices[position] as usize;
            self.tokens.kinds[index] = kind;
            self.position += 1;
        }
    }

    /// Takes the current token if it is a `kind`.
    pub(super) fn eat(&mut self, kind: TokenKind) -> bool {
        let found = self.at(kind);
        if found {
            self.bump();
        }
        found
    }

    /// Takes a `kind`, or says that it was expected.
    pub(super) fn expect(&mut self, kind: TokenKind) -> bool {
        let found = self.eat(kind);
        if !found {
            self.expected(kind.describe());
        }
        found
    }

    /// The text of the token `n` after the current one.
    pub(super) fn nth_text(&self, n: u32) -> &'t str {
        self.span_of(self.position + n).of(self.text)
    }

    /// Whether the token `n` after the current one is the word `word`, in any case.
    pub(super) fn nth_is_word(&self, n: u32, word: &str) -> bool {
        self.nth_text(n).eq_ignore_ascii_case(word)
    }

    /// Whether a line break stands before the token `n` after the current one, or the text begins there.
    pub(super) fn nth_begins_line(&self, n: u32) -> bool {
        let position = (self.position + n) as usize;
        let Some(end) = self.indices.get(position) else { return true };
        let start = match position.checked_sub(1) {
            Some(before) => self.indices[before] + 1,
            None => return true,
        };
        let between = start as usize..*end as usize;
        self.tokens.kinds[between].iter().any(|kind| matches!(kind, TokenKind::Newline | TokenKind::LineComment))
    }

    /// Whether the current token is the first one on its line.
    pub(super) fn begins_line(&self) -> bool {
        self.nth_begins_line(0)
    }

    /// Whether nothing, not even a blank, stands between the tokens `n` and `n + 1` after the current one.
    pub(super) fn nth_is_joined(&self, n: u32) -> bool {
        let position = (self.position + n) as usize;
        match (self.indices.get(position), self.indices.get(position + 1)) {
            (Some(first), Some(second)) => *second == first + 1,
            _ => false,
        }
    }

    /// The kind of the token before the current one.
    pub(super) fn previous(&self) -> TokenKind {
        self.position.checked_sub(1).map_or(TokenKind::Eof, |last| self.kinds[last as usize])
    }

    pub(super) fn start(&self) -> Marker {
        Marker { position: self.position, nodes: self.nodes.len() as u32 }
    }

    /// Finishes the node that began at `marker`; `height` is that of its highest child.
    pub(super) fn finish(&mut self, marker: Marker, kind: NodeKind, height: u32) -> Done {
        let behind_last = self.position.checked_sub(1).map_or(0, |last| self.indices[last as usize] + 1);
        let is_empty = self.position == marker.position;
        // A node without tokens stands right behind the last token, so that it lies in the node around it.
        let first_token = if is_empty { behind_last } else { self.indices[marker.position as usize] };
        let end_token = behind_last;
        let index = self.nodes.len() as u32;
        self.nodes.push(Finished { kind, first_token, end_token, size: index - marker.nodes + 1 });
        Done { marker, index, height: height + 1 }
    }

    /// Finishes a node that nothing wraps.
    pub(super) fn complete(&mut self, marker: Marker, kind: NodeKind) -> Done {
        self.finish(marker, kind, 0)
    }

    /// Begins a node where `done` began; `done` becomes its first child.
    pub(super) const fn precede(&self, done: Done) -> Marker {
        done.marker
    }

    /// Makes a finished node one of another kind.
    pub(super) fn change_kind(&mut self, done: Done, kind: NodeKind) {
        self.nodes[done.index as usize].kind = kind;
    }

    pub(super) fn kind_of(&self, done: Done) -> NodeKind {
        self.nodes[done.index as usize].kind
    }

    /// Whether a node of height `height` may be wrapped here.
    pub(super) const fn may_grow(&self, height: u32) -> bool {
        self.depth + height < MAX_HEIGHT
    }

    /// Runs `rule` one level deeper; where that is too deep, says so and gives `None`.
    pub(super) fn deeper<T>(&mut self, rule: impl FnOnce(&mut Self) -> T) -> Option<T> {
        if self.depth >= MAX_DEPTH {
            self.too_deep();
            return None;
        }
        self.depth += 1;
        let result = rule(self);
        self.depth -= 1;
        Some(result)
    }

    /// Says that nesting is too deep here.
    pub(super) fn too_deep(&mut self) {
        let message = format!("more than {MAX_DEPTH} levels of nesting");
        self.error_at(self.span_of(self.position), &codes::NESTING_TOO_DEEP, message);
    }

    /// Notes that a construct waits for `end` while `rule` runs.
    pub(super) fn within<T>(&mut self, end: TokenKind, rule: impl FnOnce(&mut Self) -> T) -> T {
        self.open[end as usize] = self.open[end as usize].saturating_add(1);
        let result = rule(self);
        self.open[end as usize] = self.open[end as usize].saturating_sub(1);
        result
    }

    /// Whether some construct waits for `end`.
    pub(super) fn is_open(&self, end: TokenKind) -> bool {
        self.open[end as usize] > 0
    }

    /// Says that `what` was expected at the current token.
    pub(super) fn expected(&mut self, what: &str) {
        let message = format!("expected {what}, found {}", self.found());
        self.error_at(self.span_of(self.position), &codes::UNREADABLE_CONSTRUCT, message);
    }

    /// Says `message` about the current token.
    pub(super) fn error(&mut self, message: impl Into<String>) {
        self.error_at(self.span_of(self.position), &codes::UNREADABLE_CONSTRUCT, message.into());
    }

    /// Says that the current token is an operator of another language, and is read as the one of this that it describes.
    pub(super) fn foreign_operator(&mut self) {
        let (written, meant) = (self.nth_text(0), self.current().describe());
        let message = format!("`{written}` was read as {meant}");
        let before = self.errors.len();
        self.error_at(self.span_of(self.position), &codes::FOREIGN_OPERATOR, message);
        if let Some(error) = self.errors.get_mut(before) {
            error.help = Some(format!("write {meant} to compare"));
        }
    }

    /// Says that a semicolon is missing behind the last token.
    pub(super) fn missing_semicolon(&mut self) {
        let end = self.position.checked_sub(1).map_or(0, |last| self.span_of(last).end);
        let message = "missing `;`".to_owned();
        self.error_at(Span::at(end), &codes::MISSING_SEMICOLON, message);
    }

    /// Says that the construct that began at `marker` has no `end`.
    pub(super) fn missing_end(&mut self, marker: Marker, end: TokenKind) {
        let opener = self.span_of(marker.position);
        let message = format!("`{}` without {}", opener.of(self.text), end.describe());
        let before = self.errors.len();
        self.error_at(opener, &codes::MISSING_END, message);
        if let Some(error) = self.errors.get_mut(before) {
            error.help = Some(format!("write {} where it ends", end.describe()));
        }
    }

    fn error_at(&mut self, span: Span, code: &'static Code, message: String) {
        let repeated = self.errors.last().is_some_and(|last| last.span.start == span.start);
        if !repeated && self.errors.len() < MAX_ERRORS {
            self.errors.push(SyntaxError { span, message, help: None, code });
        }
    }

    fn found(&self) -> String {
        match self.current() {
            TokenKind::Eof => TokenKind::Eof.describe().to_owned(),
            _ => {
                let text = self.nth_text(0);
                match text.char_indices().nth(40) {
                    Some((cut, _)) => format!("`{}…`", &text[..cut]),
                    None => format!("`{text}`"),
                }
            }
        }
    }

    fn span_of(&self, position: u32) -> Span {
        let length = self.text.len() as u32;
        let start = |index: u32| self.tokens.starts.get(index as usize).copied().unwrap_or(length);
        match self.indices.get(position as usize) {
            Some(index) => Span::new(start(*index), start(index + 1)),
            None => Span::at(length),
        }
    }
}

/// The stretch of preorder that a node's children still to come will fill, and the node's first token.
struct Edge {
    start: u32,
    end: u32,
    first_token: u32,
}

/// Turns finished nodes in postorder into preorder.
///
/// Read backwards, postorder is preorder with the children reversed. So the last child of each node comes right
/// after it, and takes its place at the end of the node's stretch; `edges` holds the ends of the open stretches.
fn preorder(finished: &[Finished], token_count: usize) -> Box<[NodeData]> {
    let empty = NodeData { first_token: 0, end_token: 0, subtree_end: 0, kind: NodeKind::SourceFile };
    let mut nodes = vec![empty; finished.len()].into_boxed_slice();
    let mut edges: Vec<Edge> = vec![Edge { start: 0, end: finished.len() as u32, first_token: 0 }];
    for node in finished.iter().rev() {
        while let Some(edge) = edges.last()
            && edge.start == edge.end
        {
            edges.pop();
        }
        let Some(edge) = edges.last_mut() else { break };
        let subtree_end = edge.end;
        let id = subtree_end - node.size;
        edge.end = id;
        // Only a node without tokens can stand before the first token of its parent.
        let first_token = node.first_token.max(edge.first_token);
        let end_token = node.end_token.max(first_token);
        nodes[id as usize] = NodeData { first_token, end_token, subtree_end, kind: node.kind };
        edges.push(Edge { start: id + 1, end: subtree_end, first_token });
    }
    if let Some(root) = nodes.first_mut() {
        root.first_token = 0;
        root.end_token = token_count as u32;
    }
    nodes
}
