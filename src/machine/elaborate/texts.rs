//! Strings: comparison and the standard functions on them (IEC 61131-3:2013, table 34).

use super::access::Spot;
use super::expressions::Val;
use super::{Elaborator, Lowered};
use crate::machine::program::{Location, StatementKind, Text, TextOperation, TextOrder, Value};
use crate::semantics::expr::{Expr, ExprKind, Op};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::binary::binary;
use crate::semantics::typing::convert::assigned;
use crate::semantics::typing::types::{INT, elementary, is_whole, name as scalar_name};
use crate::semantics::typing::{Operand, Type, apply, constant, converted};
use crate::syntax::Node;
use crate::syntax::ast::{BinaryOperator, Expression};

/// The longest result of a function on strings, as CODESYS and TwinCAT have it.
const LONGEST: u32 = 255;

/// The functions on strings, with how many arguments they take.
const FUNCTIONS: [(&str, usize); 9] = [
    ("LEN", 1),
    ("LEFT", 2),
    ("RIGHT", 2),
    ("MID", 3),
    ("CONCAT", 2),
    ("INSERT", 3),
    ("DELETE", 3),
    ("REPLACE", 4),
    ("FIND", 2),
];

/// The function on strings called `name`, those on wide ones too.
pub(super) fn function(name: &str) -> Option<(&'static str, usize)> {
    let upper = name.to_ascii_uppercase();
    let plain = upper.strip_prefix('W').unwrap_or(&upper);
    FUNCTIONS.iter().find(|(known, _)| *known == upper || *known == plain).copied()
}

/// A conversion between integers and strings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Conversion {
    /// `STRING_TO_INT`.
    FromText(Scalar),
    /// `INT_TO_STRING`, or `TO_STRING` of anything.
    ToText(Option<Scalar>),
}

/// The conversion between integers and strings that a function is.
pub(super) fn conversion(name: &str) -> Option<Conversion> {
    let upper = name.to_ascii_uppercase();
    let simple = |name: &str| elementary(name).filter(|scalar| is_whole(*scalar) || *scalar == Scalar::Bool);
    match upper.split_once("_TO_") {
        Some(("STRING", to)) => simple(to).filter(|scalar| *scalar != Scalar::Bool).map(Conversion::FromText),
        Some((from, "STRING")) => simple(from).map(|scalar| Conversion::ToText(Some(scalar))),
        _ => (upper == "TO_STRING").then_some(Conversion::ToText(None)),
    }
}

impl<'c> Elaborator<'c> {
    /// A conversion between integers and strings.
    pub(super) fn text_conversion(
        &mut self,
        conversion: Conversion,
        value: Expression<'c>,
        node: Node<'c>,
    ) -> Lowered<Val> {
        let value = self.value(value)?;
        let from = match conversion {
            Conversion::FromText(to) => {
                let number = self.call_own("__TEXT_TO_NUMBER", value, node)?;
                let (number, _) = self.scalar(number, node)?.settled()?;
                return Ok(Val::Scalar(Operand::of(converted(number, to))));
            }
            Conversion::ToText(from) => from,
        };
        if value.is_text() {
            return Ok(value);
        }
        let operand = self.scalar(value, node)?;
        let expr = match from {
            Some(from) => assigned(operand, &Type::Scalar(from))?.expr,
            None => operand.settled()?.0,
        };
        let function = match expr.scalar {
            Scalar::Bool => "__BOOL_TO_TEXT",
            Scalar::Int { signed: true, .. } => "__SIGNED_TO_TEXT",
            Scalar::Int { .. } | Scalar::Bits(_) => "__UNSIGNED_TO_TEXT",
            other => {
                let message = format!("a conversion of `{}` to a string", scalar_name(other));
                return Err(self.unsupported("a conversion between numbers and strings", node, message));
            }
        };
        self.call_own(function, Val::Scalar(Operand::of(expr)), node)
    }

    /// A string in memory; a literal gets slots of its own.
    pub(super) fn text(&mut self, value: Val, node: Node<'c>) -> Lowered<(Text, bool)> {
        match value {
            Val::Memory(Spot { location, type_: Type::Text { capacity, wide }, .. }) => {
                Ok((Text { location, capacity }, wide))
            }
            Val::Text(codes, wide) => {
                let capacity = u32::try_from(codes.len()).unwrap_or(u32::MAX).max(1);
                let location = self.temporary_text(capacity, wide)?;
                let text = Text { location, capacity };
                self.emit(StatementKind::Text(Box::new(TextOperation::Literal(text.clone(), codes))));
                Ok((text, wide))
            }
            other => {
                let message = format!("`{}` where a string is needed", other.type_name());
                Err(self.unsupported("types that do not fit", node, message))
            }
        }
    }

