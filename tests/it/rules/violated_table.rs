//! `violated-table`: tables with a run that violates them.

use rungbook::evidence::record::{Answer, Verdict};
use rungbook::pipeline;

use crate::support::{project, settings};

const TEXT: &str = "(* A lamp.\n\n   @gtt Follows\n   | # | in Switch | out Lamp | dur |\n   |---|---|---|---|\n   | 1 | T | T | 1 |\n*)\n\
                    FUNCTION_BLOCK FB_Lamp\nVAR_INPUT\n  Switch : BOOL; // s\nEND_VAR\nVAR_OUTPUT\n  Lamp : BOOL; // l\nEND_VAR\n\
                    Lamp := NOT Switch;\nEND_FUNCTION_BLOCK\n";

/// The codes of the two rules about verdicts, once `verdict` is known of the table.
fn codes(verdict: Verdict) -> Vec<&'static str> {
    let mut project = project(&[("a.st", TEXT)], "");
    pipeline::know(&mut project, &settings(""), vec![Answer::without_engine(verdict)]);
    let found = project.findings.iter().map(|finding| finding.code.name);
    found.filter(|name| matches!(*name, "violated-table" | "unverified-table")).collect()
}

#[test]
fn a_verdict_decides_which_rule_speaks() {
    assert_eq!(codes(Verdict::Violated), ["violated-table"]);
    assert_eq!(codes(Verdict::Unverified), ["unverified-table"]);
    assert_eq!(codes(Verdict::Bounded { cycles: 3 }), ["unverified-table"]);
    assert_eq!(codes(Verdict::Verified), [""; 0]);
}
