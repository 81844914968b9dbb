//! The values of a plan.

use std::fmt::Write;

use super::plan::{Plan, Visit, admits};
use super::{Goal, Goals, Instance, NoInstance, Step};
use crate::logic::term::Term;
use crate::semantics::scalar::Scalar;
use crate::table::automaton::{Automaton, Site, Target};
use crate::table::bind::BoundTable;
use crate::table::decide::{Effort, Moment, Puzzle, Session, literal};
use crate::table::model::{Subject, Table};
use crate::table::write::pipe::header_cell;

/// How long one plan is thought about.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    pub(super) effort: Effort,
    /// A plan of more cycles is not unrolled cycle by cycle.
    pub(super) cycles: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { effort: Effort { conflicts: 20_000, misses: 3, work: 2_000_000_000 }, cycles: 2_000 }
    }
}

/// Some cycles without a change.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    row: usize,
    start: i64,
    cycles: u64,
}

/// What must hold: the term, and the cell that it comes from, if it is one.
type Part = (Term, Option<(usize, usize)>);

/// The values of a plan: first where the values of a row change at most behind its first cycle, then in every cycle.
pub(super) fn solve(
    automaton: &Automaton,
    bound: &BoundTable,
    plan: &Plan,
    goals: &Goals,
    limits: Limits,
) -> Result<(Vec<Step>, Vec<u64>), NoInstance> {
    let cycles = plan.visits.iter().map(|visit| visit.cycles).fold(0, u64::saturating_add);
    match attempt(automaton, bound, plan, goals, (false, limits.effort)) {
        Err(NoInstance::Contradiction(_)) if cycles <= limits.cycles => {
            attempt(automaton, bound, plan, goals, (true, limits.effort))
        }
        other => other,
    }
}

fn stretches(automaton: &Automaton, plan: &Plan, each: bool) -> Vec<Stretch> {
    let (mut out, mut start) = (Vec::new(), 0_i64);
    for visit in &plan.visits {
        let row = automaton.leaves[visit.leaf].row;
        let lengths: Vec<u64> = match visit.cycles {
            0 => Vec::new(),
            1 => vec![1],
            cycles if each => vec![1; usize::try_from(cycles).unwrap_or(0)],
            cycles => vec![1, cycles - 1],
        };
        for cycles in lengths {
            out.push(Stretch { row, start, cycles });
            start += i64::try_from(cycles).unwrap_or(i64::MAX - start);
        }
    }
    out
}

fn attempt(
    automaton: &Automaton,
    bound: &BoundTable,
    plan: &Plan,
    goals: &Goals,
    (each, effort): (bool, Effort),
) -> Result<(Vec<Step>, Vec<u64>), NoInstance> {
    let stretches = stretches(automaton, plan, each);
    let mut puzzle = Puzzle::new(bound, true);
    puzzle.stretches = stretches.iter().map(|stretch| stretch.start).collect();
    let mut parts: Vec<Part> = Vec::new();
    let mut start = 0_i64;
    for visit in &plan.visits {
        constrain(automaton, &mut puzzle, visit, start, &mut parts)?;
        start += i64::try_from(visit.cycles).unwrap_or(0);
    }
    let terms: Vec<Term> = parts.iter().map(|(term, _)| *term).collect();
    let mut session = puzzle.session(&terms, effort);
    match session.ask(&terms, &[]) {
        Some(true) => {}
        Some(false) => {
            let mut cells: Vec<(usize, usize)> =
                parts.iter().filter(|(term, _)| session.needed(*term)).filter_map(|(_, cell)| *cell).collect();
            cells.sort_unstable();
            cells.dedup();
            return Err(NoInstance::Contradiction(cells));
        }
        None => return Err(NoInstance::Undecided),
    }
    if !choose(&puzzle, &mut session, &terms, &stretches, goals) {
        return Err(NoInstance::Undecided);
    }
    Ok(read(&puzzle, &session, &stretches))
}

