//! `conditional-pragma`: both branches are read, and that is said.

use crate::support::{in_text, project};

const TEXT: &str = "// Moves.\nFUNCTION_BLOCK FB_Axis\nVAR_INPUT\n  {IF defined (SIM)}\n  a : INT; // one\n  {ELSE}\n  \
                    b : INT; // other\n  {END_IF}\nEND_VAR\nEND_FUNCTION_BLOCK\n";

#[test]
fn each_if_is_found_once_and_both_branches_are_read() {
    assert_eq!(
        in_text("conditional-pragma", TEXT),
        ["a.st:4:3 a conditional pragma is stepped over; all its branches are read"]
    );
    let project = project(&[("a.st", TEXT)], "");
    assert_eq!(project.catalogue.items[0].variables.len(), 2);
}

#[test]
fn a_definition_is_told() {
    let text = "// Moves.\nPROGRAM P\n{define sim}\nEND_PROGRAM\n";
    let told = "a.st:3:1 a definition for conditional pragmas is stepped over";
    assert_eq!(in_text("conditional-pragma", text), [told]);
}

#[test]
fn an_attribute_is_none() {
    let text = "{attribute 'if'}\n// Moves.\nFUNCTION_BLOCK FB_Axis\nEND_FUNCTION_BLOCK\n";
    assert_eq!(in_text("conditional-pragma", text), [""; 0]);
}
