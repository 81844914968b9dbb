//! Operations on strings. A string is read as its characters, all zero behind its end; positions and counts that are not
//! constant move them by shifters of logarithmic depth. What each operation means, the interpreter says.

use super::Unsupported;
use super::flow::Executor;
use crate::logic::term::{Op, Term};
use crate::machine::program::{Location, Text, TextOperation, TextOrder, Value};
use crate::semantics::encode;
use crate::semantics::scalar::Scalar;
use crate::text::Place;

/// Bits of a length.
const LENGTH: u32 = 32;

/// Bits of a character, whatever its string has.
const CHARACTER: u32 = 16;

/// Characters, as many as there may be; behind the end they are zero.
type Characters = Vec<Term>;

impl<'p> Executor<'p> {
    /// An operation.
    pub(super) fn text(&mut self, operation: &'p TextOperation, place: Option<Place>) -> Result<(), Unsupported> {
        let (target, characters) = match operation {
            TextOperation::Compare { target, order, left, right } => {
                let (left, right) = (self.read_text(left, place)?, self.read_text(right, place)?);
                let result = self.compare(*order, left, right);
                return self.set_number(target, Scalar::Bool, result, place);
            }
            TextOperation::Length(target, scalar, text) => {
                let text = self.read_text(text, place)?;
                let length = self.length(&text);
                return self.set_number(target, *scalar, length, place);
            }
            TextOperation::Find(target, scalar, text, needle) => {
                let (text, needle) = (self.read_text(text, place)?, self.read_text(needle, place)?);
                let position = self.find(&text, &needle);
                return self.set_number(target, *scalar, position, place);
            }
            TextOperation::Assign(target, source) => (target, self.read_text(source, place)?),
            TextOperation::Literal(target, codes) => {
                (target, codes.iter().map(|code| self.pool.constant(CHARACTER, u64::from(*code))).collect())
            }
            TextOperation::Concat(target, first, second) => {
                let (first, second) = (self.read_text(first, place)?, self.read_text(second, place)?);
                (target, self.concat(first, &second))
            }
            TextOperation::Left(target, source, count) => {
                let text = self.read_text(source, place)?;
                let count = self.count(count, text.len())?;
                (target, self.take(text, count))
            }
            TextOperation::Right(target, source, count) => {
                let text = self.read_text(source, place)?;
                let count = self.count(count, text.len())?;
                (target, self.right(text, count))
            }
            TextOperation::Mid(target, source, count, position) => {
                let text = self.read_text(source, place)?;
                let count = self.count(count, text.len())?;
                let (valid, from) = self.index(position, &text)?;
                let rest = self.drop(text, from);
                let middle = self.take(rest, count);
                (target, self.only_if(valid, middle))
            }
            TextOperation::Insert(target, first, second, position) => {
                let (first, second) = (self.read_text(first, place)?, self.read_text(second, place)?);
                (target, self.insert(first, &second, position)?)
            }
            TextOperation::Delete(target, source, count, position) => {
                let text = self.read_text(source, place)?;
                (target, self.replace(text, &[], count, position)?)
            }
            TextOperation::Replace(target, first, second, count, position) => {
                let (text, by) = (self.read_text(first, place)?, self.read_text(second, place)?);
                (target, self.replace(text, &by, count, position)?)
            }
        };
        self.write_text(target, &characters, place)
    }

    fn set_number(
        &mut self,
        target: &'p Location,
        scalar: Scalar,
        number: Term,
        place: Option<Place>,
    ) -> Result<(), Unsupported> {
        let area = self.resolve(target, place)?;
        let value = self.resize(number, scalar.width(), false);
        self.store(&area, 0, value);
        Ok(())
    }

    fn read_text(&mut self, text: &'p Text, place: Option<Place>) -> Result<Characters, Unsupported> {
        let area = self.resolve(&text.location, place)?;
        let scalar = self.scalar_at(&area, 0);
        let mut inside = self.pool.truth(true);
        let mut characters = Vec::with_capacity(text.capacity as usize);
        for offset in 0..text.capacity {
            let character = self.load(&area, offset, scalar);
            let character = self.resize(character, CHARACTER, false);
            let there = self.is_there(character);
            inside = self.and(inside, there);
            characters.push(self.or_zero(inside, character));
            if self.pool.value(inside) == Some(0) {
                break;
            }
        }
        Ok(characters)
    }

    fn write_text(&mut self, text: &'p Text, characters: &[Term], place: Option<Place>) -> Result<(), Unsupported> {
        let area = self.resolve(&text.location, place)?;
        let zero = self.pool.constant(CHARACTER, 0);
        for offset in 0..=text.capacity {
            let given = characters.get(offset as usize).filter(|_| offset < text.capacity);
            self.store(&area, offset, given.copied().unwrap_or(zero));
        }
        Ok(())
    }

