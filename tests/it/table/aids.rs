//! What helps to read a table: its legend, what a cell tells, its automaton, a run that conforms.

use rungbook::book::view::table::TableView;

use crate::html::{site, text};
use crate::support;

const TREE: &str = "\
FUNCTION_BLOCK FB
VAR_INPUT A : INT; B : BOOL; END_VAR
VAR_OUTPUT X : INT; Y : BOOL; END_VAR
END_FUNCTION_BLOCK
";

const TABLE: &str = "\
@gtt T (cycle 10ms, global p : INT with [3, 9])
| # | in A     | in B | out X   | out Y | dur     | remark | repeat    |
|---|----------|------|---------|-------|---------|--------|-----------|
| 1 | > 3, < 8 | F    | p       | F     | -       | idle   |           |
| 2 | -        | √T   | >X[-1]  |       | [2,5] p | moves  | {         |
| 3 | 7        | F    | -       | T     | 1       |        | } x [1,3] |
| 4 | 9        | T    | -       | T     | -∞      | done   |           |
";

fn book(table: &str) -> rungbook::book::view::Book {
    support::book(&support::project(&[("a.st", TREE), ("FB.gtt.md", table)], ""))
}

fn view(table: &str) -> TableView {
    let mut book = book(table);
    let mut tables = std::mem::take(&mut book.entities[0].tables);
    assert!(tables[0].errors.is_empty(), "{:?}", tables[0].errors);
    tables.swap_remove(0)
}

fn long(rows: usize) -> String {
    let rows: Vec<String> = (0..rows).map(|row| format!("| {row} | {row} | - | - | T | 1 |\n")).collect();
    format!("@gtt L\n| # | in A | in B | out X | out Y | dur |\n|---|---|---|---|---|---|\n{}", rows.concat())
}

#[test]
fn the_legend_has_what_the_table_uses_and_nothing_else() {
    let signs: Vec<&str> = view(TABLE).legend.iter().map(|sign| sign.text).collect();
    assert_eq!(signs, ["–", "(blank)", "≥ e", "c, d", "√c", "X[-n]", "p", "–", "[m, n]", "p", "ω", "⎤"]);
    let plain = view("@gtt P\n| # | in A | out X | dur |\n|---|---|---|---|\n| 1 | 1 | 2 | 3 |\n");
    assert_eq!(plain.legend, []);
}

#[test]
fn the_first_cell_of_each_sign_is_a_stop_of_the_keyboard_and_leads_to_the_legend() {
    let pages = site(&book(TABLE));
    let page = pages.iter().find(|page| page.path.ends_with("fb.html")).expect("the page of the block");
    let html = text(&pages, &page.path);
    let described: Vec<&str> =
        html.split("aria-describedby=\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
    let mut ids: Vec<&str> = described.iter().flat_map(|ids| ids.split(' ')).collect();
    ids.sort_unstable();
    let count = ids.len();
    ids.dedup();
    assert_eq!(ids.len(), count, "each sign has one stop: {described:?}");
    for id in &ids {
        assert!(html.contains(&format!("<div id=\"{id}\"><dt>")), "{id} is in the legend");
    }
    // All of the legend but the bracket, which stands in no cell.
    assert_eq!(count, view(TABLE).legend.len() - 1);
    assert!(html.contains("√c  c in the first cycle of the row, then anything"), "told at the cell");
}

#[test]
fn the_automaton_is_drawn_for_short_tables_and_the_page_says_why_not_for_long_ones() {
    let aid = view(TABLE).automaton;
    let svg = aid.diagram.expect("a drawing").svg;
    for text in [">1<", ">4<", ">[1, 3]<", ">ω<", ">moves<"] {
        assert!(svg.contains(text), "{text}");
    }
    assert!(!svg.contains(">end<"), "row 4 lasts for ever");
    assert!(aid.note.contains("left out") && aid.note.contains("dashed"), "{}", aid.note);
    let long = view(&long(41)).automaton;
    assert!(long.diagram.is_none());
    assert_eq!(long.note, "The automaton is drawn for up to 40 rows; this table has 41.");
}

#[test]
fn a_run_that_conforms_is_drawn_and_the_page_says_why_not() {
    let aid = view(TABLE).example;
    assert!(aid.note.starts_with("One run that satisfies the table: ") && aid.note.contains("p = "), "{}", aid.note);
    let svg = aid.diagram.expect("a drawing").svg;
    for lane in ["row", "A", "B", "X", "Y"] {
        assert!(svg.contains(&format!(">{lane}</text>")), "{lane}");
    }
    let long = view(&long(101)).example;
    assert_eq!(long.note, "No example run is shown: it has more than 100 rows.");
    let contradiction =
        view("@gtt C\n| # | in A | out X | dur |\n|---|---|---|---|\n| 1 | > 3, < 2 | 2 | 3 |\n").example;
    assert!(contradiction.diagram.is_none());
    assert_eq!(contradiction.note, "No example run is shown: no run was found that satisfies its cells.");
}

#[test]
fn the_header_of_a_long_table_stays_in_sight() {
    let has = |rows: usize| {
        let pages = site(&book(&long(rows)));
        pages.iter().any(|page| String::from_utf8_lossy(&page.bytes).contains("class=\"scroll long\""))
    };
    assert!(has(19) && !has(18));
    let css = include_str!("../../../themes/style.css");
    assert!(css.contains(".scroll.long .gtt thead { position: sticky; top: 0;"));
}