    /// A comparison of strings, or of a character with a literal of one.
    pub(super) fn compare_texts(
        &mut self,
        operator: BinaryOperator,
        left: Val,
        right: Val,
        node: Node<'c>,
    ) -> Lowered<Val> {
        let place = self.place(node);
        let character = |value: &Val, other: &Val| match (value, other) {
            (Val::Text(codes, _), Val::Scalar(operand)) if codes.len() == 1 => match operand.scalar() {
                Some(scalar @ Scalar::Bits(8 | 16)) => Some(Operand::of(constant(scalar, u64::from(codes[0]), place))),
                _ => None,
            },
            (Val::Scalar(operand), _) => Some(operand.clone()),
            _ => None,
        };
        if let (Some(a), Some(b)) = (character(&left, &right), character(&right, &left)) {
            return Ok(Val::Scalar(binary(operator, a, b, place)?));
        }
        let (left, _) = self.text(left, node)?;
        let (right, _) = self.text(right, node)?;
        let (order, left, right, negated) = match operator {
            BinaryOperator::Equal => (TextOrder::Equal, left, right, false),
            BinaryOperator::NotEqual => (TextOrder::Equal, left, right, true),
            BinaryOperator::Less => (TextOrder::Less, left, right, false),
            BinaryOperator::LessEqual => (TextOrder::LessOrEqual, left, right, false),
            BinaryOperator::Greater => (TextOrder::Less, right, left, false),
            BinaryOperator::GreaterEqual => (TextOrder::LessOrEqual, right, left, false),
            _ => return Err(self.unsupported("types that do not fit", node, "this operator on strings")),
        };
        let target = self.temporary(Scalar::Bool);
        let compare = TextOperation::Compare { target: target.clone(), order, left, right };
        self.emit(StatementKind::Text(Box::new(compare)));
        let read = Expr { kind: ExprKind::Read(target), scalar: Scalar::Bool, place };
        let value = if negated { apply(Op::Not, Scalar::Bool, vec![read], place) } else { read };
        Ok(Val::Scalar(Operand::of(value)))
    }

    /// A standard function on strings.
    pub(super) fn text_function(&mut self, name: &'static str, values: Vec<Val>, node: Node<'c>) -> Lowered<Val> {
        let mut texts = Vec::new();
        let mut numbers = Vec::new();
        for value in values {
            match value {
                Val::Scalar(operand) => {
                    let (expr, _) = operand.settled()?;
                    if !is_whole(expr.scalar) {
                        return Err(self.unsupported(
                            "types that do not fit",
                            node,
                            format!("an argument of `{name}`"),
                        ));
                    }
                    numbers.push(expr);
                }
                text => texts.push(self.text(text, node)?),
            }
        }
        self.text_operation(name, texts, numbers, node)
    }

    fn text_operation(
        &mut self,
        name: &'static str,
        texts: Vec<(Text, bool)>,
        numbers: Vec<Value>,
        node: Node<'c>,
    ) -> Lowered<Val> {
        let wide = texts.first().is_some_and(|(_, wide)| *wide);
        let capacities: Vec<u32> = texts.iter().map(|(text, _)| text.capacity).collect();
        let mut texts = texts.into_iter().map(|(text, _)| text);
        let mut numbers = numbers.into_iter();
        let (first, second) = (texts.next(), texts.next());
        let (one, two) = (numbers.next(), numbers.next());
        let whole: u32 = capacities.iter().fold(0_u32, |sum, capacity| sum.saturating_add(*capacity)).min(LONGEST);
        let longest = capacities.first().copied().unwrap_or(1);
        let wrong = || self.unsupported("types that do not fit", node, format!("the arguments of `{name}`"));
        let Some(first) = first else { return Err(wrong()) };
        let operation: Box<dyn FnOnce(Text) -> TextOperation> = match (name, second, one, two) {
            ("LEN", None, None, None) => {
                return self.text_number(node, |target| TextOperation::Length(target, INT, first));
            }
            ("FIND", Some(second), None, None) => {
                return self.text_number(node, |target| TextOperation::Find(target, INT, first, second));
            }
            ("LEFT", None, Some(n), None) => Box::new(move |target| TextOperation::Left(target, first, n)),
            ("RIGHT", None, Some(n), None) => Box::new(move |target| TextOperation::Right(target, first, n)),
            ("MID", None, Some(n), Some(p)) => Box::new(move |target| TextOperation::Mid(target, first, n, p)),
            ("DELETE", None, Some(n), Some(p)) => Box::new(move |target| TextOperation::Delete(target, first, n, p)),
            ("CONCAT", Some(second), None, None) => {
                Box::new(move |target| TextOperation::Concat(target, first, second))
            }
            ("INSERT", Some(second), Some(p), None) => {
                Box::new(move |target| TextOperation::Insert(target, first, second, p))
            }
            ("REPLACE", Some(second), Some(n), Some(p)) => {
                Box::new(move |target| TextOperation::Replace(target, first, second, n, p))
            }
            _ => return Err(wrong()),
        };
        let capacity = if matches!(name, "CONCAT" | "INSERT" | "REPLACE") { whole } else { longest };
        let location = self.temporary_text(capacity, wide)?;
        let target = Text { location: location.clone(), capacity };
        self.emit(StatementKind::Text(Box::new(operation(target))));
        Ok(Val::Memory(Spot { location, type_: Type::Text { capacity, wide }, constant: true }))
    }

    fn text_number(&mut self, node: Node<'c>, operation: impl FnOnce(Location) -> TextOperation) -> Lowered<Val> {
        let target = self.temporary(INT);
        self.emit(StatementKind::Text(Box::new(operation(target.clone()))));
        let read = Expr { kind: ExprKind::Read(target), scalar: INT, place: self.place(node) };
        Ok(Val::Scalar(Operand::of(read)))
    }
}