    /// Whether a character is not the closing zero.
    fn is_there(&mut self, character: Term) -> Term {
        let zero = self.pool.constant(self.pool.width(character), 0);
        let is_zero = self.pool.apply(Op::Eq, &[character, zero]);
        self.not(is_zero)
    }

    fn or_zero(&mut self, condition: Term, character: Term) -> Term {
        let zero = self.pool.constant(CHARACTER, 0);
        self.pool.apply(Op::Ite, &[condition, character, zero])
    }

    fn only_if(&mut self, condition: Term, text: Characters) -> Characters {
        text.into_iter().map(|character| self.or_zero(condition, character)).collect()
    }

    fn length_constant(&mut self, number: usize) -> Term {
        self.pool.constant(LENGTH, number as u64)
    }

    fn length(&mut self, text: &[Term]) -> Term {
        let mut length = self.length_constant(text.len());
        for (index, character) in text.iter().enumerate().rev() {
            let there = self.is_there(*character);
            let here = self.length_constant(index);
            length = self.pool.apply(Op::Ite, &[there, length, here]);
        }
        length
    }

    /// The value as a count from 0 to `most`.
    fn count(&mut self, value: &'p Value, most: usize) -> Result<Term, Unsupported> {
        let (term, scalar) = (encode::value(self, value)?, value.scalar);
        let inside = self.in_range(term, scalar, 0, most as i128);
        let negative = self.in_range(term, scalar, i128::MIN, -1);
        let (none, all) = (self.length_constant(0), self.length_constant(most));
        let outside = self.pool.apply(Op::Ite, &[negative, none, all]);
        let count = self.resize(term, LENGTH, false);
        Ok(self.pool.apply(Op::Ite, &[inside, count, outside]))
    }

    /// The value as a position in the text from 1: whether there is such a character, and its index.
    fn index(&mut self, value: &'p Value, text: &[Term]) -> Result<(Term, Term), Unsupported> {
        let length = self.length(text);
        let (term, scalar) = (encode::value(self, value)?, value.scalar);
        let possible = self.in_range(term, scalar, 1, text.len() as i128);
        let position = self.resize(term, LENGTH, false);
        let inside = self.pool.apply(Op::Ule, &[position, length]);
        let one = self.length_constant(1);
        let index = self.pool.apply(Op::Sub, &[position, one]);
        Ok((self.and(possible, inside), index))
    }

    /// The first `count` characters.
    fn take(&mut self, text: Characters, count: Term) -> Characters {
        let mut taken = Vec::with_capacity(text.len());
        for (index, character) in text.into_iter().enumerate() {
            let here = self.length_constant(index);
            let inside = self.pool.apply(Op::Ult, &[here, count]);
            taken.push(self.or_zero(inside, character));
        }
        taken
    }

    /// The text without its first `count` characters.
    fn drop(&mut self, mut text: Characters, count: Term) -> Characters {
        let bits = self.bits_for(text.len());
        for bit in 0..bits {
            let moves = self.pool.apply(Op::Extract { high: bit, low: bit }, &[count]);
            text = (0..text.len())
                .map(|index| {
                    let zero = self.pool.constant(CHARACTER, 0);
                    let from = text.get(index + (1 << bit)).copied().unwrap_or(zero);
                    self.pool.apply(Op::Ite, &[moves, from, text[index]])
                })
                .collect();
        }
        let beyond = self.is_beyond(count, bits);
        let inside = self.not(beyond);
        self.only_if(inside, text)
    }

    /// The text with `count` zeros in front, `count` being at most `most`.
    fn indent(&mut self, text: &[Term], count: Term, most: usize) -> Characters {
        let zero = self.pool.constant(CHARACTER, 0);
        let mut text = text.to_vec();
        text.resize(text.len() + most, zero);
        for bit in 0..self.bits_for(most) {
            let moves = self.pool.apply(Op::Extract { high: bit, low: bit }, &[count]);
            text = (0..text.len())
                .map(|index| {
                    let from = index.checked_sub(1 << bit).map_or(zero, |from| text[from]);
                    self.pool.apply(Op::Ite, &[moves, from, text[index]])
                })
                .collect();
        }
        text
    }

    /// How many bits a count up to `most` has.
    fn bits_for(&self, most: usize) -> u32 {
        (usize::BITS - most.leading_zeros()).min(LENGTH)
    }

    /// Whether a count has more bits than these.
    fn is_beyond(&mut self, count: Term, bits: u32) -> Term {
        if bits >= LENGTH {
            return self.pool.truth(false);
        }
        let high = self.pool.apply(Op::Extract { high: LENGTH - 1, low: bits }, &[count]);
        self.is_there(high)
    }

