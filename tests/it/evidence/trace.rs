//! The traceability matrix and results of other tools, from a tree to the page.

use super::{rungbook, stdout, tree};

const TREE: [(&str, &str); 5] = [
    ("a.st", "// Switches the lamp.\n// @req REQ-1\n// @req REQ-9\nFUNCTION_BLOCK FB_Lamp\nEND_FUNCTION_BLOCK\n"),
    (
        "req.csv",
        "id,title,justification\nREQ-1,Lamp goes on,\nREQ-2,Lamp is bright,a matter of the lamp\nREQ-3,Lamp goes off,\n",
    ),
    (
        "reports/junit.xml",
        "<testsuites><testsuite name=\"Lamp\"><testcase classname=\"PRG.FB_Lamp_Tests\" name=\"Goes on\"/></testsuite></testsuites>",
    ),
    ("reports/broken.xml", "<testsuites>"),
    (
        "rungbook.toml",
        "[evidence]\nrequirements = [\"req.csv\"]\nresults = [\"reports/*.xml\"]\nsign-off = [\"Assessor: M. Ober\"]\n",
    ),
];

#[test]
fn holes_and_unknown_identifiers_are_findings() {
    let dir = tree(&TREE);
    let text = stdout(rungbook().args(["check", "-q"]).arg(dir.path()));
    for part in [
        "warning[unmet-requirement]: no block meets the requirement `REQ-3`",
        "warning[unknown-requirement]: there is no requirement `REQ-9`",
        "warning[unreadable-results]",
        "req.csv:4:1",
    ] {
        assert!(text.contains(part), "{part} is missing in:\n{text}");
    }
    assert!(!text.contains("REQ-2"), "an exception with a reason is no finding:\n{text}");
}

#[test]
fn the_page_shows_matrix_results_and_blanks() {
    let dir = tree(&TREE);
    let out = tree(&[]);
    rungbook().args(["build", "-q", "--html", "--evidence", "-o"]).arg(out.path()).arg(dir.path()).assert().code(0);
    let page = std::fs::read_to_string(out.path().join("html/chapters/evidence.html")).expect("written");
    for part in
        ["REQ-1", "justified exception", "hole", "Goes on", "passed", "M. Ober", "rungbook has checked none of this"]
    {
        assert!(page.contains(part), "{part} is missing");
    }
    let model = stdout(rungbook().args(["build", "-q", "--json", "-o"]).arg(out.path()).arg(dir.path()));
    assert!(model.is_empty());
    let model = std::fs::read(out.path().join("model.json")).expect("written");
    let model: serde_json::Value = serde_json::from_slice(&model).expect("JSON");
    let lamp = model["entities"].as_array().expect("a list").iter().find(|entity| entity["name"] == "FB_Lamp");
    let url = lamp.and_then(|entity| entity["page"].as_str()).expect("a page").split('#').next().expect("an address");
    let block = std::fs::read_to_string(out.path().join("html").join(url)).expect("written");
    assert!(block.contains("Results of other tools") && block.contains("Goes on"), "shown at its block");
    assert!(page.contains("1 holes"), "REQ-3; REQ-2 is justified, REQ-9 has a block");
}
