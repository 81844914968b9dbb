//! `TYPE … END_TYPE`.

use super::members::modify;
use super::variables::own_token;
use super::{Lowering, comments};
use crate::library::{Comment, Excerpt, FragmentId, Item, ItemId, ItemKind, Placement};
use crate::syntax::ast::{AstNode, Type, TypeBlock, TypeDecl};
use crate::syntax::{Token, TokenKind, Tree};

impl Lowering<'_> {
    /// The types of a block.
    pub(super) fn types(&mut self, tree: &Tree, fragment: FragmentId, block: TypeBlock<'_>) -> Vec<ItemId> {
        let types: Vec<TypeDecl<'_>> = block.types().collect();
        let alone = types.len() == 1;
        types.into_iter().filter_map(|one| self.type_(tree, fragment, block, one, alone)).collect()
    }

    fn type_(
        &mut self,
        tree: &Tree,
        fragment: FragmentId,
        block: TypeBlock<'_>,
        one: TypeDecl<'_>,
        alone: bool,
    ) -> Option<ItemId> {
        let name = one.name()?;
        let place = self.place(fragment, name.span());
        let mut item = self.blank(ItemKind::Alias, name.text(), place, None);
        let whole = if alone { block.node() } else { one.node() };
        item.declaration = Some(Excerpt { fragment, span: whole.span() });
        modify(&mut item, one.modifiers());
        item.extends = self.paths(fragment, one.extends());
        let pragmas = if alone { block.pragmas() } else { Vec::new() };
        let pragmas: Vec<Token<'_>> = pragmas.into_iter().chain(one.pragmas()).collect();
        item.pragmas = self.pragmas(fragment, &pragmas);
        if let Some(type_) = one.type_() {
            self.shape(fragment, type_, &mut item);
        }
        item.comments = type_comments(tree, fragment, block, one, alone);
        Some(self.push(item))
    }

    fn shape(&self, fragment: FragmentId, type_: Type<'_>, item: &mut Item) {
        match type_ {
            Type::Struct(inner) => {
                item.kind = if inner.is_union() { ItemKind::Union } else { ItemKind::Struct };
                item.variables = self.fields(fragment, inner);
            }
            Type::Enum(inner) => {
                item.kind = ItemKind::Enum;
                item.variables = self.values(fragment, inner);
                item.type_ = inner.base().map(|base| self.type_use(fragment, Type::Named(base)));
            }
            Type::Subrange(_) => {
                item.kind = ItemKind::Subrange;
                item.type_ = Some(self.type_use(fragment, type_));
            }
            _ => item.type_ = Some(self.type_use(fragment, type_)),
        }
    }
}

/// Above the block (if it holds one type only), above the type, behind its opening, behind its end.
fn type_comments(
    tree: &Tree,
    fragment: FragmentId,
    block: TypeBlock<'_>,
    one: TypeDecl<'_>,
    alone: bool,
) -> Vec<Comment> {
    let mut own = Vec::new();
    if alone {
        own.extend(comments::before(tree, fragment, block.node().first_token()));
    }
    own.extend(comments::before(tree, fragment, one.node().first_token()));
    if let Some(colon) = own_token(one.node(), TokenKind::Colon) {
        own.extend(comments::behind(tree, fragment, colon.index() + 1, Placement::BelowHeader));
    }
    let opening = one.type_().and_then(|type_| {
        let kind = match type_ {
            Type::Struct(_) | Type::Enum(_) => type_.node().own_tokens().next(),
            _ => None,
        };
        kind.filter(|token| matches!(token.kind(), TokenKind::Struct | TokenKind::Union | TokenKind::LParen))
    });
    let on_line = |index: u32| {
        let all = comments::behind(tree, fragment, index, Placement::BetweenSections);
        all.into_iter().filter(|comment| comment.placement == Placement::Trailing)
    };
    own.extend(opening.into_iter().flat_map(|token| on_line(token.index() + 1)));
    let end = one.node().end_token();
    let semicolon = tree.token(end).is_some_and(|token| token.kind() == TokenKind::Semicolon);
    own.extend(on_line(end + u32::from(semicolon)));
    own
}
