//! Layouts of structures and of instances of blocks: their variables in a row, inherited ones first.

use std::rc::Rc;
use std::sync::Arc;

use super::world::Decl;
use super::{Elaborator, Lowered, Unsupported};
use crate::library::names::fold;
use crate::library::{ItemId, ItemKind, Section};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::Type;

/// What has a layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum LayoutKey {
    /// A structure by its number.
    Structure(u32),
    /// A block, class or program.
    Class(ItemId),
}

/// Where the variables of a structure or an instance lie.
#[derive(Debug)]
pub(super) struct Layout<'c> {
    pub(super) fields: Vec<Field<'c>>,
    /// How many slots it has.
    pub(super) size: u32,
}

/// A variable in a layout.
#[derive(Clone, Debug)]
pub(super) struct Field<'c> {
    /// The folded name; with `$` where no text can name it.
    pub(super) key: String,
    /// The name as it is declared.
    pub(super) name: String,
    pub(super) type_: Type,
    pub(super) offset: u32,
    pub(super) section: Section,
    /// What declares it.
    pub(super) owner: ItemId,
    pub(super) decl: Option<Decl<'c>>,
}

/// The name of the slot that an edge input is read from in the body.
pub(super) fn edge_key(key: &str) -> String {
    format!("{key}$edge")
}

/// The name of the slot that keeps an edge input's last value.
pub(super) fn last_key(key: &str) -> String {
    format!("{key}$last")
}

impl Layout<'_> {
    pub(super) fn field(&self, name: &str) -> Option<&Field<'_>> {
        let key = fold(name);
        self.fields.iter().find(|field| field.key == key)
    }
}

