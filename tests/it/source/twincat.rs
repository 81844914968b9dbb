//! TwinCAT 3 objects, whole and damaged.

use rungbook::source::Memory;
use rungbook::text::{Body, Language, ObjectKind, Span, Vendor};

use super::{codes_of, declaration, find, read, unit};

const PUMP: &str = r#"<?xml version="1.0" encoding="utf-8"?>
<TcPlcObject Version="1.1.0.1" ProductVersion="3.1.4024.9">
  <POU Name="FB_Pump" Id="{1}" SpecialFunc="None">
    <Declaration><![CDATA[FUNCTION_BLOCK FB_Pump
VAR_INPUT
END_VAR
]]></Declaration>
    <Implementation>
      <ST><![CDATA[run := a < b AND c > d;]]></ST>
    </Implementation>
    <Folder Name="inner" Id="{2}" />
    <Action Name="Reset" Id="{3}">
      <Implementation>
        <ST><![CDATA[run := FALSE;]]></ST>
      </Implementation>
    </Action>
    <Method Name="Start" Id="{4}" FolderPath="outer\inner\">
      <Declaration><![CDATA[METHOD Start : BOOL]]></Declaration>
      <Implementation>
        <ST><![CDATA[]]></ST>
      </Implementation>
    </Method>
    <Property Name="Speed" Id="{5}">
      <Declaration><![CDATA[PROPERTY Speed : REAL]]></Declaration>
      <Get Name="Get" Id="{6}">
        <Declaration><![CDATA[VAR
END_VAR
]]></Declaration>
        <Implementation>
          <ST><![CDATA[Speed := _speed;]]></ST>
        </Implementation>
      </Get>
      <Set Name="Set" Id="{7}">
        <Declaration><![CDATA[]]></Declaration>
        <Implementation>
          <ST><![CDATA[_speed := Speed;]]></ST>
        </Implementation>
      </Set>
    </Property>
    <Transition Name="Ready" Id="{8}">
      <Implementation>
        <ST><![CDATA[Ready := TRUE;]]></ST>
      </Implementation>
    </Transition>
    <LineIds Name="FB_Pump"><LineId Id="1" Count="0" /></LineIds>
  </POU>
</TcPlcObject>"#;

#[test]
fn a_block_with_members_of_every_kind() {
    let unit = unit("FB_Pump.TcPOU", PUMP);
    assert_eq!((unit.format, unit.vendor), ("TwinCAT 3", Vendor::TwinCat));
    let [block] = &unit.objects[..] else { panic!("one object") };
    assert_eq!((block.kind, block.name.as_deref()), (ObjectKind::Pou, Some("FB_Pump")));
    assert_eq!(block.span.of(PUMP), "FB_Pump");
    assert!(declaration(block).starts_with("FUNCTION_BLOCK FB_Pump\n"));
    assert!(matches!(&block.body, Body::St(body) if &*body.text == "run := a < b AND c > d;"));
    assert_eq!(block.properties, [("id".to_owned(), "{1}".to_owned())]);
    let kinds: Vec<_> = block.children.iter().map(|child| child.kind).collect();
    assert_eq!(kinds, [ObjectKind::Action, ObjectKind::Method, ObjectKind::Property, ObjectKind::Transition]);
    assert!(block.children[0].declaration.is_none(), "an action declares nothing");
    assert_eq!(block.children[1].folder, ["outer", "inner"]);
    let accessors: Vec<_> = block.children[2].children.iter().map(|child| child.kind).collect();
    assert_eq!(accessors, [ObjectKind::Getter, ObjectKind::Setter]);
}

