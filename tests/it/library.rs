//! Names and what they mean: types, members, parameters, uses.

use rungbook::library::listing::{self, ListedToken};
use rungbook::library::names::Found;
use rungbook::library::{ItemBody, ItemId};
use rungbook::pipeline::Project;

use crate::support::project;

const TEXT: &str = "\
INTERFACE I_Axis
METHOD Move : BOOL
VAR_INPUT
    Target : INT;
END_VAR
END_METHOD
END_INTERFACE
FUNCTION F_Scale : INT
VAR_INPUT
    Value : INT;
END_VAR
F_Scale := Value * 2;
END_FUNCTION
FUNCTION_BLOCK FB_Base
VAR_OUTPUT
    Busy : BOOL;
END_VAR
END_FUNCTION_BLOCK
FUNCTION_BLOCK FB_Axis EXTENDS FB_Base IMPLEMENTS I_Axis
VAR_INPUT
    Speed : INT;
END_VAR
METHOD Move : BOOL
VAR_INPUT
    Target : INT;
END_VAR
Speed := F_Scale(Value := Target);
END_METHOD
END_FUNCTION_BLOCK
PROGRAM PRG_Main
VAR
    axes : ARRAY[0..3] OF FB_Axis;
    any  : I_Axis;
END_VAR
axes[0].speed := 5;
IF NOT axes[1].Busy THEN
    any.Move(Target := Unknown);
END_IF
END_PROGRAM
";

fn item(project: &Project, name: &str) -> ItemId {
    let found = project.catalogue.iter().find(|(id, _)| project.catalogue.qualified_name(*id) == name);
    found.unwrap_or_else(|| panic!("no {name}")).0
}

/// What each linked name in a body means: `name → owner.target`.
fn meanings(project: &Project, name: &str) -> Vec<String> {
    let id = item(project, name);
    let ItemBody::St(excerpt) = project.catalogue.item(id).body else { panic!("{name} has a body") };
    let text = project.catalogue.excerpt(excerpt);
    let meaning = |token: ListedToken| {
        let target = match token.target? {
            Found::Item(id) => project.catalogue.qualified_name(id),
            Found::Variable(id, i) => {
                format!("{}.{}", project.catalogue.qualified_name(id), project.catalogue.item(id).variables[i].name)
            }
        };
        Some(format!("{} → {target}", token.span.of(text)))
    };
    listing::tokens(&project.catalogue, &project.names, id, excerpt).into_iter().filter_map(meaning).collect()
}

#[test]
fn names_in_a_body_lead_to_their_declarations() {
    let project = project(&[("a.st", TEXT)], "");
    assert_eq!(
        meanings(&project, "PRG_Main"),
        [
            "axes → PRG_Main.axes",
            "speed → FB_Axis.Speed",
            "axes → PRG_Main.axes",
            "Busy → FB_Base.Busy",
            "any → PRG_Main.any",
            "Move → I_Axis.Move",
            "Target → I_Axis.Move.Target",
        ]
    );
    assert_eq!(
        meanings(&project, "FB_Axis.Move"),
        ["Speed → FB_Axis.Speed", "F_Scale → F_Scale", "Value → F_Scale.Value", "Target → FB_Axis.Move.Target",]
    );
}

#[test]
fn what_a_body_names_is_used() {
    let project = project(&[("a.st", TEXT)], "");
    let used_by = |name: &str| -> Vec<String> {
        let users = project.relations.used_by.get(&item(&project, name)).into_iter().flatten();
        users.map(|id| project.catalogue.qualified_name(*id)).collect()
    };
    assert_eq!(used_by("F_Scale"), ["FB_Axis"]);
    assert_eq!(used_by("FB_Axis"), ["PRG_Main"]);
    assert_eq!(used_by("I_Axis"), ["PRG_Main"]);
}

#[test]
fn equal_names_of_two_libraries_are_kept_apart() {
    let project_file = |name: &str| {
        format!(
            "<Project><PropertyGroup><Name>{name}</Name></PropertyGroup><ItemGroup>\
             <Compile Include=\"FB_A.TcPOU\"/><Compile Include=\"FB_B.TcPOU\"/></ItemGroup></Project>"
        )
    };
    let pou = |name: &str, text: &str| {
        format!(
            "<TcPlcObject><POU Name=\"{name}\"><Declaration><![CDATA[{text}]]></Declaration>\
             <Implementation><ST><![CDATA[]]></ST></Implementation></POU></TcPlcObject>"
        )
    };
    let (one, two) = (project_file("One"), project_file("Two"));
    let a = pou("FB_A", "FUNCTION_BLOCK FB_A\n");
    let b = pou("FB_B", "FUNCTION_BLOCK FB_B EXTENDS FB_A\n");
    let files = [
        ("one/One.plcproj", one.as_str()),
        ("one/FB_A.TcPOU", &a),
        ("one/FB_B.TcPOU", &b),
        ("two/Two.plcproj", &two),
        ("two/FB_A.TcPOU", &a),
        ("two/FB_B.TcPOU", &b),
    ];
    let project = project(&files, "");
    assert_eq!(project.catalogue.libraries.len(), 2);
    for (id, item) in project.catalogue.iter().filter(|(_, item)| item.name == "FB_B") {
        let base = item.extends[0].item().expect("the base is in the tree");
        assert_eq!(project.catalogue.item(base).library, item.library, "{id:?}");
    }
}

#[test]
fn an_action_that_stands_apart_belongs_to_its_block() {
    let files = [
        ("a.st", "FUNCTION_BLOCK FB_Pump\nEND_FUNCTION_BLOCK\nACTION FB_Pump.Start:\nx := 1;\nEND_ACTION\n"),
        ("b.st", "ACTION fb_pump.Stop:\nx := 0;\nEND_ACTION\nACTION Nobody.Act:\nEND_ACTION\n"),
    ];
    let project = project(&files, "");
    let pump = item(&project, "FB_Pump");
    let names = |ids: &[ItemId]| ids.iter().map(|id| project.catalogue.item(*id).name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&project.catalogue.item(pump).children), ["Start", "Stop"]);
    let alone: Vec<_> =
        project.catalogue.iter().filter(|(_, item)| item.parent.is_none()).map(|(_, item)| &item.name).collect();
    assert_eq!(alone, ["FB_Pump", "Nobody.Act"]);
}

#[test]
fn algorithms_are_actions_of_their_block() {
    let text = "<FBType Name=\"A\"><InterfaceList><OutputVars><VarDeclaration Name=\"Y\" Type=\"INT\"/></OutputVars></InterfaceList><BasicFB><Algorithm Name=\"REQ\"><ST><![CDATA[ALGORITHM REQ\nY := 1;\nEND_ALGORITHM]]></ST></Algorithm></BasicFB></FBType>";
    let project = project(&[("A.fbt", text)], "");
    let action = project.catalogue.item(item(&project, "A.REQ"));
    assert!(matches!(action.body, ItemBody::St(_)), "{:?}", action.body);
    assert!(project.findings.iter().all(|finding| finding.severity != rungbook::diagnostic::Severity::Error));
}
