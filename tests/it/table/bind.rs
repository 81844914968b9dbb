//! Tables bound to blocks: what columns and cells mean, and where what is wrong with them is told.

use rungbook::pipeline::Project;
use rungbook::semantics::eval::{self, FaultAt, Leaves};
use rungbook::semantics::expr::Expr;
use rungbook::semantics::scalar::Scalar;
use rungbook::table::bind::{BoundTable, Leaf, Role};

use crate::support;

const TREE: &str = "\
TYPE Colour : (RED, GREEN := 5, BLUE); END_TYPE
TYPE Fruit : (APPLE, LEMON) USINT; END_TYPE
TYPE Point : STRUCT X : INT; Y : REAL; END_STRUCT; END_TYPE
TYPE Percent : INT (0..100); END_TYPE
VAR_GLOBAL CONSTANT LAST : INT := 2 + 1; END_VAR
VAR_GLOBAL Speed : UINT; END_VAR
FUNCTION_BLOCK Base
VAR_INPUT Enable : BOOL; END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB EXTENDS Base
VAR_INPUT Level : INT; Small : SINT; Lamp : Colour; Wait : TIME; Name : STRING; END_VAR
VAR_OUTPUT Pump : BOOL; Count : UINT; Ratio : REAL; Word1 : WORD; END_VAR
VAR
    Timer : TON;
    Points : ARRAY[1..LAST] OF Point;
    Grid : ARRAY[0..1, -1..1] OF BOOL;
    Step : (Idle, Busy, Done);
    Share : Percent;
END_VAR
END_FUNCTION_BLOCK
";

fn project(table: &str) -> Project {
    support::project(&[("a.st", TREE), ("FB.gtt.md", table)], "")
}

/// The findings of the table as `code line:column message / help`, those of binding alone.
fn findings(table: &str) -> Vec<String> {
    let project = project(table);
    let binding = ["table-unknown-name", "table-type", "table-declared-type", "table-direction", "table-unsupported"];
    let own = project.findings.iter().filter(|f| binding.contains(&f.code.name));
    own.map(|f| {
        let at = project.files.line_column(f.place);
        let text = f.place.span.of(&project.files.get(f.place.file).text);
        format!("{} {}:{} {text:?} {} / {}", f.code.name, at.line, at.column, f.message, f.help.join("; "))
    })
    .collect()
}

fn bound(table: &str) -> BoundTable {
    let project = project(table);
    let errors: Vec<_> = project.tables[0].errors.iter().map(|error| &error.message).collect();
    assert!(errors.is_empty(), "{errors:?}");
    project.tables[0].bound.clone().expect("its block is known")
}

/// One column and one cell.
fn cell(header: &str, cell: &str) -> String {
    let cell = cell.replace('|', "\\|");
    format!(
        "@gtt T (global p : INT, global q)\n| # | {header} | dur |\n|---|---|---|\n| 1 | {cell} | 5 |\n| 2 |  | - |\n"
    )
}

/// Values by path, past ones behind `@`.
struct Run<'a>(&'a BoundTable, &'a [(&'a str, i128)]);

impl Leaves<Leaf> for Run<'_> {
    fn read(&mut self, leaf: &Leaf) -> Result<u64, FaultAt> {
        let (name, scalar) = match leaf {
            Leaf::Variable { index, ago: 0 } => {
                (self.0.variables[*index].path.clone(), self.0.variables[*index].scalar)
            }
            Leaf::Variable { index, ago } => {
                (format!("{}@{ago}", self.0.variables[*index].path), self.0.variables[*index].scalar)
            }
            Leaf::Global(index) => (self.0.globals[*index].name.clone(), self.0.globals[*index].scalar),
        };
        let found = self.1.iter().find(|(other, _)| *other == name);
        Ok(scalar.bits(found.unwrap_or_else(|| panic!("`{name}` is read")).1))
    }

    fn address(&mut self, _: &Leaf) -> Result<u64, FaultAt> {
        panic!("no cell takes an address")
    }
}

/// Whether the cell holds in the row's first cycle, and in a later one; a fault is no.
fn holds(header: &str, text: &str, values: &[(&str, i128)]) -> (bool, bool) {
    let table = bound(&cell(header, text));
    let cell = table.rows[0].cells[0].clone().expect("it says something");
    assert_eq!(table.rows[1].cells[0], Some(cell.clone()), "a blank repeats the one above");
    let judge = |term: &Expr<Leaf>| {
        assert_eq!(term.scalar, Scalar::Bool);
        eval::evaluate(term, &mut Run(&table, values)).is_ok_and(|bits| bits == 1)
    };
    (judge(cell.constraint(true)), judge(cell.constraint(false)))
}

