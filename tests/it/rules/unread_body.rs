//! `unread-body`: drawn bodies are named, and their declarations are read.

use crate::support::{findings, project};

const CHART: &str = "<?xml version=\"1.0\"?>\n<TcPlcObject>\n  <POU Name=\"FB_Drawn\">\n    <Declaration><![CDATA[// Opens.\n\
                     FUNCTION_BLOCK FB_Drawn\n]]></Declaration>\n    <Implementation>\n      <CFC><cfcWorksheet/></CFC>\n    \
                     </Implementation>\n  </POU>\n</TcPlcObject>\n";

#[test]
fn a_drawn_body_is_named_with_its_language() {
    let found = findings("unread-body", &[("FB_Drawn.TcPOU", CHART)], "");
    assert_eq!(found, ["FB_Drawn.TcPOU:5:16 the body of `FB_Drawn` is drawn in CFC and not shown"]);
    let project = project(&[("FB_Drawn.TcPOU", CHART)], "");
    assert!(project.docs.items[0].doc.is_some(), "its comment is read");
}

#[test]
fn a_written_body_is_not() {
    let text = "FUNCTION_BLOCK FB_Valve\nEND_FUNCTION_BLOCK\n";
    assert_eq!(findings("unread-body", &[("a.st", text)], ""), [""; 0]);
}
