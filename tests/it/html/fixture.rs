//! A manual made by hand: a small plant with everything that a page can show, and a hostile block.

use rungbook::book::view::coverage::{Coverage, CoverageRow, Hole};
use rungbook::book::view::entity::*;
use rungbook::book::view::finding::{CodeCount, FindingView, ReadingView, SkippedView};
use rungbook::book::view::prose::{Block, Href, Inline, ListItem};
use rungbook::book::view::table::*;
use rungbook::book::view::{Book, Chapter, Entry, FolderView, Front, IndexEntry, KindList, LibraryView, Totals};

use super::source;

/// Text that would do harm as markup, as an attribute or in a script.
pub(crate) const HOSTILE: &str =
    "</script><script>alert(1)</script><img src=x onerror=alert(2)>\"'`{{ 7*7 }}{% raw %}&lt;";

/// A link to a page.
pub(crate) fn page(url: &str) -> Href {
    Href::Page { url: url.to_owned(), label: String::new() }
}

/// A link to an entity, or a name from elsewhere for an empty address.
pub(crate) fn link(name: &str, kind_label: &'static str, url: &str) -> EntityLink {
    EntityLink { name: name.to_owned(), kind_label, to: (!url.is_empty()).then(|| page(url)) }
}

fn text(text: &str) -> Vec<Inline> {
    vec![Inline::text(text)]
}

fn paragraph(content: &str) -> Block {
    Block::Paragraph { content: text(content) }
}

/// A type that is one name.
fn type_(name: &str, url: &str) -> Vec<TypePart> {
    vec![TypePart { text: name.to_owned(), to: (!url.is_empty()).then(|| page(url)) }]
}

fn variable(name: &str, type_: Vec<TypePart>, initial: &str, brief: &str) -> VariableView {
    VariableView {
        name: name.to_owned(),
        anchor: format!("v-{}", name.to_lowercase()),
        label: String::new(),
        type_,
        initial: initial.to_owned(),
        address: String::new(),
        badges: Vec::new(),
        brief: if brief.is_empty() { Vec::new() } else { text(brief) },
        detail: Vec::new(),
        pragmas: Vec::new(),
        line: 12,
        inherited_from: None,
    }
}

fn section(key: &'static str, title: &str, public: bool, variables: Vec<VariableView>) -> SectionView {
    SectionView { key, title: title.to_owned(), public, variables }
}

/// A drawing as the figure room writes one.
fn diagram(name: &str, pins: &[(&str, &str)]) -> Diagram {
    let height = 60 + 20 * pins.len();
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"rb-figure\" role=\"img\" aria-label=\"{name}\" width=\"380\" \
         height=\"{height}\" viewBox=\"0 0 380 {height}\" style=\"font-family:ui-monospace,monospace;font-size:12px\">\
         <rect x=\"90\" y=\"4\" width=\"200\" height=\"{}\" rx=\"3\" style=\"fill:var(--rb-paper,#ffffff);\
         stroke:var(--rb-line,#5a6b7b);stroke-width:1.4\"/><rect x=\"90\" y=\"4\" width=\"200\" height=\"36\" \
         style=\"fill:var(--rb-fill,#f1f5f9);stroke:var(--rb-line,#5a6b7b)\"/><text x=\"190\" y=\"27\" \
         text-anchor=\"middle\" style=\"fill:var(--rb-ink,#1c2733);font-weight:bold\">{name}</text>",
        height - 8
    );
    for (i, (input, output)) in pins.iter().enumerate() {
        let y = 60 + 20 * i;
        svg.push_str(&format!(
            "<line x1=\"60\" y1=\"{y}\" x2=\"90\" y2=\"{y}\" style=\"stroke:var(--rb-line,#5a6b7b)\"/>\
             <text x=\"98\" y=\"{}\" style=\"fill:var(--rb-ink,#1c2733)\">{input}</text>\
             <text x=\"282\" y=\"{}\" text-anchor=\"end\" style=\"fill:var(--rb-ink,#1c2733)\">{output}</text>\
             <text x=\"52\" y=\"{}\" text-anchor=\"end\" style=\"fill:var(--rb-muted,#5f6f7e)\">BOOL</text>",
            y + 4,
            y + 4,
            y + 4
        ));
    }
    svg.push_str("</svg>");
    Diagram { svg, alt: name.to_owned(), width: 380.0, height: height as f64 }
}

