//! Pipe tables.

use super::{pipe, shown};
use rungbook::table::duration::Repeat;
use rungbook::table::model::{ColumnKind, Node};

const EXTENDS: &str = "
Extends the cylinder.

@gtt Extends in time (cycle 10ms, strict, const TOUT = 500ms)
| # | in E | in R | out Ext : BOOL | out Alarm | dur     | remark     |
|---|------|------|----------------|-----------|---------|------------|
| 1 | F    | -    | T              | F         | < 500ms | travelling |
| 2 | T    | F    |                | F         | -∞      | arrived    |
";

#[test]
fn the_example_of_the_reference_reads() {
    let read = pipe(EXTENDS);
    assert_eq!(shown(EXTENDS, &read.findings), [""; 0]);
    let table = &read.tables[0];
    assert_eq!(table.name, "Extends in time");
    assert!(table.options.strict && !table.has_errors());
    assert_eq!(table.columns.iter().map(|c| c.kind).collect::<Vec<_>>(), {
        use ColumnKind::{Input, Output};
        [Input, Input, Output, Output]
    });
    let rows = table.rows();
    assert_eq!(rows[0].duration.repeat, Some(Repeat::Times { low: 0, high: Some(49) }));
    assert_eq!(rows[1].duration.repeat, Some(Repeat::Omega));
    assert!(rows[1].cells[2].is_none());
    assert_eq!(table.effective()[1][2].map(|cell| cell.text.as_str()), Some("T"));
    assert_eq!(table.place.span.of(EXTENDS).lines().count(), 5);
}

#[test]
fn places_are_in_the_file_even_behind_comment_marks_and_escapes() {
    let text = "(*\n * @gtt A (for FB_X,\n *   global g : INT with [0,5],\n *   const N = 3)\n * | in X | out Y      | dur |\n * | a \\| (b | c    | [1,N] |\n *)";
    let read = pipe(text);
    assert_eq!(shown(text, &read.findings), ["table-cell at \"\": `)` is missing at the end",]);
    assert_eq!(read.findings[0].place.span.start as usize, text.find("(b | c").map_or(0, |at| at + 2));
    let table = &read.tables[0];
    assert_eq!(table.unit.as_ref().map(|unit| unit.text.as_str()), Some("FB_X"));
    assert_eq!(table.globals[0].constraint.as_ref().map(|cell| cell.place.span.of(text)), Some("[0,5]"));
    assert_eq!(table.rows()[0].cells[1].as_ref().map(|cell| cell.place.span.of(text)), Some("c"));
    assert!(table.rows()[0].is_spoiled() && table.has_errors());
}

#[test]
fn blocks_nest_as_the_repeat_column_says() {
    let text =
        "@gtt B\n| repeat | in X |\n|---|---|\n| { { | T |\n| } x [1,3] p | F |\n| } | - |\n| { once } x 2 | T |\n";
    let read = pipe(text);
    assert_eq!(shown(text, &read.findings), [""; 0]);
    let [Node::Block(outer), Node::Block(once)] = read.tables[0].body.as_slice() else { panic!("two blocks") };
    assert_eq!(outer.duration.repeat, Some(Repeat::Omega));
    assert_eq!((once.id.as_deref(), once.children.len()), (Some("once"), 1));
    let [Node::Block(inner), Node::Row(_)] = outer.children.as_slice() else { panic!("a block and a row") };
    assert!(inner.duration.duration.has_progress());
    assert_eq!(inner.duration.repeat, Some(Repeat::Times { low: 1, high: Some(3) }));
}

