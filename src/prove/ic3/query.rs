//! The questions that the search asks.

use super::frames::Cube;
use super::{Ic3Search, Stop, negated, next, now};
use crate::logic::aig::Lit;

/// Work for the first try at a question; then twice as much.
const FIRST_TRY: u64 = 2_000_000;

/// Which solver.
#[derive(Clone, Copy)]
enum Whom {
    Frame(usize),
    Forever,
    Lifter,
    First,
}

impl Ic3Search {
    /// Asks until there is an answer, or time or share are up.
    fn ask(&mut self, whom: Whom, assumptions: &[Lit], extra: Option<&[Lit]>) -> Result<bool, Stop> {
        if self.work > self.pause {
            return Err(Stop::Pause);
        }
        let mut budget = FIRST_TRY;
        loop {
            let asker = match whom {
                Whom::Frame(frame) => &mut self.frames[frame].asker,
                Whom::Forever => &mut self.forever,
                Whom::Lifter => &mut self.lifter,
                Whom::First => &mut self.first,
            };
            let before = asker.solver.ticks;
            let answer = asker.ask(&self.encoding, assumptions, extra, budget);
            self.work += asker.solver.ticks - before + 200;
            if let Some(answer) = answer {
                return Ok(answer);
            }
            if let Some(reason) = self.budget.exhausted() {
                return Err(Stop::End(reason));
            }
            // What was learnt stays, so that the question is easier when it comes again.
            if self.work > self.pause {
                return Err(Stop::Pause);
            }
            budget = budget.saturating_mul(2);
        }
    }

    /// A predecessor, from the last answer of a frame's solver: what is known of its state, and its inputs.
    fn found(&mut self, frame: usize) -> (Vec<Lit>, Vec<bool>) {
        let solver = &self.frames[frame].asker.solver;
        let signals = self.problem.signals.iter().enumerate();
        let state = signals.filter_map(|(i, s)| solver.value(s.now).map(|v| Lit::of(i as u32).invert_if(!v))).collect();
        let inputs = self.problem.model.inputs.iter().map(|&i| solver.value(i) == Some(true)).collect();
        (state, inputs)
    }

    /// A bad state of the top frame, lifted, with inputs that show it.
    pub(super) fn bad_state(&mut self) -> Result<Option<(Cube, Vec<bool>)>, Stop> {
        let (top, bad) = (self.top(), self.problem.bad);
        if !self.ask(Whom::Frame(top), &[bad], None)? {
            return Ok(None);
        }
        let (state, inputs) = self.found(top);
        let cube = self.lift(state, &inputs, &[!bad])?;
        Ok(Some((cube, inputs)))
    }

    /// Whether the clause that excludes the cube is preserved whatever else holds.
    pub(super) fn is_inductive_alone(&mut self, cube: &Cube) -> Result<bool, Stop> {
        let clause = negated(&self.problem, cube);
        let target: Vec<Lit> = cube.lits().iter().map(|&l| next(&self.problem, l)).collect();
        Ok(!self.ask(Whom::Forever, &target, Some(&clause))?)
    }

    /// Whether the frame's clauses exclude the cube one cycle later; then the part of it that they exclude.
    pub(super) fn is_excluded_after(&mut self, frame: usize, cube: &Cube) -> Result<Option<Cube>, Stop> {
        self.consecution(frame, cube, false)
    }

    /// The same when the cube is excluded in the present cycle, too; `None` leaves a predecessor to be fetched.
    pub(super) fn is_relatively_inductive(&mut self, frame: usize, cube: &Cube) -> Result<Option<Cube>, Stop> {
        self.consecution(frame, cube, true)
    }

    fn consecution(&mut self, frame: usize, cube: &Cube, exclude: bool) -> Result<Option<Cube>, Stop> {
        let mut order = cube.lits().to_vec();
        order.sort_by(|a, b| self.by_activity(*b, *a));
        let target: Vec<Lit> = order.iter().map(|&l| next(&self.problem, l)).collect();
        let clause = negated(&self.problem, cube);
        if self.ask(Whom::Frame(frame), &target, exclude.then_some(clause.as_slice()))? {
            return Ok(None);
        }
        let solver = &self.frames[frame].asker.solver;
        let core = order.iter().zip(&target).filter(|(_, t)| solver.failed(**t)).map(|(&l, _)| l).collect();
        self.apart_from_first(core, cube).map(Some)
    }