/// What a visit asks for, in the cycles in which it may ask for different things.
fn constrain(
    automaton: &Automaton,
    puzzle: &mut Puzzle<'_>,
    visit: &Visit,
    start: i64,
    parts: &mut Vec<Part>,
) -> Result<(), NoInstance> {
    let bound = puzzle.bound;
    let row = automaton.leaves[visit.leaf].row;
    let depth = bound.depths().into_iter().max().unwrap_or(0);
    let several = puzzle.stretches.iter().filter(|s| **s >= start && **s < start + visit.cycles as i64).count() as u64;
    // Behind the oldest value that is asked for, all cycles of a stretch ask for the same; the last one is looked at for
    // the progress flag.
    let looked = visit.cycles.min((u64::from(depth) + 2).max(several));
    for at in (0..looked).chain((looked < visit.cycles).then(|| visit.cycles - 1)) {
        let cycle = start + i64::try_from(at).unwrap_or(0);
        for (column, cell) in bound.rows[row].cells.iter().enumerate() {
            let Some(cell) = cell else { continue };
            let constraint = cell.constraint(at == 0);
            let term = puzzle.holds(constraint, cycle, bound.assumptions[column]);
            let term = term.ok_or_else(|| NoInstance::Unusable("a cell has no meaning for the solver".to_owned()))?;
            parts.push((term, Some((row, column))));
        }
        let rivals = if at == 0 { visit.forbidden(automaton) } else { staying(automaton, visit, at) };
        for rival in rivals {
            let inputs = inputs(automaton, puzzle, Site { leaf: rival, first: true }, cycle)?;
            let not = puzzle.pool.not(inputs);
            parts.push((not, None));
        }
    }
    Ok(())
}

/// The rows whose inputs must not fit where the row goes on behind `count` cycles.
fn staying(automaton: &Automaton, visit: &Visit, count: u64) -> Vec<usize> {
    let stay = automaton.edges[visit.leaf].iter().filter(|edge| matches!(edge.target, Target::Stay(_)));
    let rivals = stay.flat_map(|edge| &edge.rivals);
    let holds = |rival: &&crate::table::automaton::Rival| {
        rival.conditions.iter().all(|c| admits(automaton, c, visit.leaf, count, &visit.loops))
    };
    rivals.filter(holds).map(|rival| rival.leaf).collect()
}

fn inputs(automaton: &Automaton, puzzle: &mut Puzzle<'_>, site: Site, cycle: i64) -> Result<Term, NoInstance> {
    let bound = puzzle.bound;
    let mut all = puzzle.pool.truth(true);
    for constraint in bound.constraints(automaton.leaves[site.leaf].row, true, site.first) {
        let term = puzzle.holds(constraint, cycle, true);
        let term = term.ok_or_else(|| NoInstance::Unusable("a cell has no meaning for the solver".to_owned()))?;
        all = puzzle.pool.and(all, term);
    }
    Ok(all)
}

/// Pushes every value that may be chosen to its goal, bit by bit from the top. The last model, in which all of them are chosen,
/// is there if this says so.
fn choose(puzzle: &Puzzle<'_>, session: &mut Session, terms: &[Term], stretches: &[Stretch], goals: &Goals) -> bool {
    let bound = puzzle.bound;
    let variables = bound.variables.len() + bound.globals.len();
    let mut fixed: Vec<i32> = Vec::new();
    let globals =
        (0..bound.globals.len()).map(|g| (Moment::Global(g), 0, bound.variables.len() + g, bound.globals[g].scalar));
    let mut all: Vec<(Moment, usize, usize, Scalar)> = globals.collect();
    for (number, stretch) in stretches.iter().enumerate() {
        for (index, variable) in bound.variables.iter().enumerate() {
            for begins in [true, false] {
                let moment = Moment::Variable { index, cycle: stretch.start, begins };
                all.push((moment, number, index, variable.scalar));
            }
        }
    }
    let mut model = session.model();
    for (moment, stretch, variable, scalar) in all {
        let Some(term) = puzzle.terms.get(&moment).copied() else { continue };
        let goal = goals.of(stretch, variable, variables);
        let bits = session.bits(term).to_vec();
        for (at, bit) in bits.iter().enumerate().rev() {
            let sign = at + 1 == bits.len() && (scalar.is_signed() || matches!(scalar, Scalar::Real(_)));
            let wanted = match goal {
                Goal::Near => false,
                Goal::Low => sign || matches!(scalar, Scalar::Real(_)),
                Goal::High => !sign,
                Goal::Drawn(seed) => seed >> at & 1 == 1,
            };
            let wanted = if wanted { *bit } else { -*bit };
            fixed.push(wanted);
            // A model that has the bit already needs no other.
            if !model.contains(&wanted) {
                match session.ask(terms, &fixed) {
                    Some(true) => model = session.model(),
                    _ => {
                        fixed.pop();
                        fixed.push(-wanted);
                    }
                }
            }
        }
    }
    session.ask(terms, &fixed) == Some(true)
}

