//! The state of a symbolic execution: frames of loops and routines, path conditions, jumps, faults.

use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;

use super::memory::{self, Delta, Memory};
use super::{Options, Unsupported};
use crate::logic::term::{Op, Pool, Term, Var};
use crate::machine::program::{Location, Program};
use crate::semantics::encode::Context;
use crate::semantics::expr::{Expr, Fault};
use crate::text::Place;

/// Paths that wait at the end of a loop, of an iteration or of a routine.
#[derive(Debug)]
pub(super) struct Pending {
    /// Which ones, relative to the frame.
    condition: Term,
    /// What they have changed since the frame began.
    delta: Delta,
}

/// A loop or a routine that is being executed.
#[derive(Debug)]
pub(super) struct Frame {
    /// Whether it is a loop.
    pub(super) is_loop: bool,
    /// The path condition where it began, from the beginning of the cycle.
    outer: Term,
    /// The present path condition, relative to that.
    pub(super) path: Term,
    /// Memory where it began.
    mark: usize,
    /// Paths that go on behind it.
    leaving: Option<Pending>,
    /// Paths that go on with the next iteration.
    continuing: Option<Pending>,
    /// Relative to the frame: the paths on which a routine was left from within a loop.
    returned: Term,
}

/// A site of a fault.
#[derive(Clone, Copy, Debug)]
pub(super) struct Site {
    /// Which.
    pub(super) fault: Fault,
    /// Where.
    pub(super) place: Option<Place>,
    /// Whether the cycle runs into it.
    pub(super) condition: Term,
}

/// A symbolic execution.
#[derive(Debug)]
pub(super) struct Executor<'p> {
    pub(super) program: &'p Program,
    pub(super) options: &'p Options,
    pub(super) pool: Pool,
    pub(super) memory: Memory,
    pub(super) frames: Vec<Frame>,
    /// The instance that the present routine is called on.
    pub(super) this: u32,
    /// No fault so far in the cycle.
    unharmed: Term,
    /// The sites, in the order of their first visit, and the way to them.
    pub(super) sites: Vec<Site>,
    site_index: HashMap<(Fault, Option<Place>), usize>,
    /// The addresses that the variables of references may hold.
    pub(super) addresses: HashMap<Var, Rc<BTreeSet<u32>>>,
    /// The same for terms, as found.
    pub(super) targets: HashMap<Term, Rc<BTreeSet<u32>>>,
    pub(super) steps: u64,
    /// How many calls are under way.
    pub(super) depth: usize,
}

impl<'p> Executor<'p> {
    /// An execution that begins with a memory of these cells.
    pub(super) fn new(program: &'p Program, options: &'p Options, mut pool: Pool, cells: Vec<Term>) -> Self {
        let yes = pool.truth(true);
        Self {
            program,
            options,
            pool,
            memory: Memory::new(cells),
            frames: Vec::new(),
            this: program.this.0,
            unharmed: yes,
            sites: Vec::new(),
            site_index: HashMap::new(),
            addresses: HashMap::new(),
            targets: HashMap::new(),
            steps: 0,
            depth: 0,
        }
    }

    /// The innermost frame.
    fn top(&mut self) -> &mut Frame {
        self.frames.last_mut().expect("statements are executed inside of a frame")
    }

    /// The present path condition, relative to the innermost frame.
    pub(super) fn path(&mut self) -> Term {
        self.top().path
    }

    /// Sets it.
    pub(super) fn set_path(&mut self, path: Term) {
        self.top().path = path;
    }

    /// Whether no path leads here.
    pub(super) fn is_dead(&mut self) -> bool {
        let path = self.path();
        self.pool.value(path) == Some(0)
    }

    /// No path leads on from here.
    pub(super) fn kill(&mut self) {
        let no = self.pool.truth(false);
        self.set_path(no);
    }

    pub(super) fn not(&mut self, term: Term) -> Term {
        self.pool.apply(Op::Not, &[term])
    }

    pub(super) fn and(&mut self, left: Term, right: Term) -> Term {
        self.pool.apply(Op::And, &[left, right])
    }

    pub(super) fn or(&mut self, left: Term, right: Term) -> Term {
        self.pool.apply(Op::Or, &[left, right])
    }

    /// Begins a loop or a routine.
    pub(super) fn enter(&mut self, is_loop: bool) {
        let (yes, no) = (self.pool.truth(true), self.pool.truth(false));
        let outer = match self.frames.last() {
            Some(frame) => {
                let (outer, path) = (frame.outer, frame.path);
                self.and(outer, path)
            }
            None => yes,
        };
        let mark = self.memory.mark();
        let frame = Frame { is_loop, outer, path: yes, mark, leaving: None, continuing: None, returned: no };
        self.frames.push(frame);
    }

    /// Ends it: the paths that have left it join the one that has come to its end.
    pub(super) fn leave(&mut self) {
        let Some(mut frame) = self.frames.pop() else { return };
        let dead = self.pool.value(frame.path) == Some(0);
        if dead && frame.leaving.is_none() {
            if !self.frames.is_empty() {
                self.kill();
            }
            return;
        }
        self.join(&mut frame.path, frame.mark, frame.leaving.take());
        if frame.is_loop && self.pool.value(frame.returned) != Some(0) {
            let stayed = self.not(frame.returned);
            let path = self.path();
            let path = self.and(path, stayed);
            self.set_path(path);
        }
    }

