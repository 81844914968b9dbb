//! The forms in XML.

use super::{any, shown};
use rungbook::table::duration::Repeat;
use rungbook::table::model::Node;

#[test]
fn exteta_reads_with_blocks_and_entities() {
    let text = r#"<?xml version="1.0"?>
<!-- a comment -- with two dashes -->
<test-table xmlns="http://formal.iti.kit.edu/exteta-1.1" version="1.1" name="Tank">
  <variables>
    <variable io="input" name="level" data-type="INT"/>
    <variable io="output" identifier="full" data-type="BOOLEAN"/>
    <constraint name="p" data-type="INT" constraint="&gt;=3"/>
    <constraint name="q" data-type="INT"/>
  </variables>
  <steps>
    <step duration="wait"><cell>&lt;p, &lt;&gt; q</cell><cell>false</cell></step>
    <block duration="[1,-]"><step><full>= level &gt;</full><level>-</level></step></block>
    <step duration="omega"><cell><![CDATA[>= p]]></cell><cell/></step>
  </steps>
  <functions>FUNCTION f : INT f := 1; END_FUNCTION</functions>
  <options><option key="mode" value="ic3"/></options>
</test-table>"#;
    let read = any(text);
    assert_eq!(shown(text, &read.findings), ["table-cell at \"\": a value is missing at the end"]);
    let at = read.findings[0].place.span.start as usize;
    assert_eq!(&text[at - 5..at], " &gt;", "the place is behind the entity");
    let table = &read.tables[0];
    assert_eq!(table.name, "Tank");
    assert_eq!(table.globals.iter().filter(|g| g.constraint.is_some()).count(), 1);
    let rows = table.rows();
    assert!(rows[0].duration.duration.has_progress());
    assert_eq!(rows[0].cells[0].as_ref().map(|cell| cell.text.as_str()), Some("<p, <> q"));
    assert_eq!(rows[2].cells[0].as_ref().map(|cell| cell.place.span.of(text)), Some(">= p"));
    assert_eq!(rows[2].duration.repeat, Some(Repeat::Omega));
    assert!(rows[2].cells[1].is_none());
    assert!(matches!(&table.body[1], Node::Block(block) if block.children.len() == 1));
    assert_eq!(table.functions[0].name, "f");
}

#[test]
fn a_session_gives_its_code_and_its_tables() {
    let text = r#"<session xmlns="http://formal.iti.kit.edu/stvs/io/1.0/">
<code><plaintext><![CDATA[PROGRAM P
END_PROGRAM]]></plaintext></code>
<tabs><tab id="0" open="true" readOnly="false">
  <specification isConcrete="false" name="Spec">
    <variables><ioVariable io="input" name="a" data-type="BOOL" comment="key"/><ioVariable io="output" name="b" data-type="INT"/>
      <freeVariable name="g" data-type="INT" default="[1,5]"/></variables>
    <rows><row comment="first"><duration>[1,-]</duration><cell>TRUE</cell><cell>g</cell></row></rows>
  </specification>
  <specification isConcrete="true" isCounterExample="true" name="Spec">
    <variables><ioVariable io="input" name="a" data-type="BOOL"/><ioVariable io="output" name="b" data-type="INT"/></variables>
    <rows><row><duration>3</duration>
      <cycle><cell>TRUE</cell><cell>1</cell></cycle><cycle><cell>TRUE</cell><cell>1</cell></cycle>
      <cycle><cell>TRUE</cell><cell>2</cell></cycle></row></rows>
  </specification>
</tab></tabs></session>"#;
    let read = any(text);
    assert_eq!(shown(text, &read.findings), [""; 0]);
    let code = read.code.expect("the session has code");
    assert_eq!(&*code.text, "PROGRAM P\nEND_PROGRAM");
    assert_eq!(code.map.offset(10) as usize, text.find("END_PROGRAM").expect("it is there"));
    assert_eq!(read.tables[0].columns[0].remark.as_deref(), Some("key"));
    let counterexample = &read.tables[1];
    assert!(counterexample.options.concrete && counterexample.options.counterexample);
    let repeats: Vec<_> = counterexample.rows().iter().map(|row| row.duration.repeat).collect();
    let times = |n| Some(Repeat::Times { low: n, high: Some(n) });
    assert_eq!(repeats, [times(2), times(1)]);
}

#[test]
fn test_manager_tables_become_concrete_ones() {
    let text = r#"<tabletestspec><testinformation name="T" testee="FB_X"/>
<testcasegroup name="G"><testcase name="Case 1"><teststeps>
  <teststep description="start"><durationrepeat count="3"/><inputs><set var="a" value="TRUE"/><set var="n" value="5"/></inputs>
    <call/><conditions><checkvalue var="out.x" value="4" operator="=&gt;"/><checkrange var="y" lower="1" upper="2"/></conditions></teststep>
  <teststep><durationtimespan time="T#20ms"/><inputs><set var="a" value="FALSE"/></inputs><call/>
    <conditions><checkvalue var="y" value="7" operator="="/><checkramp var="y" ramp="rising"/></conditions></teststep>
</teststeps></testcase></testcasegroup></tabletestspec>"#;
    let read = any(text);
    assert_eq!(
        shown(text, &read.findings),
        [
            "table-cycle-time at \"T#20ms\": `T#20ms` is a time, and the length of a cycle is not known",
            "table-unsupported at \"<checkramp var=\\\"y\\\" ramp=\\\"rising\\\"/>\": `checkramp` has no counterpart in a table and is left out",
        ]
    );
    let table = &read.tables[0];
    assert_eq!(table.unit.as_ref().map(|word| word.text.as_str()), Some("FB_X"));
    let texts: Vec<Vec<&str>> = table
        .effective()
        .iter()
        .map(|row| row.iter().map(|cell| cell.map_or("", |cell| cell.text.as_str())).collect())
        .collect();
    assert_eq!(texts, [["TRUE", "5", ">= 4", "[1, 2]"], ["FALSE", "5", "-", "7"]]);
    assert_eq!(table.rows()[0].remark.as_ref().map(|remark| remark.text.as_str()), Some("start"));
}

#[test]
fn files_that_are_no_tables_are_findings() {
    for text in [
        "<html/>",
        "<test-table>",
        "<test-table/>",
        "<specification><variables/><rows><row/></rows></specification>",
        "<",
    ] {
        assert!(any(text).has_errors(), "{text}");
    }
}
