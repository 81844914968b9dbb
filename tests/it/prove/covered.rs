//! What proofs covered, of small blocks with known answers; every answer with a run has been played on the interpreter and the
//! game before it is given.

use rungbook::evidence::coverage::{Coverage, Fate, Kind};
use rungbook::pipeline::verify::{Verified, verify};
use rungbook::prove::engine::Cancel;
use rungbook::prove::verdict::Verdict;

use crate::support::{project, settings};

fn verified(text: &str) -> Verified {
    let project = project(&[("a.st", text)], "");
    verify(&project, &settings(""), 0, &Cancel::default(), &|_, _| {})
}

/// The coverage of the only table of a text.
fn coverage(text: &str) -> Coverage {
    let verified = verified(text);
    assert!(matches!(verified.verdict, Verdict::Verified(_)), "{:?}", verified.verdict);
    assert_eq!(verified.internal, None);
    verified.coverage.expect("a verified table has a coverage")
}

fn fates(coverage: &Coverage, kind: Kind) -> Vec<(String, String)> {
    let own = coverage.items.iter().filter(|item| item.kind == kind);
    own.map(|item| (item.name.clone(), item.fate.text())).collect()
}

const LAMP: &str = "(* A lamp.

   @gtt T
   | # | in A | in N | out Q | out R | dur   |
   |---|------|------|-------|-------|-------|
   | 1 | F    | -    | F     | -     | [1,∞] |
   | 2 | T    | < 5  | T     | FALSE | 2     |
   | 3 | T    | 9    | T     | -     | 1     |
   | 4 | F    | -    | F     | -     | 1     |
*)
FUNCTION_BLOCK FB_Lamp
VAR_INPUT A : BOOL; N : INT; END_VAR
VAR_OUTPUT Q : BOOL; R : BOOL; S : INT; END_VAR
VAR c : INT; END_VAR
IF A THEN
  Q := TRUE;
  c := c + 1;
ELSE
  Q := FALSE;
  c := 0;
END_IF
IF c > 3 THEN
  S := 3;
END_IF
IF N = 9 AND c = 3 THEN
  S := 4;
END_IF
IF FALSE THEN
  R := TRUE;
END_IF
END_FUNCTION_BLOCK
";

#[test]
fn rows_statements_and_branches_have_their_fates() {
    let coverage = coverage(LAMP);
    assert_eq!((coverage.rows.hit, coverage.rows.total), (4, 4), "{coverage:?}");
    let missed: Vec<(String, String)> =
        coverage.missed().filter(|i| i.kind == Kind::Statement).map(|i| (i.name.clone(), i.fate.text())).collect();
    let never = |name: &str| (name.to_owned(), "never".to_owned());
    assert_eq!(missed, [never("S := 3;"), never("R := TRUE;")]);
    let branches = fates(&coverage, Kind::Branch);
    let fate = |name: &str| branches.iter().find(|(own, _)| own == name).map(|(_, fate)| fate.as_str());
    assert_eq!(fate("c > 3: holds"), Some("never"), "{branches:?}");
    assert!(fate("N = 9 AND c = 3: holds").is_some_and(|fate| fate.starts_with("in cycle")), "{branches:?}");
    assert_eq!(coverage.free_outputs, ["S"]);
    assert_eq!(coverage.free_cells.len(), 1);
    assert_eq!(
        (coverage.free_cells[0].output.as_str(), coverage.free_cells[0].rows.join(",")),
        ("R", "1,3,4".to_owned())
    );
    assert!(coverage.vacuous.is_empty());
}

#[test]
fn witnesses_are_as_long_as_they_say() {
    let coverage = coverage(LAMP);
    for item in &coverage.items {
        if let Fate::Reached { witness, cycle } = item.fate {
            let length: u64 = coverage.witnesses[witness].stretches.iter().map(|stretch| stretch.cycles).sum();
            assert!(cycle >= 1 && cycle as u64 <= length, "{item:?}");
        }
    }
}

#[test]
fn the_same_question_has_the_same_answer() {
    assert_eq!(coverage(LAMP), coverage(LAMP));
}

