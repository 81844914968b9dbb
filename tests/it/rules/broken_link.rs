//! `broken-link`: links in prose that lead nowhere.

use crate::support::in_text;

fn with(prose: &str) -> Vec<String> {
    in_text(
        "broken-link",
        &format!(
            "(* {prose} *)\nFUNCTION_BLOCK FB_Valve\nVAR_INPUT\n  Open : BOOL; // open\nEND_VAR\nEND_FUNCTION_BLOCK\n"
        ),
    )
}

#[test]
fn a_name_that_is_not_there_is_found_at_its_place() {
    assert_eq!(with("Like [FB_Gate] does."), ["a.st:1:9 nothing here is called `FB_Gate`"]);
    assert_eq!(with("Like [FB_Valve.Shut] does.").len(), 1);
}

#[test]
fn names_that_are_there_pass_in_any_letter_case() {
    for prose in ["See [FB_Valve].", "See [fb_valve.open].", "See [`Open`].", "See [the input](FB_Valve.Open)."] {
        assert_eq!(with(prose), [""; 0], "{prose}");
    }
}

#[test]
fn units_and_ranges_in_brackets_are_no_links() {
    for prose in ["The pressure [bar].", "From [0..100].", "In [mm/s].", "Element [3] of it."] {
        assert_eq!(with(prose), [""; 0], "{prose}");
    }
}