    pub(super) fn by_activity(&self, a: Lit, b: Lit) -> std::cmp::Ordering {
        let of = |l: Lit| self.activity[l.node() as usize];
        of(a).total_cmp(&of(b)).then(a.cmp(&b))
    }

    /// The predecessor that the last *no* of this frame left, lifted with respect to `cube`.
    pub(super) fn predecessor(&mut self, frame: usize, cube: &Cube) -> Result<(Cube, Vec<bool>), Stop> {
        let (state, inputs) = self.found(frame);
        let target: Vec<Lit> = cube.lits().iter().map(|&l| !next(&self.problem, l)).collect();
        let lifted = self.lift(state, &inputs, &target)?;
        Ok((lifted, inputs))
    }

    /// The state that the last *no* of this frame left, not lifted.
    pub(super) fn raw_predecessor(&mut self, frame: usize) -> Vec<Lit> {
        self.found(frame).0
    }

    /// A part of the state that, with these inputs, suffices for the constraints and against `unless`.
    fn lift(&mut self, state: Vec<Lit>, inputs: &[bool], unless: &[Lit]) -> Result<Cube, Stop> {
        let mut extra = unless.to_vec();
        extra.extend(self.problem.model.constraints.iter().map(|&c| !c));
        let lits = self.problem.model.inputs.iter().zip(inputs);
        let choice: Vec<Lit> = lits.map(|(l, &v)| l.invert_if(!v)).collect();
        let mut state = state;
        state.sort_by(|a, b| {
            let predicate = |l: &Lit| self.problem.signals[l.node() as usize].is_latch;
            predicate(a).cmp(&predicate(b)).then(self.by_activity(*b, *a))
        });
        for _ in 0..2 {
            let before = state.len();
            let mut assumptions = choice.clone();
            assumptions.extend(state.iter().map(|&l| now(&self.problem, l)));
            if self.ask(Whom::Lifter, &assumptions, Some(&extra))? {
                break;
            }
            let solver = &self.lifter.solver;
            state.retain(|&l| solver.failed(now(&self.problem, l)));
            state.reverse();
            if state.len() == before {
                break;
            }
        }
        Ok(Cube::new(state))
    }

    /// Whether some first state lies in the cube.
    pub(super) fn meets_first(&mut self, lits: &[Lit]) -> Result<bool, Stop> {
        let mut certain = true;
        for &lit in lits {
            let signal = &self.problem.signals[lit.node() as usize];
            match signal.initial {
                Some(value) if value == lit.inverted() => return Ok(false),
                Some(_) => {}
                None => certain &= signal.is_latch,
            }
        }
        if certain {
            return Ok(true);
        }
        let assumptions: Vec<Lit> = lits.iter().map(|&l| now(&self.problem, l)).collect();
        self.ask_first(&assumptions)
    }

    pub(super) fn ask_first(&mut self, assumptions: &[Lit]) -> Result<bool, Stop> {
        let latches: Vec<Lit> = assumptions.to_vec();
        self.ask(Whom::First, &latches, None)
    }

    /// `core`, with as much of `cube`, which no first state lies in, as it takes to keep the first states out.
    fn apart_from_first(&mut self, core: Vec<Lit>, cube: &Cube) -> Result<Cube, Stop> {
        if !self.meets_first(&core)? {
            return Ok(Cube::new(core));
        }
        let signals = &self.problem.signals;
        let clash = cube.lits().iter().find(|l| signals[l.node() as usize].initial == Some(l.inverted()));
        let mut lits = core;
        if let Some(&clash) = clash {
            lits.push(clash);
        } else {
            let assumptions: Vec<Lit> = cube.lits().iter().map(|&l| now(&self.problem, l)).collect();
            if self.ask_first(&assumptions)? {
                return Ok(cube.clone());
            }
            let solver = &self.first.solver;
            let failed: Vec<bool> = assumptions.iter().map(|&a| solver.failed(a)).collect();
            lits.extend(cube.lits().iter().zip(failed).filter(|(_, f)| *f).map(|(&l, _)| l));
        }
        Ok(Cube::new(lits))
    }
}
