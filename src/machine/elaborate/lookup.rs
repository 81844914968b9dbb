//! What a name means in a body: locals, variables and members of the block, globals, items, values of enumerations.

use super::access::{Designated, Spot};
use super::classes::{LayoutKey, edge_key, instance_key};
use super::finish::{Global, GlobalKind};
use super::{Elaborator, Lowered, Unsupported};
use crate::library::names::{Found, fold};
use crate::library::{ItemId, ItemKind, Section};
use crate::machine::program::{Base, Role};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::{Operand, Type, constant};
use crate::syntax::Node;
use crate::syntax::ast;

const MEMBERS: [ItemKind; 3] = [ItemKind::Method, ItemKind::Property, ItemKind::Action];

impl<'c> Elaborator<'c> {
    /// What a name means here; `None` for nothing.
    pub(super) fn lookup(&mut self, name: &str, node: Node<'c>) -> Lowered<Option<Designated>> {
        let key = fold(name);
        if let Some(spot) = self.body.frame.as_ref().and_then(|frame| frame.variables.get(&key)) {
            return Ok(Some(Designated::Spot(spot.clone())));
        }
        if let Some(found) = self.lookup_declared(&key, node)? {
            return Ok(Some(found));
        }
        if let Some(found) = self.lookup_member(name)? {
            return Ok(Some(found));
        }
        self.lookup_outside(name, node)
    }

    /// Variables of the item itself, of its block and of what that extends.
    fn lookup_declared(&mut self, key: &str, node: Node<'c>) -> Lowered<Option<Designated>> {
        let item = self.body.item;
        let owner = self.owner(item);
        let mut scopes = vec![item];
        scopes.extend(self.world.lineage(owner).into_iter().filter(|scope| *scope != item));
        for scope in scopes {
            let decls = self.decls(scope);
            let Some(n) = decls.iter().position(|decl| fold(decl.name) == *key) else { continue };
            let decl = decls[n];
            if decl.section == Section::External {
                return match self.global_path(&[decl.name])? {
                    Some(found) => Ok(Some(found)),
                    None => Err(self.unsupported(
                        "a global variable without source",
                        node,
                        format!("`{}` is declared as external and nowhere as global", decl.name),
                    )),
                };
            }
            return self.declared_variable(scope, n, node).map(Some);
        }
        Ok(None)
    }

    /// A variable of a block, or of the item itself.
    fn declared_variable(&mut self, scope: ItemId, n: usize, node: Node<'c>) -> Lowered<Designated> {
        if let Some(value) = self.constant_variable(scope, n)? {
            return Ok(Designated::Value(value));
        }
        let decl = self.decls(scope)[n];
        if let Some(address) = decl.address().filter(|address| !address.ends_with('*')) {
            let type_ = self.type_of(scope, n)?;
            return self.address(address, Some(type_), node).map(Designated::Spot);
        }
        let role = match decl.section {
            Section::Temp => Role::Temporary,
            Section::Stat => Role::State,
            Section::Global if self.world.item(scope).kind == ItemKind::GlobalVariables => {
                return self.global(scope, n).map(Designated::Spot);
            }
            _ => return self.instance_variable(scope, n, node),
        };
        self.static_variable(scope, n, role).map(Designated::Spot)
    }

    fn instance_variable(&mut self, scope: ItemId, n: usize, node: Node<'c>) -> Lowered<Designated> {
        let decl = self.decls(scope)[n];
        let Some(class) = self.body.class else {
            let message = format!("`{}` is not constant", decl.name);
            return Err(self.unsupported(super::constants::NOT_CONSTANT, node, message));
        };
        let layout = self.layout(LayoutKey::Class(class))?;
        let plain = fold(decl.name);
        let key = match decl.section {
            Section::Inst if self.world.parent(scope).is_some() => {
                instance_key(&self.world.item(scope).name, decl.name)
            }
            _ if decl.edge.is_some() => edge_key(&plain),
            _ => plain,
        };
        let this = Spot::this(self.instance_type(class));
        match layout.fields.iter().find(|field| field.key == key) {
            Some(field) => Ok(Designated::Spot(this.field(field))),
            None => {
                let message = format!("`{}` is a variable of another block", decl.name);
                Err(self.unsupported("a name that means nothing here", node, message))
            }
        }
    }

    /// Methods, properties and actions of the class.
    fn lookup_member(&mut self, name: &str) -> Lowered<Option<Designated>> {
        let Some(class) = self.body.class else { return Ok(None) };
        let this = Spot::this(self.instance_type(class));
        Ok(self.member(class, name).map(|item| Designated::Member { this, item, class }))
    }