#[test]
fn cells_mean_what_the_reference_says() {
    let yes = |header: &str, text: &str, values: &[(&str, i128)]| {
        assert_eq!(holds(header, text, values), (true, true), "{header}: {text} of {values:?}");
    };
    let no = |header: &str, text: &str, values: &[(&str, i128)]| {
        assert_eq!(holds(header, text, values), (false, false), "{header}: {text} of {values:?}");
    };
    yes("in Level", "7", &[("Level", 7)]);
    no("in Level", "7", &[("Level", 8)]);
    yes("in Level", "[1, 5)", &[("Level", 4)]);
    no("in Level", "[1, 5)", &[("Level", 5)]);
    yes("in Level", "[2,∞]", &[("Level", 32767)]);
    yes("in Level", "> 2, <> p", &[("Level", 3), ("p", 4)]);
    no("in Level", "> 2, <> p", &[("Level", 4), ("p", 4)]);
    yes("in Level", "2*p", &[("Level", 8), ("p", 4)]);
    yes("in Level", ">= Level[-1]", &[("Level", 3), ("Level@1", 3)]);
    // A comparison is a condition; after `=` it is a value.
    no("out Pump", "Level > 3", &[("Pump", 1), ("Level", 3)]);
    yes("out Pump", "= Level > 3", &[("Pump", 0), ("Level", 3)]);
    yes("out Pump", "NOT Enable", &[("Pump", 0), ("Enable", 1)]);
    yes("out Pump", "T", &[("Pump", 1)]);
    yes("out Pump", "1", &[("Pump", 1)]);
    yes("in Lamp", "GREEN", &[("Lamp", 5)]);
    yes("in Lamp", "Colour#BLUE", &[("Lamp", 6)]);
    yes("in Lamp", "Colour.RED", &[("Lamp", 0)]);
    yes("in Lamp", "<> RED, <> BLUE", &[("Lamp", 5)]);
    yes("in Lamp", "SEL(Enable, RED, GREEN)", &[("Lamp", 5), ("Enable", 1)]);
    yes("out Pump", "= (Lamp = GREEN)", &[("Pump", 1), ("Lamp", 5)]);
    yes("out Pump", "= (GREEN = Lamp)", &[("Pump", 1), ("Lamp", 5)]);
    yes("in Wait", "T#1s500ms", &[("Wait", 1500)]);
    yes("state Timer.Q", "T", &[("Timer.Q", 1)]);
    yes("state Timer.ET", "< T#10ms", &[("Timer.ET", 9)]);
    yes("state Points[3].X", "-1", &[("Points[3].X", -1)]);
    yes("state Grid[1,-1]", "F", &[("Grid[1,-1]", 0)]);
    yes("state Step", "Busy", &[("Step", 1)]);
    yes("state Share", "<= LAST", &[("Share", 3)]);
    yes("out Word1.3", "T", &[("Word1", 8)]);
    yes(
        "out Count",
        "= Speed + 1",
        &[("Count", 8), ("VAR_GLOBAL.Speed", 7)].map(|(n, v)| if n == "Count" { (n, v) } else { (global(), v) }),
    );
    yes("in sum : INT as Level + Small", "5", &[("Level", 7), ("Small", -2)]);
    yes("in pair as Level, Small", "leq", &[("Level", -5), ("Small", -2)]);
    yes("in Level", "if :: Enable -> 5 :: TRUE -> >= 6 fi", &[("Level", 6), ("Enable", 0)]);
    no("in Level", "if :: Enable -> 5 fi", &[("Level", 5), ("Enable", 0)]);
    no("in Level", "1 + (if :: Enable -> 5 fi)", &[("Level", 6), ("Enable", 0)]);
    yes("in Level", "1 + (if :: Enable -> 5 fi)", &[("Level", 6), ("Enable", 1)]);
    // What has no value is not satisfied, even where its opposite is asked for.
    no("in Level", "<> 7 / Small", &[("Level", 3), ("Small", 0)]);
    // Sums wrap around in the type of their operands.
    yes("in Level", "Level[-1] + 1", &[("Level", -32768), ("Level@1", 32767)]);
    assert_eq!(holds("in Enable", "√T", &[("Enable", 0)]), (false, true));
    assert_eq!(holds("in Level", "√>3, <9", &[("Level", 8)]), (true, true));
    assert_eq!(holds("in Level", "√>3, <9", &[("Level", 9)]), (false, false));
    assert_eq!(holds("in Level", "√>3, <9", &[("Level", 1)]), (false, true));
}

