//! Which assertions say anything: a cell that every value satisfies leaves its column free.

use super::{Effort, Puzzle};
use crate::table::bind::{BoundCell, BoundTable};

/// The most that is spent on a cell; one that takes more counts as saying something.
const EFFORT: Effort = Effort { conflicts: 20_000, misses: 1, work: 4_000_000 };

/// For each row, the columns of assertions whose cells any values of the variables satisfy, in a first cycle and in later ones.
#[must_use]
pub fn free(bound: &BoundTable) -> Vec<Vec<usize>> {
    let columns = || bound.assumptions.iter().enumerate().filter(|(_, assumption)| !**assumption);
    let row = |row: &crate::table::bind::BoundRow| {
        let free = columns().filter(|(column, _)| match row.cells.get(*column) {
            Some(Some(cell)) => admits_all(bound, cell),
            _ => true,
        });
        free.map(|(column, _)| column).collect()
    };
    bound.rows.iter().map(row).collect()
}

fn admits_all(bound: &BoundTable, cell: &BoundCell) -> bool {
    cell.distinct().all(|constraint| {
        let mut puzzle = Puzzle::new(bound, false);
        let Some(holds) = puzzle.holds(constraint, 0, false) else { return false };
        let fails = puzzle.pool.not(holds);
        puzzle.session(&[fails], EFFORT).ask(&[fails], &[]) == Some(false)
    })
}
