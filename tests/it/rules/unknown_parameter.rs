//! `unknown-parameter`: tags that name nothing.

use crate::support::{in_text, project};

const TEXT: &str = "(* Opens and closes.\n   @param Opne open while true *)\nFUNCTION_BLOCK FB_Valve\nVAR_INPUT\n  \
                    Open : BOOL; // open\nEND_VAR\nEND_FUNCTION_BLOCK\n";

#[test]
fn a_misspelt_name_is_found_with_the_nearest_one() {
    assert_eq!(in_text("unknown-parameter", TEXT), ["a.st:2:11 `FB_Valve` has no parameter `Opne`"]);
    let project = project(&[("a.st", TEXT)], "");
    let finding = project.findings.iter().find(|finding| finding.code.name == "unknown-parameter").expect("found");
    assert_eq!(finding.help, ["did you mean `Open`?"]);
}

#[test]
fn letter_case_does_not_matter_and_bases_count() {
    let text = "(* Base. *)\nFUNCTION_BLOCK FB_Base\nVAR_INPUT\n  Open : BOOL; // open\nEND_VAR\nEND_FUNCTION_BLOCK\n\
                (* Derived.\n   @param OPEN open *)\nFUNCTION_BLOCK FB_Valve EXTENDS FB_Base\nEND_FUNCTION_BLOCK\n";
    assert_eq!(in_text("unknown-parameter", text), [""; 0]);
}