#[test]
fn each_mistake_stands_at_its_cell() {
    let text = "@gtt Broken (cycle 10ms, strictly)
| # | E | in A | in A | out Y | dur | repeat |
|---|---|------|------|-------|-----|--------|
| 1 | F | 1 2  | -    | Y[+3] | 125 ms | {   |
| 1 | F | -    | -    | >     | [5,2]  | x   | more |
";
    let read = pipe(text);
    assert_eq!(
        shown(text, &read.findings),
        [
            "table-syntax at \"strictly\": a heading has no attribute `strictly`",
            "table-column at \"E\": the header does not say what column `E` is for",
            "table-column at \"in A\": column `A` is there twice",
            "table-cell at \"2\": nothing was expected here any more",
            "table-future-reference at \"[+3]\": `Y[+3]` asks for the future",
            "table-duration at \"125 ms\": 125ms is no whole number of cycles of 10ms",
            "table-block at \"{\": this block never ends",
            "table-name at \"| 1 | F | -    | -    | >     | [5,2]  | x   | more |\": two rows are named `1`",
            "table-cell at \"\": a value is missing at the end",
            "table-duration at \"[5,2]\": the upper bound is below the lower one",
            "table-block at \"x\": `x` is neither `{` nor `} x [1,3]`",
            "table-column at \"more\": this row has 8 cells, and the header has 7",
        ]
    );
    assert_eq!(read.findings[5].help, ["the nearest values are 120ms and 130ms"]);
    assert_eq!(read.tables[0].errors, 12);
}

#[test]
fn a_path_behind_the_tag_is_a_reference_and_a_lone_heading_an_error() {
    let text = "@gtt tables/FB_X.gtt\n\n@gtt Nothing here\n\ntext";
    let read = pipe(text);
    assert_eq!(read.references[0].text, "tables/FB_X.gtt");
    assert_eq!(shown(text, &read.findings), ["table-syntax at \"Nothing here\": no table follows this heading"]);
}

#[test]
fn durations_of_every_form_count() {
    for (text, low, high) in [
        ("", 1, Some(1)),
        ("7", 7, Some(7)),
        ("[1, 5]", 1, Some(5)),
        ("[2,∞]", 2, None),
        ("[2,*]", 2, None),
        ("[2,-]", 2, None),
        (">= 3", 3, None),
        ("> 3", 4, None),
        ("<=3", 0, Some(3)),
        ("< 3", 0, Some(2)),
        ("-", 0, None),
        ("*", 0, None),
        ("-p", 0, None),
        ("¬p", 0, None),
        (">=1 progress", 1, None),
        ("200 ms", 20, Some(20)),
        ("2sec", 200, Some(200)),
        ("T#1s500ms", 150, Some(150)),
        ("1s 500ms", 150, Some(150)),
        ("[TOUT, 2]", 1, Some(2)),
        ("[0, Tx - 20ms]", 0, Some(8)),
        ("5 cycles", 5, Some(5)),
    ] {
        let source = format!("@gtt D (cycle 10ms, const TOUT = 1, const Tx = 100ms)\n| in X | dur |\n| - | {text} |\n");
        let read = pipe(&source);
        assert_eq!(shown(&source, &read.findings), [""; 0], "{text}");
        assert_eq!(read.tables[0].rows()[0].duration.repeat, Some(Repeat::Times { low, high }), "{text}");
    }
    for text in ["-∞", "ω", "omega"] {
        let source = format!("@gtt D\n| in X | dur |\n| - | {text} |\n");
        assert_eq!(pipe(&source).tables[0].rows()[0].duration.repeat, Some(Repeat::Omega), "{text}");
    }
}

#[test]
fn a_column_may_be_a_projection_and_a_duration_have_its_unit_in_the_header() {
    let text = "@gtt P (cycle 10ms)\n| in A, B as A, B | out sum as X + Y | state fb.x | state! arr[2] : INT | dur [ms] |\n| leq | 5 | - | 1 | 30 |\n";
    let read = pipe(&text.replace("in A, B as", "in pair as"));
    assert_eq!(shown(text, &read.findings), [""; 0]);
    let table = &read.tables[0];
    let arguments: Vec<usize> = table.columns.iter().map(|column| column.subject.arguments()).collect();
    assert_eq!(arguments, [2, 1, 1, 1]);
    assert_eq!(table.rows()[0].duration.repeat, Some(Repeat::Times { low: 3, high: Some(3) }));
}
