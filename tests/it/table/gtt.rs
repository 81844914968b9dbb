//! The language of geteta.

use super::{gtt, shown};
use rungbook::diagnostic::Severity;
use rungbook::table::duration::Repeat;
use rungbook::table::model::{ColumnKind, Control, Node, Subject};

#[test]
fn declarations_groups_and_rows() {
    let text = "
// a valve
table Valve {
    var input open, shut as closed : BOOL
    var state assert count : INT;
    column output sum : INT as a + b
    column assume pair as a, b
    gvar p : INT with >= 0, <= 5
    gvar q : INT
    timeconst TOUT : 7
    options { technique = IC3; cycles.1 = -10 }
    group 0 [1, 1] {
        row first TOUT_IS_NO_DURATION { open: TRUE }
        row [0,TOUT] progress { open: FALSE closed: T; sum: =p+q // not part of the cell
            pair: leq }
        group omega {
            row 7 { count: count[-1] + 1 }
            row >=1 { }
        }
    }
    FUNCTION f : INT VAR_INPUT x : INT; END_VAR f := x; END_FUNCTION
}
";
    let read = gtt(&text.replace(" TOUT_IS_NO_DURATION", ""));
    assert_eq!(shown(text, &read.findings), [""; 0]);
    let table = &read.tables[0];
    let kinds: Vec<(&str, ColumnKind)> = table.columns.iter().map(|c| (c.name.as_str(), c.kind)).collect();
    assert_eq!(
        kinds,
        [
            ("open", ColumnKind::Input),
            ("closed", ColumnKind::Input),
            ("count", ColumnKind::StateAssertion),
            ("sum", ColumnKind::Output),
            ("pair", ColumnKind::Input),
        ]
    );
    assert!(matches!(&table.columns[1].subject, Subject::Variable(path) if path.name == "shut"));
    let ids: Vec<&str> = table.rows().iter().map(|row| row.id.as_str()).collect();
    assert_eq!(ids, ["first", "2", "7", "4"]);
    assert_eq!(table.rows()[1].duration.repeat, Some(Repeat::Times { low: 0, high: Some(7) }));
    assert_eq!(table.rows()[1].cells[3].as_ref().map(|cell| cell.text.as_str()), Some("=p+q"));
    let [Node::Row(_), Node::Row(_), Node::Block(block)] = table.body.as_slice() else {
        panic!("two rows and a block")
    };
    assert_eq!(block.duration.repeat, Some(Repeat::Omega));
    assert_eq!(table.functions[0].name, "f");
    assert_eq!(table.options.entries[1].1.text, "-10");
}

#[test]
fn rows_and_tables_inherit() {
    let text = "
table A { var input x : INT var output y : INT gvar g : INT
    group { row a { x: 1; y: 2 } } }
table B { \\inherit_from A; var output z : INT
    group { row b { \\inherit_from A a; y: g; z: 3 } row c { \\inherit_from A missing } } }
";
    let read = gtt(text);
    assert_eq!(shown(text, &read.findings), ["table-name at \"missing\": `A` has no row named `missing`"]);
    let row = read.tables[1].rows()[0];
    let cells: Vec<&str> = row.cells.iter().flatten().map(|cell| cell.text.as_str()).collect();
    assert_eq!(cells, ["1", "g", "3"]);
    assert_eq!(read.tables[1].globals.len(), 1);
}

#[test]
fn relational_tables_name_their_runs() {
    let text = "
relational table R(old, new) {
    var input {old, new} a, b : BOOL
    var output 1|>c as d : INT
    group { row { \\pause: 1, old  old|>a: =new::a, TRUE  0::b: F  new|>d: 5 } }
}";
    let read = gtt(text);
    let table = &read.tables[0];
    let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
    assert_eq!(names, ["old::a", "new::a", "old::b", "new::b", "new::d"]);
    let row = table.rows()[0];
    assert_eq!(row.cells.iter().map(Option::is_some).collect::<Vec<_>>(), [true, false, true, false, true]);
    assert!(matches!(&row.controls[0], Control::Pause(runs) if runs.len() == 2 && runs[0].text == "new"));
    assert_eq!(
        shown(text, &read.findings),
        ["table-unsupported at \"\\\\pause\": `\\pause` is kept and has no meaning here"]
    );
}

#[test]
fn old_spellings_are_read_and_mentioned() {
    let text =
        "table T { var input e : ENUM ENUM var output o : INT group omega { row >=0 _p { e: A } row [0,1]>> { } } }";
    let read = gtt(text);
    assert!(
        read.findings.iter().all(|finding| finding.severity == Severity::Info),
        "{:?}",
        shown(text, &read.findings)
    );
    assert_eq!(read.findings.len(), 3);
    assert!(read.tables[0].rows().iter().all(|row| row.duration.duration.has_progress()));
}

#[test]
fn mistakes_are_found_where_they_are_and_the_rest_is_read() {
    let text = "
table A { prev var input i : INT group { row { i: 2(x) ; j: 1 } root - { i: 1 } row { i: 5 } } }
nonsense
table B { var i : INT group { row a { i: 1 } } ";
    let read = gtt(text);
    assert_eq!(
        shown(text, &read.findings),
        [
            "table-syntax at \"prev\": a declaration or `group` was expected before `prev`",
            "table-cell at \"(\": nothing was expected here any more",
            "table-column at \"j\": no column is named `j`",
            "table-syntax at \"root\": `row` or `group` was expected before `root`",
            "table-syntax at \"nonsense\": `nonsense` begins no table",
            "table-syntax at \"i\": `input`, `output` or `state` was expected before `i`",
            "table-column at \"i\": no column is named `i`",
        ]
    );
    assert_eq!(read.tables[0].rows().len(), 2);
}