    /// The paths that wait join the present one, whose condition is `path`.
    fn join(&mut self, path: &mut Term, mark: usize, pending: Option<Pending>) {
        let Some(pending) = pending else { return };
        if self.pool.value(*path) == Some(0) {
            self.memory.replace(mark, &pending.delta);
            *path = pending.condition;
            return;
        }
        let present = self.memory.changes(mark);
        let merged = memory::merge(&mut self.pool, pending.condition, &pending.delta, &present);
        self.memory.replace(mark, &merged);
        *path = self.or(*path, pending.condition);
    }

    /// Paths that have continued join the present one, before the next iteration.
    pub(super) fn join_continuing(&mut self) {
        let frame = self.top();
        let (mut path, mark, pending) = (frame.path, frame.mark, frame.continuing.take());
        self.join(&mut path, mark, pending);
        self.set_path(path);
    }

    /// The part of the present path on which the condition holds leaves the innermost loop.
    pub(super) fn leave_loop_if(&mut self, condition: Term) {
        let path = self.path();
        let leaving = self.and(path, condition);
        let index = self.frames.len() - 1;
        self.wait(index, leaving, false);
        let staying = self.not(condition);
        let path = self.and(path, staying);
        self.set_path(path);
    }

    /// `EXIT`, `CONTINUE`: the present path goes to the end of the innermost loop, or of its iteration; outside of a loop, of the
    /// routine.
    pub(super) fn jump(&mut self, is_continue: bool) {
        let index = self.frames.len() - 1;
        let frame = &self.frames[index];
        let (path, is_loop) = (frame.path, frame.is_loop);
        self.wait(index, path, is_continue && is_loop);
        self.kill();
    }

    /// `RETURN`: the present path goes to the end of the routine.
    pub(super) fn return_(&mut self) {
        let mut condition = self.path();
        let mut index = self.frames.len() - 1;
        while self.frames[index].is_loop && index > 0 {
            let returned = self.frames[index].returned;
            self.frames[index].returned = self.or(returned, condition);
            index -= 1;
            let path = self.frames[index].path;
            condition = self.and(path, condition);
        }
        self.wait(index, condition, false);
        self.kill();
    }

    /// The present memory waits at the end of a frame.
    fn wait(&mut self, index: usize, condition: Term, is_continue: bool) {
        if self.pool.value(condition) == Some(0) {
            return;
        }
        let mut delta = self.memory.changes(self.frames[index].mark);
        let frame = &mut self.frames[index];
        let waiting = if is_continue { &mut frame.continuing } else { &mut frame.leaving };
        let before = waiting.take();
        let mut all = condition;
        if let Some(before) = before {
            delta = memory::merge(&mut self.pool, condition, &delta, &before.delta);
            all = self.or(before.condition, condition);
        }
        let pending = Some(Pending { condition: all, delta });
        let frame = &mut self.frames[index];
        if is_continue {
            frame.continuing = pending;
        } else {
            frame.leaving = pending;
        }
    }

    /// Whether the cycle has run into a fault.
    pub(super) fn harmed(&mut self) -> Term {
        let unharmed = self.unharmed;
        self.not(unharmed)
    }

    /// Counts a step.
    pub(super) fn step(&mut self, place: Option<Place>) -> Result<(), Unsupported> {
        self.steps += 1;
        if self.steps > self.options.step_limit || self.pool.len() > self.options.term_limit {
            let what = format!(
                "a cycle of more than {} statements or {} terms with its loops unrolled",
                self.options.step_limit, self.options.term_limit
            );
            return Err(Unsupported { what, place });
        }
        Ok(())
    }
}

impl Context<Location> for Executor<'_> {
    type Error = Unsupported;

    fn pool(&mut self) -> &mut Pool {
        &mut self.pool
    }

    fn read(&mut self, leaf: &Location, at: &Expr<Location>) -> Result<Term, Unsupported> {
        let area = self.resolve(leaf, at.place)?;
        Ok(self.load(&area, 0, at.scalar))
    }

    fn address(&mut self, leaf: &Location, at: &Expr<Location>) -> Result<Term, Unsupported> {
        let area = self.resolve(leaf, at.place)?;
        Ok(self.address_of(&area))
    }

    fn fault(&mut self, condition: Term, fault: Fault, place: Option<Place>) {
        if self.pool.value(condition) == Some(0) {
            return;
        }
        let frame = self.top();
        let (outer, path) = (frame.outer, frame.path);
        let here = self.and(outer, path);
        let raw = self.and(here, condition);
        let unharmed = self.unharmed;
        let exact = self.and(raw, unharmed);
        if self.pool.value(exact) == Some(0) {
            return;
        }
        let safe = self.not(raw);
        self.unharmed = self.and(unharmed, safe);
        if let Some(index) = self.site_index.get(&(fault, place)).copied() {
            let before = self.sites[index].condition;
            self.sites[index].condition = self.or(before, exact);
        } else {
            self.site_index.insert((fault, place), self.sites.len());
            self.sites.push(Site { fault, place, condition: exact });
        }
        if self.pool.value(condition) == Some(1) {
            self.kill();
        }
    }

    fn narrow(&mut self, condition: Term) -> Term {
        let before = self.path();
        let path = self.and(before, condition);
        self.set_path(path);
        before
    }

    fn widen(&mut self, before: Term) {
        self.set_path(before);
    }
}
