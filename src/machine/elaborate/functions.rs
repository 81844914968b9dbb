//! Functions that the language defines: the standard ones, and the vendors' operators that look like functions.

use super::access::Spot;
use super::expressions::Val;
use super::texts;
use super::{Elaborator, Lowered};
use crate::machine::program::{Role, StatementKind, TextOperation};
use crate::semantics::expr::Op;
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::types::{LTIME, TIME, UDINT, elementary};
use crate::semantics::typing::{Operand, Type, apply, constant, functions};
use crate::syntax::Node;
use crate::syntax::ast::{Argument, ArgumentKind, AstNode, BinaryOperator, CallExpression, Expression};

use super::memory::{Placement, at};

impl<'c> Elaborator<'c> {
    /// A call of a function that no source declares.
    pub(super) fn standard_call(&mut self, name: &str, call: CallExpression<'c>) -> Lowered<Option<Val>> {
        let node = call.node();
        let arguments: Vec<Argument<'c>> = call.arguments().collect();
        let upper = name.to_ascii_uppercase();
        match (upper.as_str(), arguments.as_slice()) {
            ("TIME", []) => return Ok(Some(self.clock(TIME))),
            ("LTIME", []) => return Ok(Some(self.clock(LTIME))),
            ("ADR" | "REF", [argument]) => {
                let value = argument.value().ok_or_else(|| self.incomplete(node))?;
                return self.address_of(value, node).map(Some);
            }
            ("SIZEOF" | "XSIZEOF", [argument]) => {
                let value = argument.value().ok_or_else(|| self.incomplete(node))?;
                return self.size_in_bytes(value, node).map(Some);
            }
            ("__ISVALIDREF", [argument]) => {
                let value = argument.value().ok_or_else(|| self.incomplete(node))?;
                return self.is_valid_reference(value, node).map(Some);
            }
            _ => {}
        }
        if let ([argument], Some(conversion)) = (arguments.as_slice(), texts::conversion(&upper)) {
            let value = argument.value().ok_or_else(|| self.incomplete(node))?;
            return self.text_conversion(conversion, value, node).map(Some);
        }
        let text = texts::function(&upper);
        if text.is_none() && !functions::is_standard(&upper) {
            return Err(self.without_body(&upper, name, node));
        }
        let expressions = self.by_position(&upper, &arguments, node)?;
        let mut values = self.values(&expressions)?;
        if let Some((function, count)) = text {
            if function == "CONCAT" && values.len() > count {
                return self.long_concat(values, node).map(Some);
            }
            return self.text_function(function, values, node).map(Some);
        }
        if values.iter().any(|value| !matches!(value, Val::Scalar(_))) {
            return self.on_texts(&upper, &mut values, node).map(Some);
        }
        let mut operands = Vec::new();
        for value in values {
            let operand = self.scalar(value, node)?;
            operands.push(if repeats(&upper) { self.shared(operand) } else { operand });
        }
        let place = self.place(node);
        let result = functions::call(&upper, operands, place);
        let result = result.ok_or_else(|| self.without_body(&upper, name, node))?;
        Ok(Some(Val::Scalar(result?)))
    }

    fn without_body(&self, upper: &str, name: &str, node: Node<'c>) -> super::Unsupported {
        let is_text = |part: &str| matches!(part, "STRING" | "WSTRING");
        let pair = upper.split_once("_TO_").or_else(|| upper.strip_prefix("TO_").map(|to| ("ANY", to)));
        match pair {
            Some((from, to)) if is_text(from) || is_text(to) => {
                let message = format!("`{name}` converts between numbers and strings");
                self.unsupported("a conversion between numbers and strings", node, message)
            }
            Some((from, to)) if elementary(from).is_some() || elementary(to).is_some() => {
                self.unsupported("a conversion that is not modelled", node, format!("the conversion `{name}`"))
            }
            _ => self
                .unsupported("a function without source", node, format!("`{name}` has no source"))
                .help("give it a stub in the configuration, or add its library to the tree"),
        }
    }

