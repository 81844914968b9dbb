//! `undocumented`: public top-level entities without a comment.

use crate::support::in_text;

#[test]
fn a_bare_block_is_found_at_its_name() {
    let found = in_text("undocumented", "\nFUNCTION_BLOCK FB_Valve\nEND_FUNCTION_BLOCK\n");
    assert_eq!(found, ["a.st:2:16 function block `FB_Valve` has no documentation"]);
}

#[test]
fn every_kind_of_entity_is_looked_at() {
    let text = "FUNCTION F : INT\nEND_FUNCTION\nPROGRAM P\nEND_PROGRAM\nINTERFACE I\nEND_INTERFACE\n\
                TYPE S : STRUCT a : INT; END_STRUCT END_TYPE\nTYPE E : (One, Two); END_TYPE\nTYPE A : INT; END_TYPE\n";
    assert_eq!(in_text("undocumented", text).len(), 6);
}

#[test]
fn a_comment_above_below_or_behind_the_variables_is_documentation() {
    for text in [
        "// Opens and closes.\nFUNCTION_BLOCK FB_Valve\nEND_FUNCTION_BLOCK\n",
        "FUNCTION_BLOCK FB_Valve\n// Opens and closes.\nVAR_INPUT\n  x : BOOL; // open\nEND_VAR\nEND_FUNCTION_BLOCK\n",
        "FUNCTION_BLOCK FB_Valve\nVAR_INPUT\n  x : BOOL; // open\nEND_VAR\n(* Opens and closes. *)\nEND_FUNCTION_BLOCK\n",
    ] {
        assert_eq!(in_text("undocumented", text), [""; 0], "{text}");
    }
}

#[test]
fn a_licence_header_is_none() {
    let text = "(* Copyright (c) 2020 Somebody. All rights reserved.\n   Licensed under the MIT licence. *)\n\
                FUNCTION_BLOCK FB_Valve\nEND_FUNCTION_BLOCK\n";
    assert_eq!(in_text("undocumented", text).len(), 1);
}

#[test]
fn what_is_internal_is_not_for_others() {
    let text = "FUNCTION_BLOCK INTERNAL FB_Valve\nEND_FUNCTION_BLOCK\n";
    assert_eq!(in_text("undocumented", text), [""; 0]);
}