#[test]
fn a_row_that_no_input_leads_to_is_never_reached() {
    let text =
        LAMP.replace("| 3 | T    | 9    | T     | -     | 1     |", "| 3 | T    | > 5, < 3 | T     | -     | 1     |");
    let coverage = coverage(&text);
    let rows = fates(&coverage, Kind::Row);
    let told: Vec<&str> = rows.iter().map(|(_, fate)| fate.as_str()).collect();
    assert!(told[0].starts_with("in cycle") && told[1].starts_with("in cycle"), "{rows:?}");
    assert_eq!(told[2..], ["never", "never"]);
}

#[test]
fn a_table_without_content_says_so() {
    let free = "(* A lamp.\n\n   @gtt T\n   | # | in A | out Q | dur |\n   |---|---|---|---|\n   | 1 | - | - | -∞ |\n*)\n\
                FUNCTION_BLOCK FB_Lamp\nVAR_INPUT A : BOOL; END_VAR\nVAR_OUTPUT Q : BOOL; END_VAR\nQ := A;\nEND_FUNCTION_BLOCK\n";
    let reasons = coverage(free).vacuous;
    assert_eq!(reasons, ["no row that a run reaches constrains an output"]);
    let tautology = free.replace("| 1 | - | - |", "| 1 | - | Q = Q |");
    assert_eq!(coverage(&tautology).vacuous, reasons, "a cell that always holds says nothing");
    let unreached = free.replace("| 1 | - | - |", "| 1 | A AND NOT A = TRUE, A = FALSE, A = TRUE | T |");
    assert_eq!(coverage(&unreached).vacuous, ["no run reaches a row of the table"]);
    let says = free.replace("| 1 | - | - |", "| 1 | - | A |");
    assert!(coverage(&says).vacuous.is_empty());
}

#[test]
fn a_row_after_a_long_wait_is_reached() {
    let text = "(* A lamp.\n\n   @gtt T\n   | # | in A | out Q | dur |\n   |---|---|---|---|\n   | 1 | T | F | 40 |\n   | 2 | T | T | -∞ |\n*)\n\
                FUNCTION_BLOCK FB_Lamp\nVAR_INPUT A : BOOL; END_VAR\nVAR_OUTPUT Q : BOOL; END_VAR\nVAR c : UINT; END_VAR\n\
                IF NOT A THEN\n  c := 0;\nELSIF c < 41 THEN\n  c := c + 1;\nEND_IF\nQ := c > 40;\nEND_FUNCTION_BLOCK\n";
    let coverage = coverage(text);
    assert_eq!((coverage.rows.hit, coverage.rows.total), (2, 2), "{coverage:?}");
    let missed: Vec<&str> = coverage.missed().map(|item| item.name.as_str()).collect();
    assert_eq!(missed, ["c := 0;", "NOT A: holds"]);
}

#[test]
fn a_row_behind_a_long_wait_with_given_inputs_is_reached() {
    let text = "(* A valve.

   @gtt T
   | # | in A | in B | in C | out Q | dur |
   |---|------|------|------|-------|-----|
   | 1 | 1234 | 4711 | 16#8 | F     | 100 |
   | 2 | 1234 | -77  | 16#8 | T     | 1   |
   | 3 | 99   | -77  | 16#8 | F     | 1   |
*)
FUNCTION_BLOCK FB_Valve
VAR_INPUT A : INT; B : INT; C : INT; END_VAR
VAR_OUTPUT Q : BOOL; END_VAR
VAR c1 : UINT; END_VAR
IF A = 1234 AND C = 8 THEN
  c1 := c1 + 1;
END_IF
Q := c1 = 101 AND B = -77 AND A = 1234;
IF c1 > 101 THEN
  c1 := 0;
END_IF
END_FUNCTION_BLOCK
";
    let coverage = coverage(text);
    assert_eq!((coverage.rows.hit, coverage.rows.total), (3, 3), "{coverage:?}");
    let missed: Vec<(&str, String)> = coverage.missed().map(|item| (item.name.as_str(), item.fate.text())).collect();
    assert_eq!(missed, [("c1 := 0;", "never".to_owned()), ("c1 > 101: holds", "never".to_owned())]);
}
