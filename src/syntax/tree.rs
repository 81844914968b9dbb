//! The tree: flat, immutable, compact, and without loss.
//!
//! Tokens lie in two arrays (kinds and offsets), nodes in one, in preorder; a node knows its range of tokens and
//! where its subtree ends, so that children need no links. Nothing points upwards: who needs parents walks down,
//! or asks [`Tree::innermost`].
//!
//! # Where blanks, comments and pragmas stand
//!
//! All of them are tokens of the tree. A node begins at its first significant token and ends behind its last
//! one, so what stands before, between and after declarations belongs to the node around them. To see the
//! comments before a declaration, walk back from [`Node::first_token`] with [`Tree::trivia_before`]; for those
//! behind it, [`Tree::trivia_after`]; for those inside, [`Node::tokens`]. The root holds every token.

use std::fmt;
use std::sync::Arc;

use super::kind::{NodeKind, TokenKind};
use crate::text::Span;

/// Names a node in its [`Tree`]; nodes are counted in preorder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub u32);

#[derive(Clone, Copy, Debug)]
pub(super) struct NodeData {
    pub(super) first_token: u32,
    pub(super) end_token: u32,
    pub(super) subtree_end: u32,
    pub(super) kind: NodeKind,
}

/// The tree of one text.
#[derive(Clone, Debug)]
pub struct Tree {
    text: Arc<str>,
    kinds: Box<[TokenKind]>,
    starts: Box<[u32]>,
    nodes: Box<[NodeData]>,
}

impl Tree {
    /// Puts a tree together; `nodes` are in preorder and the first one is the root.
    pub(super) fn new(text: Arc<str>, kinds: Vec<TokenKind>, starts: Vec<u32>, nodes: Box<[NodeData]>) -> Self {
        Self { text, kinds: kinds.into(), starts: starts.into(), nodes }
    }

    /// The text that was parsed.
    #[must_use]
    pub const fn text(&self) -> &Arc<str> {
        &self.text
    }

    /// The root; it holds every token.
    #[must_use]
    pub const fn root(&self) -> Node<'_> {
        Node { tree: self, id: 0 }
    }

    /// The node that `id` names.
    #[must_use]
    pub fn node(&self, id: NodeId) -> Option<Node<'_>> {
        ((id.0 as usize) < self.nodes.len()).then_some(Node { tree: self, id: id.0 })
    }

    /// The number of nodes.
    #[must_use]
    pub const fn node_count(&self) -> usize {
        self.nodes.len()
    }

    /// The number of tokens.
    #[must_use]
    pub const fn token_count(&self) -> usize {
        self.kinds.len()
    }

    /// The token at `index`.
    #[must_use]
    pub fn token(&self, index: u32) -> Option<Token<'_>> {
        ((index as usize) < self.kinds.len()).then_some(Token { tree: self, index })
    }

    /// All tokens.
    pub fn tokens(&self) -> Tokens<'_> {
        Tokens { tree: self, next: 0, end: count(self.kinds.len()) }
    }

    /// The token that holds the byte at `offset`.
    #[must_use]
    pub fn token_at(&self, offset: u32) -> Option<Token<'_>> {
        let after = self.starts.partition_point(|start| *start <= offset);
        let token = self.token(count(after.checked_sub(1)?))?;
        (offset < token.span().end).then_some(token)
    }

    /// The blanks, comments and pragmas right before the token at `index`, last one first.
    pub fn trivia_before(&self, index: u32) -> impl Iterator<Item = Token<'_>> {
        (0..index.min(count(self.kinds.len()))).rev().map_while(|i| self.token(i)).take_while(|t| t.kind().is_trivia())
    }

    /// The blanks, comments and pragmas from the token at `index` on, first one first. With a node's
    /// [`Node::end_token`], what follows the node.
    pub fn trivia_after(&self, index: u32) -> impl Iterator<Item = Token<'_>> {
        (index..count(self.kinds.len())).map_while(|i| self.token(i)).take_while(|t| t.kind().is_trivia())
    }

    /// The innermost node whose span holds `offset`; the root where there is none.
    #[must_use]
    pub fn innermost(&self, offset: u32) -> Node<'_> {
        self.path_to(offset).last().copied().unwrap_or(self.root())
    }

    /// The nodes whose spans hold `offset`, outermost first.
    #[must_use]
    pub fn path_to(&self, offset: u32) -> Vec<Node<'_>> {
        let mut path = vec![self.root()];
        let mut next = Some(self.root());
        while let Some(node) = next {
            next = node.children().find(|child| child.span().start <= offset && offset < child.span().end);
            path.extend(next);
        }
        path
    }

    /// The bytes that the tree takes in memory, its text not counted.
    #[must_use]
    pub const fn memory(&self) -> usize {
        self.kinds.len() * (size_of::<TokenKind>() + size_of::<u32>()) + self.nodes.len() * size_of::<NodeData>()
    }

    fn token_start(&self, index: u32) -> u32 {
        self.starts.get(index as usize).copied().unwrap_or(count(self.text.len()))
    }
}

/// A node; copying it costs nothing.
#[derive(Clone, Copy)]
pub struct Node<'t> {
    tree: &'t Tree,
    id: u32,
}

