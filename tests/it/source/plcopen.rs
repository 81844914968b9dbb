//! PLCopen XML: declarations written from XML, with places, or taken as text where the tool adds it.

use rungbook::source::{Memory, ProjectKind};
use rungbook::text::{Body, ObjectKind, Span, Vendor};

use super::{declaration, find, read};

const FILE: &str = r#"<?xml version="1.0" encoding="utf-8"?>
<project xmlns="http://www.plcopen.org/xml/tc6_0200">
  <fileHeader companyName="Tool maker" productName="CODESYS" />
  <contentHeader name="Press" version="1.2"><Comment>A press</Comment></contentHeader>
  <types>
    <dataTypes>
      <dataType name="E_Mode"><baseType><enum><values><value name="Off" value="0"/><value name="On"/></values><baseType><INT/></baseType></enum></baseType></dataType>
      <dataType name="T_Small"><baseType><subrangeSigned><range lower="-5" upper="5"/><baseType><INT/></baseType></subrangeSigned></baseType></dataType>
      <dataType name="ST_Axis"><baseType><struct>
        <variable name="pos"><type><array><dimension lower="0" upper="3"/><dimension lower="1" upper="N"/><baseType><LREAL/></baseType></array></type></variable>
        <variable name="name"><type><string length="20"/></type><initialValue><simpleValue value="'a &lt; b'"/></initialValue></variable>
      </struct></baseType></dataType>
    </dataTypes>
    <pous>
      <pou name="FB_Press" pouType="functionBlock">
        <interface>
          <inputVars retain="true"><variable name="go" address="%IX0.0"><type><BOOL/></type><documentation><xhtml xmlns="http://www.w3.org/1999/xhtml">starts it
at once</xhtml></documentation></variable></inputVars>
          <localVars constant="true"><variable name="next"><type><pointer><baseType><derived name="FB_Press"/></baseType></pointer></type></variable>
            <variable name="table"><type><derived name="T"/></type><initialValue><arrayValue><value repetitionValue="3"><simpleValue value="0"/></value><value><structValue><value member="x"><simpleValue value="1"/></value></structValue></value></arrayValue></initialValue></variable></localVars>
          <documentation>
            <xhtml xmlns="http://www.w3.org/1999/xhtml"><p>Presses <b>hard</b>.</p><ul><li>one</li><li>two</li></ul></xhtml>
          </documentation>
        </interface>
        <actions><action name="Reset"><body><ST><xhtml xmlns="http://www.w3.org/1999/xhtml">go := a &lt; b;</xhtml></ST></body></action></actions>
        <body><SFC><step localId="0" name="Init"/></SFC></body>
        <addData>
          <data name="http://www.3s-software.com/plcopenxml/method"><Method name="Run" ObjectId="m">
            <interface><returnType><BOOL/></returnType><inputVars><variable name="x"><type><INT/></type></variable></inputVars></interface>
            <body><ST><xhtml xmlns="http://www.w3.org/1999/xhtml">Run := x &gt; 0;</xhtml></ST></body></Method></data>
          <data name="http://www.3s-software.com/plcopenxml/objectid"><ObjectId>id-press</ObjectId></data>
        </addData>
      </pou>
      <pou name="F_Plain" pouType="function">
        <interface><returnType><INT/></returnType><addData><data name="http://www.3s-software.com/plcopenxml/interfaceasplaintext"><InterfaceAsPlainText><xhtml xmlns="http://www.w3.org/1999/xhtml">// says &amp; does
FUNCTION F_Plain : INT
</xhtml></InterfaceAsPlainText></data></addData></interface>
        <body><IL><xhtml xmlns="http://www.w3.org/1999/xhtml">LD 1</xhtml></IL></body>
      </pou>
    </pous>
  </types>
  <instances><configurations><configuration name="C"><resource name="R">
    <task name="Fast" interval="PT0.01S" priority="1"><pouInstance name="MAIN" typeName=""/></task>
    <globalVars name="GVL" constant="true"><variable name="N"><type><INT/></type></variable></globalVars>
  </resource></configuration></configurations></instances>
  <addData><data name="http://www.3s-software.com/plcopenxml/projectstructure"><ProjectStructure><Folder Name="Blocks"><Object Name="FB_Press" ObjectId="id-press"/></Folder></ProjectStructure></data></addData>
</project>"#;

