//! What a type as written is made of: a scalar, elements, members, or something that a table cannot look into.

use std::sync::Arc;

use super::Binder;
use super::standard::{self, Standard};
use crate::library::names::{Found, Scope, fold};
use crate::library::{ItemId, ItemKind};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::Type;
use crate::semantics::typing::types::{self, INT};
use crate::table::cell::ast::{BinaryOp, Expr, ExprKind, LiteralValue, UnaryOp};
use crate::table::cell::{self, Context};
use crate::table::piece::Piece;
use crate::text::FileId;

/// What a type is made of.
#[derive(Clone, Debug)]
pub(super) enum Shape {
    /// A scalar, an enumeration, a subrange.
    Scalar(Type),
    /// An array: lowest index and number of each dimension, and the type of its elements.
    Array(Vec<(i64, u32)>, String),
    /// A structure or a block.
    Members(ItemId),
    /// A standard function block.
    Standard(&'static Standard),
    /// What a table cannot look into.
    Other(&'static str),
}

/// Types that name types go no deeper than this.
const MAX_DEPTH: u32 = 32;

impl Binder<'_> {
    /// What the type `text`, which stands in `owner`, is made of.
    pub(super) fn shape(&self, text: &str, owner: ItemId) -> Shape {
        self.shape_at(text, owner, 0)
    }

    fn shape_at(&self, text: &str, owner: ItemId, depth: u32) -> Shape {
        let text = text.trim();
        let upper = text.to_ascii_uppercase();
        let first = upper.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("");
        match first {
            _ if depth > MAX_DEPTH => Shape::Other("a type that names itself"),
            "ARRAY" => self.array(text, owner).unwrap_or(Shape::Other("an array whose bounds are not known")),
            "STRING" | "WSTRING" => Shape::Other("a string"),
            "POINTER" | "REFERENCE" | "REF_TO" | "REF" => Shape::Other("a reference"),
            "" if text.starts_with('(') => inline_enumeration(text),
            _ => self.named(text, owner, depth),
        }
    }

    /// `NAME`, or `NAME (low..high)`.
    fn named(&self, text: &str, owner: ItemId, depth: u32) -> Shape {
        let open = text.find('(').unwrap_or(text.len());
        let (name, range) = (text[..open].trim(), text[open..].trim_matches(|c: char| "() ".contains(c)));
        let Some(scalar) = types::elementary(name) else { return self.declared(name, owner, depth) };
        match range.split_once("..") {
            Some((low, high)) => match (self.number(low, owner), self.number(high, owner)) {
                (Some(low), Some(high)) => Shape::Scalar(Type::Subrange { base: scalar, low, high }),
                _ => Shape::Other("a subrange whose bounds are not known"),
            },
            None => Shape::Scalar(Type::Scalar(scalar)),
        }
    }

    fn declared(&self, name: &str, owner: ItemId, depth: u32) -> Shape {
        let parts: Vec<&str> = name.split('.').collect();
        let Some(Found::Item(id)) = self.names.path(self.catalogue, &parts, self.scope(owner)) else {
            let unknown = Shape::Other("of a type that is not in this tree");
            return standard::block(name).map_or(unknown, Shape::Standard);
        };
        let item = self.catalogue.item(id);
        let aliased = || item.type_.as_ref().map(|type_| self.shape_at(&type_.text, id, depth + 1));
        match item.kind {
            ItemKind::Enum => Shape::Scalar(self.enumeration(id)),
            ItemKind::Alias | ItemKind::Subrange => aliased().unwrap_or(Shape::Other("of a type that is not known")),
            ItemKind::Struct | ItemKind::Union | ItemKind::FunctionBlock | ItemKind::Class | ItemKind::Program => {
                Shape::Members(id)
            }
            ItemKind::Interface => Shape::Other("a variable of an interface"),
            _ => Shape::Other("of a type that is not known"),
        }
    }

    /// The scope of what stands in `owner`.
    pub(super) fn scope(&self, owner: ItemId) -> Scope<'_> {
        let item = self.catalogue.item(owner);
        Scope { library: item.library, namespace: &item.namespace }
    }

    /// The type that an item of the kind `Enum` is.
    pub(super) fn enumeration(&self, id: ItemId) -> Type {
        let item = self.catalogue.item(id);
        let base = item.type_.as_ref().and_then(|type_| types::elementary(type_.text.trim()));
        Type::Enumeration { item: Some(id), name: Arc::from(item.name.as_str()), base: base.unwrap_or(INT) }
    }

