//! Runs a program cycle by cycle on values.
//!
//! The program is first brought into a compact form: addresses are resolved as far as they are known, and types become the
//! few bits that an operator needs. Then the trees are walked; there is no byte code, since the walk is fast enough (the
//! bench `machine` measures it). After a fault the memory is as the fault left it, and the run is over: every further cycle
//! gives the same fault.

mod code;
mod compile;
mod run;
#[cfg(test)]
mod tests;
mod text;

use std::sync::Arc;

use super::program::{Program, SlotId};
use crate::semantics::eval::{FaultAt, mask};
use crate::text::Place;
use code::Code;
use run::Walk;

/// What an interpreter must know besides the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// How often a loop's body may be done in one execution of the loop; a `FOR` with constant bounds is done as often as
    /// they say.
    pub loop_limit: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self { loop_limit: 1000 }
    }
}

/// Sees what is executed.
pub trait Observer {
    /// Whether it wants to see anything; where it does not, observing costs nothing.
    const ACTIVE: bool = true;

    /// A slot was set by the statement at `place`.
    fn assigned(&mut self, place: Option<Place>, slot: SlotId, value: u64);
}

/// The observer that sees nothing.
impl Observer for () {
    const ACTIVE: bool = false;

    fn assigned(&mut self, _: Option<Place>, _: SlotId, _: u64) {}
}

/// An assignment that was executed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Assigned {
    /// The statement; `None` for what the elaboration added.
    pub place: Option<Place>,
    /// What was set.
    pub slot: SlotId,
    /// To which bits.
    pub value: u64,
}

/// The observer that keeps everything.
impl Observer for Vec<Assigned> {
    fn assigned(&mut self, place: Option<Place>, slot: SlotId, value: u64) {
        self.push(Assigned { place, slot, value });
    }
}

/// A program that runs.
#[derive(Clone, Debug)]
pub struct Interpreter {
    code: Arc<Code>,
    memory: Vec<u64>,
    fault: Option<FaultAt>,
    cycles: u64,
}

impl Interpreter {
    /// The program before its first cycle, its startup done, with the usual options.
    #[must_use]
    pub fn new(program: &Program) -> Self {
        Self::with(program, &Options::default())
    }

    /// The program before its first cycle, its startup done. If the startup faults, the first cycle says so.
    #[must_use]
    pub fn with(program: &Program, options: &Options) -> Self {
        let code = Arc::new(compile::code(program, options));
        let mut made = Self { memory: code.initial.clone(), code, fault: None, cycles: 0 };
        made.cold_start();
        made
    }

    /// Goes back to before the first cycle: every slot as it is declared (`RETAIN` too: the start is a cold one).
    pub fn cold_start(&mut self) {
        self.memory.clone_from(&self.code.initial);
        self.cycles = 0;
        let started = Walk::new(&self.code, &mut self.memory, &mut ()).whole(&self.code.startup);
        self.fault = started.err().map(|stop| self.code.explain(stop));
    }

    /// The bits of a slot; zero for a slot that the program does not have.
    #[must_use]
    pub fn get(&self, slot: SlotId) -> u64 {
        self.memory.get(slot.0 as usize).copied().unwrap_or(0)
    }

    /// Sets a slot, cut to its width. A slot that the program does not have is left alone.
    pub fn set(&mut self, slot: SlotId, bits: u64) {
        let at = slot.0 as usize;
        if let (Some(place), Some(scalar)) = (self.memory.get_mut(at), self.code.scalars.get(at)) {
            *place = mask(*scalar, bits);
        }
    }

    /// The whole memory, slot by slot.
    #[must_use]
    pub fn memory(&self) -> &[u64] {
        &self.memory
    }

    /// How many cycles have been done without a fault.
    #[must_use]
    pub const fn cycles(&self) -> u64 {
        self.cycles
    }

    /// Does one cycle: the clocks go on, the unit is called.
    ///
    /// # Errors
    /// The fault that stopped the run, in this cycle or before.
    pub fn cycle(&mut self) -> Result<(), FaultAt> {
        self.cycle_observed(&mut ())
    }

    /// As [`Self::cycle`], seen by an observer.
    ///
    /// # Errors
    /// As for [`Self::cycle`].
    pub fn cycle_observed<O: Observer>(&mut self, observer: &mut O) -> Result<(), FaultAt> {
        if let Some(fault) = self.fault {
            return Err(fault);
        }
        for (slot, step, scalar) in &self.code.clocks {
            if let Some(clock) = self.memory.get_mut(*slot as usize) {
                *clock = mask(*scalar, clock.wrapping_add(*step));
            }
        }
        match Walk::new(&self.code, &mut self.memory, observer).whole(&self.code.cycle) {
            Ok(()) => {
                self.cycles += 1;
                Ok(())
            }
            Err(stop) => {
                let fault = self.code.explain(stop);
                self.fault = Some(fault);
                Err(fault)
            }
        }
    }
}
