//! The tables of the papers, typed for this project: each reads without an error in two forms and says the same in both.

use rungbook::table::automaton::game::Standing;
use rungbook::table::automaton::{Automaton, Site};
use rungbook::table::eval::{IntType, Value};
use rungbook::table::explain::sentences;
use rungbook::table::layout::layout;
use rungbook::table::lint::lint;
use rungbook::table::read::{self, Options};
use rungbook::table::{Piece, Table, run, write};
use rungbook::text::FileId;

use super::{gtt, pipe, shown};

const PAPERS: [(&str, &str); 6] = [
    ("notation", include_str!("../../../samples/papers/notation.gtt.md")),
    ("interpolation", include_str!("../../../samples/papers/interpolation.gtt.md")),
    ("conveyor", include_str!("../../../samples/papers/conveyor.gtt.md")),
    ("cylinders", include_str!("../../../samples/papers/cylinders.gtt.md")),
    ("sorting", include_str!("../../../samples/papers/sorting.gtt.md")),
    ("qualifiers", include_str!("../../../samples/papers/qualifiers.gtt.md")),
];

const IN_GTT: [(&str, &str); 6] = [
    ("notation", include_str!("../../../samples/papers/notation.gtt")),
    ("interpolation", include_str!("../../../samples/papers/interpolation.gtt")),
    ("conveyor", include_str!("../../../samples/papers/conveyor.gtt")),
    ("cylinders", include_str!("../../../samples/papers/cylinders.gtt")),
    ("sorting", include_str!("../../../samples/papers/sorting.gtt")),
    ("qualifiers", include_str!("../../../samples/papers/qualifiers.gtt")),
];

fn table(name: &str) -> Table {
    let mut all = PAPERS.iter().flat_map(|(_, text)| pipe(text).tables);
    all.find(|table| table.name == name).expect("the papers hold the table")
}

#[test]
fn every_paper_reads_the_same_in_both_forms() {
    for ((name, pipes), (_, text)) in PAPERS.iter().zip(IN_GTT) {
        let first = read::text(&Piece::verbatim(FileId(0), pipes, 0), &Options::default());
        assert_eq!(shown(pipes, &first.findings), [""; 0], "{name}");
        assert_eq!(write::format_in_place(pipes), *pipes, "{name} is not formatted");
        let second = gtt(text);
        assert_eq!(shown(text, &second.findings), [""; 0], "{name}");
        assert_eq!(first.tables.len(), second.tables.len());
        for (a, b) in first.tables.iter().zip(&second.tables) {
            assert_eq!(write::pipe(a).content, write::pipe(b).content);
            assert_eq!(layout(a).rows.len(), a.rows().len());
            assert!(Automaton::build(a).is_ok());
        }
    }
}

/// Writes the second form from the first: `RUNGBOOK_BLESS=1 cargo test -- --ignored bless`.
#[test]
#[ignore = "writes the samples"]
#[allow(clippy::disallowed_methods, reason = "writes the samples on demand")]
fn bless_the_samples() {
    for (name, text) in PAPERS {
        let path = format!("{}/samples/papers/{name}.gtt", env!("CARGO_MANIFEST_DIR"));
        let tables: Vec<String> = pipe(text).tables.iter().map(|table| write::gtt(table).content).collect();
        std::fs::write(path, tables.join("\n")).expect("the samples can be written");
        let path = format!("{}/samples/papers/{name}.gtt.md", env!("CARGO_MANIFEST_DIR"));
        std::fs::write(path, write::format_in_place(text)).expect("the samples can be written");
    }
}

fn int(value: i128) -> Value {
    Value::Int(value, IntType::named("INT"))
}

fn cycle(names: &[&str], values: &[i128]) -> run::Cycle {
    names.iter().zip(values).map(|(name, value)| ((*name).to_owned(), int(*value))).collect()
}

/// Figure 2 is the instance `p = 3` of figure 4.
#[test]
fn the_concrete_run_is_an_instance_of_the_generalized_table() {
    let names = ["A", "B", "C", "X", "Y", "Z"];
    let mut rows = vec![[1, 1, 2, 0, 0, 5]];
    rows.extend([[0, 3, 3, 6, 6, 5]; 7]);
    rows.push([1, 4, 2, 2, 8, 5]);
    let cycles = |rows: &[[i128; 6]]| rows.iter().map(|row| cycle(&names, row)).collect::<Vec<_>>();
    let play = |p: i128, rows: &[[i128; 6]]| {
        let globals = vec![("p".to_owned(), int(p))];
        run::play(&table("Generalized"), globals, Vec::new(), cycles(rows)).expect("it has an automaton")
    };
    // The last row may be skipped, so the end is reached with the sixth repetition of the second one.
    assert_eq!(play(3, &rows), [vec![Standing::Open; 6], vec![Standing::Ended]].concat());
    assert_eq!(play(4, &rows)[1..], [Standing::Uncovered]);
    rows[3][4] = 7;
    assert_eq!(play(3, &rows)[3..], [Standing::Lost { rows: vec![Site { leaf: 1, first: false }] }]);
}