impl<'t> Node<'t> {
    /// The tree it stands in.
    #[must_use]
    pub const fn tree(self) -> &'t Tree {
        self.tree
    }

    /// Its name in the tree.
    #[must_use]
    pub const fn id(self) -> NodeId {
        NodeId(self.id)
    }

    /// What it is.
    #[must_use]
    pub fn kind(self) -> NodeKind {
        self.data().kind
    }

    /// From its first significant token to its last; empty for a node without tokens.
    #[must_use]
    pub fn span(self) -> Span {
        let data = self.data();
        let start = self.tree.token_start(data.first_token);
        if data.first_token == data.end_token {
            return Span::at(start);
        }
        Span::new(start, self.tree.token_start(data.end_token))
    }

    /// Its text, comments inside included.
    #[must_use]
    pub fn text(self) -> &'t str {
        self.span().of(&self.tree.text)
    }

    /// The index of its first token.
    #[must_use]
    pub fn first_token(self) -> u32 {
        self.data().first_token
    }

    /// The index behind its last token.
    #[must_use]
    pub fn end_token(self) -> u32 {
        self.data().end_token
    }

    /// All tokens in it, those of its children and the trivia among them.
    #[must_use]
    pub fn tokens(self) -> Tokens<'t> {
        Tokens { tree: self.tree, next: self.first_token(), end: self.end_token() }
    }

    /// The significant tokens that stand in this node and in none of its children.
    pub fn own_tokens(self) -> impl Iterator<Item = Token<'t>> {
        let mut children = self.children();
        let mut child = children.next();
        let mut next = self.first_token();
        std::iter::from_fn(move || {
            loop {
                while let Some(inner) = child
                    && next >= inner.first_token()
                {
                    next = next.max(inner.end_token());
                    child = children.next();
                }
                if next >= self.end_token() {
                    return None;
                }
                let token = Token { tree: self.tree, index: next };
                next += 1;
                if !token.kind().is_trivia() {
                    return Some(token);
                }
            }
        })
    }

    /// The first of its own tokens that is a `kind`.
    #[must_use]
    pub fn own_token(self, kind: TokenKind) -> Option<Token<'t>> {
        self.own_tokens().find(|token| token.kind() == kind)
    }

    /// Whether one of its own tokens is a `kind`.
    #[must_use]
    pub fn has_token(self, kind: TokenKind) -> bool {
        self.own_token(kind).is_some()
    }

    /// Its children, in order.
    #[must_use]
    pub fn children(self) -> Children<'t> {
        Children { tree: self.tree, next: self.id + 1, end: self.data().subtree_end }
    }

    /// Its first child of `kind`.
    #[must_use]
    pub fn child(self, kind: NodeKind) -> Option<Self> {
        self.children().find(|child| child.kind() == kind)
    }

    /// Itself and everything below it, in preorder.
    pub fn descendants(self) -> impl Iterator<Item = Self> {
        (self.id..self.data().subtree_end).map(move |id| Self { tree: self.tree, id })
    }

    /// The id behind its last descendant.
    pub(super) fn subtree_end(self) -> u32 {
        self.data().subtree_end
    }

    fn data(self) -> NodeData {
        self.tree.nodes[self.id as usize]
    }
}

impl PartialEq for Node<'_> {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.tree, other.tree) && self.id == other.id
    }
}

impl Eq for Node<'_> {}

impl fmt::Debug for Node<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}@{}..{}", self.kind().name(), self.span().start, self.span().end)
    }
}

/// The children of a node.
#[derive(Clone)]
pub struct Children<'t> {
    tree: &'t Tree,
    next: u32,
    end: u32,
}

impl<'t> Iterator for Children<'t> {
    type Item = Node<'t>;

    fn next(&mut self) -> Option<Node<'t>> {
        if self.next >= self.end {
            return None;
        }
        let node = Node { tree: self.tree, id: self.next };
        self.next = node.data().subtree_end;
        Some(node)
    }
}

/// A token; copying it costs nothing.
#[derive(Clone, Copy)]
pub struct Token<'t> {
    tree: &'t Tree,
    index: u32,
}

impl<'t> Token<'t> {
    /// Its index in the tree.
    #[must_use]
    pub const fn index(self) -> u32 {
        self.index
    }

    /// What it is.
    #[must_use]
    pub fn kind(self) -> TokenKind {
        self.tree.kinds[self.index as usize]
    }

    /// Its bytes.
    #[must_use]
    pub fn span(self) -> Span {
        Span::new(self.tree.token_start(self.index), self.tree.token_start(self.index + 1))
    }

    /// Its text.
    #[must_use]
    pub fn text(self) -> &'t str {
        self.span().of(&self.tree.text)
    }

    /// The token before it.
    #[must_use]
    pub fn previous(self) -> Option<Self> {
        self.tree.token(self.index.checked_sub(1)?)
    }

    /// The token after it.
    #[must_use]
    pub fn next(self) -> Option<Self> {
        self.tree.token(self.index + 1)
    }
}

impl PartialEq for Token<'_> {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.tree, other.tree) && self.index == other.index
    }
}

impl Eq for Token<'_> {}

impl fmt::Debug for Token<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?} {:?}", self.kind(), self.text())
    }
}

/// Tokens in a row.
#[derive(Clone)]
pub struct Tokens<'t> {
    tree: &'t Tree,
    next: u32,
    end: u32,
}

impl<'t> Iterator for Tokens<'t> {
    type Item = Token<'t>;

    fn next(&mut self) -> Option<Token<'t>> {
        if self.next >= self.end {
            return None;
        }
        self.next += 1;
        Some(Token { tree: self.tree, index: self.next - 1 })
    }
}

impl DoubleEndedIterator for Tokens<'_> {
    fn next_back(&mut self) -> Option<Self::Item> {
        if self.next >= self.end {
            return None;
        }
        self.end -= 1;
        Some(Token { tree: self.tree, index: self.end })
    }
}

fn count(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}