    /// The method, property or action of that name, of the class or of what it extends, nearest first.
    pub(super) fn member(&self, class: ItemId, name: &str) -> Option<ItemId> {
        self.world.lineage(class).into_iter().find_map(|at| self.world.child(at, name, &MEMBERS))
    }

    /// The method of that name.
    pub(super) fn find_method(&self, class: ItemId, name: &str) -> Option<ItemId> {
        self.world.lineage(class).into_iter().find_map(|at| self.world.child(at, name, &[ItemKind::Method]))
    }

    /// Globals, items, values of enumerations.
    pub(super) fn lookup_outside(&mut self, name: &str, node: Node<'c>) -> Lowered<Option<Designated>> {
        if let Some(value) = self.local_enum_value(name)? {
            return Ok(Some(Designated::Value(value)));
        }
        if let Some(found) = self.global_path(&[name])? {
            return Ok(Some(found));
        }
        for item in self.world.enumerations_with(name, self.body.item) {
            if let Some(value) = self.enum_value(item, name)? {
                return Ok(Some(Designated::Value(value)));
            }
        }
        let _ = node;
        Ok(None)
    }

    /// What a path outside of the block means.
    pub(super) fn global_path(&mut self, parts: &[&str]) -> Lowered<Option<Designated>> {
        Ok(match self.world.path(parts, self.body.item) {
            Some(Found::Item(item)) => Some(Designated::Item(item)),
            Some(Found::Variable(item, n)) => {
                let name = self.world.item(item).variables.get(n).map(|variable| variable.name.clone());
                match name {
                    Some(name) => self.global_named(item, &name)?,
                    None => None,
                }
            }
            None => None,
        })
    }

    /// The variable `name` of a list of globals.
    pub(super) fn global_named(&mut self, item: ItemId, name: &str) -> Lowered<Option<Designated>> {
        let key = fold(name.split('.').next().unwrap_or(name));
        let Some(n) = self.decls(item).iter().position(|decl| fold(decl.name) == key) else { return Ok(None) };
        if let Some(value) = self.constant_variable(item, n)? {
            return Ok(Some(Designated::Value(value)));
        }
        self.global(item, n).map(|spot| Some(Designated::Spot(spot)))
    }

    /// The variable that a Siemens data block of a named type is.
    pub(super) fn data_block(&mut self, item: ItemId) -> Lowered<Option<Spot>> {
        if let Some(known) = self.statics.get(&(item, usize::MAX)) {
            return Ok(Some(known.clone()));
        }
        if self.world.item(item).kind != ItemKind::GlobalVariables {
            return Ok(None);
        }
        let Some(type_) = self.world.header_type(item).filter(|type_| !matches!(type_, ast::Type::Struct(_))) else {
            return Ok(None);
        };
        let type_ = self.resolve(type_, item)?;
        let values = self.defaults(&type_)?.values;
        let name = self.world.item(item).name.clone();
        let placement =
            super::memory::Placement { name: name.clone(), role: Role::State, place: self.world.place_of(item) };
        let slot = self.put(&type_, &values, &placement)?;
        let length = self.known_size(&type_)?;
        let kind = GlobalKind::Variable;
        self.globals.push(Global { slot, length, path: name, type_: type_.clone(), kind, constant: false });
        let spot = Spot { location: super::memory::at(slot), type_, constant: false };
        self.statics.insert((item, usize::MAX), spot.clone());
        self.cone.insert(item);
        Ok(Some(spot))
    }

    fn global(&mut self, item: ItemId, n: usize) -> Lowered<Spot> {
        let decl = self.decls(item)[n];
        if let Some(address) = decl.address().filter(|address| !address.ends_with('*')) {
            let type_ = self.type_of(item, n)?;
            return self.address(address, Some(type_), ast::AstNode::node(decl.var));
        }
        let known = self.statics.contains_key(&(item, n));
        let spot = self.static_variable(item, n, Role::State)?;
        if !known && let Base::Slot(slot) = spot.location.base {
            let kind = match decl.address() {
                Some(address) if address.to_ascii_uppercase().starts_with("%I") => GlobalKind::Input,
                Some(address) if address.to_ascii_uppercase().starts_with("%Q") => GlobalKind::Output,
                _ => GlobalKind::Variable,
            };
            let path = format!("{}.{}", self.world.item(item).name, decl.name);
            let length = self.known_size(&spot.type_)?;
            let constant = decl.constant;
            self.globals.push(Global { slot, length, path, type_: spot.type_.clone(), kind, constant });
        }
        Ok(spot)
    }