/// An inheritance drawing with links, as addresses below the root.
fn inheritance() -> Diagram {
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"rb-figure\" role=\"img\" aria-label=\"FB_Cylinder extends \
               FB_Actuator\" width=\"220\" height=\"120\" viewBox=\"0 0 220 120\" style=\"font-size:12px\">\
               <a href=\"handling/base/fb_actuator.html\"><rect x=\"30\" y=\"4\" width=\"160\" height=\"30\" \
               style=\"fill:var(--rb-fill,#f1f5f9);stroke:var(--rb-line,#5a6b7b)\"/><text x=\"110\" y=\"24\" \
               text-anchor=\"middle\" style=\"fill:var(--rb-accent,#0b5cad)\">FB_Actuator</text></a>\
               <line x1=\"110\" y1=\"34\" x2=\"110\" y2=\"84\" style=\"stroke:var(--rb-line,#5a6b7b)\"/>\
               <rect x=\"30\" y=\"84\" width=\"160\" height=\"30\" style=\"fill:var(--rb-paper,#fff);\
               stroke:var(--rb-line,#5a6b7b)\"/><text x=\"110\" y=\"104\" text-anchor=\"middle\" \
               style=\"fill:var(--rb-ink,#1c2733)\">FB_Cylinder</text></svg>";
    Diagram { svg: svg.to_owned(), alt: "inheritance".to_owned(), width: 220.0, height: 120.0 }
}

fn core(kind: &'static str, kind_label: &'static str, name: &str, url: &str, file: &str) -> CoreView {
    CoreView {
        kind,
        kind_label,
        name: name.to_owned(),
        qualified_name: name.to_owned(),
        url: url.to_owned(),
        file: file.to_owned(),
        line: 3,
        documented: true,
        ..CoreView::default()
    }
}

fn entity(core: CoreView, folder: &[&str]) -> EntityView {
    EntityView {
        core,
        library: 0,
        library_name: "Handling".to_owned(),
        namespace: Vec::new(),
        folder: folder.iter().map(|part| (*part).to_owned()).collect(),
        relations: Vec::new(),
        inheritance: None,
        members: Vec::new(),
        inherited: Vec::new(),
        tables: Vec::new(),
        sources: Vec::new(),
        findings: Vec::new(),
    }
}

const ACTUATOR: &str = "handling/base/fb_actuator.html";
const CYLINDER: &str = "handling/drives/fb_cylinder.html";
const STATE: &str = "handling/types/e_cylinderstate.html";
const RECIPE: &str = "handling/types/st_recipe.html";
const DRIVE: &str = "handling/base/i_drive.html";

fn cylinder() -> EntityView {
    let mut core =
        core("function-block", "Function block", "FB_Cylinder", CYLINDER, "Handling/Drives/FB_Cylinder.TcPOU");
    core.brief = vec![
        Inline::text("Drives a double-acting cylinder and watches that it "),
        Inline::Emph { content: text("arrives in time") },
        Inline::text("; see "),
        Inline::Link {
            to: page("handling/base/fb_actuator.html#m-reset"),
            content: vec![Inline::Code { text: "FB_Actuator.Reset".to_owned() }],
        },
        Inline::text("."),
    ];
    core.detail = cylinder_prose();
    core.facts = vec![
        Fact { title: "Since".to_owned(), content: vec![paragraph("1.2.0")] },
        Fact { title: "Requirements".to_owned(), content: vec![paragraph("REQ-017, REQ-018")] },
    ];
    core.signature = "FUNCTION_BLOCK FINAL FB_Cylinder EXTENDS FB_Actuator IMPLEMENTS I_Drive".to_owned();
    core.diagram = Some(diagram(
        "FB_Cylinder",
        &[("bExtend", "bExtended"), ("bRetract", "bRetracted"), ("tTimeout", "bError"), ("stRecipe", "eState")],
    ));
    core.badges = vec!["final".to_owned()];
    core.pragmas = vec!["{attribute 'reflection'}".to_owned()];
    core.sections = cylinder_sections();
    let mut entity = entity(core, &["Drives"]);
    entity.relations = vec![
        Relation { key: "extends", title: "Extends", links: vec![link("FB_Actuator", "Function block", ACTUATOR)] },
        Relation {
            key: "implements",
            title: "Implements",
            links: vec![link("I_Drive", "Interface", DRIVE), link("I_Vendor", "", "")],
        },
        Relation {
            key: "uses",
            title: "Uses",
            links: vec![link("E_CylinderState", "Enumeration", STATE), link("TON", "", "")],
        },
        Relation { key: "used-by", title: "Used by", links: vec![link("MAIN", "Program", "handling/main.html")] },
    ];
    entity.inheritance = Some(inheritance());
    entity.members = cylinder_members();
    entity.inherited = vec![InheritedView {
        link: link("Reset", "Method", "handling/base/fb_actuator.html#m-reset"),
        kind_label: "Method",
        from: link("FB_Actuator", "Function block", ACTUATOR),
        brief: text("Acknowledges an error."),
    }];
    entity.tables = vec![travel_table(), wide_table(), broken_table()];
    entity.sources = vec![
        source::listing("Declaration", "Handling/Drives/FB_Cylinder.TcPOU", 3, source::DECLARATION),
        source::listing("Body", "Handling/Drives/FB_Cylinder.TcPOU", 60, source::BODY),
        SourceView {
            note: Some("drawn in a graphical language".to_owned()),
            ..source::listing("Homing", "Handling/Drives/FB_Cylinder.TcPOU", 90, "")
        },
    ];
    entity.findings = vec![
        finding(
            "undocumented-member",
            "warning",
            "the output `bError` has no description",
            "Handling/Drives/FB_Cylinder.TcPOU",
            14,
        ),
        finding(
            "unverified-table",
            "info",
            "the table `Travel` has no verdict",
            "Handling/Drives/FB_Cylinder.TcPOU",
            5,
        ),
    ];
    entity
}