    /// The values of an enumeration in order: those without a number are one more than the one before.
    pub(super) fn values(&self, type_: &Type) -> Vec<(String, i128)> {
        let written: Vec<(String, Option<String>)> = match type_ {
            Type::Enumeration { item: Some(id), .. } => {
                let variables = self.catalogue.item(*id).variables.iter();
                variables.map(|variable| (variable.name.clone(), variable.initial.clone())).collect()
            }
            Type::Enumeration { name, .. } => inline_values(name),
            _ => Vec::new(),
        };
        let mut out: Vec<(String, i128)> = Vec::new();
        for (name, initial) in written {
            let owner = if let Type::Enumeration { item: Some(id), .. } = type_ { *id } else { self.unit };
            let known = |text: &str| {
                let earlier = out.iter().find(|(other, _)| other.eq_ignore_ascii_case(text.trim()));
                earlier.map(|(_, value)| *value).or_else(|| self.number(text, owner))
            };
            let next = out.last().map_or(0, |(_, value)| value + 1);
            let value = initial.as_deref().and_then(known).unwrap_or(next);
            out.push((name, value));
        }
        out
    }

    fn array(&self, text: &str, owner: ItemId) -> Option<Shape> {
        let open = text.find('[')?;
        let close = open + text[open..].find(']')?;
        let of = text[close..].to_ascii_uppercase().find("OF")? + close + 2;
        let dimension = |part: &str| {
            let (low, high) = part.split_once("..")?;
            let (low, high) = (self.number(low, owner)?, self.number(high, owner)?);
            Some((i64::try_from(low).ok()?, u32::try_from(high.checked_sub(low)?.checked_add(1)?).ok()?))
        };
        let dimensions = text[open + 1..close].split(',').map(dimension).collect::<Option<Vec<_>>>()?;
        Some(Shape::Array(dimensions, text[of..].trim().to_owned()))
    }

    /// The number that a constant expression in `owner` comes to.
    pub(super) fn number(&self, text: &str, owner: ItemId) -> Option<i128> {
        self.number_at(text, owner, 0)
    }

    fn number_at(&self, text: &str, owner: ItemId, depth: u32) -> Option<i128> {
        if depth > MAX_DEPTH {
            return None;
        }
        let expr = cell::parse_expression(&Piece::verbatim(FileId(0), text.trim(), 0), &Context::default()).ok()?;
        self.constant(&expr, owner, depth)
    }

    fn constant(&self, expr: &Expr, owner: ItemId, depth: u32) -> Option<i128> {
        match &expr.kind {
            ExprKind::Literal(literal) => match &literal.value {
                LiteralValue::Int(value, _) => Some(*value),
                LiteralValue::Bool(value) => Some(i128::from(*value)),
                _ => None,
            },
            ExprKind::Unary(UnaryOp::Minus, inner) => self.constant(inner, owner, depth)?.checked_neg(),
            ExprKind::Unary(UnaryOp::Plus, inner) => self.constant(inner, owner, depth),
            ExprKind::Binary(op, left, right) => {
                let (a, b) = (self.constant(left, owner, depth)?, self.constant(right, owner, depth)?);
                match op {
                    BinaryOp::Add => a.checked_add(b),
                    BinaryOp::Sub => a.checked_sub(b),
                    BinaryOp::Mul => a.checked_mul(b),
                    BinaryOp::Div => a.checked_div(b),
                    BinaryOp::Mod => a.checked_rem(b),
                    _ => None,
                }
            }
            ExprKind::Name(path) => {
                let text = cell::print::path(path);
                let parts: Vec<&str> = text.split('.').collect();
                let member = || self.names.member(self.catalogue, owner, parts.first()?);
                let found = if parts.len() == 1 { member() } else { None };
                let found = found.or_else(|| self.names.path(self.catalogue, &parts, self.scope(owner)));
                let Some(Found::Variable(id, index)) = found else { return None };
                let variable = &self.catalogue.item(id).variables[index];
                let enumerator = self.catalogue.item(id).kind == ItemKind::Enum;
                if enumerator {
                    return self.values(&self.enumeration(id)).get(index).map(|(_, value)| *value);
                }
                variable.constant.then_some(())?;
                self.number_at(variable.initial.as_deref()?, id, depth + 1)
            }
            _ => None,
        }
    }
}

/// `(A, B := 5, C) DINT`, declared with its variable.
fn inline_enumeration(text: &str) -> Shape {
    let base = text.rsplit(')').next().and_then(|rest| types::elementary(rest.trim())).unwrap_or(INT);
    Shape::Scalar(Type::Enumeration { item: None, name: Arc::from(text), base })
}

fn inline_values(text: &str) -> Vec<(String, Option<String>)> {
    let inner = text.trim_start_matches('(').split(')').next().unwrap_or("");
    let one = |part: &str| match part.split_once(":=") {
        Some((name, value)) => (name.trim().to_owned(), Some(value.trim().to_owned())),
        None => (part.trim().to_owned(), None),
    };
    inner.split(',').map(one).collect()
}

/// How a message calls a type.
pub(super) fn called(type_: &Type) -> String {
    type_.to_string()
}

/// The type of that name in a table: those of the tree, and the spellings of older tables.
pub(super) fn spelled(name: &str) -> Option<Scalar> {
    match fold(name).as_str() {
        "boolean" => Some(Scalar::Bool),
        _ => types::elementary(name),
    }
}
