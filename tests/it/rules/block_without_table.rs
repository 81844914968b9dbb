//! `block-without-table`: off unless switched on.

use crate::support::findings;

const BLOCK: &str = "// Opens.\nFUNCTION_BLOCK FB_Valve\nEND_FUNCTION_BLOCK\n";
const ON: &str = "[audit.rules]\nblock-without-table = \"warning\"\n";

#[test]
fn it_is_off_by_default() {
    assert_eq!(findings("block-without-table", &[("a.st", BLOCK)], ""), [""; 0]);
}

#[test]
fn switched_on_it_finds_concrete_blocks_only() {
    let abstract_block = "// Opens.\nFUNCTION_BLOCK ABSTRACT FB_Base\nEND_FUNCTION_BLOCK\n";
    let files = [("a.st", BLOCK), ("b.st", abstract_block)];
    assert_eq!(findings("block-without-table", &files, ON), ["a.st:2:16 function block `FB_Valve` has no test table"]);
}

#[test]
fn a_table_file_of_the_blocks_name_is_a_table() {
    let table = "@gtt Opens\n| # | in x : BOOL | dur |\n|---|---|---|\n| 1 | T | 1 |\n";
    let files = [("FB_Valve.st", BLOCK), ("FB_Valve.gtt.md", table)];
    assert_eq!(findings("block-without-table", &files, ON), [""; 0]);
}
