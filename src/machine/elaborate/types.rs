//! Types as they are written to types as they are meant.

use std::sync::Arc;

use super::world::Decl;
use super::{Elaborator, Lowered, Unsupported};
use crate::library::names::Found;
use crate::library::{ItemId, ItemKind, Section};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::types::{INT, elementary};
use crate::semantics::typing::{Array, Type};
use crate::syntax::ast::{self, AstNode, Dimension, Expression, NamedType, Range, StructType};
use crate::syntax::{Node, NodeKind};

/// How many characters a `STRING` without a length holds, as CODESYS and TwinCAT have it.
const DEFAULT_LENGTH: u32 = 80;

/// A structure before it is laid out.
#[derive(Clone, Copy)]
pub(super) struct StructureDef<'c> {
    pub(super) item: Option<ItemId>,
    pub(super) node: StructType<'c>,
    /// From where names in it are looked up.
    pub(super) scope: ItemId,
}

impl<'c> Elaborator<'c> {
    /// The type of the `n`th variable of an item. An in-out is a reference that is followed by itself.
    pub(super) fn type_of(&mut self, item: ItemId, n: usize) -> Lowered<Type> {
        if let Some(known) = self.types.get(&(item, n)) {
            return Ok(known.clone());
        }
        let decls = self.decls(item);
        let decl = decls.get(n).copied();
        let Some(decl) = decl else {
            return Err(Unsupported::new("text that cannot be read", None, "a variable without a declaration"));
        };
        if !self.open_types.insert((item, n)) {
            return Err(self.unsupported(
                "a type that needs itself",
                decl.var.node(),
                format!("the type of `{}` needs itself", decl.name),
            ));
        }
        let found = self.declared_type(&decl, item);
        self.open_types.remove(&(item, n));
        let found = found?;
        self.types.insert((item, n), found.clone());
        Ok(found)
    }

    /// The type in a declaration.
    pub(super) fn declared_type(&mut self, decl: &Decl<'c>, scope: ItemId) -> Lowered<Type> {
        let node = decl.var.node();
        let type_ = match decl.var.type_() {
            Some(type_) => self.resolve(type_, scope)?,
            None if decl.constant => self.type_of_constant(decl, scope)?,
            None => {
                return Err(self.unsupported("text that cannot be read", node, format!("`{}` has no type", decl.name)));
            }
        };
        Ok(if decl.section == Section::InOut {
            Type::Reference { target: Arc::new(type_), implicit: true }
        } else {
            type_
        })
    }

    /// Siemens' constants without a type take that of their value.
    fn type_of_constant(&mut self, decl: &Decl<'c>, scope: ItemId) -> Lowered<Type> {
        let initial = decl.var.initial().ok_or_else(|| self.incomplete(decl.var.node()))?;
        let operand = self.constant_operand(initial, scope)?;
        let operand = operand.ok_or_else(|| self.not_constant(initial))?;
        Ok(operand.settled()?.1)
    }

    pub(super) fn not_constant(&self, expression: Expression<'c>) -> Unsupported {
        let node = expression.node();
        self.unsupported(super::constants::NOT_CONSTANT, node, format!("`{}` is not constant", short(node.text())))
    }

    /// What a type means in the scope of an item.
    pub(super) fn resolve(&mut self, type_: ast::Type<'c>, scope: ItemId) -> Lowered<Type> {
        match type_ {
            ast::Type::Named(named) => self.named(named, scope),
            ast::Type::Array(array) => {
                let mut dimensions = Vec::new();
                for dimension in array.dimensions() {
                    dimensions.push(self.dimension(dimension, type_.node(), scope)?);
                }
                let element = array.element().ok_or_else(|| self.incomplete(type_.node()))?;
                let element = self.resolve(element, scope)?;
                Ok(Type::Array(Arc::new(Array { dimensions, element })))
            }
            ast::Type::Pointer(node) | ast::Type::Reference(node) => {
                let target = type_.target().ok_or_else(|| self.incomplete(node))?;
                let implicit = node.kind() == NodeKind::ReferenceType
                    && node.own_tokens().next().is_some_and(|token| token.text().eq_ignore_ascii_case("REFERENCE"));
                Ok(Type::Reference { target: Arc::new(self.resolve(target, scope)?), implicit })
            }
            ast::Type::String(text) => {
                let capacity = match text.length() {
                    Some(length) => self.size_of_text(length, scope)?,
                    None => DEFAULT_LENGTH,
                };
                Ok(Type::Text { capacity, wide: text.is_wide() })
            }
            ast::Type::Subrange(subrange) => {
                let base = subrange.base().ok_or_else(|| self.incomplete(type_.node()))?;
                let base = self.named(base, scope)?.scalar();
                let range = subrange.range().ok_or_else(|| self.incomplete(type_.node()))?;
                let (low, high) = self.range(range, scope)?;
                let base = base.ok_or_else(|| self.incomplete(type_.node()))?;
                Ok(Type::Subrange { base, low, high })
            }
            ast::Type::Enum(values) => {
                let base = match values.base() {
                    Some(base) => self.named(base, scope)?.scalar().unwrap_or(INT),
                    None => INT,
                };
                Ok(Type::Enumeration { item: None, name: Arc::from(short(type_.node().text()).as_str()), base })
            }
            ast::Type::Struct(node) => Ok(self.structure(node, None, scope)),
        }
    }

    fn size_of_text(&mut self, length: Expression<'c>, scope: ItemId) -> Lowered<u32> {
        let number = self.constant_number(length, scope)?;
        match u32::try_from(number) {
            Ok(capacity @ 1..=65_535) => Ok(capacity),
            _ => Err(self.unsupported(
                "a string of this length",
                length.node(),
                format!("a string of {number} characters"),
            )),
        }
    }

