//! A small book by hand, and a large one by rule.

use rungbook::book::view::coverage::{Coverage, CoverageRow, Hole};
use rungbook::book::view::entity::{
    CoreView, Diagram, EntityLink, EntityView, Fact, InheritedView, MemberView, Relation, RunClass, SectionView,
    SourceView, TypePart, VariableView,
};
use rungbook::book::view::finding::{CodeCount, FindingView, ReadingView, SkippedView};
use rungbook::book::view::prose::{Block, Href, Inline, ListItem};
use rungbook::book::view::run::{RunCycle, RunLine, RunValue, RunView};
use rungbook::book::view::table::{
    AidView, BracketView, CellView, ColumnView, CoverageView, MissedView, RowView, TableView, VerdictView,
};
use rungbook::book::view::{Book, Chapter, Entry, FolderView, Front, IndexEntry, LibraryView, Totals};
use rungbook::figure::{Drawing, inheritance, interface};

pub(super) fn text(text: &str) -> Vec<Inline> {
    vec![Inline::text(text)]
}

pub(super) fn paragraph(content: &str) -> Block {
    Block::Paragraph { content: text(content) }
}

pub(super) fn page(label: &str) -> Href {
    Href::Page { url: format!("{label}.html"), label: label.to_owned() }
}

pub(super) fn link(name: &str, kind_label: &'static str, label: &str) -> EntityLink {
    EntityLink { name: name.to_owned(), kind_label, to: Some(page(label)) }
}

pub(super) fn diagram(drawing: &Drawing) -> Diagram {
    let (width, height) = drawing.points();
    Diagram { svg: drawing.to_svg(), alt: drawing.alt.clone(), width, height }
}

pub(super) fn variable(name: &str, type_: &str, initial: &str, brief: &str) -> VariableView {
    VariableView {
        name: name.to_owned(),
        anchor: name.to_lowercase(),
        label: format!("v:{name}"),
        type_: vec![TypePart { text: type_.to_owned(), to: None }],
        initial: initial.to_owned(),
        address: String::new(),
        badges: Vec::new(),
        brief: if brief.is_empty() { Vec::new() } else { text(brief) },
        detail: Vec::new(),
        pragmas: Vec::new(),
        line: 7,
        inherited_from: None,
    }
}

pub(super) fn section(key: &'static str, title: &str, variables: Vec<VariableView>) -> SectionView {
    SectionView { key, title: title.to_owned(), public: !matches!(key, "var" | "temp"), variables }
}

pub(super) fn core(kind: &'static str, kind_label: &'static str, name: &str, brief: &str) -> CoreView {
    CoreView {
        kind,
        kind_label,
        name: name.to_owned(),
        qualified_name: name.to_owned(),
        url: format!("{}.html", name.to_lowercase()),
        label: format!("e:{name}"),
        file: format!("Pneumatics/Cylinders/{name}.TcPOU"),
        line: 12,
        documented: !brief.is_empty(),
        brief: if brief.is_empty() { Vec::new() } else { text(brief) },
        ..CoreView::default()
    }
}

pub(super) fn entity(core: CoreView) -> EntityView {
    EntityView {
        core,
        library: 0,
        library_name: "Pneumatics".to_owned(),
        namespace: Vec::new(),
        folder: vec!["Cylinders".to_owned()],
        relations: Vec::new(),
        inheritance: None,
        members: Vec::new(),
        inherited: Vec::new(),
        tables: Vec::new(),
        sources: Vec::new(),
        findings: Vec::new(),
    }
}

fn pin(name: &str, type_: &str) -> interface::Pin {
    interface::Pin { name: name.to_owned(), type_: type_.to_owned(), ..interface::Pin::default() }
}

fn entry(name: &str, type_: &str) -> interface::Entry {
    let (name, type_) = (name.to_owned(), type_.to_owned());
    interface::Entry { access: interface::Access::Public, name, type_, ..interface::Entry::default() }
}

fn cell(text: &str) -> CellView {
    let (same, any) = (text.is_empty(), text == "-");
    let (text, effective) = (text.to_owned(), text.to_owned());
    CellView { text, effective, same, any, meaning: String::new(), signs: Vec::new(), error: None, failing: None }
}

