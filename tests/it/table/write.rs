//! What was written reads again as the same model.

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use rungbook::table::cell::print::{Style, constraint};
use rungbook::table::model::{Cell, Node, Table};
use rungbook::table::read::{self, Options, Read};
use rungbook::table::{Piece, write};
use rungbook::text::FileId;

use super::{any, gtt, pipe, shown};

/// The model without places: everything that a reader of the table can see.
fn shape(table: &Table) -> String {
    let cell = |cell: &Option<Cell>| match cell {
        Some(Cell { constraint: Some(read), .. }) => constraint(read, Style::Ascii),
        Some(cell) => format!("?{}", cell.text),
        None => "blank".to_owned(),
    };
    let mut out = format!(
        "{} {:?} {:?}\n",
        table.name,
        table.unit.as_ref().map(|u| &u.text),
        table.options.cycle.map(|c| c.nanos)
    );
    out += &format!("{} {}\n", table.options.strict, table.options.concrete);
    for (key, value) in &table.options.entries {
        out += &format!("option {} {}\n", key.text, value.text);
    }
    for column in &table.columns {
        let subject = write::pipe(&Table { columns: vec![column.clone()], ..Table::clone(table) }).content;
        out += &format!(
            "{:?} {} {:?} {}\n",
            column.kind,
            column.name,
            column.ty.as_ref().map(|t| &t.text),
            subject.lines().nth(1).unwrap_or("")
        );
    }
    for global in &table.globals {
        out += &format!("{} {:?} {}\n", global.name, global.ty.as_ref().map(|t| &t.text), cell(&global.constraint));
    }
    out += &format!("{:?}\n", table.constants.iter().map(|c| (&c.name, c.value)).collect::<Vec<_>>());
    fn visit(nodes: &[Node], cell: &dyn Fn(&Option<Cell>) -> String, out: &mut String) {
        for node in nodes {
            match node {
                Node::Row(row) => {
                    let cells: Vec<String> = row.cells.iter().map(cell).collect();
                    let remark = row.remark.as_ref().map(|remark| &remark.text);
                    *out += &format!("{} {cells:?} {:?} {remark:?}\n", row.id, row.duration.duration);
                }
                Node::Block(block) => {
                    *out += &format!("{{ {:?} {:?}\n", block.id, block.duration.duration);
                    visit(&block.children, cell, out);
                    *out += "}\n";
                }
            }
        }
    }
    let mut rows = Table { columns: Vec::new(), ..table.clone() };
    rows.globals.clear();
    visit(&rows.body, &cell, &mut out);
    out
}

fn cell() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "",
        "-",
        "1",
        "TRUE",
        ">= 5",
        "< 3, <> g",
        "[1,5]",
        "(0, ∞]",
        "a > 3 AND g < 2",
        "= a > 3",
        "√T",
        "X[-2] + 1",
        "if :: a = 1 -> 5 :: TRUE -> >= 6 fi",
        "SEL(G := NOT b, IN0 := 1, IN1 := MAX(1, 2))",
        "a OR b | c",
        "T#5ms",
        "Colour#RED",
        "fb.x[3].y",
        "'it; is} a \"text'",
        ">= 1 AND <= 5",
        "-(-a) ** 2",
    ])
}

fn duration() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "",
        "7",
        "[1, 5]",
        "[2,∞]",
        ">= 3",
        "> 3",
        "<= 3",
        "< 50 ms",
        "-",
        "-p",
        ">=1 progress",
        "omega",
        "[K, 20]",
        "[0, K - 2]",
    ])
}

/// The source of a random table, in pipes.
fn source() -> impl Strategy<Value = String> {
    let row =
        (cell(), cell(), cell(), duration(), prop::sample::select(vec!["", "a remark", "100 % & <more>"]), 0_u8..6);
    prop::collection::vec(row, 1..6).prop_map(|rows| {
        let mut out = "@gtt Some name, (odd) (for FB_X, cycle 10ms, strict, const K = 4, global g : INT with >=0, <= 9, global h, option a.b = 7)\n".to_owned();
        out += "| # | in a : INT | out o | state fb.x | out sum : INT as a + b | dur | repeat | remark |\n|--|--|--|--|--|--|--|--|\n";
        let mut open = 0_usize;
        let last = rows.len() - 1;
        for (at, (a, o, x, duration, remark, mark)) in rows.into_iter().enumerate() {
            let mut repeat = ["{", "{ { deep", "{ } x [1,3] p"].get(usize::from(mark)).copied().unwrap_or("").to_owned();
            open += [1, 2].get(usize::from(mark)).copied().unwrap_or(0);
            if mark == 4 && open > 0 {
                repeat += "} x >=2";
                open -= 1;
            }
            if at == last {
                repeat += &" } x 2".repeat(open);
            }
            let escape = |text: &str| text.replace('|', "\\|");
            out += &format!("| r{at} | {} | {} | {} | - | {duration} | {repeat} | {remark} |\n", escape(a), escape(o), escape(x));
        }
        out
    })
}