fn cylinder_prose() -> Vec<Block> {
    vec![
        paragraph("The block commands both valves of a double-acting cylinder. A rising edge of an input starts a stroke; the stroke ends when its end switch reports, or with an error after the timeout."),
        Block::Heading { level: 1, anchor: "wiring".to_owned(), content: text("Wiring") },
        Block::List {
            start: None,
            items: vec![
                ListItem { checked: Some(true), content: vec![paragraph("Both end switches are connected.")] },
                ListItem { checked: Some(false), content: vec![paragraph("The flow restrictors are set.")] },
            ],
        },
        Block::Code { language: "st".to_owned(), text: "fbClamp(bExtend := TRUE, tTimeout := T#2s); // one stroke\nIF fbClamp.bError THEN\n    fbClamp.Reset();\nEND_IF".to_owned() },
        Block::Note { style: "warning".to_owned(), title: "Warning".to_owned(), content: vec![paragraph("Both valves are off while an error stands.")] },
        Block::Table {
            align: vec!["left", "right", "center"],
            head: vec![text("Model"), text("Stroke in mm"), text("Cushioned")],
            rows: vec![vec![text("C40"), text("40"), text("no")], vec![text("C120"), text("120"), text("yes")]],
        },
        Block::Quote { content: vec![paragraph("A cylinder that is late is a cylinder that is stuck.")] },
        Block::Definitions { items: vec![(text("Stroke"), vec![paragraph("The way between the end positions.")])] },
        Block::List { start: Some(3), items: vec![ListItem { checked: None, content: vec![paragraph("Third."), paragraph("With more.")] }] },
        Block::Paragraph {
            content: vec![
                Inline::Strong { content: text("See") },
                Inline::text(" "),
                Inline::Link { to: Href::External { url: "https://example.org/cylinders?a=1&b=2".to_owned() }, content: text("the data sheet") },
                Inline::Break,
                Inline::Link { to: Href::Broken { target: "FB_Gone".to_owned() }, content: text("FB_Gone") },
                Inline::Image { source: "img/cut.png".to_owned(), alt: "A section through the cylinder".to_owned() },
                Inline::Strike { content: text("old") },
            ],
        },
        Block::Rule,
    ]
}

fn cylinder_sections() -> Vec<SectionView> {
    let bool_ = || type_("BOOL", "");
    let mut enable = variable("bEnable", bool_(), "", "Lets the cylinder move at all.");
    enable.inherited_from = Some(link("FB_Actuator", "Function block", ACTUATOR));
    let mut valve = variable("qValve", bool_(), "", "The valve that extends.");
    valve.address = "%QX1.0".to_owned();
    valve.badges = vec!["retain".to_owned()];
    let mut timeout = variable("tTimeout", type_("TIME", ""), "T#2s", "How long a stroke may last.");
    timeout.detail = vec![paragraph("Zero switches the supervision off.")];
    timeout.pragmas = vec!["{attribute 'unit' := 'ms'}".to_owned()];
    let long = "ARRAY [0..GVL_Plant.cMaximumNumberOfStations - 1, 1..16] OF REFERENCE TO ST_Recipe";
    vec![
        section(
            "input",
            "Inputs",
            true,
            vec![
                variable("bExtend", bool_(), "", "Extends on a rising edge."),
                variable("bRetract", bool_(), "", "Retracts on a rising edge."),
                timeout,
                enable,
            ],
        ),
        section(
            "output",
            "Outputs",
            true,
            vec![
                variable("bExtended", bool_(), "", "The front end switch reports."),
                variable("bRetracted", bool_(), "", "The rear end switch reports."),
                variable("bError", bool_(), "", ""),
                variable("eState", type_("E_CylinderState", STATE), "E_CylinderState.Idle", "What it is doing."),
            ],
        ),
        section(
            "in-out",
            "In-outs",
            true,
            vec![
                variable("stRecipe", type_("ST_Recipe", RECIPE), "", "The recipe in force."),
                variable("aStations", type_(long, ""), "", ""),
            ],
        ),
        section("var", "Variables", false, vec![valve, variable("fbTimer", type_("TON", ""), "", "")]),
        section("temp", "Temporary", false, vec![variable("nIndex", type_("INT", ""), "0", "")]),
    ]
}

