//! Concrete test tables from a generalized one: a way through the automaton, and values that satisfy every cell on it, solved.
//!
//! A *plan* is a way: which rows, how long each. The solver gives the values; what it is free to choose is pushed to the
//! lowest, the highest or a drawn value, bit by bit from the top. The values of a row change at most behind its first cycle,
//! where that satisfies the cells; else they may change in every cycle. A plan that nothing satisfies names the cells that
//! contradict.

mod example;
mod plan;
mod solve;
pub mod tcunit;

pub use example::example;

use super::automaton::{Automaton, NoAutomaton};
use super::bind::BoundTable;
use super::model::Table;
use plan::{Plan, Planner};

/// How instances are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Strategy {
    /// Every row, and both bounds of every duration, are in one of them.
    Covering,
    /// The same ways, each with all inputs at their lowest and at their highest.
    Boundary,
    /// Each two of the durations and inputs are together at each combination of their lowest and highest.
    Pairwise,
    /// Ways and values are drawn.
    Random,
}

/// What is wanted.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// How they are chosen.
    pub strategy: Strategy,
    /// How many there are at most.
    pub count: usize,
    /// From what is drawn.
    pub seed: u64,
    /// How many cycles a row without end lasts.
    pub forever: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self { strategy: Strategy::Covering, count: 100, seed: 1, forever: 5 }
    }
}

/// A concrete run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Instance {
    /// Its name.
    pub name: String,
    /// Its stretches of equal values, from the first cycle on.
    pub steps: Vec<Step>,
    /// The values of the global variables.
    pub globals: Vec<u64>,
}

/// Some cycles with the same values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// The row, by its index among [`Table::rows`].
    pub row: usize,
    /// How many cycles.
    pub cycles: u64,
    /// For each variable of the table its value; `None` where nothing in this run asks for it.
    pub values: Vec<Option<u64>>,
}

/// Why there are no instances.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoInstance {
    /// The table has errors, or uses what cannot be decided.
    Unusable(String),
    /// Nothing satisfies the table: the cells that contradict, by row and column.
    Contradiction(Vec<(usize, usize)>),
    /// It was not decided with the effort that is allowed.
    Undecided,
}

/// The instances of a table.
///
/// # Errors
/// Why there are none.
pub fn instances(table: &Table, bound: &BoundTable, options: &Options) -> Result<Vec<Instance>, NoInstance> {
    let automaton = unrolled(table, bound)?;
    let planner = Planner { automaton: &automaton, forever: options.forever };
    let mut out: Vec<Instance> = Vec::new();
    let mut failure = NoInstance::Unusable("no way leads through the table".to_owned());
    for (plan, goals) in wanted(&planner, options, bound) {
        if out.len() >= options.count {
            break;
        }
        match solve::solve(&automaton, bound, &plan, &goals, solve::Limits::default()) {
            Ok((steps, globals)) => {
                let known = out.iter().any(|other| other.steps == steps && other.globals == globals);
                let name = format!("{} {}", table.name, out.len() + 1);
                if !known {
                    out.push(Instance { name, steps, globals });
                }
            }
            Err(error) => failure = error,
        }
    }
    if out.is_empty() { Err(failure) } else { Ok(out) }
}

fn unrolled(table: &Table, bound: &BoundTable) -> Result<Automaton, NoInstance> {
    if bound.errors > 0 {
        return Err(NoInstance::Unusable("the table has errors".to_owned()));
    }
    if let Some(unsupported) = bound.unsupported.first() {
        return Err(NoInstance::Unusable(format!("{} is not modelled", unsupported.what)));
    }
    Automaton::build(table).map_err(|error| NoInstance::Unusable(reason(error).to_owned()))
}

const fn reason(error: NoAutomaton) -> &'static str {
    match error {
        NoAutomaton::Errors => "the table has errors",
        NoAutomaton::NoCycleTime => "the length of a cycle is not known",
        NoAutomaton::Unsupported => "the table compares runs, or jumps into others",
        NoAutomaton::TooLarge => "its rows are left in too many ways",
    }
}

/// Where a value that may be chosen is pushed to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Goal {
    /// To zero, or the smallest value above it.
    Near,
    Low,
    High,
    /// Drawn from a seed.
    Drawn(u64),
}

