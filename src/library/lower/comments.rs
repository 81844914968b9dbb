//! Which comments stand where, seen from a declaration.

use crate::library::{Comment, FragmentId, Placement};
use crate::syntax::{Node, Token, TokenKind, Tree};
use crate::text::Span;

/// Comments that stand together: those of `tokens` between which only blanks are.
fn runs<'t>(tokens: impl Iterator<Item = Token<'t>>) -> Vec<Vec<Span>> {
    let mut runs: Vec<Vec<Span>> = Vec::new();
    let mut open = false;
    for token in tokens {
        if token.kind().is_comment() {
            match runs.last_mut() {
                Some(run) if open => run.push(token.span()),
                _ => runs.push(vec![token.span()]),
            }
            open = true;
        } else if !matches!(token.kind(), TokenKind::Blank | TokenKind::Newline) {
            open = false;
        }
    }
    runs
}

fn comments(fragment: FragmentId, placement: Placement, runs: Vec<Vec<Span>>) -> impl Iterator<Item = Comment> {
    runs.into_iter().map(move |spans| Comment { placement, fragment, spans })
}

/// The trivia from token `index` on, cut behind the line on which it begins: that line, and the rest.
fn line_and_rest(tree: &Tree, index: u32) -> (Vec<Token<'_>>, Vec<Token<'_>>) {
    let all: Vec<Token<'_>> = tree.trivia_after(index).collect();
    let cut = all.iter().position(|token| token.kind() == TokenKind::Newline).unwrap_or(all.len());
    let (line, rest) = all.split_at(cut);
    (line.to_vec(), rest.to_vec())
}

/// The trivia before token `index`, without what stands behind something else on its line.
fn above(tree: &Tree, index: u32) -> Vec<Token<'_>> {
    let mut all: Vec<Token<'_>> = tree.trivia_before(index).collect();
    all.reverse();
    let start = index - u32::try_from(all.len()).unwrap_or(0);
    if start > 0 {
        let cut = all.iter().position(|token| token.kind() == TokenKind::Newline).unwrap_or(all.len());
        all.drain(..cut);
    }
    all
}

/// Comments above the token `index`.
pub(super) fn before(tree: &Tree, fragment: FragmentId, index: u32) -> Vec<Comment> {
    comments(fragment, Placement::Above, runs(above(tree, index).into_iter())).collect()
}

/// Comments behind the token before `index`: those on its line are trailing, the rest are at `rest`.
pub(super) fn behind(tree: &Tree, fragment: FragmentId, index: u32, rest: Placement) -> Vec<Comment> {
    let (line, below) = line_and_rest(tree, index);
    let trailing = comments(fragment, Placement::Trailing, runs(line.into_iter()));
    trailing.chain(comments(fragment, rest, runs(below.into_iter()))).collect()
}

/// Comments in the trivia from the token `index` on.
pub(super) fn after(tree: &Tree, fragment: FragmentId, index: u32, placement: Placement) -> Vec<Comment> {
    comments(fragment, placement, runs(tree.trivia_after(index))).collect()
}

/// Comments of a variable, field or value: above it, inside it, behind it, and those below that are
/// aligned with the one behind it.
pub(super) fn of_variable(node: Node<'_>, fragment: FragmentId) -> Vec<Comment> {
    let tree = node.tree();
    let mut own = Vec::new();
    let above = unaligned(tree, above(tree, node.first_token()), node.first_token());
    own.extend(comments(fragment, Placement::Above, runs(above.into_iter())));
    let inside = node.tokens().filter(|token| token.kind().is_comment() || !token.kind().is_trivia());
    own.extend(comments(fragment, Placement::Trailing, runs(inside)));
    let (line, below) = trailing(tree, node.end_token());
    let column = line.iter().find(|token| token.kind().is_comment()).map(|token| column(tree, *token));
    own.extend(comments(fragment, Placement::Trailing, runs(line.into_iter())));
    if let Some(column) = column {
        let aligned = below.into_iter().take_while(|token| continues(tree, *token, column));
        own.extend(comments(fragment, Placement::Below, runs(aligned)));
    }
    own
}

/// What follows a declaration on its line, a separator passed over, and what follows on the next lines.
fn trailing(tree: &Tree, index: u32) -> (Vec<Token<'_>>, Vec<Token<'_>>) {
    let (mut line, mut rest) = line_and_rest(tree, index);
    let next = index + u32::try_from(line.len() + rest.len()).unwrap_or(0);
    let separator = tree.token(next).filter(|token| matches!(token.kind(), TokenKind::Comma | TokenKind::Semicolon));
    if separator.is_some() {
        line.append(&mut rest);
        let (more, below) = line_and_rest(tree, next + 1);
        line.extend(more);
        rest = below;
    }
    (line, rest)
}

/// Whether a token may stand in a continuation of a trailing comment that begins at `column`.
fn continues(tree: &Tree, token: Token<'_>, column: usize) -> bool {
    match token.kind() {
        TokenKind::Blank | TokenKind::Newline => true,
        kind if kind.is_comment() => self::column(tree, token) + 1 >= column && column > 1,
        _ => false,
    }
}

/// The characters before a token on its line, a tab as four.
fn column(tree: &Tree, token: Token<'_>) -> usize {
    let start = token.span().start as usize;
    let line = tree.text()[..start].rfind('\n').map_or(0, |at| at + 1);
    tree.text()[line..start].chars().map(|c| if c == '\t' { 4 } else { 1 }).sum()
}

/// Without the lines at the beginning that continue the trailing comment of the declaration above.
fn unaligned<'t>(tree: &'t Tree, tokens: Vec<Token<'t>>, index: u32) -> Vec<Token<'t>> {
    let run = tree.trivia_before(index).count();
    let start = index - u32::try_from(run).unwrap_or(0);
    let behind = tree.trivia_after(start).take_while(|token| token.kind() != TokenKind::Newline);
    let Some(column) = behind.filter(|token| token.kind().is_comment()).map(|token| column(tree, token)).next() else {
        return tokens;
    };
    let own_column = tree.token(index).map_or(0, |token| self::column(tree, token));
    if start == 0 || column <= own_column {
        return tokens;
    }
    let skipped = tokens.iter().take_while(|token| continues(tree, **token, column)).count();
    // Only comments count: the blanks before the next one stay with it.
    let skipped = tokens[..skipped].iter().rposition(|token| token.kind().is_comment()).map_or(0, |at| at + 1);
    tokens[skipped..].to_vec()
}
