//! What there is to elaborate: the catalogue of the tree and the libraries that the tool brings along, behind one numbering,
//! and the way from an item to the nodes of its declaration and body.

use std::collections::{BTreeMap, BTreeSet};

use super::conditional::Excluded;
use crate::library::names::{Found, Names, Scope, fold};
use crate::library::{Catalogue, Excerpt, FragmentId, Item, ItemBody, ItemId, ItemKind, Section, TypeUse};
use crate::syntax::ast::{self, AstNode, Expression, SectionKind, SourceFile, StructType, Type, VarDecl, VarSection};
use crate::syntax::{Node, NodeKind, Tree};
use crate::text::Place;

/// A catalogue and where its items begin in the common numbering.
#[derive(Clone, Copy)]
struct Part<'c> {
    catalogue: &'c Catalogue,
    names: &'c Names,
    first: u32,
}

/// All catalogues, the tree's own one first: it wins.
pub(super) struct World<'c> {
    parts: Vec<Part<'c>>,
    /// The fragments of the own catalogue, by the address of their trees.
    fragments: BTreeMap<usize, FragmentId>,
    enum_values: BTreeMap<String, Vec<ItemId>>,
    excluded: Excluded,
}

/// A variable as it is declared.
#[derive(Clone, Copy, Debug)]
pub(super) struct Decl<'c> {
    pub(super) name: &'c str,
    pub(super) section: Section,
    pub(super) constant: bool,
    /// `R_EDGE` (true) or `F_EDGE` (false).
    pub(super) edge: Option<bool>,
    pub(super) var: VarDecl<'c>,
    /// Which of the names of its declaration it is.
    pub(super) index: usize,
}

impl<'c> Decl<'c> {
    pub(super) fn address(&self) -> Option<&'c str> {
        let address = self.var.address_of(self.index).or_else(|| self.var.address());
        address.map(|token| token.text())
    }

    /// Whether the attribute stands above it.
    pub(super) fn has_attribute(&self, name: &str) -> bool {
        self.var.pragmas().into_iter().any(|pragma| ast::pragma_text(pragma).to_ascii_lowercase().contains(name))
    }
}