fn row(seq: &str, cells: &[&str], duration: &str, remark: &str) -> RowView {
    RowView {
        seq: seq.to_owned(),
        cells: cells.iter().map(|text| cell(text)).collect(),
        duration: duration.to_owned(),
        duration_meaning: String::new(),
        duration_signs: Vec::new(),
        remark: if remark.is_empty() { Vec::new() } else { text(remark) },
        sentence: String::new(),
    }
}

fn column(group: &'static str, name: &str, type_: &str) -> ColumnView {
    ColumnView { group, name: name.to_owned(), type_: type_.to_owned(), state: false }
}

pub(super) fn table(name: &str, columns: Vec<ColumnView>, rows: Vec<RowView>, brackets: Vec<BracketView>) -> TableView {
    TableView {
        name: name.to_owned(),
        anchor: name.to_lowercase().replace(' ', "-"),
        label: format!("t:{}", name.replace(' ', "-")),
        file: "Pneumatics/Cylinders/FB_Cylinder.TcPOU".to_owned(),
        line: 31,
        verdict: VerdictView {
            key: "unverified",
            label: "unverified".to_owned(),
            note: "Nobody has checked this table yet.".to_owned(),
            facts: Vec::new(),
            coverage: None,
        },
        facts: vec![("cycle".to_owned(), "10 ms".to_owned()), ("p".to_owned(), "1 <= p AND p <= 9".to_owned())],
        remark: text("The cylinder reaches its end position in time, or says so."),
        columns,
        rows,
        brackets,
        errors: Vec::new(),
        run: None,
        legend: Vec::new(),
        automaton: AidView::default(),
        example: AidView::default(),
    }
}

/// A table with the run that violates it, of twelve cycles.
pub(super) fn violated() -> TableView {
    let mut out = big_table("Violated", 2, 2);
    out.verdict.key = "violated";
    out.verdict.label = "violated".to_owned();
    if let Some(cell) = out.rows.last_mut().and_then(|row| row.cells.last_mut()) {
        cell.failing = Some("expected 1, seen 7".to_owned());
    }
    let line = RunLine {
        file: "FB_Tested.st".to_owned(),
        line: 9,
        text: "nColumn1 := 7;".to_owned(),
        set: vec![("nColumn1".to_owned(), "7".to_owned())],
        wrong: true,
    };
    let cycle = |number: usize| RunCycle {
        number,
        values: vec![
            RunValue { text: "3".to_owned(), changed: false, failing: false },
            RunValue { text: number.to_string(), changed: true, failing: number == 12 },
        ],
        tried: vec!["R1".to_owned()],
        live: vec!["R1".to_owned()],
        lines: vec![line.clone()],
    };
    out.run = Some(RunView {
        summary: vec!["Cycle 12, row R1: nColumn1 is 7 where 1 is expected.".to_owned()],
        globals: vec![("p".to_owned(), "4".to_owned())],
        variables: vec![("nColumn0".to_owned(), true), ("nColumn1".to_owned(), false)],
        length: 12,
        cycles: (1..=12).map(cycle).collect(),
        timing: diagram(&Drawing { width: 200.0, height: 60.0, alt: "Timing diagram".to_owned(), shapes: Vec::new() }),
        unchanged: vec![("nColumn0".to_owned(), "3".to_owned())],
        failing: vec![("R1".to_owned(), "nColumn1".to_owned(), "expected 1, seen 7".to_owned())],
        edges: vec![0.0; 13],
    });
    out
}

/// A verified table that says nothing.
pub(super) fn proves_nothing() -> TableView {
    let mut out = big_table("Empty", 2, 2);
    out.verdict.key = "verified";
    out.verdict.label = "verified".to_owned();
    out.verdict.coverage = Some(CoverageView {
        line: "rows 1/2 · statements 3/3 · branches 0/0".to_owned(),
        vacuous: vec!["no row that a run reaches constrains an output".to_owned()],
        missed: vec![MissedView {
            kind: "row",
            text: "R1".to_owned(),
            file: "FB_Tested.st".to_owned(),
            line: 3,
            fate: "not reached in 9 cycles".to_owned(),
        }],
    });
    out
}