fn member(kind: &'static str, kind_label: &'static str, name: &str, signature: &str, brief: &str) -> MemberView {
    let anchor = format!("m-{}", name.to_lowercase());
    let mut core = core(kind, kind_label, name, &format!("{CYLINDER}#{anchor}"), "Handling/Drives/FB_Cylinder.TcPOU");
    core.anchor = anchor;
    core.qualified_name = format!("FB_Cylinder.{name}");
    core.signature = signature.to_owned();
    core.documented = !brief.is_empty();
    core.brief = if brief.is_empty() { Vec::new() } else { text(brief) };
    core.line = 62;
    MemberView { core, overrides: Vec::new(), access: None }
}

fn cylinder_members() -> Vec<MemberView> {
    let mut extend = member(
        "method",
        "Method",
        "Extend",
        "METHOD PUBLIC Extend : BOOL\nVAR_INPUT\n    nForce : UINT := 100;\nEND_VAR",
        "Starts a stroke outwards.",
    );
    extend.core.diagram = Some(diagram("Extend", &[("nForce", "Extend")]));
    let mut force = variable("nForce", type_("UINT", ""), "100", "In newton.");
    force.anchor = "m-extend-nforce".to_owned();
    extend.core.sections = vec![section("input", "Inputs", true, vec![force])];
    extend.core.type_label = Some("Return value");
    extend.core.type_ = type_("BOOL", "");
    extend.core.returns = text("Whether the stroke was started.");
    extend.overrides = vec![link("I_Drive.Extend", "Method", "handling/base/i_drive.html#m-extend")];
    extend.core.detail = vec![paragraph("Does nothing while an error stands.")];
    let mut stop = member("method", "Method", "Stop", "METHOD PROTECTED Stop", "");
    stop.core.badges = vec!["protected".to_owned()];
    let mut old = member(
        "method",
        "Method",
        "MoveOutwardsAndWaitUntilTheFrontEndSwitchHasReportedOrTheTimeoutHasPassed",
        "METHOD MoveOutwardsAndWaitUntilTheFrontEndSwitchHasReportedOrTheTimeoutHasPassed : BOOL",
        "The old way.",
    );
    old.core.badges = vec!["deprecated".to_owned()];
    let mut position = member(
        "property",
        "Property",
        "Position",
        "PROPERTY PUBLIC Position : LREAL",
        "Where the rod is, in millimetres.",
    );
    position.access = Some("read/write");
    position.core.type_label = Some("Type");
    position.core.type_ = type_("LREAL", "");
    vec![
        extend,
        member("method", "Method", "Retract", "METHOD PUBLIC Retract : BOOL", "Starts a stroke inwards."),
        stop,
        old,
        position,
        member("action", "Action", "Homing", "ACTION Homing", "Finds the rear end position."),
    ]
}

fn finding(code: &str, severity: &'static str, message: &str, file: &str, line: u32) -> FindingView {
    FindingView {
        code: code.to_owned(),
        severity,
        message: message.to_owned(),
        file: file.to_owned(),
        line,
        column: 5,
        help: vec!["write a comment above it or behind it".to_owned()],
    }
}

fn verdict(key: &'static str, note: &str) -> VerdictView {
    VerdictView { key, label: key.to_owned(), note: note.to_owned(), facts: Vec::new(), coverage: None }
}

fn column(group: &'static str, name: &str, type_: &str) -> ColumnView {
    ColumnView { group, name: name.to_owned(), type_: type_.to_owned(), state: false }
}

/// A row; a cell `"` repeats the one above and `-` admits anything.
fn row(seq: &str, cells: &[&str], duration: &str, remark: &str) -> RowView {
    let cell = |text: &&str| CellView {
        text: if *text == "\"" { String::new() } else { (*text).to_owned() },
        effective: (*text).to_owned(),
        same: *text == "\"",
        any: *text == "-",
        meaning: format!("the value is {text}"),
        signs: Vec::new(),
        error: None,
        failing: None,
    };
    RowView {
        seq: seq.to_owned(),
        cells: cells.iter().map(cell).collect(),
        duration: duration.to_owned(),
        duration_meaning: format!("lasts {duration} cycles"),
        duration_signs: Vec::new(),
        remark: if remark.is_empty() { Vec::new() } else { text(remark) },
        sentence: if remark.is_empty() { String::new() } else { format!("While {remark}, the outputs hold.") },
    }
}