    fn concat(&mut self, first: Characters, second: &[Term]) -> Characters {
        let length = self.length(&first);
        self.append(first, second, length)
    }

    /// `second` from index `length` of `first` on, which is zero from there.
    fn append(&mut self, first: Characters, second: &[Term], length: Term) -> Characters {
        if second.is_empty() {
            return first;
        }
        let moved = self.indent(second, length, first.len());
        let mut joined = Vec::with_capacity(moved.len());
        for (index, character) in moved.into_iter().enumerate() {
            joined.push(match first.get(index) {
                Some(own) => self.pool.apply(Op::Or, &[*own, character]),
                None => character,
            });
        }
        joined
    }

    fn right(&mut self, text: Characters, count: Term) -> Characters {
        let length = self.length(&text);
        let fits = self.pool.apply(Op::Ule, &[count, length]);
        let rest = self.pool.apply(Op::Sub, &[length, count]);
        let none = self.length_constant(0);
        let from = self.pool.apply(Op::Ite, &[fits, rest, none]);
        self.drop(text, from)
    }

    fn insert(&mut self, first: Characters, second: &[Term], position: &'p Value) -> Result<Characters, Unsupported> {
        let length = self.length(&first);
        let (term, scalar) = (encode::value(self, position)?, position.scalar);
        let possible = self.in_range(term, scalar, 0, first.len() as i128);
        let at = self.resize(term, LENGTH, false);
        let inside = self.pool.apply(Op::Ule, &[at, length]);
        let valid = self.and(possible, inside);
        let changed = self.splice(&first, second, at, at);
        Ok(self.choose_text(valid, changed, first))
    }

    fn replace(
        &mut self,
        text: Characters,
        by: &[Term],
        count: &'p Value,
        position: &'p Value,
    ) -> Result<Characters, Unsupported> {
        let count = self.count(count, text.len())?;
        let (valid, from) = self.index(position, &text)?;
        let to = self.pool.apply(Op::Add, &[from, count]);
        let changed = self.splice(&text, by, from, to);
        Ok(self.choose_text(valid, changed, text))
    }

    /// The text with `by` instead of what lies from `from` to before `to`.
    fn splice(&mut self, text: &[Term], by: &[Term], from: Term, to: Term) -> Characters {
        let (head, tail) = (self.take(text.to_vec(), from), self.drop(text.to_vec(), to));
        let added = self.length(by);
        let with = self.append(head, by, from);
        let end = self.pool.apply(Op::Add, &[from, added]);
        self.append(with, &tail, end)
    }

    fn choose_text(&mut self, condition: Term, yes: Characters, no: Characters) -> Characters {
        (0..yes.len().max(no.len()))
            .map(|index| match (yes.get(index), no.get(index)) {
                (Some(a), Some(b)) => self.pool.apply(Op::Ite, &[condition, *a, *b]),
                (Some(a), None) => self.or_zero(condition, *a),
                (None, Some(b)) => {
                    let not = self.not(condition);
                    self.or_zero(not, *b)
                }
                (None, None) => self.pool.constant(CHARACTER, 0),
            })
            .collect()
    }

    fn compare(&mut self, order: TextOrder, left: Characters, right: Characters) -> Term {
        let mut result = self.pool.truth(order != TextOrder::Less);
        let zero = self.pool.constant(CHARACTER, 0);
        for index in (0..left.len().max(right.len())).rev() {
            let (a, b) = (left.get(index).copied().unwrap_or(zero), right.get(index).copied().unwrap_or(zero));
            let equal = self.pool.apply(Op::Eq, &[a, b]);
            result = match order {
                TextOrder::Equal => self.and(equal, result),
                TextOrder::Less | TextOrder::LessOrEqual => {
                    let less = self.pool.apply(Op::Ult, &[a, b]);
                    self.pool.apply(Op::Ite, &[equal, result, less])
                }
            };
        }
        result
    }

    /// The first position from 1 where the needle lies, or 0.
    fn find(&mut self, text: &[Term], needle: &[Term]) -> Term {
        let mut position = self.length_constant(0);
        let Some(first) = needle.first().copied() else { return position };
        let nonempty = self.is_there(first);
        for start in (0..text.len()).rev() {
            let mut matches = nonempty;
            for (index, wanted) in needle.iter().enumerate() {
                let wanted_there = self.is_there(*wanted);
                let past = self.not(wanted_there);
                let same = match text.get(start + index) {
                    Some(character) => self.pool.apply(Op::Eq, &[*character, *wanted]),
                    None => self.pool.truth(false),
                };
                let fits = self.or(past, same);
                matches = self.and(matches, fits);
                if self.pool.value(matches) == Some(0) {
                    break;
                }
            }
            let here = self.length_constant(start + 1);
            position = self.pool.apply(Op::Ite, &[matches, here, position]);
        }
        position
    }
}
