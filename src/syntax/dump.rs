//! A tree as an S-expression, for tests and for looking at.
//!
//! One node a line, indented by its depth, followed by its own significant tokens in the order in which they
//! stand; trivia are left out. Names and literals print as written, keywords in upper case.

use std::fmt::Write as _;

use super::kind::TokenKind;
use super::tree::{Node, Token, Tree};

/// `tree` as text.
#[must_use]
pub fn dump(tree: &Tree) -> String {
    let mut out = String::new();
    let mut open: Vec<Node<'_>> = Vec::new();
    for node in tree.root().descendants() {
        while let Some(top) = open.last()
            && !holds(*top, node)
        {
            open.pop();
            out.push(')');
        }
        if !out.is_empty() {
            out.push('\n');
        }
        for _ in 0..open.len() {
            out.push_str("  ");
        }
        let _ = write!(out, "({}", node.kind().name());
        for token in node.own_tokens() {
            out.push(' ');
            push_token(&mut out, token);
        }
        open.push(node);
    }
    out.extend(open.iter().map(|_| ')'));
    out.push('\n');
    out
}

fn holds(outer: Node<'_>, inner: Node<'_>) -> bool {
    inner.id().0 < outer.subtree_end()
}

fn push_token(out: &mut String, token: Token<'_>) {
    match token.kind() {
        kind if kind.is_keyword() => out.push_str(&token.text().to_uppercase()),
        TokenKind::LParen | TokenKind::RParen => {
            let _ = write!(out, "'{}'", token.text());
        }
        _ => out.push_str(token.text()),
    }
}
