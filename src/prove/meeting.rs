//! Which rows of a table some values satisfy together: decided by a SAT solver over the cells' types, whatever the block
//! does. Rows that exclude each other need less memory in the game.

use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use super::product::{Parts, holds};
use crate::logic::blast::Blaster;
use crate::logic::cone;
use crate::logic::sat::cadi::Cadical;
use crate::logic::sat::encode::Encoder;
use crate::logic::sat::{Solver, Stop};
use crate::logic::term::{Pool, Term};
use crate::table::automaton::Site;
use crate::table::bind::Leaf;

/// Answers for pairs of rows, kept.
pub(super) struct Meeting<'a> {
    parts: &'a Parts<'a>,
    pool: Pool,
    /// A free variable for each leaf at each moment of the cycle.
    leaves: BTreeMap<(Leaf, bool), Term>,
    rows: BTreeMap<Site, Option<Term>>,
    known: BTreeMap<(Site, Site), bool>,
}

impl<'a> Meeting<'a> {
    pub(super) fn new(parts: &'a Parts<'a>) -> Self {
        Self { parts, pool: Pool::default(), leaves: BTreeMap::new(), rows: BTreeMap::new(), known: BTreeMap::new() }
    }

    /// Whether some values satisfy both rows; says so too where it cannot be decided in a second.
    pub(super) fn compatible(&mut self, one: Site, other: Site) -> bool {
        let key = (one.min(other), one.max(other));
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        let answer = match (self.row(one), self.row(other)) {
            (Some(a), Some(b)) => {
                let both = self.pool.and(a, b);
                self.pool.value(both).map_or_else(|| satisfiable(&self.pool, both), |value| value == 1)
            }
            _ => true,
        };
        self.known.insert(key, answer);
        answer
    }

    /// All constraints of a row; `None` where one has no term.
    fn row(&mut self, site: Site) -> Option<Term> {
        if let Some(known) = self.rows.get(&site) {
            return *known;
        }
        let row = self.parts.automaton.leaves[site.leaf].row;
        let mut all = Some(self.pool.truth(true));
        for assumptions in [true, false] {
            for constraint in self.parts.table.constraints(row, assumptions, site.first) {
                let mut needed = Vec::new();
                constraint.leaves(&mut |leaf| needed.push(*leaf));
                for leaf in needed {
                    self.leaf(leaf, assumptions);
                }
                let leaves = &self.leaves;
                let term = holds(&mut self.pool, constraint, &mut |leaf| {
                    leaves[&(*leaf, begins(self.parts, *leaf, assumptions))]
                });
                all = match (all, term) {
                    (Some(all), Ok(term)) => Some(self.pool.and(all, term)),
                    _ => None,
                };
            }
        }
        self.rows.insert(site, all);
        all
    }

    fn leaf(&mut self, leaf: Leaf, assumptions: bool) {
        let scalar = match leaf {
            Leaf::Variable { index, .. } => self.parts.table.variables[index].scalar,
            Leaf::Global(index) => self.parts.table.globals[index].scalar,
        };
        let key = (leaf, begins(self.parts, leaf, assumptions));
        let pool = &mut self.pool;
        self.leaves.entry(key).or_insert_with(|| pool.variable(scalar.width(), "leaf"));
    }
}

/// Whether the leaf is an in-out as the environment set it, which may differ from what the block made of it.
fn begins(parts: &Parts<'_>, leaf: Leaf, assumptions: bool) -> bool {
    let Leaf::Variable { index, ago: 0 } = leaf else { return false };
    assumptions && parts.table.variables[index].role == crate::table::bind::Role::InOut
}

fn satisfiable(pool: &Pool, term: Term) -> bool {
    let mut blaster = Blaster::new(pool);
    for variable in cone::variables(pool, term) {
        blaster.fresh(variable);
    }
    blaster.blast([term]);
    let lit = blaster.word(term)[0];
    let aig = blaster.finish();
    let mut solver = Cadical::default();
    solver.set_stop(Stop::at(Instant::now() + Duration::from_secs(1)));
    let lit = Encoder::default().encode(&aig, lit, &mut solver);
    solver.add_clause(&[lit]);
    solver.solve(&[]) != Some(false)
}
