//! Siemens, B&R, 4diac, logi.CAD.

use rungbook::source::Memory;
use rungbook::text::{Body, Language, ObjectKind, Span, Vendor};

use super::{codes_of, declaration, find, read, unit};

#[test]
fn siemens_sources_are_text_and_stl_bodies_are_kept() {
    let unit_of = |path: &str, text: &str| unit(path, text);
    let scl = unit_of("a.scl", "\u{FEFF}FUNCTION \"F a\" : Int\nBEGIN\n#x := 1;\nEND_FUNCTION\n");
    assert_eq!((scl.vendor, scl.objects[0].kind), (Vendor::Siemens, ObjectKind::Text));
    assert!(declaration(&scl.objects[0]).starts_with("FUNCTION"), "the mark is gone");
    let stl = "FUNCTION_BLOCK \"FB 1\"\nVAR_INPUT\n a : BOOL;\nEND_VAR\nBEGIN\nNETWORK\n A #a;\nEND_FUNCTION_BLOCK\nDATA_BLOCK \"D\"\nSTRUCT\nEND_STRUCT\nBEGIN\nEND_DATA_BLOCK\n";
    let awl = unit_of("b.awl", stl);
    let names: Vec<_> = awl.objects.iter().map(|object| object.name.as_deref()).collect();
    assert_eq!(names, [Some("FB 1"), None]);
    assert_eq!(declaration(&awl.objects[0]), "FUNCTION_BLOCK \"FB 1\"\nVAR_INPUT\n a : BOOL;\nEND_VAR\n");
    assert!(matches!(&awl.objects[0].body, Body::Other(Language::Unknown, body) if body.text.contains("A #a;")));
    assert!(declaration(&awl.objects[1]).contains("BEGIN"));
    let ladder = unit_of(
        "c.s7dcl",
        "FUNCTION_BLOCK \"L\"\nVAR_INPUT\nEND_VAR\n  NETWORK\n    RUNG wire#powerrail\n    END_RUNG\n  END_NETWORK\nEND_FUNCTION_BLOCK\n",
    );
    assert!(matches!(&ladder.objects[0].body, Body::Other(Language::Ld, _)));
    let text = unit_of("d.s7dcl", "FUNCTION_BLOCK \"S\"\nVAR_INPUT\nEND_VAR\nx := 1;\nEND_FUNCTION_BLOCK\n");
    assert_eq!(text.objects[0].kind, ObjectKind::Text);
}

#[test]
fn variables_of_automation_studio_are_a_list_of_the_files_name() {
    let memory = Memory::new()
        .with("L/Package.pkg", "<Package/>")
        .with("L/Global.var", b"VAR\n x : INT; (*Gr\xF6\xDFe der \xD6lpumpe*)\nEND_VAR")
        .with("L/T.typ", "TYPE T : STRUCT END_STRUCT; END_TYPE")
        .with("L/f.fun", "FUNCTION f : BOOL END_FUNCTION")
        .with("L/m.st", "ACTION a: END_ACTION");
    let tree = read(&memory);
    assert_eq!(tree.units.len(), 4);
    assert!(tree.units.iter().all(|unit| unit.vendor == Vendor::BAndR && unit.nested_comments == Some(false)));
    let list = &tree.units[0].objects[0];
    assert_eq!((list.kind, list.name.as_deref()), (ObjectKind::GlobalVariables, Some("Global")));
    assert!(declaration(list).contains("Größe"));
    assert_eq!(codes_of(&tree.findings), ["encoding-guessed"]);
}

const COUNTER: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<FBType Name="Counter" Comment="Counts up">
  <Identification Standard="61499-1" Description="To a limit &amp; no further"/>
  <VersionInfo Version="0.9" Author="A" Date="2020-01-01"/><VersionInfo Version="1.0" Author="B" Date="2021-01-01"/>
  <CompilerInfo packageName="util::count"/>
  <InterfaceList>
    <EventInputs><Event Name="CU" Type="Event" Comment="count"><With Var="PV"/><With Var="EN"/></Event></EventInputs>
    <EventOutputs><Event Name="CUO"/></EventOutputs>
    <InputVars><VarDeclaration Name="PV" Type="UINT" InitialValue="10" Comment="limit&#10;of all"/><VarDeclaration Name="EN" Type="BOOL" ArraySize="4"/></InputVars>
    <OutputVars><VarDeclaration Name="Q" Type="BOOL" ArraySize="1..3"/></OutputVars>
  </InterfaceList>
  <BasicFB>
    <InternalVars><VarDeclaration Name="n" Type="UINT"/></InternalVars>
    <ECC><ECState Name="START"/></ECC>
    <Algorithm Name="Up" Comment="one more"><ST><![CDATA[n := n + 1;]]></ST></Algorithm>
    <Algorithm Name="Old"><ST Text="n := 0;&#10;"/></Algorithm>
  </BasicFB>
