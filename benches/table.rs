//! A large table: 500 rows, 40 columns. `cargo bench --no-default-features --bench table`.

use rungbook::config::{ConfigFile, Settings};
use rungbook::pipeline::{self, Project};
use rungbook::source::Memory;
use rungbook::table::automaton::Automaton;
use rungbook::table::bind;

fn main() {
    divan::main();
}

/// A block with 20 inputs and 20 outputs, and a table over all of them.
fn project() -> Project {
    let variables = |section: &str, name: &str| {
        let names: Vec<String> = (0..20).map(|at| format!("    {name}{at} : INT;\n")).collect();
        format!("VAR_{section}\n{}END_VAR\n", names.concat())
    };
    let block =
        format!("FUNCTION_BLOCK FB\n{}{}END_FUNCTION_BLOCK\n", variables("INPUT", "i"), variables("OUTPUT", "o"));
    let columns: Vec<String> =
        (0..20).map(|at| format!("in i{at}")).chain((0..20).map(|at| format!("out o{at}"))).collect();
    let mut table = format!("@gtt Large\n| # | {} | dur |\n|{}\n", columns.join(" | "), "---|".repeat(42));
    for row in 0..500 {
        let cells: Vec<String> = (0..40).map(|at| format!(">= {row}, <= {at} + 500")).collect();
        let duration = ["[1,10]", "-", "5", ">= 2 p"][row % 4];
        table += &format!("| {row} | {} | {duration} |\n", cells.join(" | "));
    }
    let fs = Memory::new().with("a.st", &block).with("FB.gtt.md", &table);
    let settings = Settings::new(ConfigFile::default()).expect("the defaults are a configuration");
    pipeline::read(&fs, "tree", &settings, &|_| {})
}

/// Binds and unrolls.
#[divan::bench]
fn binds_and_unrolls(bencher: divan::Bencher<'_, '_>) {
    let project = project();
    let attached = &project.tables[0];
    let unit = attached.item.expect("its block is known");
    assert_eq!(attached.errors, []);
    bencher.bench(|| {
        let (bound, findings) = bind::bind(&attached.table, &project.catalogue, &project.names, unit);
        assert!(findings.is_empty() && bound.rows.len() == 500);
        Automaton::build(&attached.table).map(|automaton| automaton.leaves.len())
    });
}
