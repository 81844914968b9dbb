//! Instances: every one is a run that the table covers and that wins.

use rungbook::pipeline::Project;
use rungbook::semantics::eval::{self, FaultAt, Leaves};
use rungbook::table::automaton::game::{Game, Judge, Standing};
use rungbook::table::automaton::{Automaton, Site};
use rungbook::table::bind::{BoundTable, Leaf};
use rungbook::table::instances::{self, Instance, NoInstance, Options, Strategy, tcunit};

use crate::support;

const TREE: &str = "\
TYPE Colour : (RED, GREEN, BLUE); END_TYPE
FUNCTION_BLOCK FB
VAR_INPUT E : BOOL; Level : INT := 3; Lamp : Colour; R : REAL; END_VAR
VAR_OUTPUT Ext : BOOL; Count : UINT; END_VAR
END_FUNCTION_BLOCK
";

const TABLE: &str = "\
@gtt T (cycle 10ms, global p : INT with > 10, < 20)
| # | in E | in Level         | in Lamp | in R  | out Ext | out Count      | dur     | repeat   |
|---|------|------------------|---------|-------|---------|----------------|---------|----------|
| 1 | F    | >= Level[-1], <9 | -       | > 1.5 | T       | -              | [2,9]   | {        |
| 2 | √T   | p                | <> RED  | -     | F       | = Level + 1    | -p      |          |
| 3 | -    | [-5, 5]          | GREEN   | -     | -       | >= Count[-1]   | 3       | } x [1,2]|
| 4 | T    | > Level[-1]      | -       | -     | T       | -              | 4       |          |
";

fn project(table: &str) -> Project {
    support::project(&[("a.st", TREE), ("FB.gtt.md", table)], "")
}

/// The values of a cycle, with all before it.
struct Cycle<'a> {
    bound: &'a BoundTable,
    instance: &'a Instance,
    cycle: u64,
}

impl Cycle<'_> {
    fn step(&self, cycle: u64) -> &instances::Step {
        let mut left = cycle;
        for step in &self.instance.steps {
            if left < step.cycles {
                return step;
            }
            left -= step.cycles;
        }
        panic!("cycle {cycle} is behind the instance")
    }
}

impl Leaves<Leaf> for Cycle<'_> {
    fn read(&mut self, leaf: &Leaf) -> Result<u64, FaultAt> {
        Ok(match *leaf {
            Leaf::Global(index) => self.instance.globals[index],
            Leaf::Variable { index, ago } => match self.cycle.checked_sub(u64::from(ago)) {
                // What nothing asks for may be anything.
                Some(cycle) => self.step(cycle).values[index].unwrap_or(0),
                None => self.bound.variables[index].initial,
            },
        })
    }

    fn address(&mut self, _: &Leaf) -> Result<u64, FaultAt> {
        panic!("no cell takes an address")
    }
}

struct Judged<'a> {
    cycle: Cycle<'a>,
    automaton: &'a Automaton,
}

impl Judged<'_> {
    fn fits(&mut self, site: Site, assumptions: bool) -> bool {
        let (bound, row) = (self.cycle.bound, self.automaton.leaves[site.leaf].row);
        let mut terms = bound.constraints(row, assumptions, site.first);
        terms.all(|term| eval::evaluate(term, &mut self.cycle) == Ok(1))
    }
}

impl Judge for Judged<'_> {
    fn inputs_fit(&mut self, site: Site) -> bool {
        self.fits(site, true)
    }
    fn outputs_fit(&mut self, site: Site) -> bool {
        self.fits(site, false)
    }
}

/// Plays an instance: never lost, never left.
fn wins(automaton: &Automaton, bound: &BoundTable, instance: &Instance) {
    let mut game = Game::new(automaton);
    for cycle in 0..instance.steps.iter().map(|step| step.cycles).sum() {
        let mut judge = Judged { cycle: Cycle { bound, instance, cycle }, automaton };
        let standing = game.play(&mut judge).clone();
        assert!(matches!(standing, Standing::Open | Standing::Ended), "cycle {cycle}: {standing:?} of {instance:?}");
    }
}

fn of(table: &str, strategy: Strategy) -> (Project, Vec<Instance>) {
    let project = project(table);
    let errors: Vec<_> = project.tables[0].errors.iter().map(|error| &error.message).collect();
    assert!(errors.is_empty(), "{errors:?}");
    let bound = project.tables[0].bound.clone().expect("its block is known");
    let options = Options { strategy, count: 3, seed: 7, forever: 3 };
    let found = instances::instances(&project.tables[0].table, &bound, &options).expect("it has instances");
    let automaton = Automaton::build(&project.tables[0].table).expect("it has one");
    found.iter().for_each(|instance| wins(&automaton, &bound, instance));
    (project, found)
}