fn table(name: &str, line: u32, verdict: VerdictView, columns: Vec<ColumnView>, rows: Vec<RowView>) -> TableView {
    TableView {
        name: name.to_owned(),
        anchor: format!("t-{}", name.to_lowercase().replace(' ', "-")),
        label: String::new(),
        file: "Handling/Drives/FB_Cylinder.TcPOU".to_owned(),
        line,
        verdict,
        facts: vec![("cycle".to_owned(), "10 ms".to_owned()), ("TOUT".to_owned(), "2 s".to_owned())],
        remark: Vec::new(),
        columns,
        rows,
        brackets: Vec::new(),
        errors: Vec::new(),
        run: None,
        legend: Vec::new(),
        automaton: AidView::default(),
        example: AidView::default(),
    }
}

fn travel_table() -> TableView {
    let columns = vec![
        column("input", "bExtend", "BOOL"),
        column("input", "bFront", "BOOL"),
        column("output", "qValve", "BOOL"),
        column("output", "bError", "BOOL"),
    ];
    let rows = vec![
        row("1", &["FALSE", "-", "FALSE", "FALSE"], ">= 1", "at rest"),
        row("2", &["TRUE", "FALSE", "TRUE", "\""], "< TOUT", "travelling"),
        row("3", &["\"", "TRUE", "\"", "\""], "[1, 5]", "arrived"),
        row("4", &["FALSE", "-", "FALSE", "\""], "-∞", "released"),
    ];
    let mut table = table("Travel", 5, verdict("unverified", "Nobody has checked this table."), columns, rows);
    table.remark = text("A stroke that arrives in time raises no error.");
    table.brackets = vec![
        BracketView { depth: 1, first: 1, last: 2, label: "[1, 3]".to_owned() },
        BracketView { depth: 0, first: 0, last: 3, label: "ω".to_owned() },
    ];
    table
}

fn wide_table() -> TableView {
    let names = ["bStart", "bStop", "bFront", "bRear", "nPressure", "rSetpoint"];
    let inputs = names.iter().map(|name| column("input", name, "BOOL"));
    let outputs = (1..=6).map(|i| column("output", &format!("qValveStation{i}"), "BOOL"));
    let mut columns: Vec<ColumnView> = inputs.chain(outputs).collect();
    columns[5].state = true;
    let row_of = |seq: &str, first: &str| {
        let mut cells = vec![first, "\"", "-", "[1, 5]", ">= 2*p", "= A_Pos[-1]"];
        cells.extend(["TRUE", "\"", "FALSE", "\"", "x2, <> x1", "√TRUE"]);
        row(seq, &cells, "[m, n]", "")
    };
    let mut table = table(
        "All stations",
        8,
        verdict("verified", "Proven for runs of every length."),
        columns,
        (1..=8).map(|i| row_of(&i.to_string(), "TRUE")).collect(),
    );
    table.brackets = vec![
        BracketView { depth: 0, first: 0, last: 2, label: "[2, 2]".to_owned() },
        BracketView { depth: 0, first: 4, last: 7, label: "-".to_owned() },
    ];
    table
}

fn broken_table() -> TableView {
    let columns = vec![column("input", "bExtend", "BOOL"), column("output", "bGone", "")];
    let mut table = table(
        "Broken",
        9,
        verdict("unusable", "The table cannot be read."),
        columns,
        vec![row("1", &["TRUE", "1 +"], "1", "")],
    );
    table.rows[0].cells[1].error = Some("expected an operand".to_owned());
    table.errors = vec![
        "`bGone` is no variable of `FB_Cylinder`".to_owned(),
        "row 1, column `bGone`: expected an operand".to_owned(),
    ];
    table
}