    /// The arguments of a standard function in the order of its parameters.
    fn by_position(&self, function: &str, arguments: &[Argument<'c>], node: Node<'c>) -> Lowered<Vec<Expression<'c>>> {
        let mut found: Vec<(usize, Expression<'c>)> = Vec::new();
        for (n, argument) in arguments.iter().enumerate() {
            let value = argument.value().ok_or_else(|| self.incomplete(argument.node()))?;
            let position = match (argument.kind(), argument.name()) {
                (ArgumentKind::Input, Some(name)) => text_position(function, name.text())
                    .or_else(|| functions::position(function, name.text()))
                    .ok_or_else(|| {
                        let message = format!("`{function}` has no parameter `{}`", name.text());
                        self.unsupported("types that do not fit", node, message)
                    })?,
                (ArgumentKind::Positional, _) => n,
                _ => {
                    return Err(self.unsupported(
                        "types that do not fit",
                        node,
                        format!("`{function}` has no outputs"),
                    ));
                }
            };
            found.push((position, value));
        }
        found.sort_by_key(|(position, _)| *position);
        Ok(found.into_iter().map(|(_, value)| value).collect())
    }

    /// `CONCAT` of more than two, as some dialects have it.
    fn long_concat(&mut self, values: Vec<Val>, node: Node<'c>) -> Lowered<Val> {
        let mut rest = values.into_iter();
        let mut all = rest.next().ok_or_else(|| self.incomplete(node))?;
        for value in rest {
            all = self.text_function("CONCAT", vec![all, value], node)?;
        }
        Ok(all)
    }

    /// Standard functions that take strings and other types: `SEL`, comparisons, `MOVE`.
    fn on_texts(&mut self, name: &str, values: &mut Vec<Val>, node: Node<'c>) -> Lowered<Val> {
        let operator = match name {
            "EQ" => Some(BinaryOperator::Equal),
            "NE" => Some(BinaryOperator::NotEqual),
            "LT" => Some(BinaryOperator::Less),
            "LE" => Some(BinaryOperator::LessEqual),
            "GT" => Some(BinaryOperator::Greater),
            "GE" => Some(BinaryOperator::GreaterEqual),
            _ => None,
        };
        match (operator, values.as_slice()) {
            (Some(operator), [a, b]) => self.compare_texts(operator, a.clone(), b.clone(), node),
            (None, [only]) if name == "MOVE" => Ok(only.clone()),
            (None, [which, zero, one]) if name == "SEL" => {
                let which = self.scalar(which.clone(), node)?;
                let condition = crate::semantics::typing::convert::logical(which)?;
                let (zero, one) = (self.text(zero.clone(), node)?, self.text(one.clone(), node)?);
                let capacity = zero.0.capacity.max(one.0.capacity);
                let location = self.temporary_text(capacity, zero.1)?;
                let target = crate::machine::program::Text { location: location.clone(), capacity };
                let assign = |source| StatementKind::Text(Box::new(TextOperation::Assign(target.clone(), source)));
                let place = self.body.place;
                let statement = |kind| vec![crate::machine::program::Statement { kind, place }];
                let (then, otherwise) = (statement(assign(one.0)), statement(assign(zero.0)));
                self.emit(StatementKind::If { condition, then, otherwise });
                Ok(Val::Memory(Spot { location, type_: Type::Text { capacity, wide: zero.1 }, constant: true }))
            }
            _ => Err(self.without_body(name, name, node)),
        }
    }

    /// The time since the start: a slot that each cycle moves on.
    fn clock(&mut self, scalar: Scalar) -> Val {
        let width = scalar.width();
        let slot = match self.clock_slots.get(&width) {
            Some(slot) => *slot,
            None => {
                let name = if width == 64 { "LTIME()" } else { "TIME()" }.to_owned();
                let placement = Placement { name, role: Role::State, place: None };
                let crate::machine::program::Base::Slot(slot) = self.clock_location(scalar, &placement).base else {
                    return Val::Scalar(Operand::Integer(0, None));
                };
                self.clocks.push((slot, self.options.cycle_time / if width == 64 { 1 } else { 1_000_000 }));
                self.clock_slots.insert(width, slot);
                slot
            }
        };
        let spot = Spot { location: at(slot), type_: Type::Scalar(scalar), constant: true };
        Val::Scalar(Operand::Typed(spot.read(), spot.type_))
    }

    fn clock_location(&mut self, scalar: Scalar, placement: &Placement) -> crate::machine::program::Location {
        match self.put(&Type::Scalar(scalar), &[0], placement) {
            Ok(slot) => at(slot),
            Err(error) => {
                self.errors.push(error);
                at(crate::machine::program::SlotId(0))
            }
        }
    }

    fn is_valid_reference(&mut self, value: Expression<'c>, node: Node<'c>) -> Lowered<Val> {
        let super::access::Designated::Spot(spot) = self.designate(value)? else {
            return Err(self.unsupported("types that do not fit", node, "`__ISVALIDREF` of what is no reference"));
        };
        if spot.type_.scalar() != Some(Scalar::Ref) {
            return Err(self.unsupported("types that do not fit", node, "`__ISVALIDREF` of what is no reference"));
        }
        let place = self.place(node);
        let null = apply(Op::Eq, Scalar::Bool, vec![spot.read(), constant(Scalar::Ref, 0, place)], place);
        Ok(Val::Scalar(Operand::of(apply(Op::Not, Scalar::Bool, vec![null], place))))
    }

    /// `SIZEOF`: in bytes, with the natural alignment of TwinCAT 3 and CODESYS V3.
    fn size_in_bytes(&mut self, value: Expression<'c>, node: Node<'c>) -> Lowered<Val> {
        let type_ = match value.unwrapped() {
            Expression::Name(name) if elementary(name.text()).is_some() => {
                Type::Scalar(elementary(name.text()).unwrap_or(Scalar::Bool))
            }
            _ => match self.designate(value)? {
                super::access::Designated::Item(item) => self.item_type(item)?,
                super::access::Designated::Value(operand) => operand.settled()?.1,
                super::access::Designated::Spot(spot) => self.followed(spot).type_,
                _ => return Err(self.unsupported("the size of this", node, "the size of what is no variable")),
            },
        };
        let Some((bytes, _)) = self.bytes(&type_)? else {
            return Err(self.unsupported("the size of this", node, format!("the size of `{type_}` in bytes")));
        };
        let place = self.place(node);
        Ok(Val::Scalar(Operand::of(constant(UDINT, bytes, place))))
    }

    /// Size and alignment.
    pub(super) fn bytes(&mut self, type_: &Type) -> Lowered<Option<(u64, u64)>> {
        Ok(match type_ {
            Type::Text { capacity, wide } => {
                let unit = if *wide { 2 } else { 1 };
                Some((unit * (u64::from(*capacity) + 1), unit))
            }
            Type::Array(array) => {
                let count: u64 = array.dimensions.iter().map(|(_, count)| u64::from(*count)).product();
                self.bytes(&array.element)?.map(|(size, align)| (size * count, align))
            }
            Type::Structure { .. } => {
                let Some(layout) = self.layout_of(type_)? else { return Ok(None) };
                let (mut size, mut greatest) = (0_u64, 1_u64);
                for field in &layout.fields {
                    let Some((own, align)) = self.bytes(&field.type_)? else { return Ok(None) };
                    size = size.next_multiple_of(align) + own;
                    greatest = greatest.max(align);
                }
                Some((size.next_multiple_of(greatest), greatest))
            }
            Type::Instance { .. } | Type::Interface { .. } | Type::Reference { .. } | Type::Null => None,
            _ => type_.scalar().map(|scalar| {
                let bytes = u64::from(scalar.width().div_ceil(8));
                (bytes, bytes)
            }),
        })
    }
}

/// Whether the typing of a function uses its arguments more than once.
fn repeats(name: &str) -> bool {
    matches!(name, "MIN" | "MAX" | "LIMIT" | "MUX" | "SQR" | "GT" | "GE" | "EQ" | "LE" | "LT")
}

/// The position of a formal parameter of a function on strings.
fn text_position(function: &str, parameter: &str) -> Option<usize> {
    let (function, _) = texts::function(function)?;
    let names: &[&str] = match function {
        "LEN" => &["STR"],
        "LEFT" | "RIGHT" => &["STR", "SIZE"],
        "MID" => &["STR", "LEN", "POS"],
        "CONCAT" | "FIND" => &["STR1", "STR2"],
        "INSERT" => &["STR1", "STR2", "POS"],
        "DELETE" => &["STR", "LEN", "POS"],
        _ => &["STR1", "STR2", "L", "P"],
    };
    let iec: &[&str] = match function {
        "LEFT" | "RIGHT" => &["IN", "L"],
        "MID" | "DELETE" => &["IN", "L", "P"],
        "INSERT" => &["IN1", "IN2", "P"],
        "REPLACE" => &["IN1", "IN2", "L", "P"],
        "LEN" => &["IN"],
        _ => &["IN1", "IN2"],
    };
    let at = |list: &[&str]| list.iter().position(|name| name.eq_ignore_ascii_case(parameter));
    at(names).or_else(|| at(iec))
}
