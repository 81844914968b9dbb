//! `undocumented-member`: methods, properties and interface variables without a comment.

use crate::support::in_text;

#[test]
fn variables_are_named_together_at_the_first() {
    let text = "// Opens and closes.\nFUNCTION_BLOCK FB_Valve\nVAR_INPUT\n  a : BOOL;\n  b : BOOL; // known\n  c : BOOL;\n\
                END_VAR\nVAR\n  inner : INT;\nEND_VAR\nEND_FUNCTION_BLOCK\n";
    assert_eq!(in_text("undocumented-member", text), ["a.st:4:3 `a`, `c` of `FB_Valve` have no documentation"]);
}

#[test]
fn a_bare_method_is_found_and_a_private_one_is_not() {
    let text = "// Opens and closes.\nFUNCTION_BLOCK FB_Valve\nMETHOD Open : BOOL\nEND_METHOD\n\
                METHOD PRIVATE Check : BOOL\nEND_METHOD\nEND_FUNCTION_BLOCK\n";
    assert_eq!(in_text("undocumented-member", text), ["a.st:3:8 method `FB_Valve.Open` has no documentation"]);
}

#[test]
fn a_method_that_implements_a_documented_one_has_its_documentation() {
    let text = "// Moves.\nINTERFACE I_Valve\n// Opens.\nMETHOD Open : BOOL\nEND_METHOD\nEND_INTERFACE\n\
                // Opens and closes.\nFUNCTION_BLOCK FB_Valve IMPLEMENTS I_Valve\nMETHOD Open : BOOL\nEND_METHOD\n\
                END_FUNCTION_BLOCK\n";
    assert_eq!(in_text("undocumented-member", text), [""; 0]);
}