fn actuator() -> EntityView {
    let mut core = core("function-block", "Function block", "FB_Actuator", ACTUATOR, "Handling/Base/FB_Actuator.TcPOU");
    core.badges = vec!["abstract".to_owned()];
    core.brief = text("What all actuators share.");
    core.signature =
        "FUNCTION_BLOCK ABSTRACT FB_Actuator\nVAR_INPUT\n    bEnable : BOOL; // Lets it move.\nEND_VAR".to_owned();
    core.sections = vec![section(
        "input",
        "Inputs",
        true,
        vec![variable("bEnable", type_("BOOL", ""), "", "Lets it move at all.")],
    )];
    let mut entity = entity(core, &["Base"]);
    let mut reset = member("method", "Method", "Reset", "METHOD PUBLIC Reset", "Acknowledges an error.");
    reset.core.url = format!("{ACTUATOR}#m-reset");
    entity.members = vec![reset];
    entity.relations = vec![Relation {
        key: "extended-by",
        title: "Extended by",
        links: vec![link("FB_Cylinder", "Function block", CYLINDER)],
    }];
    entity
}

fn drive() -> EntityView {
    let mut core = core("interface", "Interface", "I_Drive", DRIVE, "Handling/Base/I_Drive.TcIO");
    core.brief = text("Anything that goes out and comes back.");
    core.signature = "INTERFACE I_Drive".to_owned();
    let mut entity = entity(core, &["Base"]);
    let mut extend = member("method", "Method", "Extend", "METHOD Extend : BOOL", "Goes out.");
    extend.core.url = format!("{DRIVE}#m-extend");
    entity.members = vec![extend];
    entity
}

fn state() -> EntityView {
    let mut core = core("enum", "Enumeration", "E_CylinderState", STATE, "Handling/Types/E_CylinderState.TcDUT");
    core.brief = text("What a cylinder is doing.");
    core.signature = "TYPE E_CylinderState : (\n    Idle := 0, // At rest.\n    Extending, // On its way out.\n    Error := 16#FF\n) USINT := Idle;\nEND_TYPE".to_owned();
    core.type_label = Some("Base type");
    core.type_ = type_("USINT", "");
    core.sections = vec![section(
        "value",
        "Values",
        true,
        vec![
            variable("Idle", Vec::new(), "0", "At rest."),
            variable("Extending", Vec::new(), "1", "On its way out."),
            variable("Error", Vec::new(), "16#FF", ""),
        ],
    )];
    entity(core, &["Types"])
}

fn recipe() -> EntityView {
    let mut core = core("struct", "Structure", "ST_Recipe", RECIPE, "Handling/Types/ST_Recipe.TcDUT");
    core.documented = false;
    core.signature =
        "TYPE ST_Recipe :\nSTRUCT\n    sName : STRING(80) := 'unnamed';\n    nCount : UDINT;\nEND_STRUCT\nEND_TYPE"
            .to_owned();
    core.sections = vec![section(
        "field",
        "Fields",
        true,
        vec![
            variable("sName", type_("STRING(80)", ""), "'unnamed'", ""),
            variable("nCount", type_("UDINT", ""), "", ""),
        ],
    )];
    entity(core, &["Types"])
}

fn globals() -> EntityView {
    let mut core = core("gvl", "Global variables", "GVL_Plant", "handling/gvl_plant.html", "Handling/GVL_Plant.TcGVL");
    core.brief = text("What the whole plant shares.");
    core.pragmas = vec!["{attribute 'qualified_only'}".to_owned()];
    let mut stop = variable("bEmergencyStop", type_("BOOL", ""), "", "The mushroom is pressed.");
    stop.address = "%IX0.0".to_owned();
    let mut maximum = variable("cMaximumNumberOfStations", type_("INT", ""), "16", "As built.");
    maximum.badges = vec!["constant".to_owned(), "persistent".to_owned()];
    core.sections = vec![section("global", "Global variables", true, vec![stop, maximum])];
    entity(core, &[])
}

fn program() -> EntityView {
    let mut core = core("program", "Program", "MAIN", "handling/main.html", "Handling/MAIN.TcPOU");
    core.documented = false;
    core.signature = "PROGRAM MAIN".to_owned();
    entity(core, &[])
}

