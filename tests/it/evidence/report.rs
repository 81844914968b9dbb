//! The evidence report's text.

use rungbook::evidence::coverage::{Coverage, Fate, Item, Kind};
use rungbook::evidence::record::Record;
use rungbook::evidence::report::{Input, markdown};

use super::records::{claim, origin, verified};

fn item(kind: Kind, line: u32, fate: Fate) -> Item {
    Item { kind, name: format!("at {line}"), file: "FB_Cyl.st".to_owned(), line, fate }
}

fn record(table: &str, items: Vec<Item>) -> Record {
    let mut claim = claim();
    table.clone_into(&mut claim.table.name);
    let mut answer = verified();
    answer.coverage = Some(Coverage { items, ..Coverage::default() });
    Record::new(claim, &answer, origin())
}

#[test]
fn what_one_table_reaches_is_no_hole_of_its_block() {
    let reached = Fate::Reached { witness: 0, cycle: 1 };
    let one = record(
        "One",
        vec![
            item(Kind::Row, 3, Fate::Never),
            item(Kind::Statement, 40, Fate::Never),
            item(Kind::Statement, 50, reached),
            item(Kind::Statement, 60, Fate::NotWithin { cycles: 9 }),
        ],
    );
    let other = record(
        "Other",
        vec![
            item(Kind::Statement, 40, reached),
            item(Kind::Statement, 50, Fate::Never),
            item(Kind::Statement, 60, Fate::Never),
        ],
    );
    let origin = origin();
    let records = [&one, &other];
    let input = Input {
        title: "Cylinders",
        version: "1",
        origin: &origin,
        records: &records,
        documented: (1, 1),
        undocumented: &[],
        allowed: &[],
        matrix: &[],
        outside: &[],
        changes: None,
        sign_off: &[],
    };
    let text = markdown(&input);
    let holes = text.split("## What verified tables do not cover").nth(1).expect("there are holes");
    let holes = holes.split("\n## ").next().unwrap_or_default();
    assert!(holes.contains("row at 3"), "{holes}");
    assert!(holes.contains("statement at 60") && holes.contains("by none of its tables"), "{holes}");
    assert_eq!(holes.matches("at 60").count(), 1, "once for both tables: {holes}");
    assert!(!holes.contains("at 40") && !holes.contains("at 50"), "{holes}");
}