fn read(puzzle: &Puzzle<'_>, session: &Session, stretches: &[Stretch]) -> (Vec<Step>, Vec<u64>) {
    let bound = puzzle.bound;
    let mut out: Vec<Step> = Vec::new();
    for stretch in stretches {
        let value = |index: usize| {
            let at = |begins| puzzle.terms.get(&Moment::Variable { index, cycle: stretch.start, begins });
            at(true).or_else(|| at(false)).map(|term| session.value(*term))
        };
        let values: Vec<Option<u64>> = (0..bound.variables.len()).map(value).collect();
        match out.last_mut() {
            Some(last) if last.row == stretch.row && last.values == values => last.cycles += stretch.cycles,
            _ => out.push(Step { row: stretch.row, cycles: stretch.cycles, values }),
        }
    }
    let global = |index: usize| puzzle.terms.get(&Moment::Global(index)).map_or(0, |term| session.value(*term));
    (out, (0..bound.globals.len()).map(global).collect())
}

/// The instance as a pipe table.
pub(super) fn text(of: &Table, bound: &BoundTable, instance: &Instance, unit: &str) -> String {
    let cycle = of.options.cycle.map_or_else(String::new, |cycle| {
        format!(", cycle {}", crate::table::cell::time_text(cycle.nanos).replace(' ', ""))
    });
    let mut out = format!("@gtt {} (for {unit}{cycle}, concrete)\n| # |", instance.name);
    let columns: Vec<(usize, usize)> =
        (0..of.columns.len()).filter_map(|at| Some((at, variable(of, bound, at)?))).collect();
    for (column, _) in &columns {
        let _ = write!(out, " {} |", header_cell(&of.columns[*column]));
    }
    let _ = writeln!(out, " dur | remark |\n|{}", "---|".repeat(columns.len() + 3));
    let rows = of.rows();
    let globals: Vec<String> = bound
        .globals
        .iter()
        .zip(&instance.globals)
        .map(|(global, bits)| format!("{} = {}", global.name, literal(global.scalar, &global.labels, *bits)))
        .collect();
    for (number, step) in instance.steps.iter().enumerate() {
        let _ = write!(out, "| {} |", number + 1);
        for (_, index) in &columns {
            let variable = &bound.variables[*index];
            let value = step.values[*index].map(|bits| literal(variable.scalar, &variable.labels, bits));
            let _ = write!(out, " {} |", value.unwrap_or_else(|| "-".to_owned()));
        }
        let mut remark = format!("row {}", rows[step.row].id);
        if number == 0 && !globals.is_empty() {
            remark = format!("{remark}; {}", globals.join(", "));
        }
        let _ = writeln!(out, " {} | {} |", step.cycles, remark.replace('|', "\\|"));
    }
    out
}

/// The variable that a column is bound to, if it is a plain one.
pub(super) fn variable(of: &Table, bound: &BoundTable, column: usize) -> Option<usize> {
    use crate::semantics::expr::ExprKind;
    let Subject::Variable(_) = of.columns[column].subject else { return None };
    match &bound.subjects[column].first()?.kind {
        ExprKind::Read(crate::table::bind::Leaf::Variable { index, ago: 0 }) => Some(*index),
        _ => None,
    }
}