/// Every string of it is hostile.
fn hostile() -> EntityView {
    let mut core = core("function", "Function", HOSTILE, "handling/hostile.html", HOSTILE);
    core.qualified_name = format!("Ns.{HOSTILE}");
    core.brief = vec![
        Inline::text(HOSTILE),
        Inline::Code { text: HOSTILE.to_owned() },
        Inline::Link { to: Href::External { url: "javascript:alert(3)".to_owned() }, content: text("click") },
        Inline::Link { to: Href::External { url: format!("https://x/{HOSTILE}") }, content: text(HOSTILE) },
        Inline::Link { to: Href::Broken { target: HOSTILE.to_owned() }, content: text(HOSTILE) },
        Inline::Image { source: HOSTILE.to_owned(), alt: HOSTILE.to_owned() },
    ];
    core.detail = vec![
        Block::Code { language: HOSTILE.to_owned(), text: HOSTILE.to_owned() },
        Block::Code { language: "st".to_owned(), text: format!("'{HOSTILE}' (* {HOSTILE}") },
        Block::Note { style: HOSTILE.to_owned(), title: HOSTILE.to_owned(), content: vec![paragraph(HOSTILE)] },
    ];
    core.signature = format!("FUNCTION {HOSTILE} : BOOL // {HOSTILE}");
    core.pragmas = vec![HOSTILE.to_owned()];
    core.type_label = Some("Return type");
    core.type_ = type_(HOSTILE, "");
    let mut variable = variable("x", type_(HOSTILE, RECIPE), HOSTILE, HOSTILE);
    variable.name = HOSTILE.to_owned();
    variable.address = HOSTILE.to_owned();
    core.sections = vec![section("input", HOSTILE, true, vec![variable])];
    let mut entity = entity(core, &[]);
    entity.sources = vec![source::listing(HOSTILE, HOSTILE, 1, &format!("a := '{HOSTILE}';\n(* {HOSTILE} *)\0"))];
    entity.findings = vec![finding("broken-link", "error", HOSTILE, HOSTILE, 2)];
    let columns = vec![column("input", HOSTILE, HOSTILE)];
    entity.tables = vec![TableView {
        anchor: "t-hostile".to_owned(),
        errors: vec![HOSTILE.to_owned()],
        ..table(HOSTILE, 1, verdict("violated", HOSTILE), columns, vec![row(HOSTILE, &[HOSTILE], HOSTILE, HOSTILE)])
    }];
    entity
}

/// The manual.
pub(crate) fn book() -> Book {
    of(vec![globals(), program(), hostile(), actuator(), drive(), cylinder(), state(), recipe()])
}

/// The manual with many copies of its blocks, for measuring.
pub(crate) fn large(copies: usize) -> Book {
    let mut entities = Vec::new();
    for i in 0..copies {
        for mut entity in [actuator(), cylinder(), recipe()] {
            let url = format!("many/e{i}-{}", entity.core.url.rsplit('/').next().unwrap_or_default());
            for member in &mut entity.members {
                member.core.url = format!("{url}#{}", member.core.anchor);
            }
            entity.core.name = format!("{}_{i}", entity.core.name);
            entity.core.url = url;
            entity.folder = vec!["Many".to_owned(), format!("Group {}", i / 40)];
            entities.push(entity);
        }
    }
    entities.extend([actuator(), drive(), cylinder(), state(), recipe(), program(), globals()]);
    of(entities)
}

fn of(entities: Vec<EntityView>) -> Book {
    let library = library(&entities);
    let findings: Vec<FindingView> = entities.iter().flat_map(|e| e.findings.clone()).collect();
    Book {
        front: Front {
            title: "Handling station".to_owned(),
            genre: "Reference manual".to_owned(),
            subtitle: "Pneumatic handling for the pick-and-place unit".to_owned(),
            version: "1.4.0".to_owned(),
            date: "2026-11-22".to_owned(),
            commit: "a1b2c3d".to_owned(),
            author: "Plant & Sons".to_owned(),
            tool: "rungbook 0.1.0".to_owned(),
            language: "en".to_owned(),
        },
        totals: Totals {
            files: 9,
            files_skipped: 1,
            files_other: 3,
            libraries: 1,
            entities: 16,
            documented: 12,
            undocumented: 4,
            tables: 4,
            verdicts: vec![("verified".to_owned(), 1), ("unverified".to_owned(), 3)],
            errors: 1,
            warnings: 1,
            infos: 1,
        },
        chapters: ["Getting started", "Wiring"].map(chapter).into(),
        kinds: kinds(&entities),
        index: index(&entities),
        coverage: coverage(),
        codes: [
            ("broken-link", "A link leads nowhere", "error"),
            ("undocumented-member", "A member has no description", "warning"),
            ("unverified-table", "A test table has no verdict", "info"),
        ]
        .map(|(code, title, severity)| CodeCount {
            code: code.to_owned(),
            title: title.to_owned(),
            severity,
            count: findings.iter().filter(|f| f.code == code).count(),
        })
        .into(),
        findings,
        readings: vec![ReadingView {
            format: "TwinCAT 3".to_owned(),
            encoding: "UTF-8".to_owned(),
            comments_nest: "open",
            files: 3,
        }],
        skipped: vec![SkippedView {
            file: "Handling/Old/Binary.TcPOU".to_owned(),
            reason: "not text: NUL bytes".to_owned(),
        }],
        externals: vec![("TON".to_owned(), 2), ("Tc2_Standard.R_TRIG".to_owned(), 7)],
        explanations: vec![Chapter {
            title: "A member has no description".to_owned(),
            url: "codes/undocumented-member.html".to_owned(),
            label: String::new(),
            content: vec![paragraph("Write one.")],
        }],
        libraries: vec![library],
        entities,
    }
}

