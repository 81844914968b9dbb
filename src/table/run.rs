//! A table played on a concrete run: cells over values, the automaton, and who has won.

use super::automaton::game::{Game, Judge, Standing};
use super::automaton::{Automaton, NoAutomaton, Site};
use super::cell::ast::{ChunkKind, ExprKind, Path, Predicate, Step};
use super::cell::print;
use super::eval::{Evaluator, Scope, Value, is_standard};
use super::model::{Cell, Table};

/// The values of one cycle, by the names that the table's columns are bound to.
pub type Cycle = Vec<(String, Value)>;

/// A table that is being played.
pub struct Run<'t> {
    table: &'t Table,
    automaton: &'t Automaton,
    effective: Vec<Vec<Option<&'t Cell>>>,
    game: Game<'t>,
    globals: Vec<(String, Value)>,
    initial: Cycle,
    cycles: Vec<Cycle>,
}

impl<'t> Run<'t> {
    /// A run of `table` before its first cycle. `globals` are the values of the global variables, `initial` those that
    /// variables hold before the first cycle. A cell that calls a function of the table is not satisfied: see
    /// [`calls_own_function`].
    #[must_use]
    pub fn new(table: &'t Table, automaton: &'t Automaton, globals: Vec<(String, Value)>, initial: Cycle) -> Self {
        let game = Game::new(automaton);
        Self { table, automaton, effective: table.effective(), game, globals, initial, cycles: Vec::new() }
    }

    /// How the game stands.
    #[must_use]
    pub const fn standing(&self) -> &Standing {
        self.game.standing()
    }

    /// The indices of the rows that may be the current one.
    #[must_use]
    pub fn rows(&self) -> Vec<usize> {
        self.game.live().into_iter().map(|leaf| self.automaton.leaves[leaf].row).collect()
    }

    /// How many ranges of counts the live tokens take.
    #[must_use]
    pub fn weight(&self) -> usize {
        self.game.weight()
    }

    /// Whether the global variables satisfy what they are declared with.
    #[must_use]
    pub fn globals_fit(&self) -> bool {
        self.table.globals.iter().all(|global| {
            let subject = super::model::Subject::Variable(Path::plain(global.name.clone()));
            let scope = Now { run: self };
            let cell = global.constraint.as_ref().and_then(|cell| cell.constraint.as_ref());
            cell.is_none_or(|constraint| Evaluator::new(&scope, &subject).holds(constraint, true))
        })
    }

    /// Plays one cycle with all values of it.
    pub fn play(&mut self, cycle: Cycle) -> &Standing {
        self.cycles.push(cycle);
        let mut game = self.game.clone();
        game.play(&mut Cells { run: self });
        self.game = game;
        self.game.standing()
    }

    /// The columns whose cells do not hold at `site` in the cycle played last.
    #[must_use]
    pub fn failing(&self, site: Site) -> Vec<usize> {
        (0..self.table.columns.len()).filter(|column| !self.holds(site, *column)).collect()
    }

    fn holds(&self, site: Site, column: usize) -> bool {
        let row = self.automaton.leaves[site.leaf].row;
        let constraint = self.effective[row][column].and_then(|cell| cell.constraint.as_ref());
        let scope = Now { run: self };
        constraint.is_none_or(|constraint| {
            Evaluator::new(&scope, &self.table.columns[column].subject).holds(constraint, site.first)
        })
    }

    fn fits(&self, site: Site, assumption: bool) -> bool {
        let mut columns = self.table.columns.iter().enumerate();
        columns.all(|(index, column)| column.kind.is_assumption() != assumption || self.holds(site, index))
    }
}

struct Cells<'r, 't> {
    run: &'r Run<'t>,
}

impl Judge for Cells<'_, '_> {
    fn inputs_fit(&mut self, site: Site) -> bool {
        self.run.fits(site, true)
    }

    fn outputs_fit(&mut self, site: Site) -> bool {
        self.run.fits(site, false)
    }
}

/// Names in the cycle played last.
struct Now<'r, 't> {
    run: &'r Run<'t>,
}

fn lookup(values: &[(String, Value)], name: &str) -> Option<Value> {
    values.iter().find(|(other, _)| other.eq_ignore_ascii_case(name)).map(|(_, value)| value.clone())
}

impl Scope for Now<'_, '_> {
    fn value(&self, path: &Path, ago: u32) -> Option<Value> {
        let run = self.run;
        let name = print::path(path);
        if let Some(value) = lookup(&run.globals, &name) {
            return Some(value);
        }
        let ago = ago as usize;
        let cycle = run.cycles.len().checked_sub(ago + 1).map_or(&run.initial, |at| &run.cycles[at]);
        let found = |name: &str| lookup(cycle, name);
        found(&name)
            .or_else(|| {
                // A column under another name of its own: `var input shut as closed`.
                let column = run.table.column(&name)?;
                match &run.table.columns[column].subject {
                    super::model::Subject::Variable(path) => found(&print::path(path)),
                    super::model::Subject::Projection(_) => None,
                }
            })
            .or_else(|| bit(path, &found))
    }

    fn call(&self, _name: &str, _args: &[Value]) -> Option<Value> {
        None
    }
}

/// `word.3`: a bit of a number.
fn bit(path: &Path, found: &dyn Fn(&str) -> Option<Value>) -> Option<Value> {
    let (Step::Member(bit), steps) = path.steps.split_last()? else { return None };
    let bit: u32 = bit.parse().ok().filter(|bit| *bit < 64)?;
    let word = Path { steps: steps.to_vec(), ..path.clone() };
    match found(&print::path(&word))? {
        Value::Int(value, _) => Some(Value::Bool(value >> bit & 1 == 1)),
        _ => None,
    }
}

/// Unrolls and plays a whole run; the standing after each cycle.
///
/// # Errors
/// Where the table has no automaton, or calls a function of its own, which only the interpreter of programs can evaluate.
pub fn play(
    table: &Table,
    globals: Vec<(String, Value)>,
    initial: Cycle,
    cycles: impl IntoIterator<Item = Cycle>,
) -> Result<Vec<Standing>, NoAutomaton> {
    let automaton = Automaton::build(table)?;
    if calls_own_function(table) {
        return Err(NoAutomaton::Unsupported);
    }
    let mut run = Run::new(table, &automaton, globals, initial);
    let mut out = Vec::new();
    for cycle in cycles {
        if *run.standing() != Standing::Open {
            break;
        }
        out.push(run.play(cycle).clone());
    }
    Ok(out)
}

/// Whether a cell calls a function that is none of the standard.
#[must_use]
pub fn calls_own_function(table: &Table) -> bool {
    let mut found = false;
    for cell in table.rows().iter().flat_map(|row| row.cells.iter().flatten()) {
        let Some(constraint) = &cell.constraint else { continue };
        found |= constraint.chunks.iter().any(|c| matches!(&c.kind, ChunkKind::Predicate(Predicate::Function(_))));
        constraint.walk(&mut |expr| {
            found |= matches!(&expr.kind, ExprKind::Call { name, .. } if !is_standard(name));
        });
    }
    found
}
