//! The lints that need to know which values there are: cells that contradict, rows and tables that no inputs reach, rows that
//! the inputs do not tell apart. What a solver cannot decide with the allowed effort is not reported.

use std::collections::BTreeMap;

use super::{Effort, Moment, Puzzle, Session, literal};
use crate::diagnostic::Finding;
use crate::logic::term::Term;
use crate::table::automaton::meet::{contradict, gives_way};
use crate::table::automaton::{Automaton, Edge, Site, Target};
use crate::table::bind::{BoundTable, Role};
use crate::table::codes;
use crate::table::model::{Row, Table};

/// No table is thought about for longer.
const EFFORT: Effort = Effort { conflicts: 2_000, misses: 2, work: 4_000_000 };

/// So many overlaps are told of one table.
const MOST_OVERLAPS: usize = 5;

/// All lints of a bound table without errors.
#[must_use]
pub fn lint(table: &Table, bound: &BoundTable) -> Vec<Finding> {
    let Ok(automaton) = Automaton::build(table) else { return Vec::new() };
    if bound.errors > 0 || !bound.unsupported.is_empty() {
        return Vec::new();
    }
    let mut puzzle = Puzzle::new(bound, false);
    let Some(cells) = cells(&mut puzzle) else { return Vec::new() };
    let parts: Vec<Term> = cells.iter().flatten().flatten().map(|(_, term)| *term).collect();
    let session = puzzle.session(&parts, EFFORT);
    let mut linter = Linter { table, rows: table.rows(), bound, automaton, puzzle, session, cells, out: Vec::new() };
    linter.contradictions();
    linter.reachability();
    linter.overlaps();
    linter.out
}

/// For each row, in its first cycle and in later ones, its cells by column.
type Cells = Vec<[Vec<(usize, Term)>; 2]>;

fn cells(puzzle: &mut Puzzle<'_>) -> Option<Cells> {
    let bound = puzzle.bound;
    let mut known: BTreeMap<(*const crate::table::bind::BoundCell, bool), Term> = BTreeMap::new();
    let mut out = Vec::new();
    for row in &bound.rows {
        let mut both = [Vec::new(), Vec::new()];
        for (column, cell) in row.cells.iter().enumerate() {
            let Some(cell) = cell else { continue };
            for first in [true, false] {
                let constraint = cell.constraint(first);
                let key = (std::sync::Arc::as_ptr(cell), first);
                let term = match known.get(&key) {
                    Some(term) => *term,
                    None => puzzle.holds(constraint, 0, bound.assumptions[column])?,
                };
                known.insert(key, term);
                both[usize::from(!first)].push((column, term));
            }
        }
        out.push(both);
    }
    Some(out)
}

struct Linter<'t> {
    table: &'t Table,
    rows: Vec<&'t Row>,
    bound: &'t BoundTable,
    automaton: Automaton,
    puzzle: Puzzle<'t>,
    session: Session,
    cells: Cells,
    out: Vec<Finding>,
}

