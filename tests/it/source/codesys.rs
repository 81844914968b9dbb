//! CODESYS: text exports, native exports, exports of V2.3, and projects that only CODESYS reads.

use rungbook::source::Memory;
use rungbook::text::{Body, Language, ObjectKind, Vendor};

use super::{codes_of, declaration, find, read, unit};

#[test]
fn a_divided_text_has_a_declaration_and_a_body() {
    let text = "(*#-#-#---Declaration---#-#-#*)\r\n// doc\r\nFUNCTION F : INT\r\n(*#-#-#---Implementation---#-#-#*)\r\nF := 1;\r\n";
    let unit = unit("F.pou", text);
    let object = &unit.objects[0];
    assert_eq!((object.kind, object.name.as_deref(), unit.vendor), (ObjectKind::Pou, Some("F"), Vendor::Codesys));
    assert_eq!(object.span.of(text), "F");
    assert_eq!(declaration(object), "// doc\r\nFUNCTION F : INT\r\n");
    assert!(matches!(&object.body, Body::St(body) if &*body.text == "F := 1;\r\n"));
}

#[test]
fn an_undivided_text_is_whole_and_foreign_files_are_nobodys() {
    let memory = Memory::new()
        .with("a.gvl", "{attribute 'x'}\nVAR_GLOBAL\nEND_VAR")
        .with("b.prg", "PROGRAM p END_PROGRAM")
        .with("c.fun", "something else")
        .with("d.var", b"\0\x01")
        .with("e.db", b"\0\x01");
    let tree = read(&memory);
    assert_eq!(tree.units.len(), 2);
    assert!(tree.findings.is_empty());
    assert_eq!(tree.skipped.len(), 3);
}

const EXPORT: &str = r#"<ExportFile><StructuredView><Single><List Name="EntryList">
<Single><Single Name="MetaObject"><Single Name="Guid">m</Single><Single Name="ParentGuid">p</Single><Single Name="Name">Get</Single></Single>
  <Single Name="Object"><Single Name="Implementation"><Single Name="TextDocument"><Array Name="TextLines"><Single><Single Name="Text">P := 1 &lt; 2;</Single></Single></Array></Single></Single></Single></Single>
<Single><Single Name="MetaObject"><Single Name="Guid">f</Single><Single Name="ParentGuid">0</Single><Single Name="Name">FB</Single></Single>
  <Single Name="Object"><Single Name="Interface"><Single Name="TextDocument"><Array Name="TextLines">
    <Single><Single Name="Text">FUNCTION_BLOCK FB</Single></Single><Single><Single Name="Text">VAR END_VAR</Single></Single></Array></Single></Single>
    <Single Name="Implementation"><Single Name="Network">x</Single></Single></Single>
  <Array Name="Path"><Single>Blocks</Single></Array></Single>
<Single><Single Name="MetaObject"><Single Name="Guid">p</Single><Single Name="ParentGuid">f</Single><Single Name="Name">P</Single></Single>
  <Single Name="Object"><Single Name="Interface"><Single Name="TextDocument"><Array Name="TextLines"><Single><Single Name="Text">PROPERTY P : INT</Single></Single></Array></Single></Single></Single></Single>
<Single><Single Name="MetaObject"><Single Name="Guid">x</Single><Single Name="ParentGuid">0</Single><Single Name="Name">Folder</Single></Single><Single Name="Object"/></Single>
</List></Single></StructuredView></ExportFile>"#;

#[test]
fn a_native_export_is_put_together_by_identity() {
    let unit = unit("x.export", EXPORT);
    let [block] = &unit.objects[..] else { panic!("one object: {:?}", unit.objects) };
    assert_eq!((block.kind, block.folder.as_slice()), (ObjectKind::Pou, ["Blocks".to_owned()].as_slice()));
    assert_eq!(declaration(block), "FUNCTION_BLOCK FB\nVAR END_VAR\n");
    assert!(matches!(&block.body, Body::Other(Language::Unknown, _)));
    let property = &block.children[0];
    assert_eq!((property.kind, property.children[0].kind), (ObjectKind::Property, ObjectKind::Getter));
    assert!(matches!(&property.children[0].body, Body::St(body) if &*body.text == "P := 1 < 2;\n"));
}

