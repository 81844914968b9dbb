//! Durations: how often a row or a block is repeated, in cycles or in time.
//!
//! A duration is kept as it was written (bounds that are sums of numbers, times and constants) and, once cycle time and
//! constants are known, as a [`Repeat`] in cycles.

mod parse;

use std::collections::BTreeMap;

use super::cell::literal;
use super::model::Quantity;
use crate::text::{Place, Span};
pub use parse::parse;

/// A duration as the user wrote it, and what it comes to.
#[derive(Clone, Debug)]
pub struct DurationCell {
    /// The text; empty where it was left out.
    pub text: String,
    /// Where it stands, or where it would.
    pub place: Place,
    /// What was written.
    pub duration: Duration,
    /// In cycles; `None` where a time cannot be counted for want of a cycle time, or something is wrong.
    pub repeat: Option<Repeat>,
    /// Whether it could not be read.
    pub spoiled: bool,
}

/// What a duration says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Duration {
    /// The numbers.
    pub bounds: Bounds,
    /// The flag behind them.
    pub flag: Option<Flag>,
}

/// The numbers of a duration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Bounds {
    /// Exactly so often.
    Exactly(Amount),
    /// Between the two; without an upper one for any length of time.
    Between(Amount, Option<Amount>),
    /// Strong repetition: once entered, for ever.
    Omega,
}

/// A flag of a duration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flag {
    /// Must leave as soon as the input constraint of a possible successor holds.
    Progress,
    /// geteta's `hold`, which is read and printed and has no meaning here.
    Hold,
}

/// A bound: a sum of terms.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Amount {
    /// The terms, each with whether it is subtracted.
    pub terms: Vec<(bool, Term)>,
}

/// A term of a bound.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Term {
    /// A number of cycles or a time.
    Quantity(Quantity),
    /// A time constant.
    Constant(String),
}

/// How often, in cycles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repeat {
    /// At least `low` and at most `high` times.
    Times {
        /// At least.
        low: u64,
        /// At most; `None` is without limit.
        high: Option<u64>,
    },
    /// For ever.
    Omega,
}

/// What is wrong with a duration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DurationError {
    /// Where, in the file.
    pub span: Span,
    /// What, in one line.
    pub message: String,
    /// What would help.
    pub help: Option<String>,
}

/// Why a duration cannot be counted in cycles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Uncounted {
    /// It is a time, and the cycle time is not known.
    NoCycleTime,
    /// It is wrong.
    Wrong {
        /// What is.
        message: String,
        /// What would help.
        help: Option<String>,
    },
}

impl Amount {
    /// So many cycles.
    #[must_use]
    pub fn cycles(count: i128) -> Self {
        Self { terms: vec![(false, Term::Quantity(Quantity::Cycles(count)))] }
    }

    fn plus(mut self, count: i128) -> Self {
        if let [(false, Term::Quantity(Quantity::Cycles(n)))] = self.terms.as_mut_slice() {
            *n += count;
            return self;
        }
        self.terms.push((count < 0, Term::Quantity(Quantity::Cycles(count.abs()))));
        self
    }
}

impl Duration {
    /// Exactly `count` cycles.
    #[must_use]
    pub fn exactly(count: i128) -> Self {
        Self { bounds: Bounds::Exactly(Amount::cycles(count)), flag: None }
    }

    /// For ever.
    #[must_use]
    pub const fn omega() -> Self {
        Self { bounds: Bounds::Omega, flag: None }
    }

    /// `[0, ∞]`.
    #[must_use]
    pub fn any() -> Self {
        Self { bounds: Bounds::Between(Amount::cycles(0), None), flag: None }
    }

    /// Whether it must be left as soon as possible.
    #[must_use]
    pub fn has_progress(&self) -> bool {
        self.flag == Some(Flag::Progress)
    }

    /// The duration in cycles of `cycle` nanoseconds, with `constants` by their names in upper case.
    ///
    /// # Errors
    /// Why it cannot be counted.
    pub fn count(&self, cycle: Option<i128>, constants: &BTreeMap<String, Quantity>) -> Result<Repeat, Uncounted> {
        let amount = |amount: &Amount| amount_in_cycles(amount, cycle, constants);
        match &self.bounds {
            Bounds::Omega => Ok(Repeat::Omega),
            Bounds::Exactly(exactly) => {
                let count = amount(exactly)?;
                Ok(Repeat::Times { low: count, high: Some(count) })
            }
            Bounds::Between(low, high) => {
                let (low, high) = (amount(low)?, high.as_ref().map(amount).transpose()?);
                if high.is_some_and(|high| high < low) {
                    let message = "the upper bound is below the lower one".to_owned();
                    return Err(Uncounted::Wrong { message, help: None });
                }
                Ok(Repeat::Times { low, high })
            }
        }
    }
}

fn wrong(message: impl Into<String>) -> Uncounted {
    Uncounted::Wrong { message: message.into(), help: None }
}

/// Times are added up before they are divided by the cycle, so that `T1 - T2` may be whole where neither is.
fn amount_in_cycles(
    amount: &Amount,
    cycle: Option<i128>,
    constants: &BTreeMap<String, Quantity>,
) -> Result<u64, Uncounted> {
    let (mut cycles, mut nanos) = (0_i128, 0_i128);
    for (minus, term) in &amount.terms {
        let quantity = match term {
            Term::Quantity(quantity) => *quantity,
            Term::Constant(name) => {
                *constants.get(&name.to_ascii_uppercase()).ok_or_else(|| unknown_constant(name, constants))?
            }
        };
        let sign = if *minus { -1 } else { 1 };
        let (sum, value) = match quantity {
            Quantity::Cycles(value) => (&mut cycles, value),
            Quantity::Nanos(value) => (&mut nanos, value),
        };
        *sum = sum.checked_add(sign * value).ok_or_else(|| wrong("this duration is too long"))?;
    }
    let total = if nanos == 0 { Some(cycles) } else { cycles.checked_add(divided(nanos, cycle)?) };
    match total.map(u64::try_from) {
        Some(Ok(total)) if total <= u64::from(u32::MAX) => Ok(total),
        Some(Err(_)) if total.is_some_and(|total| total < 0) => Err(wrong("this duration is below zero")),
        _ => Err(wrong("this duration has more than 4294967295 cycles")),
    }
}

fn unknown_constant(name: &str, constants: &BTreeMap<String, Quantity>) -> Uncounted {
    let near = crate::text::near::nearest(name, constants.keys().map(String::as_str));
    let help = near.map_or_else(
        || format!("declare it in the heading: `const {name} = 5`"),
        |near| format!("the table declares `{near}`"),
    );
    Uncounted::Wrong { message: format!("no time constant is named `{name}`"), help: Some(help) }
}

fn divided(nanos: i128, cycle: Option<i128>) -> Result<i128, Uncounted> {
    let cycle = cycle.filter(|cycle| *cycle > 0).ok_or(Uncounted::NoCycleTime)?;
    if nanos % cycle == 0 {
        return Ok(nanos / cycle);
    }
    let text = literal::time_text;
    let below = nanos.div_euclid(cycle) * cycle;
    let message = format!("{} is no whole number of cycles of {}", text(nanos), text(cycle));
    let help = format!("the nearest values are {} and {}", text(below), text(below + cycle));
    Err(Uncounted::Wrong { message, help: Some(help) })
}
