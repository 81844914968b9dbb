//! POUs and their members, as texts declare them.

use super::{Lowering, comments};
use crate::library::{
    Access, Comment, Excerpt, FragmentId, Item, ItemBody, ItemId, ItemKind, Placement, TypeUse, Variable,
};
use crate::syntax::ast::{
    Accessor, AstNode, Body, DataBlockType, Modifier, Path, Pou, PouKind, Property, Transition, Type, VarSection,
};
use crate::syntax::{Node, Tree};
use crate::text::Span;

const fn kind(kind: PouKind) -> ItemKind {
    match kind {
        PouKind::FunctionBlock => ItemKind::FunctionBlock,
        PouKind::Function => ItemKind::Function,
        PouKind::Program | PouKind::OrganizationBlock => ItemKind::Program,
        PouKind::Class => ItemKind::Class,
        PouKind::Interface => ItemKind::Interface,
        PouKind::DataBlock => ItemKind::GlobalVariables,
        PouKind::Method => ItemKind::Method,
        PouKind::Action => ItemKind::Action,
    }
}

impl Lowering<'_> {
    /// A POU with its members; `None` if it has no name.
    pub(super) fn pou(
        &mut self,
        tree: &Tree,
        fragment: FragmentId,
        pou: Pou<'_>,
        parent: Option<ItemId>,
    ) -> Option<ItemId> {
        let name = pou.name()?;
        let place = self.place(fragment, name.span());
        let mut item = self.blank(kind(pou.kind()), name.text(), place, parent);
        modify(&mut item, pou.modifiers());
        item.extends = self.paths(fragment, pou.extends());
        item.implements = self.paths(fragment, pou.implements());
        item.type_ = pou.return_type().map(|type_| self.type_use(fragment, type_));
        item.pragmas = self.pragmas(fragment, &pou.pragmas());
        item.variables = pou.var_sections().flat_map(|section| self.section(fragment, section)).collect();
        if let Some(DataBlockType(type_)) = pou.data_block_type() {
            match type_ {
                Type::Struct(inner) => item.variables.extend(self.fields(fragment, inner)),
                other => item.type_ = Some(self.type_use(fragment, other)),
            }
        }
        let header = pou.header_span();
        item.declaration = Some(Excerpt { fragment, span: declaration(header, pou.var_sections()) });
        item.body = body(tree, fragment, pou.body());
        let members = pou.methods().map(|member| member.node());
        let members = members.chain(pou.properties().map(|member| member.node()));
        let members = members.chain(pou.actions().map(|member| member.node()));
        let members = members.chain(pou.transitions().map(|member| member.node()));
        let starts: Vec<u32> = members.map(|node| node.first_token()).collect();
        item.comments = pou_comments(tree, fragment, pou.node(), header, pou.var_sections().collect());
        item.comments.retain_mut(|comment| leave_to_members(tree, comment, &starts));
        let id = self.push(item);
        pou.methods().for_each(|method| _ = self.pou(tree, fragment, method, Some(id)));
        pou.properties().for_each(|property| _ = self.property(tree, fragment, property, Some(id)));
        pou.actions().for_each(|action| _ = self.pou(tree, fragment, action, Some(id)));
        pou.transitions().for_each(|transition| _ = self.transition(tree, fragment, transition, Some(id)));
        Some(id)
    }

    /// A property with its accessors; a `PROPERTY_GET` and a `PROPERTY_SET` of one name are one property.
    pub(super) fn property(
        &mut self,
        tree: &Tree,
        fragment: FragmentId,
        property: Property<'_>,
        parent: Option<ItemId>,
    ) -> Option<ItemId> {
        let name = property.name()?;
        let id = self.sibling(parent, name.text()).unwrap_or_else(|| {
            let place = self.place(fragment, name.span());
            let mut item = self.blank(ItemKind::Property, name.text(), place, parent);
            modify(&mut item, property.modifiers());
            item.type_ = property.type_().map(|type_| self.type_use(fragment, type_));
            item.pragmas = self.pragmas(fragment, &property.pragmas());
            let header = property.header_span();
            let own = property.var_sections().filter(|_| !property.is_accessor());
            item.declaration = Some(Excerpt { fragment, span: declaration(header, own) });
            item.comments = pou_comments(tree, fragment, property.node(), header, property.var_sections().collect());
            self.push(item)
        });
        if property.is_accessor() {
            let sections = property.var_sections().collect();
            self.accessor(tree, fragment, id, (property.has_get(), property.node()), sections, property.body());
        }
        for accessor in property.accessors() {
            let sections = accessor.var_sections().collect();
            self.accessor(tree, fragment, id, (accessor.is_get(), accessor.node()), sections, accessor.body());
            self.accessor_access(id, accessor);
        }
        Some(id)
    }

    fn sibling(&self, parent: Option<ItemId>, name: &str) -> Option<ItemId> {
        let children = &self.items[parent?.0 as usize].children;
        let same = |id: &&ItemId| {
            let item = &self.items[id.0 as usize];
            item.kind == ItemKind::Property && item.name.eq_ignore_ascii_case(name)
        };
        children.iter().find(same).copied()
    }

    fn accessor(
        &mut self,
        tree: &Tree,
        fragment: FragmentId,
        parent: ItemId,
        (get, node): (bool, Node<'_>),
        sections: Vec<VarSection<'_>>,
        own_body: Option<Body<'_>>,
    ) {
        let (kind, name) = if get { (ItemKind::Getter, "Get") } else { (ItemKind::Setter, "Set") };
        let place = self.place(fragment, Span::at(node.span().start));
        let mut item = self.blank(kind, name, place, Some(parent));
        item.variables = sections.iter().flat_map(|section| self.section(fragment, *section)).collect();
        if !sections.is_empty() {
            let span = declaration(Span::at(sections[0].span().start), sections.iter().copied());
            item.declaration = Some(Excerpt { fragment, span });
        }
        item.body = body(tree, fragment, own_body);
        self.push(item);
    }

    fn accessor_access(&mut self, property: ItemId, accessor: Accessor<'_>) {
        let Some(id) = self.items[property.0 as usize].children.last().copied() else { return };
        modify(self.item_mut(id), accessor.modifiers());
    }

    /// A transition that is declared by its name; the transitions of a chart belong to its body.
    pub(super) fn transition(
        &mut self,
        tree: &Tree,
        fragment: FragmentId,
        transition: Transition<'_>,
        parent: Option<ItemId>,
    ) -> Option<ItemId> {
        let name = transition.name()?;
        let place = self.place(fragment, name.span());
        let mut item = self.blank(ItemKind::Transition, name.text(), place, parent);
        item.declaration = Some(Excerpt { fragment, span: Span::new(transition.span().start, name.span().end) });
        item.comments = comments::before(tree, fragment, transition.node().first_token());
        item.body = body(tree, fragment, transition.body());
        Some(self.push(item))
    }

    /// Bare sections as a list of globals of that name, or as variables of the item before them.
    pub(super) fn globals(
        &mut self,
        tree: &Tree,
        fragment: FragmentId,
        name: &str,
        sections: &[VarSection<'_>],
    ) -> Option<ItemId> {
        let (first, last) = (sections.first()?, sections.last()?);
        let place = self.place(fragment, Span::at(first.span().start));
        let mut item = self.blank(ItemKind::GlobalVariables, name, place, None);
        item.variables = self.all(fragment, sections);
        for variable in &mut item.variables {
            if variable.section == crate::library::Section::Var {
                variable.section = crate::library::Section::Global;
            }
        }
        item.pragmas = self.pragmas(fragment, &first.pragmas());
        item.comments = comments::before(tree, fragment, first.node().first_token());
        item.declaration = Some(Excerpt { fragment, span: first.span().cover(last.span()) });
        Some(self.push(item))
    }

    pub(super) fn all(&self, fragment: FragmentId, sections: &[VarSection<'_>]) -> Vec<Variable> {
        sections.iter().flat_map(|section| self.section(fragment, *section)).collect()
    }

    pub(super) fn paths<'t>(&self, fragment: FragmentId, paths: impl Iterator<Item = Path<'t>>) -> Vec<TypeUse> {
        paths.map(|path| TypeUse::new(&path.text(), Some(self.place(fragment, path.span())))).collect()
    }
}

/// Gives `item` what the words before its name say.
pub(super) fn modify(item: &mut Item, modifiers: impl Iterator<Item = Modifier>) {
    for modifier in modifiers {
        match modifier {
            Modifier::Public => item.access = Access::Public,
            Modifier::Private => item.access = Access::Private,
            Modifier::Protected => item.access = Access::Protected,
            Modifier::Internal => item.access = Access::Internal,
            Modifier::Abstract => item.is_abstract = true,
            Modifier::Final => item.is_final = true,
            Modifier::Override => item.is_override = true,
        }
    }
}

/// From the header's start to the end of the last section.
fn declaration<'t>(header: Span, sections: impl Iterator<Item = VarSection<'t>>) -> Span {
    sections.fold(header, |span, section| span.cover(section.span()))
}

