//! The layout that renderers draw from.

use super::pipe;
use rungbook::table::layout::{Role, layout};
use rungbook::table::legend::Sign;

#[test]
fn inputs_come_first_blanks_merge_and_blocks_have_brackets() {
    let text = "@gtt L
| # | out Y  | in X | dur      | repeat       |
|---|--------|------|----------|--------------|
| 1 | >=5    | √T   | >= 2 p   | { {          |
| 2 |        | -    | [1,-]    | } x <=3      |
| 3 | <>Y[-1]|      | omega    | }            |
";
    let laid = layout(&pipe(text).tables[0]);
    assert_eq!(laid.groups.iter().map(|g| (g.label, g.columns)).collect::<Vec<_>>(), [("Input", 1), ("Output", 1)]);
    let cells: Vec<Vec<(&str, usize)>> =
        laid.rows.iter().map(|row| row.cells.iter().map(|c| (c.text.as_str(), c.rows)).collect()).collect();
    assert_eq!(cells, [[("√T", 1), ("≥ 5", 2)], [("–", 2), ("≥ 5", 0)], [("–", 0), ("≠ Y[-1]", 1)]]);
    let durations: Vec<(&str, bool)> =
        laid.rows.iter().map(|row| (row.duration.text.as_str(), row.duration.progress)).collect();
    assert_eq!(durations, [("≥ 2", true), ("[1, ∞]", false), ("ω", false)]);
    let brackets: Vec<(usize, usize, usize, &str)> =
        laid.brackets.iter().map(|b| (b.depth, b.first, b.last, b.label.text.as_str())).collect();
    assert_eq!(brackets, [(0, 0, 2, "ω"), (1, 0, 1, "≤3")]);
    assert_eq!(laid.rows[0].cells[1].role, Role::Condition);
    let signs: Vec<&str> = laid.legend.iter().map(|sign| sign.text()).collect();
    assert_eq!(signs, ["–", "(blank)", "≥ e", "√c", "X[-n]", "[m, n]", "p", "ω", "⎤"]);
    assert_eq!(laid.rows[0].cells[0].signs, [Sign::Trigger]);
    assert_eq!(laid.rows[1].cells[1].signs, [Sign::Blank]);
}