/// How the list of global variables without a name is called.
fn global() -> &'static str {
    let table = bound(&cell("out Count", "= Speed"));
    let path = table.variables.iter().find(|variable| variable.role == Role::Global).expect("it is read").path.clone();
    assert!(path.ends_with("Speed"), "{path}");
    Box::leak(path.into_boxed_str())
}

#[test]
fn functions_of_the_table_are_written_out() {
    let text = "table T for_fb {
        var input Level : INT var output Pump : BOOL
        column output both as Level, Pump
        options { unit = FB }
        group { row 1 { Level: twice(3); Pump: = big(Level); both: agree } }
        FUNCTION twice : INT VAR_INPUT n : INT; END_VAR twice := n + n; END_FUNCTION
        FUNCTION big : BOOL VAR_INPUT n : INT; END_VAR big := twice(n) > 11; END_FUNCTION
        FUNCTION agree : BOOL VAR_INPUT n : INT; b : BOOL; END_VAR agree := (n > 5) = b; END_FUNCTION
        FUNCTION loops : BOOL VAR_INPUT n : INT; END_VAR IF n > 1 THEN loops := TRUE; END_IF END_FUNCTION
    }";
    let text = text.replace(" for_fb", "");
    let read = |text: &str| support::project(&[("a.st", TREE), ("FB.gtt", text)], "");
    let project = read(&text);
    let table = project.tables[0].bound.clone().expect("bound");
    assert_eq!((table.errors, table.unsupported.len()), (0, 0), "{:?}", project.findings);
    let judge = |values: &[(&str, i128)]| -> Vec<bool> {
        let cells = table.rows[0].cells.iter().flatten();
        cells.map(|cell| eval::evaluate(cell.constraint(true), &mut Run(&table, values)) == Ok(1)).collect()
    };
    assert_eq!(judge(&[("Level", 6), ("Pump", 1)]), [true, true, true]);
    assert_eq!(judge(&[("Level", 5), ("Pump", 1)]), [false, false, false]);
    let project = read(&text.replace("big(Level)", "loops(Level)"));
    let table = project.tables[0].bound.clone().expect("bound");
    assert_eq!(table.errors, 0);
    assert_eq!(table.unsupported[0].what, "the function `loops`, whose body is more than one expression");
    let place = table.unsupported[0].place;
    assert!(place.span.of(&project.files.get(place.file).text).contains("loops(Level)"));
}

#[test]
fn what_is_wrong_is_told_at_its_cell_with_the_nearest_name() {
    let one = |header: &str, text: &str| {
        let found = findings(&cell(header, text));
        assert_eq!(found.len(), 1, "{header}: {text}: {found:?}");
        found[0].clone()
    };
    assert_eq!(
        one("in Levle", "1"),
        "table-unknown-name 2:7 \"in Levle\" `FB` has no variable `Levle` / `Level` is the nearest name"
    );
    assert_eq!(
        one("in Level", "Smal"),
        "table-unknown-name 4:7 \"Smal\" `FB` has no variable `Smal` / `Small` is the nearest name"
    );
    assert_eq!(
        one("in Lamp", "GREN"),
        "table-unknown-name 4:7 \"GREN\" nothing is named `GREN` / `GREEN` is the nearest name"
    );
    assert_eq!(one("in Lamp", "APPLE"), "table-unknown-name 4:7 \"APPLE\" `Colour` has no value `APPLE` / ");
    assert_eq!(
        one("in Lamp", "Colour#GREN"),
        "table-unknown-name 4:7 \"Colour#GREN\" `Colour` has no value `GREN` / `GREEN` is one"
    );
    assert_eq!(
        one("in Lamp", "Fruit#APPLE"),
        "table-type 4:7 \"Fruit#APPLE\" a `Colour` is compared with a `Fruit` / "
    );
    assert!(one("in Level", "TRUE").starts_with("table-type 4:7 \"TRUE\" `=` is not defined for `INT` and `BOOL`"));
    assert!(one("out Pump", ">= 5").starts_with("table-type 4:"));
    assert_eq!(
        one("state Timer", "T"),
        "table-type 2:7 \"state Timer\" `Timer` is of type `TON`, which is no single value / name one of its variables: `Timer.IN`"
    );
    assert_eq!(
        one("state Timer.O", "T"),
        "table-unknown-name 2:7 \"state Timer.O\" `Timer` has no member `O` / `Timer.Q` is one"
    );
    assert_eq!(
        one("state Points[4].X", "1"),
        "table-type 2:7 \"state Points[4].X\" the index 4 is outside of `Points` / it goes from 1 to 3"
    );
    assert!(one("out Word1.16", "T").contains("which has no bit 16"));
    assert_eq!(
        one("in Level", "MAXI(1, 2)"),
        "table-unknown-name 4:7 \"MAXI(1, 2)\" no function is named `MAXI` / `MAX` is one"
    );
    assert!(one("in Name", "'a'").starts_with("table-unsupported 2:7 \"in Name\" `Name`, which is a string"));
}