#[test]
fn every_strategy_gives_runs_that_the_table_covers() {
    for strategy in [Strategy::Covering, Strategy::Boundary, Strategy::Pairwise, Strategy::Random] {
        let (_, found) = of(TABLE, strategy);
        assert!(found.len() > 1, "{strategy:?}: {}", found.len());
    }
    assert_eq!(of(TABLE, Strategy::Random).1, of(TABLE, Strategy::Random).1, "the same again");
}

#[test]
fn covering_ones_hold_every_row_and_both_bounds() {
    let (_, found) = of(TABLE, Strategy::Covering);
    let lasting = |row: usize| -> Vec<u64> {
        let mut out = Vec::new();
        for instance in &found {
            let mut run = 0;
            for step in &instance.steps {
                run = if step.row == row { run + step.cycles } else { 0 };
                out.push(run);
            }
        }
        out
    };
    assert!(lasting(0).contains(&2) && lasting(0).contains(&9), "{:?}", lasting(0));
    for row in 1..4 {
        assert!(lasting(row).iter().any(|cycles| *cycles > 0), "row {row}");
    }
}

#[test]
fn boundaries_are_the_ends_of_what_is_admitted() {
    let table = "@gtt T\n| # | in Level | out Ext | dur |\n|---|---|---|---|\n| 1 | [-5, 17], <> 17 | T | 1 |\n";
    let (_, found) = of(table, Strategy::Boundary);
    let levels: Vec<Option<u64>> = found.iter().map(|instance| instance.steps[0].values[0]).collect();
    assert_eq!(levels, [Some(0xFFFB), Some(16)]);
}

#[test]
fn a_table_without_an_instance_names_the_cells_that_contradict() {
    let table = "@gtt T (global p : INT)\n| # | in E | in Level | out Ext | dur |\n|---|---|---|---|---|\n| 1 | T | p | - | 1 |\n| 2 | F | < 3, p | - | 1 |\n| 3 | F | > 7, p | T | 1 |\n";
    let project = project(table);
    let bound = project.tables[0].bound.clone().expect("its block is known");
    let found = instances::instances(&project.tables[0].table, &bound, &Options::default());
    assert_eq!(found, Err(NoInstance::Contradiction(vec![(1, 1), (2, 1)])));
}

#[test]
fn the_example_goes_through_every_row_and_is_always_the_same() {
    let project = project(TABLE);
    let bound = project.tables[0].bound.clone().expect("its block is known");
    let table = &project.tables[0].table;
    let found = instances::example(table, &bound).expect("it has one");
    let automaton = Automaton::build(table).expect("it has one");
    wins(&automaton, &bound, &found);
    let rows: std::collections::BTreeSet<usize> = found.steps.iter().map(|step| step.row).collect();
    assert_eq!(rows.into_iter().collect::<Vec<_>>(), [0, 1, 2, 3]);
    assert_eq!(instances::example(table, &bound), Ok(found));
}

#[test]
fn instances_are_tables_that_read_and_bind_again() {
    let (project, found) = of(TABLE, Strategy::Covering);
    let attached = &project.tables[0];
    let bound = attached.bound.clone().expect("bound");
    for instance in &found {
        let table = instances::table(&attached.table, &bound, instance, "FB").expect("it reads");
        assert!(table.options.concrete);
        let text = rungbook::table::write::pipe(&table).content;
        let again = support::project(&[("a.st", TREE), ("FB.gtt.md", &text)], "");
        assert_eq!(again.tables[0].errors, [], "{text}");
        let lost = rungbook::table::write::test_manager(&[&table]).lost;
        assert!(lost.is_empty(), "{lost:?} of {text}");
    }
}

#[test]
fn a_tcunit_suite_has_a_test_for_each_instance() {
    let table = "@gtt T\n| # | in E | in Lamp | in R | out Ext | dur |\n|---|---|---|---|---|---|\n| a | T | GREEN | 1.5 | F | 2 |\n| b | F | | | T | 1 |\n";
    let (project, found) = of(table, Strategy::Covering);
    let attached = &project.tables[0];
    let suite = tcunit::suite(&attached.table, attached.bound.as_ref().expect("bound"), &found, "FB", false);
    insta::assert_snapshot!(suite);
    let again = support::project(&[("a.st", TREE), ("t.st", &suite)], "");
    let unread: Vec<_> = again.findings.iter().filter(|f| f.code.name.contains("unread")).collect();
    assert!(unread.is_empty(), "{unread:?}");
}
