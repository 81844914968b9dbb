//! Constants: what is known before a program runs.

use std::rc::Rc;

use super::routines::Body;
use super::{Elaborator, Lowered, Unsupported};
use crate::library::names::fold;
use crate::library::{ItemId, ItemKind};
use crate::machine::program::Location;
use crate::semantics::expr::{Expr, ExprKind};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::convert::assigned;
use crate::semantics::typing::{Operand, constant, literal};
use crate::syntax::ast::{self, Expression, SourceFile};
use crate::syntax::{Entry, parse};

/// The construct of what is known only in a run.
pub(super) const NOT_CONSTANT: &str = "a value that is not constant";

impl<'c> Elaborator<'c> {
    /// The value of an expression in the scope of an item, if it is a constant one.
    pub(super) fn constant_operand(
        &mut self,
        expression: Expression<'c>,
        scope: ItemId,
    ) -> Lowered<Option<Operand<Location>>> {
        let inside = Body::constant(scope, self.body.class);
        let outer = std::mem::replace(&mut self.body, inside);
        let value = self.operand(expression);
        let inner = std::mem::replace(&mut self.body, outer);
        let value = match value {
            Err(error) if error.construct == NOT_CONSTANT => return Ok(None),
            value => value?,
        };
        Ok((inner.out.is_empty() && is_constant(&value)).then_some(value))
    }

    /// The number that an expression is.
    pub(super) fn constant_number(&mut self, expression: Expression<'c>, scope: ItemId) -> Lowered<i128> {
        let value = self.constant_operand(expression, scope)?;
        value.and_then(|value| value.number()).ok_or_else(|| self.not_constant(expression))
    }

    /// The value of the `n`th variable of an item, if it is a constant of a scalar type.
    pub(super) fn constant_variable(&mut self, item: ItemId, n: usize) -> Lowered<Option<Operand<Location>>> {
        if let Some(known) = self.constants.get(&(item, n)) {
            return Ok(known.clone());
        }
        let decls = self.decls(item);
        let Some(decl) = decls.get(n).copied().filter(|decl| decl.constant) else { return Ok(None) };
        if !self.open_constants.insert((item, n)) {
            let message = format!("the value of `{}` needs itself", decl.name);
            return Err(self.unsupported("a constant that needs itself", ast::AstNode::node(decl.var), message));
        }
        let found = self.value_of_constant(item, n);
        self.open_constants.remove(&(item, n));
        let found = found?;
        self.constants.insert((item, n), found.clone());
        Ok(found)
    }

    fn value_of_constant(&mut self, item: ItemId, n: usize) -> Lowered<Option<Operand<Location>>> {
        let type_ = self.type_of(item, n)?;
        let decls = self.decls(item);
        let decl = decls[n];
        let Some(scalar) = type_.scalar().filter(|scalar| *scalar != Scalar::Ref) else { return Ok(None) };
        if let Some(text) = self.overridden(item, decl.name) {
            let operand = self.literal_text(&text, decl.name)?;
            let value = assigned(operand, &type_)?.expr;
            self.assumptions.insert(format!("`{}` is {text}", decl.name));
            return Ok(Some(Operand::Typed(value, type_)));
        }
        let value = match decl.var.initial() {
            Some(initial) => match self.constant_operand(initial, item)? {
                Some(value) => assigned(value, &type_)?.expr,
                None => return Ok(None),
            },
            None => constant(scalar, self.scalar_default(&type_)?, None),
        };
        Ok(Some(Operand::Typed(value, type_)))
    }

    /// The value that the configuration gives a constant.
    fn overridden(&self, item: ItemId, name: &str) -> Option<String> {
        let qualified = fold(&format!("{}.{name}", self.world.item(item).name));
        let given = self.options.constants.iter();
        let mut fits = given.filter(|(key, _)| fold(key) == qualified || fold(key) == fold(name));
        fits.next().map(|(_, text)| text.clone())
    }

    /// A literal in the configuration, perhaps with a minus.
    fn literal_text(&self, text: &str, name: &str) -> Lowered<Operand<Location>> {
        let wrong = |why: &str| {
            Unsupported::new("a constant of the configuration", None, format!("the value of `{name}`, `{text}`: {why}"))
                .help("write a literal")
        };
        let parsed = parse(text, Entry::Expression, &crate::syntax::Options::default());
        let mut expression = SourceFile::of(&parsed.tree).expression().filter(|_| parsed.errors.is_empty());
        let mut negative = false;
        if let Some(Expression::Unary(unary)) = expression
            && unary.operator() == Some(ast::UnaryOperator::Negate)
        {
            negative = true;
            expression = unary.operand();
        }
        let Some(Expression::Literal(literal)) = expression else { return Err(wrong("no literal")) };
        let value = literal::of(literal).map_err(|why| wrong(&why))?;
        let operand = value.operand(None).ok_or_else(|| wrong("no number"))?;
        if !negative {
            return Ok(operand);
        }
        let negated = crate::semantics::typing::binary::unary(ast::UnaryOperator::Negate, operand, None);
        Ok(negated?)
    }

    /// The values of an enumeration by their folded names.
    pub(super) fn enum_values(&mut self, item: ItemId) -> Lowered<Rc<Vec<(String, i128)>>> {
        if let Some(known) = self.enum_values.get(&item) {
            return Ok(Rc::clone(known));
        }
        let values = match self.world.header_type(item) {
            Some(ast::Type::Enum(values)) => values,
            _ => return Ok(Rc::new(Vec::new())),
        };
        let found = self.values_of(values, item, true)?;
        let found = Rc::new(found);
        self.enum_values.insert(item, Rc::clone(&found));
        Ok(found)
    }

    /// The values of an enumeration: each one more than the one before, unless its own is given.
    pub(super) fn values_of(
        &mut self,
        values: ast::EnumType<'c>,
        scope: ItemId,
        keep: bool,
    ) -> Lowered<Vec<(String, i128)>> {
        let mut found: Vec<(String, i128)> = Vec::new();
        let mut next = 0;
        for value in values.values() {
            let Some(name) = value.name() else { continue };
            if let Some(given) = value.value() {
                // Values may be given by those before them.
                if keep {
                    self.enum_values.insert(scope, Rc::new(found.clone()));
                }
                let number = self.constant_number(given, scope);
                if keep {
                    self.enum_values.remove(&scope);
                }
                next = number?;
            }
            found.push((fold(name.text()), next));
            next += 1;
        }
        Ok(found)
    }

    /// The value `name` of an enumeration.
    pub(super) fn enum_value(&mut self, item: ItemId, name: &str) -> Lowered<Option<Operand<Location>>> {
        if self.world.item(item).kind != ItemKind::Enum {
            return Ok(None);
        }
        let name = fold(name);
        let values = self.enum_values(item)?;
        let Some((_, number)) = values.iter().find(|(known, _)| *known == name) else { return Ok(None) };
        let type_ = self.item_type(item)?;
        let scalar = type_.scalar().unwrap_or(Scalar::Bool);
        Ok(Some(Operand::Typed(constant(scalar, scalar.bits(*number), None), type_)))
    }
}

/// Whether the operand is a constant.
pub(super) const fn is_constant(operand: &Operand<Location>) -> bool {
    match operand {
        Operand::Typed(Expr { kind, .. }, _) => matches!(kind, ExprKind::Const(_)),
        Operand::Integer(..) | Operand::Real(..) => true,
    }
}

/// The bits of a constant expression.
pub(super) const fn bits_of(expr: &Expr<Location>) -> Option<u64> {
    match expr.kind {
        ExprKind::Const(bits) => Some(bits),
        _ => None,
    }
}