/// The body with the comments that lead it.
pub(super) fn body(tree: &Tree, fragment: FragmentId, body: Option<Body<'_>>) -> ItemBody {
    let Some(body) = body.filter(|body| !body.span().is_empty()) else { return ItemBody::None };
    let leading = tree.trivia_before(body.node().first_token()).filter(|token| token.kind().is_comment()).last();
    let start = leading.map_or(body.span().start, |token| token.span().start);
    let excerpt = Excerpt { fragment, span: Span::new(start, body.span().end) };
    if body.instructions().is_some() { ItemBody::Il(excerpt) } else { ItemBody::St(excerpt) }
}

/// Takes from a comment below a header or a section what stands right above a member, which it documents; whether
/// anything is left.
fn leave_to_members(tree: &Tree, comment: &mut Comment, starts: &[u32]) -> bool {
    let below =
        matches!(comment.placement, Placement::BelowHeader | Placement::BetweenSections | Placement::AfterSections);
    let start_of = |index: &u32| tree.token(*index).map(|token| token.span().start);
    let last = comment.spans.last().map_or(0, |span| span.end);
    let next = starts.iter().filter_map(start_of).filter(|start| *start >= last).min();
    let between = |from: u32, to: u32| tree.text().get(from as usize..to as usize).unwrap_or("x");
    let Some(mut next) = next.filter(|next| below && is_bare(between(last, *next))) else { return true };
    while let Some(span) = comment.spans.last().filter(|span| !has_gap(between(span.end, next))) {
        next = span.start;
        comment.spans.pop();
    }
    !comment.spans.is_empty()
}