/// What a body is written in.
pub(super) enum Code<'c> {
    /// There is none.
    Empty,
    /// Structured Text, perhaps in several parts.
    Text(Vec<ast::Body<'c>>),
    /// Something that is not read.
    Other(&'static str),
}

fn address(tree: &Tree) -> usize {
    std::ptr::from_ref(tree) as usize
}

impl<'c> World<'c> {
    pub(super) fn new(parts: &[(&'c Catalogue, &'c Names)], symbols: &'c BTreeSet<String>) -> Self {
        let mut all = Vec::new();
        let mut first = 0;
        for (catalogue, names) in parts {
            all.push(Part { catalogue, names, first });
            first += u32::try_from(catalogue.items.len()).unwrap_or(u32::MAX);
        }
        let mut fragments = BTreeMap::new();
        if let Some(own) = all.first() {
            for (n, source) in own.catalogue.sources.iter().enumerate() {
                if let Some(tree) = source.tree.as_deref() {
                    fragments.insert(address(tree), FragmentId(u32::try_from(n).unwrap_or(u32::MAX)));
                }
            }
        }
        let mut enum_values: BTreeMap<String, Vec<ItemId>> = BTreeMap::new();
        for part in &all {
            for (id, item) in part.catalogue.iter().filter(|(_, item)| item.kind == ItemKind::Enum) {
                for variable in &item.variables {
                    enum_values.entry(fold(&variable.name)).or_default().push(ItemId(id.0 + part.first));
                }
            }
        }
        Self { parts: all, fragments, enum_values, excluded: Excluded::new(symbols) }
    }

    fn part(&self, id: ItemId) -> Part<'c> {
        let after = self.parts.partition_point(|part| part.first <= id.0);
        self.parts[after.saturating_sub(1)]
    }

    /// The number of the stub that declares the item.
    pub(super) fn stub(&self, id: ItemId) -> Option<usize> {
        let stubs = self.parts.get(1)?;
        let is_stub = self.part(id).first == stubs.first && !stubs.catalogue.items.is_empty();
        is_stub.then(|| self.item(id).place.file.0 as usize)
    }

    /// Whether the item belongs to the tree itself.
    pub(super) fn is_own(&self, id: ItemId) -> bool {
        self.part(id).first == 0
    }

    pub(super) fn item(&self, id: ItemId) -> &'c Item {
        let part = self.part(id);
        part.catalogue.item(ItemId(id.0 - part.first))
    }

    pub(super) fn qualified_name(&self, id: ItemId) -> String {
        let part = self.part(id);
        part.catalogue.qualified_name(ItemId(id.0 - part.first))
    }

    pub(super) fn parent(&self, id: ItemId) -> Option<ItemId> {
        let first = self.part(id).first;
        self.item(id).parent.map(|parent| ItemId(parent.0 + first))
    }

    pub(super) fn children(&self, id: ItemId) -> impl Iterator<Item = ItemId> + use<'c> {
        let first = self.part(id).first;
        self.item(id).children.iter().map(move |child| ItemId(child.0 + first))
    }

    /// The member of the item itself that has this name and one of these kinds.
    pub(super) fn child(&self, id: ItemId, name: &str, kinds: &[ItemKind]) -> Option<ItemId> {
        let name = fold(name);
        self.children(id).find(|child| {
            let item = self.item(*child);
            kinds.contains(&item.kind) && fold(&item.name) == name
        })
    }

    /// The items that a clause of the item names.
    pub(super) fn targets(&self, id: ItemId, uses: &[TypeUse]) -> Vec<Result<ItemId, String>> {
        let item = self.item(id);
        let resolve = |use_: &TypeUse| {
            let parts: Vec<&str> = use_.text.split('.').collect();
            match self.path(&parts, id) {
                Some(Found::Item(found)) => Ok(found),
                _ => Err(use_.text.clone()),
            }
        };
        debug_assert!(!item.name.is_empty() || uses.is_empty());
        uses.iter().map(resolve).collect()
    }

    /// What it extends: at most one block or structure.
    pub(super) fn base(&self, id: ItemId) -> Option<Result<ItemId, String>> {
        self.targets(id, &self.item(id).extends).into_iter().next()
    }

    /// Every item that another one extends.
    pub(super) fn extended(&self) -> BTreeSet<ItemId> {
        let mut found = BTreeSet::new();
        for part in &self.parts {
            let derived = part.catalogue.iter().filter(|(_, item)| !item.extends.is_empty());
            for (id, item) in derived {
                found.extend(self.targets(ItemId(id.0 + part.first), &item.extends).into_iter().flatten());
            }
        }
        found
    }

    /// Itself and what it extends, nearest first. A cycle ends it.
    pub(super) fn lineage(&self, id: ItemId) -> Vec<ItemId> {
        let mut all = vec![id];
        let mut at = id;
        while let Some(Ok(base)) = self.base(at) {
            if all.contains(&base) {
                break;
            }
            all.push(base);
            at = base;
        }
        all
    }

    /// Whether a block is, extends or implements `target`, over all steps.
    pub(super) fn conforms(&self, id: ItemId, target: ItemId) -> bool {
        let mut seen = BTreeSet::new();
        let mut work = vec![id];
        while let Some(at) = work.pop() {
            if at == target {
                return true;
            }
            if seen.insert(at) {
                let item = self.item(at);
                let bases = self.targets(at, &item.extends).into_iter().chain(self.targets(at, &item.implements));
                work.extend(bases.flatten());
            }
        }
        false
    }

    /// What a path of names means, seen from the item `from`.
    pub(super) fn path(&self, parts: &[&str], from: ItemId) -> Option<Found> {
        let home = self.part(from);
        let ordered = std::iter::once(&home).filter(|home| home.first != 0).chain(&self.parts);
        for part in ordered {
            let item = self.item(from);
            let library = if part.first == home.first { item.library } else { crate::library::LibraryId(0) };
            let scope = Scope { library, namespace: &item.namespace };
            if let Some(found) = part.names.path(part.catalogue, parts, scope) {
                return Some(match found {
                    Found::Item(id) => Found::Item(ItemId(id.0 + part.first)),
                    Found::Variable(id, n) => Found::Variable(ItemId(id.0 + part.first), n),
                });
            }
        }
        None
    }

    /// The enumerations of the whole world that have a value of this name, nearest to `from` first.
    pub(super) fn enumerations_with(&self, value: &str, from: ItemId) -> Vec<ItemId> {
        let mut found = self.enum_values.get(&fold(value)).cloned().unwrap_or_default();
        let library = self.item(from).library;
        let own = self.is_own(from);
        found.sort_by_key(|id| (self.is_own(*id) != own || self.item(*id).library != library, *id));
        found
    }

    /// The place of a node in the user's files; `None` for what the tool brings along.
    pub(super) fn place(&self, node: Node<'_>) -> Option<Place> {
        let fragment = *self.fragments.get(&address(node.tree()))?;
        self.parts.first().map(|own| own.catalogue.place(fragment, node.span()))
    }

    /// Where an item is declared.
    pub(super) fn place_of(&self, id: ItemId) -> Option<Place> {
        self.is_own(id).then(|| self.item(id).place)
    }

    fn tree(&self, id: ItemId, fragment: FragmentId) -> Option<&'c Tree> {
        self.part(id).catalogue.sources.get(fragment.0 as usize)?.tree.as_deref()
    }

    /// Whether a conditional pragma leaves the node out.
    pub(super) fn is_excluded(&self, node: Node<'_>) -> bool {
        self.excluded.holds(address(node.tree()), node)
    }

    /// The node of its declaration.
    pub(super) fn node(&self, id: ItemId) -> Option<Node<'c>> {
        let item = self.item(id);
        let excerpt = item.declaration?;
        let tree = self.tree(id, excerpt.fragment)?;
        let is_it = |node: &Node<'c>| {
            let name = node.children().find_map(ast::Name::cast);
            is_declaration(node.kind())
                && name.is_some_and(|name| name.text() == item.name)
                && excerpt.span.contains(crate::text::Span::at(node.span().start))
        };
        tree.root().descendants().find(is_it)
    }

    /// Its sections of variables.
    pub(super) fn sections(&self, id: ItemId) -> Vec<VarSection<'c>> {
        let item = self.item(id);
        let inside = |excerpt: Excerpt, with_blocks: bool| {
            let mut found = Vec::new();
            if let Some(tree) = self.tree(id, excerpt.fragment) {
                collect(tree.root(), excerpt, with_blocks, &mut found);
            }
            found
        };
        match (item.kind, item.declaration) {
            (ItemKind::Getter | ItemKind::Setter, Some(excerpt)) => inside(excerpt, true),
            (ItemKind::GlobalVariables, Some(excerpt)) if self.node(id).is_none() => inside(excerpt, false),
            _ => self.node(id).into_iter().flat_map(|node| node.children().filter_map(VarSection::cast)).collect(),
        }
    }

    /// Its variables, in the order of the source.
    pub(super) fn declared(&self, id: ItemId) -> Vec<Decl<'c>> {
        let mut all = Vec::new();
        for section in self.sections(id).into_iter().filter(|section| !self.is_excluded(section.node())) {
            let kind = match section.kind() {
                SectionKind::Local | SectionKind::Constants if self.item(id).kind == ItemKind::GlobalVariables => {
                    Section::Global
                }
                kind => Section::of(kind),
            };
            // An input that the body may not write is a variable all the same.
            let parameter = matches!(kind, Section::Input | Section::InOut | Section::Output);
            self.declarations(section.variables(), kind, section.is_constant() && !parameter, &mut all);
        }
        if let Some(fields) = self.data_block_fields(id) {
            self.declarations(fields.fields(), Section::Global, false, &mut all);
        }
        all
    }

    fn data_block_fields(&self, id: ItemId) -> Option<StructType<'c>> {
        let pou = ast::Pou::cast(self.node(id)?)?;
        match pou.data_block_type()?.0 {
            Type::Struct(fields) => Some(fields),
            _ => None,
        }
    }

    /// Variables, or the fields of a structure.
    pub(super) fn declarations(
        &self,
        from: impl Iterator<Item = VarDecl<'c>>,
        section: Section,
        constant: bool,
        out: &mut Vec<Decl<'c>>,
    ) {
        for var in from.filter(|var| !self.is_excluded(var.node())) {
            let edge = (var.has_rising_edge() || var.has_falling_edge()).then(|| var.has_rising_edge());
            let names = var.names().enumerate();
            out.extend(names.map(|(index, name)| Decl { name: name.text(), section, constant, edge, var, index }));
        }
    }

    /// What it does.
    pub(super) fn code(&self, id: ItemId) -> Code<'c> {
        let item = self.item(id);
        let excerpt = match item.body {
            ItemBody::None => return Code::Empty,
            ItemBody::Il(_) => return Code::Other("a body in Instruction List"),
            ItemBody::Drawn(..) => return Code::Other("a body in a drawn language"),
            ItemBody::St(excerpt) => excerpt,
        };
        let Some(tree) = self.tree(id, excerpt.fragment) else { return Code::Other("a body that was not read") };
        let own = self.node(id).filter(|node| std::ptr::eq(node.tree(), tree));
        let bodies: Vec<ast::Body<'c>> = match own {
            Some(node) => node.children().filter_map(ast::Body::cast).collect(),
            None => {
                let bodies = tree.root().descendants().filter_map(ast::Body::cast);
                bodies.filter(|body| excerpt.span.contains(body.span())).take(1).collect()
            }
        };
        match (bodies.is_empty(), SourceFile::of(tree).body()) {
            (true, Some(body)) => Code::Text(vec![body]),
            _ => Code::Text(bodies),
        }
    }

    /// The type of its result, or of the property; for a type, what it is.
    pub(super) fn header_type(&self, id: ItemId) -> Option<Type<'c>> {
        self.node(id)?.children().find_map(Type::cast)
    }

    /// The initial value of variables of this type.
    pub(super) fn type_initial(&self, id: ItemId) -> Option<Expression<'c>> {
        ast::TypeDecl::cast(self.node(id)?)?.initial()
    }
}

const fn is_declaration(kind: NodeKind) -> bool {
    matches!(
        kind,
        NodeKind::FunctionBlock
            | NodeKind::Function
            | NodeKind::Program
            | NodeKind::Class
            | NodeKind::Interface
            | NodeKind::OrganizationBlock
            | NodeKind::DataBlock
            | NodeKind::Method
            | NodeKind::Property
            | NodeKind::Action
            | NodeKind::Transition
            | NodeKind::TypeDecl
    )
}

/// The sections in an excerpt; those of blocks only if that is asked for.
fn collect<'c>(node: Node<'c>, excerpt: Excerpt, with_blocks: bool, out: &mut Vec<VarSection<'c>>) {
    for child in node.children() {
        match VarSection::cast(child) {
            Some(section) if excerpt.span.contains(section.span()) => out.push(section),
            Some(_) => {}
            None if with_blocks || !is_declaration(child.kind()) => collect(child, excerpt, with_blocks, out),
            None => {}
        }
    }
}