/// A table with a bracket inside a bracket.
fn extends_in_time() -> TableView {
    let columns = vec![
        column("input", "bExtend", "BOOL"),
        column("input", "bAtEnd", "BOOL"),
        column("output", "eState", "E_CylinderState"),
        column("output", "bAlarm", "BOOL"),
    ];
    let rows = vec![
        row("1", &["FALSE", "-", "Retracted", "FALSE"], "≥ 1", "at rest"),
        row("2", &["TRUE", "FALSE", "Moving", ""], "< 500 ms", "travelling"),
        row("3", &["", "TRUE", "Extended", ""], "[1, ∞]", "arrived"),
        row("4", &["FALSE", "", "Moving", ""], "-", ""),
        row("5", &["TRUE", "FALSE", "Error", "TRUE"], "ω", "it is stuck"),
    ];
    let brackets = vec![
        BracketView { depth: 0, first: 0, last: 3, label: "ω".to_owned() },
        BracketView { depth: 1, first: 1, last: 2, label: "[1,3]".to_owned() },
    ];
    let mut out = table("Extends in time", columns, rows, brackets);
    out.rows[3].cells[3].error = Some("`TRU` is not a value of BOOL".to_owned());
    out.rows[3].cells[3].text = "TRU".to_owned();
    out.errors = vec!["`TRU` is not a value of `BOOL` (row 4, column bAlarm)".to_owned()];
    out
}

/// A table with this many columns and rows.
pub(super) fn big_table(name: &str, columns: usize, rows: usize) -> TableView {
    let head = |index: usize| {
        column(if index.is_multiple_of(2) { "input" } else { "output" }, &format!("nColumn{index}"), "INT")
    };
    let line = |index: usize| {
        let cells: Vec<String> = (0..columns).map(|column| format!("{}", index * 3 + column)).collect();
        let cells: Vec<&str> = cells.iter().map(String::as_str).collect();
        row(&format!("R{index}"), &cells, "1", &format!("remark{index}"))
    };
    table(name, (0..columns).map(head).collect(), (0..rows).map(line).collect(), Vec::new())
}