/// What is pushed where: by the number of the stretch and of the variable; global variables come behind the variables.
enum Goals {
    All(Goal),
    /// By a bit of the parameter's number, or its complement; durations are the first parameters.
    Bit {
        bit: u32,
        complement: bool,
        durations: usize,
    },
}

impl Goals {
    fn of(&self, stretch: usize, variable: usize, variables: usize) -> Goal {
        match self {
            Self::All(Goal::Drawn(seed)) => Goal::Drawn(mixed(seed ^ mixed((stretch * variables + variable) as u64))),
            Self::All(goal) => *goal,
            Self::Bit { bit, complement, durations } => {
                let parameter = durations + stretch * variables + variable;
                if (parameter >> bit & 1 == 1) != *complement { Goal::High } else { Goal::Low }
            }
        }
    }
}

/// A number drawn from another one: the finalizer of SplitMix64 (Steele et al., *Fast Splittable Pseudorandom Number
/// Generators*, 2014).
const fn mixed(seed: u64) -> u64 {
    let a = seed.wrapping_add(0x9E37_79B9_7F4A_7C15);
    let b = (a ^ (a >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let c = (b ^ (b >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    c ^ (c >> 31)
}

fn wanted(planner: &Planner<'_>, options: &Options, bound: &BoundTable) -> Vec<(Plan, Goals)> {
    let all = |goal: Goal| move |plan: Plan| (plan, Goals::All(goal));
    match options.strategy {
        Strategy::Covering => planner.covering().into_iter().map(all(Goal::Low)).collect(),
        Strategy::Boundary => {
            let plans = planner.covering();
            plans.into_iter().flat_map(|plan| [all(Goal::Low)(plan.clone()), all(Goal::High)(plan)]).collect()
        }
        Strategy::Pairwise => pairwise(planner, bound),
        Strategy::Random => (0..options.count as u64)
            .filter_map(|number| {
                let seed = mixed(options.seed ^ mixed(number));
                Some((planner.drawn(seed)?, Goals::All(Goal::Drawn(seed))))
            })
            .collect(),
    }
}

/// Parameters with two levels each: every two of them differ in a bit of their numbers, so that the patterns of each bit and
/// their complements, with all low and all high, hold each two at each combination.
fn pairwise(planner: &Planner<'_>, bound: &BoundTable) -> Vec<(Plan, Goals)> {
    let mut out = Vec::new();
    for plan in planner.ways() {
        let durations = plan.visits.len();
        let stretches = durations * 2;
        let parameters = durations + stretches * (bound.variables.len() + bound.globals.len());
        let bits = usize::BITS - parameters.leading_zeros();
        for (long, goal) in [(false, Goal::Low), (true, Goal::High)] {
            out.push((planner.stretched(&plan, &|_| long), Goals::All(goal)));
        }
        for bit in 0..bits {
            for complement in [false, true] {
                let long = |visit: usize| (visit >> bit & 1 == 1) != complement;
                out.push((planner.stretched(&plan, &long), Goals::Bit { bit, complement, durations }));
            }
        }
    }
    out
}

/// The variable that a column is bound to, if it is a plain one, as an index into [`BoundTable::variables`].
#[must_use]
pub fn variable(of: &Table, bound: &BoundTable, column: usize) -> Option<usize> {
    solve::variable(of, bound, column)
}

/// The instance as a table of its own.
///
/// # Errors
/// Where its text does not read again, which would be a fault of this program.
pub fn table(of: &Table, bound: &BoundTable, instance: &Instance, unit: &str) -> Result<Table, String> {
    let text = solve::text(of, bound, instance, unit);
    let piece = super::Piece::verbatim(of.place.file, &text, 0);
    let read = super::read::pipe::read(&piece, &super::read::Options::default());
    let error = read.findings.iter().find(|finding| finding.severity == crate::diagnostic::Severity::Error);
    match (error, read.tables.into_iter().next()) {
        (None, Some(table)) => Ok(table),
        (Some(error), _) => Err(error.message.clone()),
        (None, None) => Err("the instance has no rows".to_owned()),
    }
}