fn chapter(title: &str) -> Chapter {
    let url = format!("chapters/{}.html", title.replace(' ', "-").to_lowercase());
    Chapter { title: title.to_owned(), url, label: String::new(), content: cylinder_prose() }
}

fn entry(entity: &EntityView) -> Entry {
    Entry {
        link: link(&entity.core.name, entity.core.kind_label, &entity.core.url),
        kind: entity.core.kind,
        library: entity.library_name.clone(),
        brief: entity.core.brief.clone(),
        documented: entity.core.documented,
        tables: entity.tables.len(),
        badges: entity.core.badges.clone(),
    }
}

fn library(entities: &[EntityView]) -> LibraryView {
    let mut paths: Vec<Vec<String>> = entities.iter().map(|e| e.folder.clone()).collect();
    paths.sort();
    paths.dedup();
    let folder = |path: Vec<String>| FolderView {
        url: format!("handling/folder-{}.html", path.join("-").replace(' ', "_").to_lowercase()),
        entities: entities.iter().filter(|e| e.folder == path).map(entry).collect(),
        path,
    };
    LibraryView {
        name: "Handling".to_owned(),
        url: "handling/index.html".to_owned(),
        label: String::new(),
        version: "1.4.0.0".to_owned(),
        author: "Plant & Sons".to_owned(),
        format: "TwinCAT 3 project".to_owned(),
        path: "Handling".to_owned(),
        description: vec![paragraph("Blocks for pneumatic handling stations.")],
        references: vec!["Tc2_Standard".to_owned(), "Tc2_System".to_owned()],
        folders: paths.into_iter().map(folder).collect(),
        entities: 16,
        documented: 12,
        documented_percent: 75,
        tables: 4,
    }
}

fn kinds(entities: &[EntityView]) -> Vec<KindList> {
    let list = |key: &'static str, title, url: &str, kinds: &[&str]| KindList {
        key,
        title,
        url: url.to_owned(),
        entries: entities.iter().filter(|e| kinds.contains(&e.core.kind)).map(entry).collect(),
    };
    vec![
        list("function-block", "Function blocks", "function-blocks.html", &["function-block"]),
        list("function", "Functions", "functions.html", &["function"]),
        list("program", "Programs", "programs.html", &["program"]),
        list("interface", "Interfaces", "interfaces.html", &["interface"]),
        list("type", "Types", "types.html", &["enum", "struct"]),
        list("gvl", "Global variables", "gvls.html", &["gvl"]),
    ]
}

fn index(entities: &[EntityView]) -> Vec<IndexEntry> {
    let mut index = Vec::new();
    for entity in entities {
        let members = entity.members.iter().map(|m| (&m.core, entity.core.name.as_str()));
        for (core, context) in std::iter::once((&entity.core, "Handling")).chain(members) {
            index.push(IndexEntry {
                name: core.name.clone(),
                kind_label: core.kind_label,
                context: context.to_owned(),
                url: core.url.clone(),
                label: String::new(),
                brief: Inline::plain(&core.brief),
            });
        }
    }
    index.sort_by_key(|entry| entry.name.to_lowercase());
    index
}

fn coverage() -> Coverage {
    let row = |name: &str, documented: usize, entities: usize, tables: usize| CoverageRow {
        name: name.to_owned(),
        entities,
        documented,
        documented_percent: documented * 100 / entities,
        variables: 10,
        variables_documented: 7,
        variables_percent: 70,
        tables,
        verified: tables.min(1),
        verified_percent: 100_usize.checked_div(tables).unwrap_or(100),
    };
    let hole = |name: &str, url: &str, what: &str| Hole {
        link: link(name, "", url),
        what: what.to_owned(),
        file: "Handling/a.TcPOU".to_owned(),
        line: 3,
    };
    Coverage {
        by_folder: vec![row("Handling", 1, 3, 0), row("Handling / Base", 3, 3, 0), row("Handling / Drives", 6, 7, 4)],
        by_kind: vec![row("Function blocks", 2, 2, 4), row("Programs", 0, 1, 0)],
        total: row("All", 12, 16, 4),
        undocumented: vec![
            hole("MAIN", "handling/main.html", "the program"),
            hole("FB_Cylinder.Stop", "handling/drives/fb_cylinder.html#m-stop", "the method"),
        ],
        unverified: vec![hole("FB_Cylinder", "handling/drives/fb_cylinder.html#t-travel", "the table `Travel`")],
    }
}