fn cylinder() -> EntityView {
    let mut start = pin("bExtend", "BOOL");
    start.edge = Some(interface::Edge::Rising);
    let block = interface::Block {
        name: "FB_Cylinder".to_owned(),
        stereotype: Some("function block".to_owned()),
        inputs: vec![start, pin("bRetract", "BOOL"), pin("tTimeout", "TIME")],
        outputs: vec![pin("eState", "E_CylinderState"), pin("bAlarm", "BOOL")],
        in_outs: vec![pin("stAxis", "ST_Axis")],
        returns: None,
        compartments: vec![interface::Compartment {
            title: "methods".to_owned(),
            entries: vec![entry("Extend()", "BOOL"), entry("Reset()", "")],
        }],
    };
    let node = |name: &str| inheritance::Node { name: name.to_owned(), ..inheritance::Node::default() };
    let mut contract = node("I_Cylinder");
    contract.interface = true;
    contract.stereotype = Some("interface".to_owned());
    let hierarchy = inheritance::Hierarchy {
        nodes: vec![node("FB_Cylinder"), node("FB_Actuator"), contract],
        links: vec![
            inheritance::Link { from: 0, to: 1, implements: false },
            inheritance::Link { from: 0, to: 2, implements: true },
        ],
        derived: vec![inheritance::Derived { node: node("FB_CylinderSafe"), implements: false }],
    };
    let mut core =
        core("function-block", "Function block", "FB_Cylinder", "A double-acting cylinder with two end positions.");
    core.badges = vec!["abstract".to_owned(), "deprecated".to_owned()];
    core.diagram = Some(diagram(&interface::draw(&block)));
    core.signature = "{attribute 'reflection'}\nFUNCTION_BLOCK ABSTRACT FB_Cylinder EXTENDS FB_Actuator IMPLEMENTS I_Cylinder\nVAR_INPUT\n    bExtend : BOOL R_EDGE; // go\n    tTimeout : TIME := T#2s;\nEND_VAR".to_owned();
    core.pragmas = vec!["{attribute 'reflection'}".to_owned()];
    core.detail = cylinder_detail();
    core.facts = vec![Fact { title: "Since".to_owned(), content: vec![paragraph("1.2")] }];
    let mut timeout = variable("tTimeout", "TIME", "T#2s", "How long a move may take.");
    timeout.badges = vec!["constant".to_owned()];
    timeout.detail = vec![paragraph("A longer time hides a leak.")];
    let mut state = variable("eState", "E_CylinderState", "", "Where it is.");
    state.type_[0].to = Some(page("e:E_CylinderState"));
    let mut axis = variable("stAxis", "ARRAY [1..4] OF ST_AxisWithAVeryLongNameThatNobodyShouldUse", "", "");
    axis.address = "%IX0.3".to_owned();
    axis.inherited_from = Some(link("FB_Actuator", "Function block", "e:FB_Actuator"));
    core.sections = vec![
        section("input", "Inputs", vec![variable("bExtend", "BOOL R_EDGE", "", "Extends on a rising edge."), timeout]),
        section("output", "Outputs", vec![state, variable("bAlarm", "BOOL", "FALSE", "The move took too long.")]),
        section("in-out", "In-outs", vec![axis]),
        section(
            "var",
            "Variables",
            vec![variable("fbTimerWhichHasAnUnusuallyLongNameForAnInternalVariable", "TON", "(PT := T#1s)", "")],
        ),
    ];
    let mut out = entity(core);
    out.inheritance = inheritance::draw(&hierarchy).map(|drawing| diagram(&drawing));
    out.relations = vec![
        Relation {
            key: "extends",
            title: "Extends",
            links: vec![link("FB_Actuator", "Function block", "e:FB_Actuator")],
        },
        Relation {
            key: "used-by",
            title: "Used by",
            links: vec![
                link("PRG_Main", "Program", "e:PRG_Main"),
                link("FB_Gone", "Function block", "e:nowhere"),
                EntityLink { name: "TON".to_owned(), kind_label: "", to: None },
            ],
        },
    ];
    out.members = vec![extend_method()];
    out.inherited = vec![InheritedView {
        link: link("Reset", "Method", "e:FB_Actuator"),
        kind_label: "Method",
        from: link("FB_Actuator", "Function block", "e:FB_Actuator"),
        brief: text("Acknowledges an alarm."),
    }];
    out.tables = vec![extends_in_time(), big_table("Wide", 40, 6), big_table("Medium", 14, 4)];
    out.sources = vec![source()];
    out
}

fn cylinder_detail() -> Vec<Block> {
    let code = Inline::Code { text: "bExtend".to_owned() };
    let to_state = Inline::Link { to: page("v:eState"), content: text("its state") };
    let broken = Inline::Link { to: Href::Broken { target: "FB_No".to_owned() }, content: text("FB_No") };
    let site = Href::External { url: "https://example.org/valves?a=1#b".to_owned() };
    let site = Inline::Link { to: site, content: text("the valve's data sheet") };
    vec![
        Block::Paragraph {
            content: vec![
                Inline::text("Set "),
                code,
                Inline::text(" and watch "),
                to_state,
                Inline::text(", see "),
                broken,
                Inline::text(" and "),
                site,
                Inline::text("."),
            ],
        },
        Block::Heading { level: 2, anchor: "limits".to_owned(), content: text("Limits") },
        Block::List {
            start: None,
            items: vec![
                ListItem { checked: Some(true), content: vec![paragraph("tested on the bench")] },
                ListItem { checked: Some(false), content: vec![paragraph("tested in the field")] },
            ],
        },
        Block::List {
            start: Some(3),
            items: vec![
                ListItem { checked: None, content: vec![paragraph("third")] },
                ListItem { checked: None, content: vec![paragraph("fourth")] },
            ],
        },
        Block::Code {
            language: "st".to_owned(),
            text: "IF fbCylinder.eState = E_CylinderState.Extended THEN\n    nCount := nCount + 1; // one more\nEND_IF"
                .to_owned(),
        },
        Block::Note {
            style: "warning".to_owned(),
            title: "Warning".to_owned(),
            content: vec![paragraph("Keep hands off.")],
        },
        Block::Table {
            align: vec!["left", "right"],
            head: vec![text("Pressure"), text("Time")],
            rows: vec![vec![text("4 bar"), text("320 ms")], vec![text("6 bar"), text("210 ms")]],
        },
        Block::Quote { content: vec![paragraph("What moves can be stuck.")] },
        Block::Definitions { items: vec![(text("stroke"), vec![paragraph("the way between the end positions")])] },
        Block::Rule,
        Block::Paragraph {
            content: vec![
                Inline::Emph { content: text("emphasis") },
                Inline::Break,
                Inline::Strong { content: text("strong") },
                Inline::Break,
                Inline::Strike { content: text("struck") },
                Inline::Break,
                Inline::Image { source: "valve.png".to_owned(), alt: "the valve".to_owned() },
            ],
        },
    ]
}