#[test]
fn lists_types_interfaces_and_tasks() {
    let memory = Memory::new()
        .with("G.TcGVL", r#"<TcPlcObject><GVL Name="G" ParameterList="True"><Declaration><![CDATA[VAR_GLOBAL END_VAR]]></Declaration></GVL></TcPlcObject>"#)
        .with("E.TcDUT", r#"<TcPlcObject><DUT Name="E"><Declaration><![CDATA[TYPE E : (a); END_TYPE]]></Declaration></DUT></TcPlcObject>"#)
        .with("I.TcIO", r#"<TcPlcObject><Itf Name="I"><Declaration><![CDATA[INTERFACE I]]></Declaration><Method Name="M"><Declaration><![CDATA[METHOD M]]></Declaration></Method></Itf></TcPlcObject>"#)
        .with("T.TcTTO", r#"<TcPlcObject><Task Name="T"><CycleTime>10000</CycleTime><Priority>20</Priority><PouCall><Name>MAIN</Name></PouCall></Task></TcPlcObject>"#);
    let tree = read(&memory);
    let kinds: Vec<_> = tree.units.iter().map(|unit| unit.objects[0].kind).collect();
    assert_eq!(kinds, [ObjectKind::DataType, ObjectKind::GlobalVariables, ObjectKind::Interface, ObjectKind::Task]);
    assert_eq!(tree.units[1].objects[0].properties, [("parameter_list".to_owned(), "True".to_owned())]);
    assert_eq!(tree.units[2].objects[0].children.len(), 1);
    let facts: Vec<_> =
        tree.units[3].objects[0].properties.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
    assert_eq!(facts, [("cycle_time_us", "10000"), ("priority", "20"), ("call", "MAIN")]);
    assert!(tree.findings.is_empty(), "{:?}", tree.findings);
}

#[test]
fn other_languages_are_kept_as_they_stand() {
    let file = |body: &str| {
        format!(
            r#"<TcPlcObject><POU Name="P"><Declaration><![CDATA[PROGRAM P]]></Declaration><Implementation>{body}</Implementation></POU></TcPlcObject>"#
        )
    };
    let body = |xml: &str| unit("P.TcPOU", file(xml)).objects[0].body.clone();
    assert!(
        matches!(body("<SFC><XmlArchive>a</XmlArchive></SFC>"), Body::Other(Language::Sfc, raw) if &*raw.text == "<XmlArchive>a</XmlArchive>")
    );
    assert!(matches!(body("<NWL/>"), Body::Other(Language::Fbd, _)));
    assert!(matches!(body("<CFC></CFC>"), Body::Other(Language::Cfc, _)));
    assert!(matches!(body("<IL><![CDATA[LD a]]></IL>"), Body::Il(text) if &*text.text == "LD a"));
    assert!(matches!(body(""), Body::None));
}

#[test]
fn split_sections_and_entities_are_put_together() {
    let xml = "<TcPlcObject><POU Name=\"P\"><Declaration>PROGRAM P &lt;x&#62; </Declaration><Implementation><ST><![CDATA[s := ']]]]><![CDATA[>';\r\n]]></ST></Implementation></POU></TcPlcObject>";
    let unit = unit("P.TcPOU", xml);
    assert_eq!(declaration(&unit.objects[0]), "PROGRAM P <x> ");
    let Body::St(body) = &unit.objects[0].body else { panic!("a body") };
    assert_eq!(&*body.text, "s := ']]>';\r\n");
    let end = body.text.find('>').expect("it is there") as u32;
    assert_eq!(body.map.span(Span::new(end, end + 2)).of(xml), ">'");
    assert_eq!(body.map.span(Span::new(end - 2, end + 1)).of(xml), "]]]]><![CDATA[>");
}

#[test]
fn a_file_without_an_object_is_told() {
    let tree = read(
        &Memory::new()
            .with("A.TcPOU", "<TcPlcObject Version=\"1\"/>")
            .with("B.TcPOU", "")
            .with("C.TcPOU", "<TcPlcObject><Visu Name=\"v\"/></TcPlcObject>"),
    );
    assert_eq!(codes_of(&tree.findings), ["empty-container", "empty-container", "empty-container", "unknown-object"]);
}

#[test]
fn damage_anywhere_leaves_the_rest() {
    let cases = [
        ("a lost closing tag of a declaration", PUMP.replacen("]]></Declaration>", "]]>", 1)),
        ("a lost end of a section", PUMP.replacen("]]></Declaration>", "</Declaration>", 1)),
        ("a lost closing tag of a method", PUMP.replacen("</Method>", "", 1)),
        ("a lost quote", PUMP.replacen("Id=\"{4}\"", "Id=\"{4}", 1)),
        ("a marker of a merge", PUMP.replacen("    <Folder", "<<<<<<< HEAD\n    <Folder", 1)),
        ("a bare ampersand", PUMP.replacen("<LineIds Name=\"FB_Pump\">", "<LineIds Name=\"A & B\">", 1)),
        ("a stray closing tag", PUMP.replacen("    <Folder", "</Nothing><Folder", 1)),
        ("lost owners", PUMP.replacen("<TcPlcObject Version=\"1.1.0.1\" ProductVersion=\"3.1.4024.9\">", "", 1)),
    ];
    for (what, text) in cases {
        let tree = read(&Memory::new().with("FB_Pump.TcPOU", &text));
        assert!(codes_of(&tree.findings).contains(&"malformed-xml"), "{what} is told");
        assert!(tree.findings[0].place.span.end as usize <= text.len());
        let objects = &tree.units[0].objects;
        for name in ["FB_Pump", "Reset", "Speed", "Ready"] {
            assert!(find(objects, name).is_some(), "{name} is there after {what}");
        }
        let block = find(objects, "FB_Pump").expect("it is there");
        assert!(declaration(block).starts_with("FUNCTION_BLOCK FB_Pump\nVAR_INPUT\nEND_VAR\n"), "{what}");
        assert!(!declaration(block).contains("Implementation"), "{what}");
        assert!(matches!(&block.body, Body::St(body) if &*body.text == "run := a < b AND c > d;"), "{what}");
        assert_eq!(declaration(find(objects, "Speed").expect("it is there")), "PROPERTY Speed : REAL", "{what}");
    }
}

#[test]
fn a_file_that_ends_early_keeps_what_it_has() {
    for end in (0..PUMP.len()).filter(|end| PUMP.is_char_boundary(*end)) {
        let tree = read(&Memory::new().with("P.TcPOU", &PUMP[..end]));
        let told = codes_of(&tree.findings);
        assert!(!told.is_empty(), "cut at {end}");
        if end > PUMP.find("VAR_INPUT").unwrap_or(0) {
            assert!(declaration(&tree.units[0].objects[0]).starts_with("FUNCTION_BLOCK FB_Pump\n"));
        }
    }
}

#[test]
fn bombs_of_every_kind_are_findings() {
    let entity = "<!DOCTYPE p [ <!ENTITY a \"aaaaaaaaaa\"> <!ENTITY b \"&a;&a;&a;&a;\"> ]><TcPlcObject><POU Name=\"P\"><Declaration>&b;</Declaration></POU></TcPlcObject>";
    let tree = read(&Memory::new().with("P.TcPOU", entity));
    assert_eq!(codes_of(&tree.findings), ["document-type", "malformed-xml"]);
    assert_eq!(declaration(&tree.units[0].objects[0]), "&b;");

    let deep = format!("<TcPlcObject>{}</TcPlcObject>", "<Method Name=\"m\">".repeat(100_000));
    let tree = read(&Memory::new().with("P.TcPOU", deep));
    assert!(codes_of(&tree.findings).contains(&"malformed-xml"));

    let unclosed = format!("<TcPlcObject>{}", "<POU><ST><![CDATA[</ST>".repeat(100_000));
    let tree = read(&Memory::new().with("P.TcPOU", unclosed));
    assert!(codes_of(&tree.findings).contains(&"malformed-xml"));
}