impl<'c> Elaborator<'c> {
    /// The layout of a structure or block.
    pub(super) fn layout(&mut self, key: LayoutKey) -> Lowered<Rc<Layout<'c>>> {
        if let Some(known) = self.layouts.get(&key) {
            return Ok(Rc::clone(known));
        }
        if !self.open_layouts.insert(key) {
            let (name, place) = match key {
                LayoutKey::Class(item) => (self.world.item(item).name.clone(), self.world.place_of(item)),
                LayoutKey::Structure(_) => ("STRUCT".to_owned(), None),
            };
            let message = format!("`{name}` contains itself");
            return Err(Unsupported::new("a type that contains itself", place, message));
        }
        let found = match key {
            LayoutKey::Structure(id) => self.structure_layout(id),
            LayoutKey::Class(item) => self.class_layout(item),
        };
        self.open_layouts.remove(&key);
        let found = Rc::new(found?);
        self.layouts.insert(key, Rc::clone(&found));
        Ok(found)
    }

    /// The layout that the type has, if it has fields.
    pub(super) fn layout_of(&mut self, type_: &Type) -> Lowered<Option<Rc<Layout<'c>>>> {
        match layout_key(type_) {
            Some(key) => self.layout(key).map(Some),
            None => Ok(None),
        }
    }

    fn structure_layout(&mut self, id: u32) -> Lowered<Layout<'c>> {
        let Some(def) = self.structures.get(id as usize).copied() else {
            return Err(Unsupported::new("a type that is not modelled", None, "a structure without a declaration"));
        };
        let mut layout = Layout { fields: Vec::new(), size: 0 };
        if let Some(base) = def.item.and_then(|item| self.world.base(item)) {
            let base = base.map_err(|name| self.without_source(def.scope, &name))?;
            if let Some(base) = self.item_type(base).ok().and_then(|type_| layout_key(&type_)) {
                let base = self.layout(base)?;
                layout.fields.extend(base.fields.iter().cloned());
                layout.size = base.size;
            }
        }
        let mut decls = Vec::new();
        self.world.declarations(def.node.fields(), Section::Field, false, &mut decls);
        for decl in decls {
            let type_ = self.declared_type(&decl, def.scope)?;
            self.append(&mut layout, decl, type_, def.scope)?;
        }
        if def.node.is_union() { self.overlaid(layout, def.item) } else { Ok(layout) }
    }

    /// All members of a union begin at one slot, where they are scalars of one width.
    fn overlaid(&mut self, mut layout: Layout<'c>, item: Option<ItemId>) -> Lowered<Layout<'c>> {
        let mut widths = Vec::new();
        for field in &layout.fields {
            widths.push(field.type_.scalar().map(Scalar::width));
        }
        if widths.windows(2).any(|pair| pair[0] != pair[1]) || widths.contains(&None) {
            let place = item.and_then(|item| self.world.place_of(item));
            let message = "a union whose members are not scalars of one width";
            return Err(Unsupported::new("a union that reinterprets memory", place, message));
        }
        layout.fields.iter_mut().for_each(|field| field.offset = 0);
        layout.size = u32::from(!layout.fields.is_empty());
        Ok(layout)
    }

    pub(super) fn without_source(&self, from: ItemId, name: &str) -> Unsupported {
        Unsupported::new("a type without source", self.world.place_of(from), format!("`{name}` has no source"))
            .help("give it a stub in the configuration, or add its library to the tree")
    }

    fn append(&mut self, layout: &mut Layout<'c>, decl: Decl<'c>, type_: Type, owner: ItemId) -> Lowered<()> {
        let size = self.size(&type_, decl.var)?;
        let (name, key) = (decl.name.to_owned(), fold(decl.name));
        let (offset, section) = (layout.size, decl.section);
        layout.fields.push(Field { key, name, type_, offset, section, owner, decl: Some(decl) });
        layout.size = self.grown(layout.size, size, owner)?;
        Ok(())
    }

    /// A slot that no text names.
    fn append_hidden(layout: &mut Layout<'c>, key: String, type_: Type, owner: ItemId) {
        let (name, offset) = (key.clone(), layout.size);
        layout.fields.push(Field { key, name, type_, offset, section: Section::Var, owner, decl: None });
        layout.size += 1;
    }

    fn grown(&self, size: u32, by: u32, owner: ItemId) -> Lowered<u32> {
        let sum = size.checked_add(by).filter(|sum| *sum <= self.options.memory_limit);
        sum.ok_or_else(|| {
            let message = format!(
                "`{}` needs more than {} slots of memory",
                self.world.item(owner).name,
                self.options.memory_limit
            );
            Unsupported::new("more memory than the limit", self.world.place_of(owner), message)
        })
    }

    /// A header slot, what is inherited, and the own variables that belong to an instance.
    fn class_layout(&mut self, item: ItemId) -> Lowered<Layout<'c>> {
        let mut layout = Layout { fields: Vec::new(), size: 1 };
        if let Some(base) = self.world.base(item) {
            let base = base.map_err(|name| self.without_source(item, &name))?;
            let base = self.layout(LayoutKey::Class(base))?;
            layout.fields.extend(base.fields.iter().cloned());
            layout.size = base.size;
        }
        for (number, decl) in self.decls(item).iter().enumerate() {
            if !in_instance(decl) || self.is_constant_scalar(item, number)? {
                continue;
            }
            let type_ = self.type_of(item, number)?;
            self.append(&mut layout, *decl, type_, item)?;
            if decl.edge.is_some() {
                let key = fold(decl.name);
                Self::append_hidden(&mut layout, edge_key(&key), Type::Scalar(Scalar::Bool), item);
                Self::append_hidden(&mut layout, last_key(&key), Type::Scalar(Scalar::Bool), item);
            }
        }
        for (owner, key, type_) in self.chart_fields(item) {
            Self::append_hidden(&mut layout, key, type_, owner);
        }
        self.method_instances(item, &mut layout)?;
        self.cone.insert(item);
        Ok(layout)
    }

    /// `VAR_INST` of methods: variables of the instance.
    fn method_instances(&mut self, item: ItemId, layout: &mut Layout<'c>) -> Lowered<()> {
        let methods: Vec<ItemId> =
            self.world.children(item).filter(|id| self.world.item(*id).kind == ItemKind::Method).collect();
        for method in methods {
            for (number, decl) in self.decls(method).iter().enumerate() {
                if decl.section == Section::Inst {
                    let type_ = self.type_of(method, number)?;
                    self.append(layout, *decl, type_, method)?;
                    if let Some(last) = layout.fields.last_mut() {
                        last.key = instance_key(&self.world.item(method).name, decl.name);
                    }
                }
            }
        }
        Ok(())
    }

    /// Whether the variable is a constant of a scalar type, which needs no memory.
    pub(super) fn is_constant_scalar(&mut self, item: ItemId, n: usize) -> Lowered<bool> {
        let constant = self.decls(item).get(n).is_some_and(|decl| decl.constant);
        Ok(constant && self.constant_variable(item, n)?.is_some())
    }

    /// The block that a member belongs to, or the item itself.
    pub(super) fn owner(&self, item: ItemId) -> ItemId {
        let mut at = item;
        while let Some(parent) = self.world.parent(at) {
            at = parent;
        }
        at
    }

    /// The class as a type.
    pub(super) fn instance_type(&self, item: ItemId) -> Type {
        Type::Instance { item, name: Arc::from(self.world.item(item).name.as_str()) }
    }
}

/// The key of a method's `VAR_INST` in the layout of its block.
pub(super) fn instance_key(method: &str, name: &str) -> String {
    format!("{}${}", fold(method), fold(name))
}

/// The layout that a type has.
pub(super) const fn layout_key(type_: &Type) -> Option<LayoutKey> {
    match type_ {
        Type::Structure { id, .. } => Some(LayoutKey::Structure(*id)),
        Type::Instance { item, .. } => Some(LayoutKey::Class(*item)),
        _ => None,
    }
}

/// Whether a block's variable lies in its instances; temporary and static ones do not, nor do those at addresses.
fn in_instance(decl: &Decl<'_>) -> bool {
    let section = matches!(
        decl.section,
        Section::Input | Section::Output | Section::InOut | Section::Var | Section::Inst | Section::Global
    );
    section && decl.address().is_none_or(|address| address.ends_with('*'))
}