#[test]
fn headers_that_lie_are_told_and_do_no_harm() {
    let found = findings(&cell("in Level : BOOL", "1"));
    assert_eq!(found, ["table-declared-type 2:18 \"BOOL\" the header says that `Level` is `BOOL`, and it is `INT` / "]);
    assert!(findings(&cell("in Lamp : Colour", "RED")).is_empty());
    assert!(findings(&cell("in Lamp : ENUM", "RED")).is_empty());
    assert!(findings(&cell("in Enable : BOOLEAN", "T")).is_empty());
    let found = findings(&cell("in Pump", "1"));
    assert!(found[0].starts_with("table-direction 2:7 \"in Pump\" `Pump` is an output of `FB`"), "{found:?}");
    assert!(findings(&cell("out Level", "1"))[0].contains("is an input of `FB`"));
    assert!(findings(&cell("in Timer.Q", "T"))[0].contains("a variable of its own"));
}

#[test]
fn a_wrong_cell_spoils_its_row_and_those_that_repeat_it() {
    let table = "@gtt T\n| # | in Level | out Pump | dur |\n|---|---|---|---|\n| 1 | 1 | T | 1 |\n| 2 | Nothing | T | 1 |\n| 3 |  | T | 1 |\n| 4 | 2 | T | 1 |\n";
    let project = project(table);
    let bound = project.tables[0].bound.clone().expect("its block is known");
    let spoiled: Vec<bool> = bound.rows.iter().map(|row| row.spoiled).collect();
    assert_eq!(spoiled, [false, true, true, false]);
    assert_eq!((bound.errors, project.tables[0].table.errors, project.tables[0].errors.len()), (1, 1, 1));
}

#[test]
fn globals_have_the_type_of_what_they_are_compared_with() {
    let table = "@gtt T (global p, global q with > 3, global r, global s : Colour)\n| # | in Small | in Level | in Lamp | out Count | dur |\n|---|---|---|---|---|---|\n| 1 | p | p, q | r, s | = q + r | 1 |\n";
    let project = project(&table.replace("= q + r", "= q"));
    let bound = project.tables[0].bound.clone().expect("its block is known");
    let types: Vec<(Scalar, bool)> = bound.globals.iter().map(|g| (g.scalar, g.enumeration.is_some())).collect();
    let int = |signed, width| Scalar::Int { signed, width };
    assert_eq!(types, [(int(true, 16), false), (int(true, 32), false), (int(true, 16), true), (int(true, 16), true)]);
    assert!(bound.globals[1].constraint.is_some());
    assert_eq!(bound.errors, 0, "{:?}", project.findings);
}

#[test]
fn variables_are_listed_once_with_their_declared_paths() {
    let table = "@gtt T\n| # | in LEVEL | in x as small + level | state timer.q | dur |\n|---|---|---|---|---|\n| 1 | POINTS[ 2 ].x[-2] | - | - | 1 |\n";
    let bound = bound(table);
    let paths: Vec<&str> = bound.variables.iter().map(|variable| variable.path.as_str()).collect();
    assert_eq!(paths, ["Level", "Timer.Q", "Small", "Points[2].X"]);
    assert_eq!(bound.depths(), [0, 0, 0, 2]);
}

fn lints(table: &str, codes: &[&str]) -> Vec<String> {
    let project = project(table);
    let own = project.findings.iter().filter(|f| codes.contains(&f.code.name));
    own.map(|f| format!("{} {}", f.code.name, f.message)).collect()
}

fn rows(rows: &str) -> String {
    format!("@gtt T\n| # | in Level | in Lamp | out Pump | out Count | dur |\n|---|---|---|---|---|---|\n{rows}")
}

