//! One instance, for a reader: it goes through as many rows as one run can, lasts long enough in each to be seen, and keeps its values
//! near zero.

use super::plan::Plan;
use super::solve::{self, Limits};
use super::{Goal, Goals, Instance, NoInstance, Planner, unrolled};
use crate::table::bind::BoundTable;
use crate::table::decide::Effort;
use crate::table::model::Table;

/// Tables with more rows have no example.
const MOST_ROWS: usize = 100;

/// How many cycles a row lasts where its duration leaves it open.
const SEEN: u64 = 3;

/// So many ways are tried.
const MOST_TRIES: usize = 6;

/// The example of a table.
///
/// # Errors
/// Why there is none.
pub fn example(table: &Table, bound: &BoundTable) -> Result<Instance, NoInstance> {
    if table.rows().len() > MOST_ROWS {
        return Err(NoInstance::Unusable(format!("it has more than {MOST_ROWS} rows")));
    }
    let automaton = unrolled(table, bound)?;
    let planner = Planner { automaton: &automaton, forever: SEEN };
    let limits = Limits { effort: Effort { conflicts: 2_000, misses: 1, work: 4_000_000 }, cycles: 60 };
    let mut failure = NoInstance::Unusable("no way leads through the table".to_owned());
    for plan in plans(&planner) {
        match solve::solve(&automaton, bound, &plan, &Goals::All(Goal::Near), limits) {
            Ok((steps, globals)) => return Ok(Instance { name: table.name.clone(), steps, globals }),
            Err(error) => failure = error,
        }
    }
    Err(failure)
}

/// The tour through the rows first, then shorter ways; each with rows that last a little and with rows as short as they may be.
fn plans(planner: &Planner<'_>) -> impl Iterator<Item = Plan> {
    let ways = std::iter::once(planner.tour()).chain(planner.ways()).filter(|plan| !plan.visits.is_empty());
    let both = ways.flat_map(|plan| [planner.lasting(&plan, SEEN), plan]);
    both.take(MOST_TRIES)
}