fn extend_method() -> MemberView {
    let block = interface::Block {
        name: "Extend".to_owned(),
        stereotype: Some("method".to_owned()),
        inputs: vec![pin("bForce", "BOOL")],
        returns: Some("BOOL".to_owned()),
        ..interface::Block::default()
    };
    let mut core = core("method", "Method", "Extend", "Starts to extend.");
    core.qualified_name = "FB_Cylinder.Extend".to_owned();
    core.label = "e:FB_Cylinder.Extend".to_owned();
    core.badges = vec!["protected".to_owned()];
    core.diagram = Some(diagram(&interface::draw(&block)));
    core.signature = "METHOD PROTECTED Extend : BOOL\nVAR_INPUT\n    bForce : BOOL;\nEND_VAR".to_owned();
    core.type_label = Some("Returns");
    core.type_ = vec![TypePart { text: "BOOL".to_owned(), to: None }];
    core.returns = text("Whether it began.");
    core.sections = vec![section("input", "Inputs", vec![variable("bForce", "BOOL", "", "Even against an alarm.")])];
    MemberView { core, overrides: vec![link("I_Cylinder.Extend", "Method", "e:I_Cylinder")], access: None }
}

fn source() -> SourceView {
    use rungbook::book::view::entity::Run;
    SourceView {
        title: "Body".to_owned(),
        anchor: String::new(),
        file: "Pneumatics/Cylinders/FB_Cylinder.TcPOU".to_owned(),
        first_line: 40,
        text:
            "fbTimer(IN := bExtend, PT := tTimeout);\nIF fbTimer.Q THEN\n\tbAlarm := TRUE; // sourceListingMark\nEND_IF"
                .to_owned(),
        runs: vec![Run { start: 0, end: 7, class: RunClass::Name, link: None }],
        links: Vec::new(),
        note: None,
    }
}

fn small(kind: &'static str, kind_label: &'static str, name: &str, brief: &str) -> EntityView {
    let block = interface::Block {
        name: name.to_owned(),
        stereotype: Some(kind_label.to_lowercase()),
        compartments: vec![interface::Compartment {
            title: String::new(),
            entries: vec![entry("First", "INT"), entry("Second", "LREAL")],
        }],
        ..interface::Block::default()
    };
    let mut core = core(kind, kind_label, name, brief);
    core.diagram = Some(diagram(&interface::draw(&block)));
    core.signature = format!("TYPE {name} :\nSTRUCT\n    First : INT;\nEND_STRUCT\nEND_TYPE");
    let mut first = variable("First", "INT", "", "The first.");
    first.label = format!("v:{name}.First");
    core.sections = vec![section("field", "Fields", vec![first])];
    entity(core)
}

fn entries(entities: &[EntityView]) -> Vec<Entry> {
    let entry = |entity: &EntityView| Entry {
        link: link(&entity.core.name, entity.core.kind_label, &entity.core.label),
        kind: entity.core.kind,
        library: entity.library_name.clone(),
        brief: entity.core.brief.clone(),
        documented: entity.core.documented,
        tables: entity.tables.len(),
        badges: entity.core.badges.clone(),
    };
    entities.iter().map(entry).collect()
}

fn index(entities: &[EntityView]) -> Vec<IndexEntry> {
    let entry = |core: &CoreView, context: &str| IndexEntry {
        name: core.name.clone(),
        kind_label: core.kind_label,
        context: context.to_owned(),
        url: core.url.clone(),
        label: core.label.clone(),
        brief: Inline::plain(&core.brief),
    };
    let mut out: Vec<IndexEntry> = Vec::new();
    for entity in entities {
        out.push(entry(&entity.core, &entity.library_name));
        out.extend(entity.members.iter().map(|member| entry(&member.core, &entity.core.name)));
    }
    out.sort_by_key(|entry| entry.name.to_lowercase());
    out
}

