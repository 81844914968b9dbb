//! Prose that stands in no comment.

use super::sample::Sample;
use crate::docs::{Block, Inline, LinkTarget, Narrator};
use crate::library::names::Names;
use crate::library::{ItemId, ItemKind};

#[test]
fn a_page_is_plain_markdown_with_links() {
    let mut sample = Sample::new();
    sample.item(ItemKind::FunctionBlock, "FB_Pump", None, Vec::new());
    let catalogue = sample.catalogue();
    let names = Names::new(&catalogue);
    let narrator = Narrator::new(&catalogue, &names);
    let blocks =
        narrator.blocks("# Pumps\n\nSee [FB_Pump].\nAnd\nmore than that, on a line of its own.\n\n    code := 1;");
    assert_eq!(blocks[0], Block::Heading(1, vec![Inline::Text("Pumps".to_owned())]));
    let Block::Paragraph(content) = &blocks[1] else { panic!("{blocks:?}") };
    assert!(matches!(&content[1], Inline::Link { target: LinkTarget::Item(ItemId(0)), .. }));
    assert!(!content.contains(&Inline::Break));
    assert_eq!(blocks[2], Block::Code { language: String::new(), text: "code := 1;".to_owned() });
    assert_eq!(narrator.blocks("# Title"), [Block::Heading(1, vec![Inline::Text("Title".to_owned())])]);
}

#[test]
fn a_sign_behind_a_declaration_is_documentation() {
    let mut sample = Sample::new();
    let list = sample.item(ItemKind::GlobalVariables, "Signs", None, Vec::new());
    for (name, comment) in [("MUL", "// *"), ("ADD", "// + (also a sign)"), ("ONE", "// 1. try"), ("LT", "//< less")] {
        sample.variable(list, name, "", comment);
    }
    let docs = sample.read();
    let briefs: Vec<String> = docs.variables[0].iter().map(|v| v.doc.as_ref().unwrap().brief_text()).collect();
    assert_eq!(briefs, ["*", "+ (also a sign)", "1. try", "less"]);
}
