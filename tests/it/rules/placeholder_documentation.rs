//! `placeholder-documentation`: what an editor puts there.

use crate::support::in_text;

#[test]
fn an_editors_placeholder_is_found_and_counts_as_nothing() {
    let text = "// TODO: Add your comment here\nFUNCTION_BLOCK FB_Valve\nEND_FUNCTION_BLOCK\n";
    assert_eq!(
        in_text("placeholder-documentation", text),
        ["a.st:1:1 the documentation of `FB_Valve` is a placeholder"]
    );
    assert_eq!(in_text("undocumented", text), [""; 0], "reported once, not twice");
}

#[test]
fn the_name_repeated_is_one() {
    let text = "// FB_Valve\nFUNCTION_BLOCK FB_Valve\nEND_FUNCTION_BLOCK\n";
    assert_eq!(in_text("placeholder-documentation", text).len(), 1);
}

#[test]
fn a_sentence_with_the_word_todo_is_none() {
    let text = "// Opens and closes; a to-do list of positions is worked off in order.\nFUNCTION_BLOCK FB_Valve\nEND_FUNCTION_BLOCK\n";
    assert_eq!(in_text("placeholder-documentation", text), [""; 0]);
}
