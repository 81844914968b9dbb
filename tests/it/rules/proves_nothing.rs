//! `proves-nothing`: verified tables that any block conforms to.

use rungbook::evidence::coverage::Coverage;
use rungbook::evidence::record::{Answer, Verdict};
use rungbook::pipeline;

use crate::support::{project, settings};

const TEXT: &str = "(* A lamp.\n\n   @gtt Follows\n   | # | in Switch | out Lamp | dur |\n   |---|---|---|---|\n   | 1 | T | - | 1 |\n*)\n\
                    FUNCTION_BLOCK FB_Lamp\nVAR_INPUT\n  Switch : BOOL; // s\nEND_VAR\nVAR_OUTPUT\n  Lamp : BOOL; // l\nEND_VAR\n\
                    Lamp := NOT Switch;\nEND_FUNCTION_BLOCK\n";

fn messages(vacuous: &[&str], verdict: Verdict) -> Vec<String> {
    let mut project = project(&[("a.st", TEXT)], "");
    let vacuous = vacuous.iter().map(|reason| (*reason).to_owned()).collect();
    let coverage = Some(Coverage { vacuous, ..Coverage::default() });
    pipeline::know(&mut project, &settings(""), vec![Answer { coverage, ..Answer::without_engine(verdict) }]);
    let found = project.findings.iter().filter(|finding| finding.code.name == "proves-nothing");
    found.map(|finding| finding.message.clone()).collect()
}

#[test]
fn a_verdict_without_content_is_found() {
    let expected = "test table `Follows` is verified and proves nothing: no row says anything";
    assert_eq!(messages(&["no row says anything"], Verdict::Verified), [expected]);
    assert_eq!(messages(&[], Verdict::Verified), [""; 0]);
    assert_eq!(messages(&["no row says anything"], Verdict::Bounded { cycles: 3 }), [""; 0]);
}