#[test]
fn types_and_interfaces_become_structured_text() {
    let tree = read(&Memory::new().with("Press.xml", FILE));
    assert!(tree.findings.is_empty(), "{:?}", tree.findings);
    let objects = &tree.units[0].objects;
    let text = |name: &str| declaration(find(objects, name).expect("it is there")).to_owned();
    assert_eq!(text("E_Mode"), "TYPE E_Mode :\n(\n\tOff := 0,\n\tOn\n) INT;\nEND_TYPE\n");
    assert_eq!(text("T_Small"), "TYPE T_Small :\nINT(-5..5);\nEND_TYPE\n");
    assert_eq!(
        text("ST_Axis"),
        "TYPE ST_Axis :\nSTRUCT\n\tpos : ARRAY [0..3, 1..N] OF LREAL;\n\tname : STRING(20) := 'a < b';\nEND_STRUCT\nEND_TYPE\n"
    );
    assert_eq!(
        text("FB_Press"),
        "FUNCTION_BLOCK FB_Press\nVAR_INPUT RETAIN\n\t// starts it\n\t// at once\n\tgo AT %IX0.0 : BOOL;\nEND_VAR\n\
         VAR CONSTANT\n\tnext : POINTER TO FB_Press;\n\ttable : T := [3(0), (x := 1)];\nEND_VAR\n"
    );
    assert_eq!(text("Run"), "METHOD Run : BOOL\nVAR_INPUT\n\tx : INT;\nEND_VAR\n");
    assert_eq!(text("F_Plain"), "// says & does\nFUNCTION F_Plain : INT\n");
    assert_eq!(text("GVL"), "VAR_GLOBAL CONSTANT\n\tN : INT;\nEND_VAR\n");
}

#[test]
fn bodies_members_tasks_and_folders() {
    let tree = read(&Memory::new().with("Press.xml", FILE));
    let objects = &tree.units[0].objects;
    let press = find(objects, "FB_Press").expect("it is there");
    assert_eq!(press.folder, ["Blocks"]);
    assert!(matches!(&press.body, Body::St(chart) if &*chart.text == "STEP Init:\nEND_STEP\n\n"));
    assert_eq!(press.documentation.as_ref().map(|text| &*text.text), Some("Presses **hard**.\n\n- one\n- two"));
    let kinds: Vec<_> = press.children.iter().map(|child| (child.kind, child.name.as_deref().unwrap_or(""))).collect();
    assert_eq!(kinds, [(ObjectKind::Action, "Reset"), (ObjectKind::Method, "Run")]);
    assert!(matches!(&press.children[0].body, Body::St(text) if &*text.text == "go := a < b;"));
    assert!(matches!(&find(objects, "F_Plain").expect("it is there").body, Body::Il(_)));
    let task = find(objects, "Fast").expect("it is there");
    assert!(task.properties.contains(&("call".to_owned(), "MAIN".to_owned())));
}

#[test]
fn a_synthesised_word_leads_to_its_element_and_a_name_to_its_attribute() {
    let tree = read(&Memory::new().with("Press.xml", FILE));
    let press = find(&tree.units[0].objects, "FB_Press").expect("it is there");
    let fragment = press.declaration.as_ref().expect("it is declared");
    let place = |text: &str| {
        let at = fragment.text.find(text).expect("it is there");
        fragment.map.span(Span::from(at..at + text.len())).of(FILE)
    };
    assert_eq!(place("go"), "go");
    assert_eq!(place("BOOL"), "BOOL");
    assert_eq!(place("VAR_INPUT"), "inputVars");
    assert_eq!(place(" RETAIN"), "true");
    assert_eq!(place("starts it"), "starts it");
    assert_eq!(place("POINTER TO"), "pointer");
    assert_eq!(place("3(0)"), "value repetitionValue=\"3\"><simpleValue value=\"0");
}

#[test]
fn the_head_is_a_project_of_its_own_file_alone() {
    let tree = read(&Memory::new().with("Press.xml", FILE).with("a.st", "A"));
    assert_eq!((tree.projects.len(), tree.projects[0].kind), (1, ProjectKind::PlcOpen));
    assert_eq!((tree.projects[0].name.as_str(), tree.projects[0].about.version.as_deref()), ("Press", Some("1.2")));
    assert_eq!(tree.projects[0].about.description.as_deref(), Some("A press"));
    assert_eq!(tree.units.iter().map(|unit| unit.project).collect::<Vec<_>>(), [Some(0), None]);
}

#[test]
fn other_xml_is_nobodys_and_twincat_is_named() {
    let tree = read(
        &Memory::new()
            .with("a.xml", "<project/>")
            .with("b.xml", b"\0\0")
            .with("c.xml", FILE.replace("CODESYS", "TwinCAT PLC Control")),
    );
    assert_eq!(tree.skipped.len(), 2);
    assert!(tree.findings.is_empty());
    assert_eq!(tree.units[0].vendor, Vendor::TwinCat);
}