#[test]
fn contradictions_are_decided_and_name_their_cells() {
    let codes = ["table-contradiction", "table-no-input", "table-never-reached"];
    let one = |text: &str| lints(&rows(text), &codes);
    assert_eq!(one("| 1 | > 5, < 7 | <> RED | - | - | 1 |\n"), [""; 0]);
    assert_eq!(
        one("| 1 | 1 | - | - | - | 1 |\n| 2 | > 5, < 6 | - | - | - | 1 |\n| 3 | 2 | - | T | - | 1 |\n"),
        [
            "table-contradiction no value satisfies `Level: > 5, < 6`",
            "table-never-reached row `3` is never reached: no inputs lead to it",
        ]
    );
    // No value of the enumeration is left; the outputs contradict each other.
    assert_eq!(
        one("| 1 | - | <> RED, <> GREEN, <> BLUE | - | - | 1 |\n"),
        [
            "table-no-input no inputs satisfy the beginning of `T`, so no run is covered by it",
            "table-contradiction no value satisfies `Lamp: <> RED, <> GREEN, <> BLUE`",
        ]
    );
    assert_eq!(
        one("| 1 | - | - | = Count > 5 | = SEL(Pump, 7, 3) | 1 |\n"),
        ["table-contradiction no values satisfy `Pump: = Count > 5` and `Count: = SEL(Pump, 7, 3)` in row `1`"]
    );
    assert_eq!(one("| 1 | - | - | = Count > 5 | = SEL(Pump, 3, 7) | 1 |\n"), [""; 0]);
}

#[test]
fn rows_that_the_inputs_do_not_tell_apart_are_told_with_an_example() {
    let one = |text: &str| lints(&rows(text), &["table-overlap"]);
    assert_eq!(one("| 1 | < 5 | - | - | - | - |\n| 2 | >= 5 | - | - | - | 1 |\n"), [""; 0]);
    assert_eq!(
        one("| 1 | <= 5 | - | - | - | - |\n| 2 | >= 5 | - | - | - | 1 |\n"),
        ["table-overlap rows `1` and `2` admit the same inputs, as `Level = 5`"]
    );
    assert_eq!(one("| 1 | <= 5 | - | - | - | -p |\n| 2 | >= 5 | - | - | - | 1 |\n"), [""; 0]);
    assert_eq!(one("| 1 | <= 5 | - | - | - | 7 |\n| 2 | >= 5 | - | - | - | 1 |\n"), [""; 0]);
}

/// How long a table of 500 rows and 40 columns takes to bind; `-- --ignored --nocapture bound_large` prints it.
#[test]
#[ignore = "measures"]
fn a_bound_large_table_is_measured() {
    let names = |name: &str| (0..20).map(|at| format!("{name}{at} : INT; ")).collect::<String>();
    let block = format!(
        "FUNCTION_BLOCK FB VAR_INPUT {} END_VAR VAR_OUTPUT {} END_VAR END_FUNCTION_BLOCK",
        names("i"),
        names("o")
    );
    let columns: Vec<String> =
        (0..40).map(|at| if at < 20 { format!("in i{at}") } else { format!("out o{}", at - 20) }).collect();
    let mut table = format!("@gtt Large\n| # | {} | dur |\n|{}\n", columns.join(" | "), "---|".repeat(42));
    for row in 0..500 {
        let cells: Vec<String> = (0..40).map(|at| format!(">= {row}, <= {at} + 500")).collect();
        table += &format!("| {row} | {} | {} |\n", cells.join(" | "), ["[1,10]", "-", "5", ">= 2 p"][row % 4]);
    }
    let start = std::time::Instant::now();
    let project = support::project(&[("a.st", &block), ("FB.gtt.md", &table)], "");
    eprintln!("read, bound and looked through {:?}", start.elapsed());
    let attached = &project.tables[0];
    let start = std::time::Instant::now();
    let unit = attached.item.expect("its block is known");
    let (bound, findings) = rungbook::table::bind::bind(&attached.table, &project.catalogue, &project.names, unit);
    let middle = start.elapsed();
    let automaton = rungbook::table::automaton::Automaton::build(&attached.table).expect("it has one");
    eprintln!("bound {middle:?}, unrolled {:?}", start.elapsed() - middle);
    assert_eq!((bound.rows.len(), findings.len(), automaton.leaves.len()), (500, 0, 500));
}
