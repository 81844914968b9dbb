//! Mutants of small blocks of which it is known what their tables notice.

use rungbook::evidence::coverage::{Mutants, Outcome};
use rungbook::pipeline::verify::verify;
use rungbook::prove::engine::Cancel;

use crate::support::{project, settings};

fn mutants(text: &str) -> Mutants {
    let project = project(&[("a.st", text)], "");
    let mut settings = settings("");
    settings.verify.mutants = true;
    let verified = verify(&project, &settings, 0, &Cancel::default(), &|_, _| {});
    assert_eq!(verified.internal, None);
    verified.coverage.and_then(|coverage| coverage.mutants).expect("mutants of a verified table")
}

fn told(mutants: &Mutants) -> Vec<(u32, String, &'static str)> {
    let word = |outcome| match outcome {
        Outcome::Caught { .. } => "caught",
        Outcome::Survived => "survived",
        Outcome::NotCaught { .. } => "not caught",
        Outcome::Equivalent => "equivalent",
        Outcome::Unsupported => "unsupported",
    };
    mutants.list.iter().map(|mutant| (mutant.line, mutant.change.clone(), word(mutant.outcome))).collect()
}

const TEXT: &str = "(* A counter.

   @gtt T
   | # | in A | out Q  | dur |
   |---|------|--------|-----|
   | 1 | -    | A      | -∞  |
*)
FUNCTION_BLOCK FB_Count
VAR_INPUT A : BOOL; END_VAR
VAR_OUTPUT Q : BOOL; S : INT; END_VAR
IF A THEN
  Q := TRUE;
ELSE
  Q := FALSE;
END_IF
S := S + 1;
IF S < 0 AND S >= 0 THEN
  S := 7;
END_IF
END_FUNCTION_BLOCK
";

#[test]
fn what_the_table_speaks_of_is_caught_and_the_rest_survives() {
    let mutants = mutants(TEXT);
    let told = told(&mutants);
    let of = |lines: std::ops::Range<u32>| told.iter().filter(|(line, ..)| lines.contains(line)).collect::<Vec<_>>();
    assert!(of(11..15).len() >= 7, "{told:?}");
    for mutant in of(11..15) {
        assert_eq!(mutant.2, "caught", "{told:?}");
    }
    assert!(of(16..17).len() >= 4, "{told:?}");
    for mutant in of(16..17) {
        assert_eq!(mutant.2, "survived", "{told:?}");
    }
    let deleted = told.iter().find(|(line, change, _)| *line == 18 && change == "`S := 7;` deleted");
    assert!(deleted.is_some_and(|(_, _, word)| matches!(*word, "survived" | "equivalent")), "{told:?}");
    assert_eq!(mutants.possible, mutants.list.len() as u64);
    let score = mutants.score();
    assert_eq!(score.hit, told.iter().filter(|(_, _, word)| *word == "caught").count() as u64);
}

#[test]
fn the_same_block_has_the_same_mutants() {
    assert_eq!(mutants(TEXT), mutants(TEXT));
}