fn library(entities: &[EntityView]) -> LibraryView {
    let mut folders: Vec<FolderView> = Vec::new();
    for entity in entities {
        if folders.last().is_none_or(|folder| folder.path != entity.folder) {
            folders.push(FolderView { path: entity.folder.clone(), url: "f.html".to_owned(), entities: Vec::new() });
        }
        if let Some(folder) = folders.last_mut() {
            folder.entities.extend(entries(std::slice::from_ref(entity)));
        }
    }
    LibraryView {
        name: "Pneumatics".to_owned(),
        url: "pneumatics/index.html".to_owned(),
        label: "l:Pneumatics".to_owned(),
        version: "3.1.0".to_owned(),
        author: "Example Works".to_owned(),
        format: "TwinCAT 3 project".to_owned(),
        path: "Pneumatics".to_owned(),
        description: vec![paragraph("Cylinders, valves and what they are mounted on.")],
        references: vec!["Tc2_Standard".to_owned()],
        folders,
        entities: entities.len(),
        documented: entities.len() / 2,
        documented_percent: 50,
        tables: 3,
    }
}

/// A book of these entities, which are in the book's order.
pub(super) fn book(entities: Vec<EntityView>) -> Book {
    let row = |name: &str| CoverageRow {
        name: name.to_owned(),
        entities: 8,
        documented: 6,
        documented_percent: 75,
        variables: 20,
        variables_documented: 5,
        variables_percent: 25,
        tables: 3,
        verified: 0,
        verified_percent: 0,
    };
    let finding = |line: u32| FindingView {
        code: "undocumented-member".to_owned(),
        severity: if line == 1 { "error" } else { "warning" },
        message: format!("`Check{line}` has no documentation"),
        file: "Pneumatics/Cylinders/FB_Cylinder.TcPOU".to_owned(),
        line,
        column: 5,
        help: Vec::new(),
    };
    Book {
        front: Front {
            title: "Pneumatics".to_owned(),
            genre: "Reference manual".to_owned(),
            subtitle: "Cylinders and valves for TwinCAT 3".to_owned(),
            version: "3.1.0".to_owned(),
            date: "2026-11-22".to_owned(),
            commit: "1a2b3c4d".to_owned(),
            author: "Example Works".to_owned(),
            tool: "rungbook 0.1.0".to_owned(),
            language: "en".to_owned(),
        },
        totals: Totals {
            files: 9,
            libraries: 1,
            entities: entities.len(),
            tables: 3,
            verdicts: vec![("unverified".to_owned(), 3)],
            errors: 1,
            warnings: 8,
            ..Totals::default()
        },
        chapters: vec![Chapter {
            title: "Getting started".to_owned(),
            url: "start.html".to_owned(),
            label: "c:start".to_owned(),
            content: vec![
                paragraph("Wire the valve first."),
                Block::Heading { level: 1, anchor: "wiring".to_owned(), content: text("Wiring") },
                paragraph("Red is plus."),
            ],
        }],
        libraries: vec![library(&entities)],
        index: index(&entities),
        kinds: Vec::new(),
        coverage: Coverage {
            by_folder: vec![row("Cylinders"), row("Types")],
            by_kind: vec![row("Function block"), row("Structure")],
            total: row("total"),
            undocumented: vec![Hole {
                link: link("FB_Actuator", "Function block", "e:FB_Actuator"),
                what: "no documentation".to_owned(),
                file: "a.TcPOU".to_owned(),
                line: 3,
            }],
            unverified: Vec::new(),
        },
        findings: (1..10).map(finding).collect(),
        codes: vec![CodeCount {
            code: "undocumented-member".to_owned(),
            title: "A member without documentation".to_owned(),
            severity: "warning",
            count: 9,
        }],
        readings: vec![ReadingView {
            format: "TwinCAT 3".to_owned(),
            encoding: "UTF-8".to_owned(),
            comments_nest: "open",
            files: 3,
        }],
        skipped: vec![SkippedView { file: "Old/Broken.TcPOU".to_owned(), reason: "not decodable".to_owned() }],
        externals: vec![("TON".to_owned(), 4), ("Tc2_MC2.AXIS_REF".to_owned(), 2)],
        explanations: Vec::new(),
        entities,
    }
}

