//! `unverified-table`: tables without a verdict.

use crate::support::{findings, in_text};

const TEXT: &str = "(* A toggle.\n\n   @gtt Toggles\n   | # | in Set : BOOL | out Q : BOOL | dur |\n   \
                    |---|---|---|---|\n   | 1 | F | F | - |\n   | 2 | T | T | 1 |\n*)\n\
                    FUNCTION_BLOCK FB_Toggle\nVAR_INPUT\n  Set : BOOL; // set\nEND_VAR\nVAR_OUTPUT\n  Q : BOOL; // out\nEND_VAR\nEND_FUNCTION_BLOCK\n";

#[test]
fn a_table_is_unverified_until_it_is_proven() {
    let found = in_text("unverified-table", TEXT);
    assert_eq!(found.len(), 1);
    assert!(found[0].ends_with("test table `Toggles` is unverified"), "{found:?}");
}

#[test]
fn it_can_be_switched_off() {
    let off = "[audit.rules]\nunverified-table = \"off\"\n";
    assert_eq!(findings("unverified-table", &[("a.st", TEXT)], off), [""; 0]);
}
