//! Elements of arrays, characters of strings, bits of integers.

use std::sync::Arc;

use super::access::{Designated, Spot, referent};
use super::constants::is_constant;
use super::{Elaborator, Lowered};
use crate::machine::program::{Index, Location};
use crate::semantics::expr::{Expr, Op};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::types::{UDINT, is_whole};
use crate::semantics::typing::{Operand, Type, apply, constant, converted, reinterpreted};
use crate::syntax::Node;
use crate::syntax::ast::{BitExpression, Expression, IndexExpression};

impl<'c> Elaborator<'c> {
    pub(super) fn bit_of(&mut self, bit: BitExpression<'c>, node: Node<'c>) -> Lowered<Designated> {
        let base = bit.base().ok_or_else(|| self.incomplete(node))?;
        let selector = bit.selector().ok_or_else(|| self.incomplete(node))?.text();
        let digits = selector.strip_prefix("%X").or_else(|| selector.strip_prefix("%x")).unwrap_or(selector);
        let number = digits.parse::<i128>().ok();
        if number.is_none() {
            return Err(self.unsupported(
                "a part of a bit string",
                node,
                format!("the part `{selector}` of a bit string"),
            ));
        }
        match self.designate(base)? {
            Designated::Value(operand) => {
                let number = number.and_then(|number| u32::try_from(number).ok()).unwrap_or(u32::MAX);
                let place = self.place(node);
                Ok(Designated::Value(crate::semantics::typing::binary::bit(operand, number, place)?))
            }
            designated => {
                let spot = self.spot_of(designated, node)?;
                self.numbered_bit(&spot, number, digits, node)
            }
        }
    }

    pub(super) fn element_of(&mut self, index: IndexExpression<'c>, node: Node<'c>) -> Lowered<Designated> {
        let base = index.base().ok_or_else(|| self.incomplete(node))?;
        let spot = self.spot(base)?;
        let indices: Vec<Expression<'c>> = index.indices().collect();
        let mut location = spot.location.clone();
        match &spot.type_ {
            Type::Array(array) if array.dimensions.len() == indices.len() => {
                let array = Arc::clone(array);
                let mut stride = self.known_size(&array.element)?;
                let mut steps = Vec::new();
                let values = self.operands(&indices)?;
                for (operand, (low, count)) in values.into_iter().zip(&array.dimensions).rev() {
                    steps.push(self.index(operand, *low, *count, stride, node)?);
                    stride = stride.saturating_mul(*count);
                }
                steps.reverse();
                steps.into_iter().for_each(|step| step_into(&mut location, step));
                Ok(Designated::Spot(Spot { location, type_: array.element.clone(), constant: spot.constant }))
            }
            Type::Text { capacity, wide } if indices.len() == 1 => {
                let (count, wide) = (capacity + 1, *wide);
                let operand = self.operand(indices[0])?;
                let step = self.index(operand, 0, count, 1, node)?;
                step_into(&mut location, step);
                let type_ = Type::Scalar(Scalar::Bits(if wide { 16 } else { 8 }));
                Ok(Designated::Spot(Spot { location, type_, constant: spot.constant }))
            }
            Type::Reference { target, .. } if indices.len() == 1 => {
                let target = target.as_ref().clone();
                let pointer = spot.read();
                let operand = self.operand(indices[0])?;
                let location = self.beyond(pointer, operand, &target, node)?;
                Ok(Designated::Spot(Spot { location, type_: target, constant: false }))
            }
            other => {
                let message = format!("{} indices on a value of type `{other}`", indices.len());
                Err(self.unsupported("types that do not fit", node, message))
            }
        }
    }

    /// What lies so many elements behind what a pointer refers to.
    fn beyond(
        &mut self,
        pointer: Expr<Location>,
        operand: Operand<Location>,
        target: &Type,
        node: Node<'c>,
    ) -> Lowered<Location> {
        let name = operand.type_name();
        let (number, _) = operand.settled()?;
        if !is_whole(number.scalar) {
            return Err(self.unsupported("types that do not fit", node, format!("an index of type `{name}`")));
        }
        let place = self.place(node);
        let size = constant(UDINT, u64::from(self.known_size(target)?), place);
        let steps = apply(Op::Mul, UDINT, vec![converted(number, UDINT), size], place);
        let moved = apply(Op::Add, Scalar::Ref, vec![pointer, reinterpreted(steps, Scalar::Ref)], place);
        Ok(referent(moved))
    }

    fn index(
        &mut self,
        operand: Operand<Location>,
        low: i64,
        count: u32,
        stride: u32,
        node: Node<'c>,
    ) -> Lowered<Index> {
        let name = operand.type_name();
        let (value, _) = operand.settled()?;
        if !is_whole(value.scalar) {
            return Err(self.unsupported("types that do not fit", node, format!("an index of type `{name}`")));
        }
        Ok(Index { value, low, count, stride })
    }

    /// The `n`th element of an array in memory.
    pub(super) fn element(&mut self, spot: &Spot, n: usize) -> Lowered<Spot> {
        let Type::Array(array) = &spot.type_ else { return Ok(spot.clone()) };
        let size = self.known_size(&array.element)?;
        let mut location = spot.location.clone();
        location.offset += size.saturating_mul(u32::try_from(n).unwrap_or(u32::MAX));
        Ok(Spot { location, type_: array.element.clone(), constant: spot.constant })
    }
}

/// Goes into an array; a constant index that is within moves the offset.
fn step_into(location: &mut Location, step: Index) {
    if let Some(number) =
        is_constant(&Operand::of(step.value.clone())).then(|| Operand::of(step.value.clone()).number()).flatten()
        && let Ok(n) = u32::try_from(number - i128::from(step.low))
        && n < step.count
    {
        location.offset += n.saturating_mul(step.stride);
        return;
    }
    location.indices.push(step);
}