#[test]
fn triggers_count_in_the_first_cycle_alone() {
    let read = pipe("@gtt T\n| in X | out Y | dur |\n|---|---|---|\n| √T | √1, < 9 | [2,3] |\n| F | 0 | 1 |\n");
    let play = |values: &[(bool, i128)]| {
        let cycle = |(x, y): &(bool, i128)| vec![("X".to_owned(), Value::Bool(*x)), ("Y".to_owned(), int(*y))];
        run::play(&read.tables[0], Vec::new(), Vec::new(), values.iter().map(cycle)).expect("it has an automaton")
    };
    assert_eq!(play(&[(true, 1), (false, 5), (false, 0)]).last(), Some(&Standing::Ended));
    assert_eq!(
        play(&[(true, 1), (false, 5), (true, 9)]).last(),
        Some(&Standing::Lost { rows: vec![Site { leaf: 0, first: false }] })
    );
    assert_eq!(play(&[(false, 1)]), [Standing::Uncovered]);
    assert_eq!(play(&[(true, 2)]), [Standing::Lost { rows: vec![Site { leaf: 0, first: true }] }]);
}

#[test]
fn long_durations_cost_no_more_than_short_ones() {
    let weight = |high: u32| {
        let text = format!(
            "@gtt T\n| in X | out Y | dur |\n|---|---|---|\n| - | - | - |\n| - | - | [1,{high}] |\n| 1 | - | 1 |\n"
        );
        let read = pipe(&text);
        let automaton = Automaton::build(&read.tables[0]).expect("it has one");
        let mut run = run::Run::new(&read.tables[0], &automaton, Vec::new(), Vec::new());
        for _ in 0..50 {
            run.play(vec![("X".to_owned(), int(0)), ("Y".to_owned(), int(0))]);
        }
        assert_eq!(*run.standing(), Standing::Open);
        (automaton.edges.iter().map(Vec::len).sum::<usize>(), run.weight())
    };
    assert_eq!(weight(10), weight(10_000));
}

#[test]
fn a_sentence_says_what_a_row_says() {
    assert_eq!(
        sentences(&table("Normal extension")),
        [
            "for less than 500ms, while `E` is false: `Ext` is on and `Alarm` is off",
            "from then on for ever, while `E` is true and `R` is false: `Ext` is on and `Alarm` is off",
        ]
    );
    assert_eq!(
        sentences(&table("Metal or plastic"))[2],
        "for any time, perhaps none, while in the first cycle `LS1` is true and `LS2` is false: `M` is on and `S` is off"
    );
    assert_eq!(sentences(&table("Qualifier S"))[2], "for one cycle, while `G2` is true: `Q` keeps its value");
    assert_eq!(
        sentences(&table("Generalized"))[2],
        "for any time, perhaps none, while `B` equals `p + 1`: `X` is between `0` and `p`, `Y` is above `Y[-1]` and `2 * Z > Y` holds"
    );
}

#[test]
fn lints_find_what_says_nothing() {
    let text = "@gtt L (strict, global g : INT)
| # | in X  | in Free | out Y      | dur   |
|---|-------|---------|------------|-------|
| 1 | g     | -       | X[-1]      | 1     |
| 2 | -     | -       | b AND X > 3 | [0,0] |
| 3 |       | -       |            | omega |
| 4 | -     | -       | 1          | -     |
";
    let read = pipe(text);
    assert_eq!(shown(text, &read.findings), [""; 0]);
    let found: Vec<String> =
        lint(&read.tables[0]).iter().map(|f| format!("{} {}", f.code.name, f.place.span.of(text))).collect();
    assert_eq!(
        found,
        [
            "table-never-strict L",
            "table-global-once g",
            "table-free-column in Free",
            "table-early-past X[-1]",
            "table-never-reached | 2 | -     | -       | b AND X > 3 | [0,0] |",
            "table-ambiguous-boolean b AND X > 3",
            "table-blank-repeats | 3 |       | -       |            | omega |",
            "table-never-reached | 4 | -     | -       | 1          | -     |",
            "table-never-checked -",
        ]
    );
    let all: Vec<&str> = lint(&table("Normal extension")).iter().map(|f| f.code.name).collect();
    assert!(all.is_empty(), "{all:?}");
    let empty = pipe("@gtt E\n| in X | out Y | dur |\n|---|---|---|\n| 1 | 1 | - |\n");
    let all: Vec<&str> = lint(&empty.tables[0]).iter().map(|f| f.code.name).collect();
    assert_eq!(all, ["table-empty-run"]);
}

#[test]
fn every_code_has_a_page_with_an_example() {
    for code in rungbook::table::codes::ALL {
        assert!(code.page.starts_with("# ") && code.page.contains("```"), "{}", code.name);
    }
}