impl Linter<'_> {
    fn row(&self, site: Site) -> usize {
        self.automaton.leaves[site.leaf].row
    }

    /// The cells of a row, those of the inputs alone or all.
    fn parts(&self, site: Site, outputs: bool) -> Vec<(usize, Term)> {
        let cells = &self.cells[self.row(site)][usize::from(!site.first)];
        cells.iter().filter(|(column, _)| outputs || self.bound.assumptions[*column]).copied().collect()
    }

    /// Whether no values satisfy the inputs.
    fn impossible(&mut self, site: Site) -> bool {
        let parts: Vec<Term> = self.parts(site, false).into_iter().map(|(_, term)| term).collect();
        self.session.ask(&parts, &[]) == Some(false)
    }

    /// Cells that no values satisfy, alone or together.
    fn contradictions(&mut self) {
        let mut told = std::collections::BTreeSet::new();
        for leaf in 0..self.automaton.leaves.len() {
            let site = Site { leaf, first: true };
            for outputs in [false, true] {
                let parts = self.parts(site, outputs);
                let terms: Vec<Term> = parts.iter().map(|(_, term)| *term).collect();
                if self.session.ask(&terms, &[]) != Some(false) {
                    continue;
                }
                let mut needed: Vec<usize> =
                    parts.iter().filter(|(_, term)| self.session.needed(*term)).map(|(column, _)| *column).collect();
                // One cell that contradicts itself says more than several.
                if let Some((column, _)) = parts.iter().find(|(_, term)| self.session.ask(&[*term], &[]) == Some(false))
                {
                    needed = vec![*column];
                }
                let row = self.row(site);
                let places: Vec<_> =
                    needed.iter().filter_map(|c| Some(self.bound.rows[row].cells[*c].as_ref()?.place)).collect();
                if told.insert(places.clone()) {
                    self.contradiction(row, &needed, &places);
                }
                break;
            }
        }
    }

    fn contradiction(&mut self, row: usize, columns: &[usize], places: &[crate::text::Place]) {
        let effective = self.table.effective();
        let text = |column: &usize| {
            let cell = effective[row][*column].map_or("", |cell| cell.text.as_str());
            format!("`{}: {cell}`", self.table.columns[*column].name)
        };
        let listed: Vec<String> = columns.iter().map(text).collect();
        let message = match listed.as_slice() {
            [] => format!("no values satisfy row `{}`", self.rows[row].id),
            [one] => format!("no value satisfies {one}"),
            more => format!("no values satisfy {} in row `{}`", more.join(" and "), self.rows[row].id),
        };
        let place = places.first().copied().unwrap_or(self.rows[row].place);
        let mut finding = Finding::new(&codes::TABLE_CONTRADICTION, place, message);
        for other in places.iter().skip(1) {
            finding = finding.label(*other, "contradicts this");
        }
        self.out.push(finding);
    }

    /// Rows that no inputs lead to.
    fn reachability(&mut self) {
        let entries = self.automaton.entries.clone();
        let mut reached = vec![false; self.automaton.leaves.len()];
        let mut work: Vec<usize> = Vec::new();
        for edge in &entries {
            self.follow(edge, &mut reached, &mut work);
        }
        if work.is_empty() && !self.automaton.may_be_empty {
            let message =
                format!("no inputs satisfy the beginning of `{}`, so no run is covered by it", self.table.name);
            self.out.push(Finding::new(&codes::TABLE_NO_INPUT, self.table.name_place, message));
            return;
        }
        while let Some(leaf) = work.pop() {
            for edge in self.automaton.edges[leaf].clone() {
                self.follow(&edge, &mut reached, &mut work);
            }
        }
        for leaf in (0..reached.len()).filter(|leaf| !reached[*leaf]) {
            if self.impossible(Site { leaf, first: true }) {
                continue;
            }
            let row = self.rows[self.automaton.leaves[leaf].row];
            let message = format!("row `{}` is never reached: no inputs lead to it", row.id);
            self.out.push(Finding::new(&codes::TABLE_NEVER_REACHED, row.place, message));
        }
    }

    fn follow(&mut self, edge: &Edge, reached: &mut [bool], work: &mut Vec<usize>) {
        let Target::Enter(leaf) = edge.target else { return };
        if !reached[leaf] && !self.impossible(Site { leaf, first: true }) {
            reached[leaf] = true;
            work.push(leaf);
        }
    }

    /// Rows that may follow one row, and that the inputs do not tell apart.
    fn overlaps(&mut self) {
        let mut told = std::collections::BTreeSet::new();
        let all: Vec<Vec<Edge>> =
            std::iter::once(self.automaton.entries.clone()).chain(self.automaton.edges.iter().cloned()).collect();
        for edges in all {
            for (at, one) in edges.iter().enumerate() {
                for other in &edges[..at] {
                    let (Some(a), Some(b)) = (other.site(), one.site()) else { continue };
                    let never = contradict(one, other) || gives_way(one, other) || gives_way(other, one);
                    if never || a.leaf == b.leaf || told.contains(&(a.leaf, b.leaf)) {
                        continue;
                    }
                    if told.len() >= MOST_OVERLAPS {
                        return;
                    }
                    if self.overlap(a, b) {
                        told.insert((a.leaf, b.leaf));
                    }
                }
            }
        }
    }

    fn overlap(&mut self, a: Site, b: Site) -> bool {
        let parts: Vec<Term> =
            self.parts(a, false).into_iter().chain(self.parts(b, false)).map(|(_, term)| term).collect();
        if self.session.ask(&parts, &[]) != Some(true) {
            return false;
        }
        let example: Vec<String> = self.inputs();
        let (first, second) = (self.rows[self.row(a)], self.rows[self.row(b)]);
        let such = if example.is_empty() { String::new() } else { format!(", as {}", example.join(", ")) };
        let message = format!("rows `{}` and `{}` admit the same inputs{such}", first.id, second.id);
        let finding = Finding::new(&codes::TABLE_OVERLAP, second.place, message);
        self.out.push(finding.label(first.place, "both may be the current row then"));
        true
    }

    /// The inputs of the last model that the table constrains.
    fn inputs(&self) -> Vec<String> {
        let mut out = Vec::new();
        for (index, variable) in self.bound.variables.iter().enumerate() {
            let begins = variable.role == Role::InOut;
            let moment = Moment::Variable { index, cycle: 0, begins };
            if !matches!(variable.role, Role::Input | Role::InOut) {
                continue;
            }
            if let Some(term) = self.puzzle.terms.get(&moment) {
                let value = literal(variable.scalar, &variable.labels, self.session.value(*term));
                out.push(format!("`{} = {value}`", variable.path));
            }
        }
        out
    }
}
