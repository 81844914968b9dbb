//! Operations on strings, IEC 61131-3 §6.6.2.5.11. A result is cut to its target; behind its closing zero the target is
//! filled with zeros. Positions count from 1. A count below zero is none; a position outside of the text leaves it as it is
//! (`INSERT`, `DELETE`, `REPLACE`) or gives the empty text (`MID`). Nothing is found of an empty text.

use super::Observer;
use super::code::{Area, Make, Measure, Number, PlaceId, Stop, TextDo};
use super::run::Walk;
use crate::machine::program::TextOrder;

impl<O: Observer> Walk<'_, O> {
    pub(super) fn text(&mut self, operation: &TextDo, place: PlaceId) -> Result<(), Stop> {
        match operation {
            TextDo::Make(target, make) => {
                let result = self.make(make)?;
                self.write(target, &result, place)
            }
            TextDo::Measure(target, scalar, measure) => {
                let number = self.measure(measure)?;
                let target = self.locate(target)?;
                self.store_number(target, *scalar, number, place)
            }
        }
    }

    fn read(&self, area: &Area) -> Result<Vec<u64>, Stop> {
        let first = self.locate(&area.first)? as usize;
        let slots = self.memory.get(first..).unwrap_or(&[]);
        Ok(slots.iter().take(area.capacity as usize).take_while(|c| **c != 0).copied().collect())
    }

    fn write(&mut self, area: &Area, text: &[u64], place: PlaceId) -> Result<(), Stop> {
        let first = self.locate(&area.first)?;
        for at in 0..=area.capacity {
            let character = if at < area.capacity { text.get(at as usize).copied().unwrap_or(0) } else { 0 };
            self.store(first.wrapping_add(at), character, place)?;
        }
        Ok(())
    }

    /// A count: none if it is negative.
    fn count(&self, number: &Number) -> Result<usize, Stop> {
        Ok(usize::try_from(self.number(number)?.max(0)).unwrap_or(usize::MAX))
    }

    /// The index of the character at a position of `text`.
    fn index(&self, number: &Number, text: &[u64]) -> Result<Option<usize>, Stop> {
        let index = usize::try_from(self.number(number)? - 1).ok();
        Ok(index.filter(|index| *index < text.len()))
    }

    fn make(&self, make: &Make) -> Result<Vec<u64>, Stop> {
        Ok(match make {
            Make::Assign(source) => self.read(source)?,
            Make::Literal(characters) => characters.clone(),
            Make::Concat(first, second) => [self.read(first)?, self.read(second)?].concat(),
            Make::Left(source, count) => {
                let mut text = self.read(source)?;
                text.truncate(self.count(count)?);
                text
            }
            Make::Right(source, count) => {
                let text = self.read(source)?;
                let count = self.count(count)?;
                text[text.len().saturating_sub(count)..].to_vec()
            }
            Make::Mid(source, count, position) => {
                let text = self.read(source)?;
                let count = self.count(count)?;
                let from = self.index(position, &text)?.unwrap_or(text.len());
                text[from..].iter().take(count).copied().collect()
            }
            Make::Insert(first, second, position) => self.insert(first, second, position)?,
            Make::Delete(source, count, position) => self.replace(self.read(source)?, &[], count, position)?,
            Make::Replace(first, second, count, position) => {
                let (text, by) = (self.read(first)?, self.read(second)?);
                self.replace(text, &by, count, position)?
            }
        })
    }

    fn insert(&self, first: &Area, second: &Area, position: &Number) -> Result<Vec<u64>, Stop> {
        let (mut text, inserted) = (self.read(first)?, self.read(second)?);
        let at = usize::try_from(self.number(position)?).ok().filter(|at| *at <= text.len());
        if let Some(at) = at {
            text.splice(at..at, inserted);
        }
        Ok(text)
    }

    fn replace(&self, mut text: Vec<u64>, by: &[u64], count: &Number, position: &Number) -> Result<Vec<u64>, Stop> {
        let count = self.count(count)?;
        if let Some(from) = self.index(position, &text)? {
            let to = from.saturating_add(count).min(text.len());
            text.splice(from..to, by.iter().copied());
        }
        Ok(text)
    }

    fn measure(&self, measure: &Measure) -> Result<i128, Stop> {
        Ok(match measure {
            Measure::Length(text) => self.read(text)?.len() as i128,
            Measure::Compare(order, left, right) => {
                let (left, right) = (self.read(left)?, self.read(right)?);
                i128::from(match order {
                    TextOrder::Equal => left == right,
                    TextOrder::Less => left < right,
                    TextOrder::LessOrEqual => left <= right,
                })
            }
            Measure::Find(text, needle) => {
                let (text, needle) = (self.read(text)?, self.read(needle)?);
                let found = text.windows(needle.len().max(1)).position(|window| window == needle);
                found.map_or(0, |at| at as i128 + 1)
            }
        })
    }
}