const V2: &str = "\r\n\r\n(* @NESTEDCOMMENTS := 'Yes' *)\r\n(* @PATH := '\\/Drives\\/Axis' *)\r\n(* @OBJECTFLAGS := '0, 8' *)\r\n\
(* about *)\r\nFUNCTION_BLOCK FB_A\r\nVAR\r\nEND_VAR\r\n(* @END_DECLARATION := '0' *)\r\na := 1;\r\nEND_FUNCTION_BLOCK\r\n\r\n\
ACTION Reset:\r\na := 0;\r\nEND_ACTION\r\n\r\n\
(* @NESTEDCOMMENTS := 'No' *)\r\n(* @PATH := '' *)\r\nPROGRAM P\r\nVAR\r\nEND_VAR\r\n(* @END_DECLARATION := '0' *)\r\n_LD_BODY\r\n_NETWORKS : 1\r\nEND_PROGRAM\r\n\
(* @NESTEDCOMMENTS := 'Yes' *)\r\n(* @PATH := '' *)\r\nFUNCTION F : INT\r\n(* @END_DECLARATION := '0' *)\r\nLD 1\r\nST F\r\nEND_FUNCTION\r\n\
(* @PATH := '' *)\r\nTYPE T : INT; END_TYPE\r\n(* @END_DECLARATION := '0' *)\r\n\
(* @NESTEDCOMMENTS := 'Yes' *)\r\n(* @GLOBAL_VARIABLE_LIST := 'Globals' *)\r\n(* @PATH := '' *)\r\nVAR_GLOBAL\r\nEND_VAR\r\n\r\n(* @OBJECT_END := 'Globals' *)\r\n\
(* @CONNECTIONS := Globals\r\nFILENAME : ''\r\n*)\r\n\
(* @PATH := '' *)\r\nVISUALISATION V\r\nEND_VISUALISATION\r\n";

#[test]
fn an_export_of_v2_is_divided_into_its_objects() {
    let tree = read(&Memory::new().with("a.EXP", V2));
    let unit = &tree.units[0];
    assert_eq!((unit.vendor, unit.nested_comments), (Vendor::Codesys2, None), "objects differ in nesting");
    let names: Vec<_> = unit.objects.iter().map(|object| (object.kind, object.name.as_deref().unwrap_or(""))).collect();
    let expected = [
        (ObjectKind::Pou, "FB_A"),
        (ObjectKind::Pou, "P"),
        (ObjectKind::Pou, "F"),
        (ObjectKind::DataType, "T"),
        (ObjectKind::GlobalVariables, "Globals"),
    ];
    assert_eq!(names, expected);
    let block = &unit.objects[0];
    assert_eq!(block.folder, ["Drives", "Axis"]);
    assert_eq!(block.properties, [("nested_comments".to_owned(), "yes".to_owned())]);
    assert!(declaration(block).trim_start().starts_with("(* about *)"));
    assert!(matches!(&block.body, Body::St(body) if body.text.trim() == "a := 1;"));
    let reset = find(&unit.objects, "Reset").expect("it is there");
    assert!(matches!(&reset.body, Body::St(body) if body.text.trim() == "a := 0;"));
    assert!(matches!(&unit.objects[1].body, Body::Other(Language::Ld, _)));
    assert!(matches!(&unit.objects[2].body, Body::Il(_)));
    assert_eq!(declaration(&unit.objects[4]).trim(), "VAR_GLOBAL\r\nEND_VAR");
    assert_eq!(codes_of(&tree.findings), ["unknown-object"]);
    assert_eq!(tree.files.text(tree.findings[0].place), "VISUALISATION");
}

#[test]
fn actions_may_stand_inside_their_block() {
    let text = "(* @NESTEDCOMMENTS := 'Yes' *)\nPROGRAM P\n(* @END_DECLARATION := '0' *)\nx := 1;\nACTION A:\ny := 2;\nEND_ACTION\nEND_PROGRAM\n";
    let unit = unit("p.exp", text);
    assert_eq!(unit.nested_comments, Some(true));
    let names: Vec<_> = unit.objects[0].children.iter().map(|child| child.name.as_deref()).collect();
    assert_eq!(names, [Some("A")]);
    assert!(matches!(&unit.objects[0].body, Body::St(body) if body.text.trim() == "x := 1;"));
}

#[test]
fn projects_that_only_codesys_reads_are_told_with_a_way_out() {
    let memory = Memory::new()
        .with("a.project", b"PK\x03\x04")
        .with("b.library", "x")
        .with("c.pro", b"CoDeSys+\0\x01")
        .with("d.pro", "QT += core")
        .with("e.lib", b"!<arch>\n\0");
    let tree = read(&memory);
    assert_eq!(codes_of(&tree.findings), ["binary-project", "binary-project", "binary-project"]);
    assert!(tree.findings.iter().all(|finding| finding.help.len() == 1));
    assert_eq!(tree.skipped.len(), 5);
}