    /// A direct address.
    pub(super) fn address(&mut self, address: &str, type_: Option<Type>, node: Node<'c>) -> Lowered<Spot> {
        let key = address.to_ascii_uppercase();
        if let Some(known) = self.addresses.get(&key) {
            if type_.as_ref().is_none_or(|type_| *type_ == known.type_) {
                return Ok(known.clone());
            }
            let message = format!("`{address}` is used with more than one type");
            return Err(self.unsupported("an address of several types", node, message));
        }
        let mut letters = key.trim_start_matches('%').chars();
        let kind = match letters.next() {
            Some('I') => GlobalKind::Input,
            Some('Q') => GlobalKind::Output,
            Some('M') => GlobalKind::Memory,
            _ => return Err(self.unsupported("an address of this form", node, format!("the address `{address}`"))),
        };
        let type_ = type_.unwrap_or(Type::Scalar(match letters.next() {
            Some('B') => Scalar::Bits(8),
            Some('W') => Scalar::Bits(16),
            Some('D') => Scalar::Bits(32),
            Some('L') => Scalar::Bits(64),
            _ => Scalar::Bool,
        }));
        self.overlapping(&key, &type_, node)?;
        let values = self.defaults(&type_)?.values;
        let placement =
            super::memory::Placement { name: address.to_owned(), role: Role::State, place: self.place(node) };
        let slot = self.put(&type_, &values, &placement)?;
        let spot = Spot { location: super::memory::at(slot), type_, constant: false };
        let length = self.known_size(&spot.type_)?;
        let (path, constant) = (address.to_owned(), false);
        self.globals.push(Global { slot, length, path, type_: spot.type_.clone(), kind, constant });
        self.addresses.insert(key, spot.clone());
        Ok(spot)
    }

    /// The value of an enumeration that is declared with a variable of the block.
    fn local_enum_value(&mut self, name: &str) -> Lowered<Option<Operand<crate::machine::program::Location>>> {
        let key = fold(name);
        let owner = self.owner(self.body.item);
        let mut scopes = self.world.lineage(owner);
        scopes.push(self.body.item);
        for scope in scopes {
            for decl in self.decls(scope).iter() {
                let Some(ast::Type::Enum(values)) = decl.var.type_() else { continue };
                let named = values.values().any(|value| value.name().is_some_and(|name| fold(name.text()) == key));
                if !named {
                    continue;
                }
                let all = self.values_of(values, scope, false)?;
                let type_ = self.resolve(ast::Type::Enum(values), scope)?;
                let scalar = type_.scalar().unwrap_or(Scalar::Bool);
                if let Some((_, number)) = all.iter().find(|(known, _)| *known == key) {
                    return Ok(Some(Operand::Typed(constant(scalar, scalar.bits(*number), None), type_)));
                }
            }
        }
        Ok(None)
    }

    /// Whether the name is that of a constant in the scope of an item.
    pub(super) fn is_constant_name(&mut self, name: &str, scope: ItemId) -> bool {
        let key = fold(name);
        let own = self.world.lineage(self.owner(scope)).into_iter().chain([scope]);
        for item in own {
            if self.decls(item).iter().any(|decl| decl.constant && fold(decl.name) == key) {
                return true;
            }
        }
        matches!(self.world.path(&[name], scope), Some(Found::Variable(..)))
    }

    /// The instance of a program, which there is once.
    pub(super) fn program_instance(&mut self, item: ItemId) -> Lowered<Spot> {
        let type_ = self.instance_type(item);
        if let Some(slot) = self.program_instances.get(&item) {
            return Ok(Spot { location: super::memory::at(*slot), type_, constant: false });
        }
        let defaults = self.defaults(&type_)?;
        let name = self.world.item(item).name.clone();
        let placement = super::memory::Placement { name, role: Role::State, place: self.world.place_of(item) };
        let slot = self.put(&type_, &defaults.values, &placement)?;
        self.program_instances.insert(item, slot);
        let location = super::memory::at(slot);
        if defaults.dynamic {
            let start = location.clone();
            self.at_start(item, Some(item), |this| {
                this.call_start(item, &start);
                Ok(())
            })?;
        }
        Ok(Spot { location, type_, constant: false })
    }

    /// That a name means nothing.
    pub(super) fn unknown(&self, name: &str, node: Node<'c>) -> Unsupported {
        self.unsupported("a name without source", node, format!("`{name}` has no source"))
            .help("add its library to the tree, or give a stub in the configuration")
    }
}