    pub(super) fn range(&mut self, range: Range<'c>, scope: ItemId) -> Lowered<(i128, i128)> {
        let (low, high) = range.low().zip(range.high()).ok_or_else(|| self.incomplete(range.node()))?;
        Ok((self.constant_number(low, scope)?, self.constant_number(high, scope)?))
    }

    fn dimension(&mut self, dimension: Dimension<'c>, node: Node<'c>, scope: ItemId) -> Lowered<(i64, u32)> {
        let (low, high) = match dimension {
            Dimension::Range(range) => self.range(range, scope)?,
            Dimension::Open => {
                return Err(self.unsupported("an array of any size", node, "an array of any size (`ARRAY[*]`)"));
            }
            Dimension::Expression(bound) => self.size_or_range(bound, scope)?,
        };
        let count = u32::try_from(high - low + 1).ok().filter(|count| *count > 0);
        let bounds = i64::try_from(low).ok().zip(count);
        bounds.ok_or_else(|| {
            self.unsupported("an array of this size", node, format!("an array with the bounds {low}..{high}"))
        })
    }

    /// A dimension that is a subrange type by its name, or a number of elements.
    fn size_or_range(&mut self, bound: Expression<'c>, scope: ItemId) -> Lowered<(i128, i128)> {
        if let Expression::Name(name) = bound
            && let Some(Found::Item(item)) = self.world.path(&[name.text()], scope)
            && self.world.item(item).kind == ItemKind::Subrange
            && let Some(range) = self.item_type(item)?.range()
        {
            return Ok(range);
        }
        Ok((0, self.constant_number(bound, scope)? - 1))
    }

    fn named(&mut self, named: NamedType<'c>, scope: ItemId) -> Lowered<Type> {
        let node = named.node();
        let path = named.path().ok_or_else(|| self.incomplete(node))?;
        let parts: Vec<&str> = path.segments().map(|segment| segment.text).collect();
        if let [name] = parts.as_slice()
            && let Some(scalar) = elementary(name)
        {
            return Ok(if scalar == Scalar::Ref { Type::Null } else { Type::Scalar(scalar) });
        }
        match self.world.path(&parts, scope) {
            Some(Found::Item(item)) => self.item_type(item),
            _ if crate::library::elementary::is_elementary(&parts.join(".")) => {
                let message = format!("variables of type `{}`", parts.join("."));
                Err(self.unsupported("a type that is not modelled", node, message))
            }
            _ => Err(self
                .unsupported("a type without source", node, format!("`{}` has no source", parts.join(".")))
                .help("give it a stub in the configuration, or add its library to the tree")),
        }
    }

    /// The type that an item declares.
    pub(super) fn item_type(&mut self, item: ItemId) -> Lowered<Type> {
        let declared = self.world.item(item);
        let name: Arc<str> = Arc::from(declared.name.as_str());
        let incomplete = |this: &Self| {
            let message = format!("`{name}` is no type that can be read");
            Unsupported::new("a type that is not modelled", this.world.place_of(item), message)
        };
        match declared.kind {
            ItemKind::FunctionBlock | ItemKind::Class | ItemKind::Program => Ok(Type::Instance { item, name }),
            ItemKind::Interface => Ok(Type::Interface { item, name }),
            ItemKind::Struct | ItemKind::Union => {
                let node = self.world.header_type(item).and_then(|type_| StructType::cast(type_.node()));
                let node = node.ok_or_else(|| incomplete(self))?;
                Ok(self.structure(node, Some(item), item))
            }
            ItemKind::Enum => {
                self.cone.insert(item);
                let base = match self.world.header_type(item) {
                    Some(ast::Type::Enum(values)) => values.base(),
                    _ => None,
                };
                let base = match base {
                    Some(base) => self.named(base, item)?.scalar().unwrap_or(INT),
                    None => INT,
                };
                Ok(Type::Enumeration { item: Some(item), name, base })
            }
            ItemKind::Alias | ItemKind::Subrange => {
                self.cone.insert(item);
                // An alias of itself ends here, as its own name is being resolved.
                if !self.open_types.insert((item, usize::MAX)) {
                    return Err(incomplete(self));
                }
                let type_ = self.world.header_type(item);
                let found = type_.map(|type_| self.resolve(type_, item));
                self.open_types.remove(&(item, usize::MAX));
                found.unwrap_or_else(|| Err(incomplete(self)))
            }
            _ => Err(incomplete(self)),
        }
    }

    /// A structure under its number.
    fn structure(&mut self, node: StructType<'c>, item: Option<ItemId>, scope: ItemId) -> Type {
        let key = (std::ptr::from_ref(node.node().tree()) as usize, node.node().id().0);
        let next = u32::try_from(self.structures.len()).unwrap_or(u32::MAX);
        let id = *self.structure_ids.entry(key).or_insert(next);
        if id == next {
            self.structures.push(StructureDef { item, node, scope });
            self.cone.extend(item);
        }
        let name = item.map_or("STRUCT", |item| self.world.item(item).name.as_str());
        Type::Structure { id, name: Arc::from(name) }
    }
}

/// Text for a message: one line, not too long.
pub(super) fn short(text: &str) -> String {
    let line: Vec<&str> = text.split_whitespace().collect();
    let line = line.join(" ");
    match line.char_indices().nth(60) {
        Some((at, _)) => format!("{}…", &line[..at]),
        None => line,
    }
}