</FBType>"#;

#[test]
fn a_block_of_4diac() {
    let unit = unit("Counter.fbt", COUNTER);
    assert_eq!(unit.vendor, Vendor::FourDiac);
    let block = &unit.objects[0];
    assert_eq!(
        declaration(block),
        "FUNCTION_BLOCK Counter\nVAR_INPUT\n\t// limit\n\t// of all\n\tPV : UINT := 10;\n\tEN : ARRAY [0..3] OF BOOL;\nEND_VAR\n\
         VAR_OUTPUT\n\tQ : ARRAY [1..3] OF BOOL;\nEND_VAR\nVAR\n\tn : UINT;\nEND_VAR\n"
    );
    let documentation = block.documentation.as_ref().expect("it has a comment");
    assert_eq!(
        &*documentation.text,
        "Counts up\n\nTo a limit & no further\n\nEvent inputs:\n\n- `CU` with `PV`, `EN`: count\n\nEvent outputs:\n\n- `CUO`"
    );
    assert_eq!(block.folder, ["util", "count"]);
    for property in [("version", "1.0"), ("author", "B"), ("event_input", "CU WITH PV, EN"), ("event_output", "CUO")] {
        assert!(block.properties.contains(&(property.0.to_owned(), property.1.to_owned())), "{property:?}");
    }
    assert!(matches!(&block.body, Body::Other(Language::Ecc, _)));
    assert!(
        matches!(&find(&unit.objects, "Up").expect("it is there").body, Body::St(body) if &*body.text == "n := n + 1;")
    );
    assert!(
        matches!(&find(&unit.objects, "Old").expect("it is there").body, Body::St(body) if &*body.text == "n := 0;\n")
    );
    let fragment = block.declaration.as_ref().expect("it is declared");
    let at = fragment.text.find("UINT := 10").expect("it is there");
    assert_eq!(fragment.map.span(Span::from(at..at + 4)).of(COUNTER), "UINT");
}

#[test]
fn data_types_and_constants_of_4diac() {
    let text = |name: &str, xml: &str| declaration(&unit(name, xml).objects[0]).to_owned();
    assert_eq!(
        text(
            "S.dtp",
            r#"<DataType Name="S"><StructuredType><VarDeclaration Name="a" Type="INT" Comment="one"/></StructuredType></DataType>"#
        ),
        "TYPE S :\nSTRUCT\n\t// one\n\ta : INT;\nEND_STRUCT;\nEND_TYPE\n"
    );
    assert_eq!(
        text(
            "E.dtp",
            r#"<DataType Name="E"><EnumeratedType><EnumeratedValue Name="A"/><EnumeratedValue Name="B"/></EnumeratedType></DataType>"#
        ),
        "TYPE E :\n(\n\tA,\n\tB\n);\nEND_TYPE\n"
    );
    assert_eq!(
        text(
            "A.dtp",
            r#"<DataType Name="A"><ArrayType BaseType="INT"><Subrange LowerLimit="0" UpperLimit="9"/></ArrayType></DataType>"#
        ),
        "TYPE A :\nARRAY [0..9] OF INT;\nEND_TYPE\n"
    );
    assert_eq!(
        text(
            "R.dtp",
            r#"<DataType Name="R"><SubrangeType BaseType="INT"><Subrange LowerLimit="0" UpperLimit="9"/></SubrangeType></DataType>"#
        ),
        "TYPE R :\nINT (0..9);\nEND_TYPE\n"
    );
    assert_eq!(
        text(
            "G.gcf",
            r#"<GlobalConstants Name="G"><GlobalConstants><VarDeclaration Name="PI" Type="REAL" InitialValue="3.14"/></GlobalConstants></GlobalConstants>"#
        ),
        "VAR_GLOBAL CONSTANT\n\tPI : REAL := 3.14;\nEND_VAR\n"
    );
}

#[test]
fn text_of_logi_cad() {
    let text = "{description := \"adds\"}\nFUNCTION f : INT\nEND_FUNCTION";
    let unit = unit("f.iecst", text);
    assert_eq!((unit.vendor, declaration(&unit.objects[0])), (Vendor::LogiCad, text));
}
