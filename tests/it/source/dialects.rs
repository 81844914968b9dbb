//! Texts that stand in containers of another kind, or in files of their own.

use rungbook::source::Memory;
use rungbook::text::{Body, ObjectKind};

use super::{codes_of, declaration, read, unit};

#[test]
fn instructions_and_charts_are_files_of_their_own() {
    let list = unit("a.il", "LD %IX1\nAND x\nST y\n");
    assert_eq!((list.format, list.objects[0].kind), ("Structured Text", ObjectKind::Text));
    let chart = unit("a.sfc", "PROGRAM A\nINITIAL_STEP S: END_STEP\nEND_PROGRAM\n");
    assert_eq!(chart.format, "Structured Text");
}

#[test]
fn a_chart_of_guarded_jumps_is_told_and_left_alone() {
    let tree =
        read(&Memory::new().with("a.sfc", "(* a chart *)\nSFC Press\nSTEP A\nEND_STEP\nGOTO x :: A -> A;\nEND_SFC\n"));
    assert_eq!(codes_of(&tree.findings), ["unread-dialect"]);
    assert_eq!((tree.units.len(), tree.skipped.len()), (0, 1));
}

#[test]
fn a_session_is_a_table_file_and_a_program() {
    let session = "<?xml version=\"1.0\"?>\n<session xmlns=\"http://formal.iti.kit.edu/stvs/io/1.0/\"><code><plaintext>PROGRAM A\nx := 1 &lt; 2;\nEND_PROGRAM</plaintext></code><tabs/></session>";
    for path in ["a.xml", "a.st"] {
        let tree = read(&Memory::new().with(path, session));
        assert_eq!(codes_of(&tree.findings), Vec::<&str>::new());
        assert_eq!(tree.tables.len(), 1, "{path}");
        assert_eq!(declaration(&tree.units[0].objects[0]), "PROGRAM A\nx := 1 < 2;\nEND_PROGRAM");
    }
    let other = read(&Memory::new().with("a.xml", "<test-table name=\"T\"><variables/><steps/></test-table>"));
    assert_eq!((other.tables.len(), other.units[0].objects.len()), (1, 0));
}

#[test]
fn algorithms_of_4diac_may_carry_their_keywords() {
    let text = "<FBType Name=\"A\"><BasicFB><Algorithm Name=\"REQ\"><ST><![CDATA[\n// Adds.\nALGORITHM REQ\nVAR_TEMP t : INT; END_VAR\n  Y := 1;\nEND_ALGORITHM]]></ST></Algorithm><Algorithm Name=\"B\"><ST Text=\"Y := 2;\"/></Algorithm></BasicFB></FBType>";
    let unit = unit("A.fbt", text);
    let [declared, bare] = unit.objects[0].children.as_slice() else { panic!("two algorithms") };
    assert!(declaration(declared).contains("ALGORITHM REQ") && matches!(declared.body, Body::None));
    assert!(matches!(&bare.body, Body::St(body) if &*body.text == "Y := 2;"));
}
