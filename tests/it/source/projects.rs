//! Projects, what they name, and which unit belongs to which.

use rungbook::source::{Memory, ProjectKind};

use super::{codes_of, read};

const OBJECT: &str =
    r#"<TcPlcObject><POU Name="P"><Declaration><![CDATA[PROGRAM P]]></Declaration></POU></TcPlcObject>"#;

const PROJECT: &str = r#"<Project xmlns="http://schemas.microsoft.com/developer/msbuild/2003">
  <PropertyGroup><Name>Pumps</Name><Title>All pumps</Title><ProjectVersion>1.2.3</ProjectVersion><Company>Maker</Company>
    <Author>Somebody</Author><Description>Pumps &amp; valves</Description><DefaultNamespace>PU</DefaultNamespace></PropertyGroup>
  <ItemGroup>
    <Compile Include="POUs\fb_one.TcPOU"><SubType>Code</SubType></Compile>
    <Compile Include="POUs\FB_%28two%29.TcPOU"><ExcludeFromBuild>true</ExcludeFromBuild></Compile>
    <Compile Include="POUs\FB_Gone.TcPOU" />
    <Compile Include="Old\FB_Old.TcPOU" />
    <Compile Include="..\shared\FB_Shared.TcPOU"><Link>From\Elsewhere\FB_Shared.TcPOU</Link></Compile>
    <Compile Include="..\..\FB_Outside.TcPOU" />
    <Compile Include="VISUs\V.TcVIS" />
    <Folder Include="Old"><ExcludeFromBuild>true</ExcludeFromBuild></Folder>
  </ItemGroup>
  <ItemGroup>
    <PlaceholderReference Include="Tc2_Standard"><DefaultResolution>Tc2_Standard, * (Maker)</DefaultResolution><Namespace>Tc2</Namespace></PlaceholderReference>
    <PlaceholderReference Include="Core"><DefaultResolution>Core, * (Maker)</DefaultResolution></PlaceholderReference>
    <PlaceholderResolution Include="Core"><Resolution>Core, 2.0 (Other)</Resolution></PlaceholderResolution>
    <LibraryReference Include="Base,1.0,System" />
  </ItemGroup>
</Project>"#;

fn pumps() -> Memory {
    Memory::new()
        .with("a/Pumps.plcproj", PROJECT)
        .with("a/POUs/FB_One.TcPOU", OBJECT)
        .with("a/POUs/FB_(two).TcPOU", OBJECT)
        .with("a/POUs/FB_Stray.TcPOU", OBJECT)
        .with("a/Old/FB_Old.TcPOU", OBJECT)
        .with("a/VISUs/V.TcVIS", "<x/>")
        .with("a/plain.st", "PROGRAM q END_PROGRAM")
        .with("shared/FB_Shared.TcPOU", OBJECT)
        .with("lone/FB_Lone.TcPOU", OBJECT)
}

#[test]
fn what_a_project_says_of_itself() {
    let tree = read(&pumps());
    let project = &tree.projects[0];
    let some = |text: &str| Some(text.to_owned());
    assert_eq!((project.kind, project.name.as_str(), project.folder.as_str()), (ProjectKind::TwinCat, "Pumps", "a"));
    assert_eq!(project.about.title, some("All pumps"));
    assert_eq!(project.about.version, some("1.2.3"));
    assert_eq!(project.about.description, some("Pumps & valves"));
    assert_eq!(project.about.namespace, some("PU"));
    let libraries: Vec<_> =
        project.libraries.iter().map(|l| (l.name.as_str(), l.version.as_deref(), l.company.as_deref())).collect();
    assert_eq!(
        libraries,
        [
            ("Tc2_Standard", None, Some("Maker")),
            ("Core", Some("2.0"), Some("Other")),
            ("Base", Some("1.0"), Some("System"))
        ]
    );
}

#[test]
fn members_are_found_in_any_case_and_the_missing_are_told() {
    let tree = read(&pumps());
    let members: Vec<_> = tree.projects[0]
        .members
        .iter()
        .map(|member| (member.path.as_str(), member.file.is_some(), member.exclude_from_build, member.folder.join("/")))
        .collect();
    let expected = [
        ("a/POUs/FB_One.TcPOU", true, false, "POUs".to_owned()),
        ("a/POUs/FB_(two).TcPOU", true, true, "POUs".to_owned()),
        ("a/POUs/FB_Gone.TcPOU", false, false, "POUs".to_owned()),
        ("a/Old/FB_Old.TcPOU", true, true, "Old".to_owned()),
        ("shared/FB_Shared.TcPOU", true, false, "From/Elsewhere".to_owned()),
        ("..\\..\\FB_Outside.TcPOU", false, false, String::new()),
        ("a/VISUs/V.TcVIS", false, false, "VISUs".to_owned()),
    ];
    assert_eq!(members, expected);
    let missing: Vec<_> = tree
        .findings
        .iter()
        .filter(|f| f.code.name == "project-names-missing-file")
        .map(|f| tree.files.text(f.place))
        .collect();
    assert_eq!(missing, ["POUs\\FB_Gone.TcPOU", "..\\..\\FB_Outside.TcPOU"]);
}