fn csv(text: &str) -> Read {
    read::sheet::csv(&Piece::verbatim(FileId(0), text, 0), "Sheet", &Options::default())
}

fn same(text: &str) -> Result<(), TestCaseError> {
    let first = pipe(text);
    let table = &first.tables[0];
    let wanted = shape(table);
    let check = |form: &str, content: &str, read: &Read, wanted: &str| {
        let found = read.tables.first().map(shape).unwrap_or_default();
        prop_assert_eq!(&found, wanted, "{} {:?}\n{}\n{}", form, shown(content, &read.findings), content, text);
        Ok(())
    };
    let written = write::pipe(table).content;
    check("pipe", &written, &pipe(&written), &wanted)?;
    prop_assert_eq!(&write::format_in_place(&written), &written);
    let written = write::gtt(table).content;
    check("gtt", &written, &gtt(&written), &wanted)?;
    let written = write::csv(table).map_err(TestCaseError::fail)?.content;
    check("csv", &written, &csv(&written), &wanted)?;
    let written = write::xlsx(&[table]).map_err(TestCaseError::fail)?.content;
    let read = read::sheet::workbook(FileId(0), &written, &Options::default());
    check("xlsx", "", &read, &wanted)?;
    let written = write::ods(&[table]).map_err(TestCaseError::fail)?.content;
    let read = read::sheet::workbook(FileId(0), &written, &Options::default());
    check("ods", "", &read, &wanted)?;
    // Where a column is bound to something else than its name, exteta loses it.
    let mut plain = table.clone();
    plain.columns.truncate(3);
    truncate(&mut plain.body, 3);
    let written = write::exteta(&plain).content;
    check("exteta", &written, &any(&written), &shape(&plain))
}

fn truncate(nodes: &mut [Node], columns: usize) {
    for node in nodes {
        match node {
            Node::Row(row) => row.cells.truncate(columns),
            Node::Block(block) => truncate(&mut block.children, columns),
        }
    }
}

#[test]
fn every_form_gives_the_model_back() {
    let config = Config { cases: crate::support::cases_or(250), failure_persistence: None, ..Config::default() };
    if let Err(error) = TestRunner::new(config).run(&source(), |text| same(&text)) {
        panic!("{error}");
    }
}

#[test]
fn formatting_touches_nothing_but_the_blanks_in_tables() {
    let text = "(* A | B\n * @gtt T\n * |#|in a|out b|\n * |---|---|---|\n * |1|  x \\| y |√T|\n *\n * | no | table |\n *)\r\nVAR a|b END_VAR";
    let wanted = "(* A | B\n * @gtt T\n * | # | in a   | out b |\n * |---|--------|-------|\n * | 1 | x \\| y | √T    |\n *\n * | no | table |\n *)\r\nVAR a|b END_VAR";
    assert_eq!(write::format_in_place(text), wanted);
    assert_eq!(write::format_in_place(wanted), wanted);
}

#[test]
fn the_layouts_of_spreadsheets_read() {
    let papers =
        "Seq.;Input;;Output;Duration;Remark\n;Level;Pump;Alarm;ms;\n1;2,5;ON;FALSE;10;go\n2;;OFF;\"= a;b\";20;\n";
    let read = csv(papers);
    let messages = shown(papers, &read.findings);
    assert_eq!(
        messages[..2],
        [
            "table-import-guess at \"2,5\": `2,5` is read as `2.5`",
            "table-import-guess at \"ON\": `ON` is read as `TRUE`",
        ]
    );
    assert!(messages.iter().any(|m| m.starts_with("table-cell at \";\"")), "{messages:?}");
    let columns: Vec<&str> = read.tables[0].columns.iter().map(|column| column.name.as_str()).collect();
    assert_eq!(columns, ["Level", "Pump", "Alarm"]);
    let library = "State,testtime,Q,ET,#,IN,PT,#,Purpose\n0,10,FALSE,T#0ms,,FALSE,T#5ms,,rest\n1,20,TRUE,,,TRUE,,,on\n";
    let table = &csv(library).tables[0];
    let columns: Vec<(&str, bool)> = table.columns.iter().map(|c| (c.name.as_str(), c.kind.is_assumption())).collect();
    assert_eq!(columns, [("Q", false), ("ET", false), ("IN", true), ("PT", true)]);
    assert_eq!(table.rows()[1].remark.as_ref().map(|remark| remark.text.as_str()), Some("on"));
    assert_eq!(table.effective()[1][3].map(|cell| cell.text.as_str()), Some("T#5ms"));
    assert!(csv("a,b\n1,2\n").has_errors());
    assert!(read::sheet::workbook(FileId(0), b"PK\x03\x04 no workbook", &Options::default()).has_errors());
}