/// Whether there are only blanks and pragmas.
fn is_bare(text: &str) -> bool {
    let mut parts = text.split('{');
    let first = parts.next().unwrap_or_default();
    first.trim().is_empty() && parts.all(|part| part.split_once('}').is_some_and(|(_, rest)| rest.trim().is_empty()))
}

/// Whether a line of `text`, which begins and ends inside of lines, is empty.
fn has_gap(text: &str) -> bool {
    let lines: Vec<&str> = text.split('\n').collect();
    lines.get(1..lines.len().saturating_sub(1)).is_some_and(|inner| inner.iter().any(|line| line.trim().is_empty()))
}

/// The comments of whatever has a header and sections.
fn pou_comments(
    tree: &Tree,
    fragment: FragmentId,
    node: Node<'_>,
    header: Span,
    sections: Vec<VarSection<'_>>,
) -> Vec<Comment> {
    let mut own = comments::before(tree, fragment, node.first_token());
    let end = node.tokens().find(|token| token.span().start >= header.end).map_or(node.end_token(), |t| t.index());
    own.extend(comments::behind(tree, fragment, end, Placement::BelowHeader));
    for (i, section) in sections.iter().enumerate() {
        let last = i + 1 == sections.len();
        let placement = if last { Placement::AfterSections } else { Placement::BetweenSections };
        own.extend(comments::after(tree, fragment, section.node().end_token(), placement));
    }
    own
}
