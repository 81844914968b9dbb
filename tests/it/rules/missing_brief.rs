//! `missing-brief`: documentation that begins with no line to show.

use crate::support::in_text;

#[test]
fn tags_alone_are_no_brief() {
    let text = "(* @param x open *)\nFUNCTION_BLOCK FB_Valve\nVAR_INPUT\n  x : BOOL;\nEND_VAR\nEND_FUNCTION_BLOCK\n";
    let found = in_text("missing-brief", text);
    assert_eq!(found, ["a.st:1:1 the documentation of `FB_Valve` has no brief description"]);
}

#[test]
fn one_line_is_enough() {
    let text = "(* Opens and closes.\n   @param x open *)\nFUNCTION_BLOCK FB_Valve\nVAR_INPUT\n  x : BOOL;\nEND_VAR\nEND_FUNCTION_BLOCK\n";
    assert_eq!(in_text("missing-brief", text), [""; 0]);
}