/// The small book.
pub(super) fn pneumatics() -> Book {
    let mut actuator = small("function-block", "Function block", "FB_Actuator", "");
    actuator.core.documented = false;
    let mut state = small("enum", "Enumeration", "E_CylinderState", "The positions of a cylinder.");
    let mut axis = small("struct", "Structure", "ST_Axis", "An axis.");
    for entity in [&mut state, &mut axis] {
        entity.folder = vec!["Types".to_owned()];
    }
    book(vec![
        actuator,
        cylinder(),
        small("function", "Function", "F_Scale", "Scales a value."),
        small("interface", "Interface", "I_Cylinder", "What every cylinder can do."),
        state,
        axis,
    ])
}

/// A large book: blocks with five methods each and documented variables.
pub(super) fn large(count: usize) -> Book {
    let entities = (0..count).map(large_entity).collect();
    book(entities)
}

fn large_entity(index: usize) -> EntityView {
    let name = format!("FB_Block{index}");
    let names = ["bEnable", "bReset", "fSetpoint", "fActual", "nCounter", "eMode", "stParameters", "tTimeout"];
    let block = |name: &str, pins: usize| interface::Block {
        name: name.to_owned(),
        stereotype: Some("function block".to_owned()),
        inputs: names[..pins].iter().map(|name| pin(name, "LREAL")).collect(),
        outputs: names[..pins / 2].iter().map(|name| pin(name, "BOOL")).collect(),
        ..interface::Block::default()
    };
    let variables = |owner: &str, count: usize| {
        let variable = |name: &&str| {
            let mut out = variable(name, "LREAL", "0.0", "What this variable is for, in a sentence of usual length.");
            out.label = format!("v:{owner}.{name}");
            out
        };
        names[..count].iter().map(variable).collect::<Vec<_>>()
    };
    let mut core = core("function-block", "Function block", &name, "A block that does something useful in a machine.");
    core.diagram = Some(diagram(&interface::draw(&block(&name, 8))));
    core.signature = format!(
        "FUNCTION_BLOCK {name} EXTENDS FB_Base\nVAR_INPUT\n    bEnable : BOOL; // on\n    fSetpoint : LREAL := 1.5;\nEND_VAR"
    );
    core.detail = vec![
        paragraph(
            "It is called once a cycle and keeps its state between the calls, so that nothing is lost when the machine stops and goes on later.",
        ),
        Block::Code {
            language: "st".to_owned(),
            text: "fbBlock(bEnable := TRUE);\nIF fbBlock.bReady THEN\n    nStep := 2;\nEND_IF".to_owned(),
        },
    ];
    core.sections = vec![
        section("input", "Inputs", variables(&name, 8)),
        section("output", "Outputs", variables(&format!("{name}.out"), 4)),
    ];
    let mut out = entity(core);
    out.folder = vec![format!("Folder{}", index / 30)];
    out.relations = vec![Relation {
        key: "used-by",
        title: "Used by",
        links: (1..6)
            .map(|step| index.saturating_sub(step))
            .map(|other| link(&format!("FB_Block{other}"), "Function block", &format!("e:FB_Block{other}")))
            .collect(),
    }];
    out.members = (0..5)
        .map(|member| {
            let method = format!("Method{member}");
            let mut core = self::core("method", "Method", &method, "Does a part of the work.");
            core.label = format!("e:{name}.{method}");
            core.qualified_name = format!("{name}.{method}");
            core.diagram = Some(diagram(&interface::draw(&block(&method, 4))));
            core.signature = format!("METHOD PUBLIC {method} : BOOL\nVAR_INPUT\n    bEnable : BOOL;\nEND_VAR");
            core.sections = vec![section("input", "Inputs", variables(&format!("{name}.{method}"), 4))];
            MemberView { core, overrides: Vec::new(), access: None }
        })
        .collect();
    out
}
