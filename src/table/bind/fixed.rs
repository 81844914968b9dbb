//! A table in a fixed-point reading: as its block is read, so are its cells.

use std::sync::Arc;

use super::{BoundCell, BoundTable, Term};
use crate::semantics::fixed::Reading;

impl BoundTable {
    /// Reads the table so.
    pub fn read_in_fixed_point(&mut self, reading: Reading) {
        let read = |term: &mut Term| reading.read(term, &mut |_| {});
        for variable in &mut self.variables {
            variable.initial = reading.value(variable.scalar, variable.initial);
            variable.scalar = reading.scalar(variable.scalar);
        }
        for global in &mut self.globals {
            global.scalar = reading.scalar(global.scalar);
            global.constraint.iter_mut().for_each(read);
        }
        self.subjects.iter_mut().flatten().for_each(read);
        // A cell that rows repeat is shared; each gets one of its own.
        for cell in self.rows.iter_mut().flat_map(|row| &mut row.cells).flatten() {
            let BoundCell { mut first, mut later, place } = BoundCell::clone(cell);
            read(&mut first);
            later.iter_mut().for_each(&read);
            *cell = Arc::new(BoundCell { first, later, place });
        }
    }
}