#[test]
fn a_unit_belongs_to_the_project_that_names_it_or_holds_it() {
    let tree = read(&pumps());
    let belonging: Vec<_> =
        tree.units.iter().map(|unit| (tree.files.get(unit.file).path.as_str(), unit.project)).collect();
    let expected = [
        ("a/Old/FB_Old.TcPOU", Some(0)),
        ("a/POUs/FB_(two).TcPOU", Some(0)),
        ("a/POUs/FB_One.TcPOU", Some(0)),
        ("a/POUs/FB_Stray.TcPOU", Some(0)),
        ("a/plain.st", Some(0)),
        ("lone/FB_Lone.TcPOU", None),
        ("shared/FB_Shared.TcPOU", Some(0)),
    ];
    assert_eq!(belonging, expected);
    let strays: Vec<_> = tree
        .findings
        .iter()
        .filter(|f| f.code.name == "not-in-project")
        .map(|f| tree.files.get(f.place.file).path.as_str())
        .collect();
    assert_eq!(strays, ["a/POUs/FB_Stray.TcPOU"]);
}

#[test]
fn of_two_projects_the_nearest_takes_the_file() {
    let names = |path: &str| format!("<Project><ItemGroup><Compile Include=\"{path}\"/></ItemGroup></Project>");
    let memory = Memory::new()
        .with("outer.plcproj", names("inner\\x.TcPOU"))
        .with("inner/inner.plcproj", names("x.TcPOU"))
        .with("inner/x.TcPOU", OBJECT);
    let tree = read(&memory);
    assert_eq!(tree.units[0].project.map(|index| tree.projects[index].name.as_str()), Some("inner"));
    assert!(tree.findings.is_empty());
}

#[test]
fn a_manifest_of_simatic_ax() {
    let text = "# comment\nname: \"@scope/pumps\"\nversion: 1.0.0 # now\nauthor: 'Somebody'\ndescription: >\n  long\ndependencies:\n  \"@ax/system\": ^10.2\n  plain: 1.0\nfiles:\n  - x\n";
    let tree = read(&Memory::new().with("apax.yml", text).with("src/a.st", "A"));
    let project = &tree.projects[0];
    assert_eq!((project.kind, project.name.as_str()), (ProjectKind::SimaticAx, "@scope/pumps"));
    assert_eq!((project.about.version.as_deref(), project.about.author.as_deref()), (Some("1.0.0"), Some("Somebody")));
    let libraries: Vec<_> =
        project.libraries.iter().map(|library| (library.name.as_str(), library.version.as_deref())).collect();
    assert_eq!(libraries, [("@ax/system", Some("^10.2")), ("plain", Some("1.0"))]);
    assert_eq!(tree.units[0].project, Some(0));
}

#[test]
fn a_machine_of_automation_studio() {
    let memory = Memory::new()
        .with("m/Machine.apj", "<Project Version=\"1.0\" Description=\"press\"/>")
        .with("m/Logical/Ctl/IEC.prg", "<Program SubType=\"IEC\"><Files><File Description=\"cyclic part\">Main.st</File><File>\\Logical\\Common\\Axis.st</File></Files></Program>")
        .with("m/Logical/Ctl/Main.st", "PROGRAM _CYCLIC\nEND_PROGRAM")
        .with("m/Logical/Common/Axis.st", "ACTION a: END_ACTION")
        .with("m/Logical/Lib/IEC.lby", "<Library Version=\"2.1\"><Files><File>gone.st</File></Files><Dependencies><Dependency ObjectName=\"standard\"/></Dependencies></Library>");
    let tree = read(&memory);
    let projects: Vec<_> = tree.projects.iter().map(|project| (project.name.as_str(), project.kind)).collect();
    let expected = [
        ("Ctl", ProjectKind::AutomationStudioProgram),
        ("Lib", ProjectKind::AutomationStudioLibrary),
        ("Machine", ProjectKind::AutomationStudio),
    ];
    assert_eq!(projects, expected);
    assert_eq!(tree.projects[0].members[0].description.as_deref(), Some("cyclic part"));
    assert!(tree.projects[0].members.iter().all(|member| member.file.is_some()));
    assert_eq!(tree.units.iter().map(|unit| unit.project).collect::<Vec<_>>(), [Some(0), Some(0)]);
    assert_eq!(tree.projects[1].libraries[0].name, "standard");
    assert_eq!(codes_of(&tree.findings), ["project-names-missing-file"]);
}
