//! Charts that are drawn: PLCopen XML and TwinCAT mean what the same chart means in text.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use rungbook::library::ItemKind;
use rungbook::machine::elaborate::{Options, elaborate};
use rungbook::machine::interpret::Interpreter;
use rungbook::machine::program::{Program, SlotId};
use rungbook::machine::translate;
use rungbook::pipeline::Project;

use crate::support::project;

const INPUTS: [&str; 4] = ["Go", "Next", "Left", "SFCReset"];
const OUTPUTS: [&str; 5] = ["Lamp", "Late", "Kept", "Count", "Entered"];

const VARIABLES: &str = "FUNCTION_BLOCK FB_Chart
VAR_INPUT Go : BOOL; Next : BOOL; Left : BOOL; SFCReset : BOOL; END_VAR
VAR_OUTPUT Lamp : BOOL; Late : BOOL; Kept : BOOL; Count : INT; Entered : INT; END_VAR
";

/// A parallel branch, an alternative one, stored and timed actions; two steps have actions of their own.
const TEXT: &str = "
INITIAL_STEP Start: Kept(R); END_STEP
STEP A: Lamp(N); END_STEP
STEP B: Counting(N); END_STEP
STEP C: Late(D, T#20ms); Entering(ON_ENTRY); Entering(ON_EXIT); END_STEP
STEP D: Kept(S); Entering(ACTIVE); END_STEP
TRANSITION FROM Start TO (A, B) := Go; END_TRANSITION
TRANSITION FROM (A, B) TO C := Next; END_TRANSITION
TRANSITION FROM C TO D := Left AND Go; END_TRANSITION
TRANSITION FROM C TO Start := NOT (Go OR Left); END_TRANSITION
TRANSITION FROM D TO Start := Next; END_TRANSITION
ACTION Counting: Count := Count + 1; END_ACTION
ACTION Entering: Entered := Entered + 1; END_ACTION
END_FUNCTION_BLOCK
";

fn program(project: &Project) -> Program {
    let mut units = project.catalogue.iter().filter(|(_, item)| item.kind == ItemKind::FunctionBlock);
    let (unit, _) = units.next().expect("the block");
    elaborate(&project.catalogue, &project.names, unit, &Options::default()).expect("everything is modelled")
}

/// The outputs in 400 cycles of inputs that change now and then.
fn trace(program: &Program) -> Vec<Vec<u64>> {
    let slots: BTreeMap<&str, SlotId> = program.variables.iter().map(|v| (v.path.as_str(), v.slot)).collect();
    let mut run = Interpreter::new(program);
    let mut state = 7_u32;
    let mut trace = Vec::new();
    for _ in 0..400 {
        for (at, name) in INPUTS.iter().enumerate() {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let rare = if at == 3 { 31 } else { 1 };
            run.set(slots[name], u64::from((state >> 16) & rare == 0));
        }
        run.cycle().expect("no fault");
        trace.push(OUTPUTS.iter().map(|name| run.get(slots[name])).collect());
    }
    trace
}

fn in_text() -> Program {
    program(&project(&[("chart.st", &format!("{VARIABLES}{TEXT}"))], ""))
}

/// An element of PLCopen XML with its connections.
fn element(name: &str, id: u32, from: &[u32], attributes: &str, inside: &str) -> String {
    let points: String = from
        .iter()
        .map(|from| format!("<connectionPointIn><connection refLocalId=\"{from}\"/></connectionPointIn>"))
        .collect();
    format!("<{name} localId=\"{id}\" {attributes}><position x=\"0\" y=\"0\"/>{points}{inside}</{name}>")
}

fn fact(identity: &str, value: &str) -> String {
    format!("<attribute guid=\"{identity}\">{value}</attribute>")
}

fn facts(all: &[String]) -> String {
    format!(
        "<addData><data name=\"http://www.3s-software.com/plcopenxml/sfc/element\"><attributes xmlns=\"\">{}</attributes></data></addData>",
        all.concat()
    )
}

fn step(id: u32, name: &str, from: &[u32], inside: &str) -> String {
    element("step", id, from, &format!("name=\"{name}\" initialStep=\"{}\"", name == "Start"), inside)
}

fn inline(code: &str) -> String {
    format!("<condition><inline name=\"\"><ST><xhtml>{code}</xhtml></ST></inline></condition>")
}

fn actions(id: u32, step: u32, all: &[(&str, &str, &str)]) -> String {
    let each = |(name, qualifier, time): &(&str, &str, &str)| {
        format!("<action qualifier=\"{qualifier}\" duration=\"{time}\"><reference name=\"{name}\"/></action>")
    };
    element("actionBlock", id, &[step], "", &all.iter().map(each).collect::<String>())
}

fn block(sfc: &str) -> String {
    let variables = |list: &str, names: &[&str], of: &str| {
        let each = |name: &str| {
            let of = if matches!(name, "Count" | "Entered") { "INT" } else { of };
            format!("<variable name=\"{name}\"><type><{of}/></type></variable>")
        };
        format!("<{list}>{}</{list}>", names.iter().copied().map(each).collect::<String>())
    };
    let code = |name: &str, code: &str| format!("name=\"{name}\"><body><ST><xhtml>{code}</xhtml></ST></body>");
    format!(
        "<project xmlns=\"http://www.plcopen.org/xml/tc6_0200\"><types><pous><pou name=\"FB_Chart\" pouType=\"functionBlock\">\
         <interface>{}{}</interface><actions><action {}</action><action {}</action></actions>\
         <transitions><transition {}</transition></transitions><body><SFC>{sfc}</SFC></body></pou></pous></types></project>",
        variables("inputVars", &INPUTS, "BOOL"),
        variables("outputVars", &OUTPUTS, "BOOL"),
        code("Counting", "Count := Count + 1;"),
        code("Entering", "Entered := Entered + 1;"),
        code("Done", "Done := Next;"),
    )
}

/// The chart of [`TEXT`]: a condition of each kind, a convergence of steps, jumps.
fn drawn() -> String {
    let own = |identity: &str| fact(identity, "Entering");
    let entering = [own("a6b08bd8-b696-47e3-9cbf-7408b61c9ff8"), own("a2621e18-7de3-4ea6-ae6d-89e9e0b7befd")];
    [
        step(0, "Start", &[], ""),
        actions(1, 0, &[("Kept", "R", "")]),
        element("inVariable", 2, &[], "", "<connectionPointOut/><expression>Go</expression>"),
        element(
            "transition",
            3,
            &[0],
            "",
            "<condition><connectionPointIn><connection refLocalId=\"2\"/></connectionPointIn></condition>",
        ),
        element("simultaneousDivergence", 4, &[3], "", "<connectionPointOut/><connectionPointOut/>"),
        step(5, "A", &[4], ""),
        actions(6, 5, &[("Lamp", "N", "")]),
        step(7, "B", &[4], ""),
        actions(8, 7, &[("Counting", "N", "")]),
        element("simultaneousConvergence", 9, &[5, 7], "", ""),
        element("transition", 10, &[9], "", "<condition><reference name=\"Done\"/></condition>"),
        step(11, "C", &[10], &facts(&entering)),
        actions(12, 11, &[("Late", "D", "T#20ms")]),
        element("selectionDivergence", 13, &[11], "", ""),
        element("transition", 14, &[13], "", &inline("Left AND Go")),
        step(15, "D", &[14], &facts(&[own("700a583f-b4d4-43e4-8c14-629c7cd3bec8")])),
        actions(16, 15, &[("Kept", "S", "")]),
        element("transition", 17, &[15], "", &inline("Next;")),
        element(
            "transition",
            18,
            &[13],
            "",
            &inline("Go OR Left").replace("<condition>", "<condition negated=\"true\">"),
        ),
        element("selectionConvergence", 19, &[17, 18], "", ""),
        element("jumpStep", 20, &[19], "targetName=\"Start\"", ""),
    ]
    .concat()
}

#[test]
fn plcopen_means_what_the_text_means() {
    let project = project(&[("chart.xml", &block(&drawn()))], "");
    assert!(project.findings.iter().all(|finding| finding.code.name != "unread-chart"), "{:?}", project.findings);
    let drawn = program(&project);
    let (drawn, text) = (trace(&drawn), trace(&in_text()));
    assert_eq!(drawn, text);
    let moved = |at: usize| text.iter().any(|outputs| outputs[at] > 0);
    assert!((0..OUTPUTS.len()).all(moved), "the inputs reach everything");
}

#[test]
fn a_drawn_chart_can_be_proven_about() {
    let program = program(&project(&[("chart.xml", &block(&drawn()))], ""));
    assert_eq!(program.assumptions, ["`SFCReset` starts a chart anew in each call that finds it TRUE"]);
    let translated = translate::translate(&program, &translate::Options::default()).expect("everything is modelled");
    assert!(!translated.system.states.is_empty());
}

fn refusal(sfc: &str) -> String {
    let project = project(&[("chart.xml", &block(sfc))], "");
    let found = project.findings.iter().find(|finding| finding.code.name == "unread-chart");
    let finding = found.unwrap_or_else(|| panic!("{:?}", project.findings));
    finding.message.clone()
}

#[test]
fn what_the_text_cannot_say_is_refused() {
    let chart = drawn();
    let changed = |from: &str, to: &str| {
        assert!(chart.contains(from), "{from}");
        refusal(&chart.replace(from, to))
    };
    assert_eq!(refusal(""), "the chart is not read: it has no steps");
    let wire = "<condition><connectionPointIn><connection refLocalId=";
    let drawn_condition = changed(&format!("{wire}\"2\""), &format!("{wire}\"5\""));
    assert_eq!(drawn_condition, "the chart is not read: a condition that is drawn");
    assert_eq!(
        changed("refLocalId=\"11\"", "refLocalId=\"10\""),
        "the chart is not read: an action block stands at no step"
    );
    assert_eq!(changed("targetName=\"Start\"", ""), "the chart is not read: a `jumpStep` without a name");
    let jump = element("jumpStep", 21, &[4], "targetName=\"C\"", "");
    let closed = format!(
        "{jump}{}",
        chart.replace(
            "<connection refLocalId=\"7\"/></connectionPointIn></simultaneousConvergence>",
            "<connection refLocalId=\"21\"/></connectionPointIn></simultaneousConvergence>"
        )
    );
    assert_eq!(refusal(&closed), "the chart is not read: a parallel branch ends in a jump");
    assert_eq!(
        refusal(&format!("{chart}<macroStep localId=\"40\" name=\"M\"/>")),
        "the chart is not read: a macro step"
    );
}

/// The archive of TwinCAT: an element with its facts.
fn archived(kind: &str, known: &[(&str, &str)], inside: &str) -> String {
    let mut out = format!("<o t=\"{kind}\">{inside}<l2 n=\"Attributes\" cet=\"SFCAttribute\">");
    for (identity, value) in known {
        let _ = write!(
            out,
            "<o><v n=\"AttributeId\">{{{identity}}}</v><o n=\"Value\" t=\"StringValue\"><v n=\"Value\">\"{value}\"</v><v n=\"DefaultValue\">\"\"</v></o></o>"
        );
    }
    out + "</l2></o>"
}

const NAME: &str = "38391c6d-6d4a-42f8-8ee7-9f45e5adafa8";
const INITIAL: &str = "6844a48e-46c2-4cc8-a185-a478f3b99cc0";
const PARALLEL: &str = "23bdaa98-72ec-41f7-817b-9dede5697086";
const QUALIFIER: &str = "e174fc0d-80b0-4a9e-a530-ca239c249a50";

fn list(items: &[String]) -> String {
    format!("<o n=\"ElementList\" t=\"SFCElementList\"><l2 n=\"InnerList\">{}</l2></o>", items.concat())
}

fn legs(legs: &[Vec<String>]) -> String {
    let each: String = legs.iter().map(|leg| format!("<o>{}</o>", list(leg))).collect();
    format!("<o n=\"ElementList\" t=\"SFCElementList\"><l2 n=\"InnerList\" cet=\"SFCSegment\">{each}</l2></o>")
}

fn tc_step(name: &str, known: &[(&str, &str)], actions: &[(&str, &str)]) -> String {
    let actions: Vec<String> =
        actions.iter().map(|(name, how)| archived("SFCAction", &[(NAME, name), (QUALIFIER, how)], "")).collect();
    let initial = if name == "Start" { "TRUE" } else { "FALSE" };
    archived("SFCStep", &[&[(NAME, name), (INITIAL, initial)], known].concat(), &list(&actions))
}

fn tc_transition(condition: &str) -> String {
    archived("SFCTransition", &[(NAME, condition)], "<n n=\"EmbeddedTransition\"/>")
}

#[test]
fn twincat_means_what_the_text_means() {
    let entering =
        [("a6b08bd8-b696-47e3-9cbf-7408b61c9ff8", "Entering"), ("a2621e18-7de3-4ea6-ae6d-89e9e0b7befd", "Entering")];
    let root = list(&[
        tc_step("Start", &[], &[("Kept", "R")]),
        tc_transition("Go"),
        archived(
            "SFCBranch",
            &[(PARALLEL, "TRUE")],
            &legs(&[vec![tc_step("A", &[], &[("Lamp", "N")])], vec![tc_step("B", &[], &[("Counting", "N")])]]),
        ),
        tc_transition("Next"),
        tc_step("C", &entering, &[("Late", "D T#20ms")]),
        archived(
            "SFCBranch",
            &[(PARALLEL, "FALSE")],
            &legs(&[
                vec![
                    tc_transition("Left AND Go"),
                    tc_step("D", &[("700a583f-b4d4-43e4-8c14-629c7cd3bec8", "Entering")], &[("Kept", "S")]),
                    tc_transition("Next"),
                ],
                vec![tc_transition("NOT (Go OR Left)"), archived("SFCJump", &[(NAME, "Start")], "")],
            ]),
        ),
        archived("SFCJump", &[(NAME, "Start")], ""),
    ]);
    let action = |name: &str, code: &str| {
        format!("<Action Name=\"{name}\"><Implementation><ST><![CDATA[{code}]]></ST></Implementation></Action>")
    };
    let file = format!(
        "<TcPlcObject><POU Name=\"FB_Chart\"><Declaration><![CDATA[{VARIABLES}]]></Declaration><Implementation><SFC><XmlArchive><Data>\
         <o xml:space=\"preserve\" t=\"SFCImplementationObject\"><o n=\"Root\" t=\"SFCSegment\">{root}</o></o></Data></XmlArchive></SFC>\
         </Implementation>{}{}</POU></TcPlcObject>",
        action("Counting", "Count := Count + 1;"),
        action("Entering", "Entered := Entered + 1;"),
    );
    let project = project(&[("FB_Chart.TcPOU", &file)], "");
    assert!(project.findings.iter().all(|finding| finding.code.name != "unread-chart"), "{:?}", project.findings);
    assert_eq!(trace(&program(&project)), trace(&in_text()));
}

#[test]
fn a_chart_may_be_the_body_of_an_action() {
    let text = "FUNCTION_BLOCK FB
VAR_INPUT Go : BOOL; Run : BOOL; END_VAR
VAR_OUTPUT Lamp : BOOL; Other : BOOL; END_VAR
IF Run THEN Chart(); END_IF
Other := Lamp;
ACTION Chart:
INITIAL_STEP Start: END_STEP
STEP On: Lamp(N); END_STEP
TRANSITION FROM Start TO On := Go; END_TRANSITION
TRANSITION FROM On TO Start := NOT Go AND On.T >= T#10ms; END_TRANSITION
END_ACTION
END_FUNCTION_BLOCK
";
    let mut machine = crate::elaborate::Machine::new(text, "FB");
    let mut seen = Vec::new();
    for (go, run) in [(1, 0), (1, 1), (0, 0), (0, 1), (0, 1), (0, 1)] {
        machine.set("Go", go).set("Run", run).cycle();
        seen.push(machine.get("Other"));
    }
    assert_eq!(seen, [0, 1, 1, 1, 0, 0]);
}
