//! Results of other tools, shown beside ours and never as *verified*: JUnit XML (TcUnit and most test frameworks write it), reports of the
//! CODESYS Test Manager in XML, reports of PLCverif in text or as JUnit.
//!
//! A result belongs to the block that its suite, class or case names; one that names none is listed apart.

use serde::{Deserialize, Serialize};

use crate::text::decode;

/// A result of another tool.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Outside {
    /// The tool or form, as `TcUnit or JUnit`.
    pub tool: String,
    /// The file that it was read from, below the root.
    pub file: String,
    /// The suite, class or test object.
    pub suite: String,
    /// The case.
    pub case: String,
    /// The tool's own word, in lower case.
    pub outcome: String,
    /// What it says besides.
    pub message: String,
}

impl Outside {
    /// The words in which a block may be named, the most telling first.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        let word = |c: char| !(c.is_alphanumeric() || c == '_');
        let words = self.suite.split(word).chain(self.case.split(word));
        let mut names: Vec<String> = words.filter(|word| !word.is_empty()).map(str::to_lowercase).collect();
        // `FB_Valve_Tests` and `FB_ValveTest` speak of `FB_Valve`.
        for name in names.clone() {
            for suffix in ["_tests", "_test", "tests", "test"] {
                names.extend(name.strip_suffix(suffix).filter(|stem| !stem.is_empty()).map(str::to_owned));
            }
            names.extend(name.strip_prefix("test_").map(str::to_owned));
        }
        names
    }
}

/// The results in a file.
///
/// # Errors
/// If it has none of the forms.
pub fn read(path: &str, bytes: &[u8]) -> Result<Vec<Outside>, String> {
    let text = decode::decode(bytes).text;
    if text.trim_start().starts_with('<') {
        let xml = roxmltree::Document::parse(&text).map_err(|error| error.to_string())?;
        return match xml.root_element().tag_name().name() {
            "testsuites" | "testsuite" => Ok(junit(path, &xml)),
            name if name.to_lowercase().contains("report") => test_manager(path, &xml),
            name => Err(format!("`<{name}>` is no report that is known")),
        };
    }
    plcverif(path, &text)
}

fn junit(path: &str, xml: &roxmltree::Document<'_>) -> Vec<Outside> {
    let tool = if xml.descendants().any(|node| node.attribute("name").is_some_and(|name| name.contains("PLCverif"))) {
        "PLCverif"
    } else {
        "TcUnit or JUnit"
    };
    let cases = xml.descendants().filter(|node| node.has_tag_name("testcase"));
    let one = |case: roxmltree::Node<'_, '_>| {
        let verdict = case.children().find(|node| matches!(node.tag_name().name(), "failure" | "error" | "skipped"));
        let outcome = match verdict.map(|node| node.tag_name().name().to_owned()).as_deref() {
            Some("failure") => "failed",
            Some("error") => "error",
            Some(_) => "skipped",
            None => "passed",
        };
        let message = verdict.and_then(|node| node.attribute("message").or_else(|| node.text())).unwrap_or("");
        let suite = case.parent_element().and_then(|node| node.attribute("name"));
        Outside {
            tool: tool.to_owned(),
            file: path.to_owned(),
            suite: case.attribute("classname").filter(|name| !name.is_empty()).or(suite).unwrap_or("").to_owned(),
            case: case.attribute("name").unwrap_or("").to_owned(),
            outcome: outcome.to_owned(),
            message: message.split_whitespace().collect::<Vec<_>>().join(" "),
        }
    };
    cases.map(one).collect()
}

/// Elements whose name ends in `case`, in whatever letters, with a name and a result as attribute or child.
fn test_manager(path: &str, xml: &roxmltree::Document<'_>) -> Result<Vec<Outside>, String> {
    let mut out = Vec::new();
    for case in xml.descendants().filter(|node| node.is_element()) {
        if !case.tag_name().name().to_lowercase().ends_with("case") {
            continue;
        }
        let Some(outcome) = value(case, &["result", "outcome", "status", "state"]) else { continue };
        let suite = case.ancestors().skip(1).find_map(|node| value(node, &["testee", "name"])).unwrap_or_default();
        out.push(Outside {
            tool: "CODESYS Test Manager".to_owned(),
            file: path.to_owned(),
            suite,
            case: value(case, &["name", "title", "id"]).unwrap_or_default(),
            outcome: outcome.to_lowercase(),
            message: value(case, &["message", "comment", "error"]).unwrap_or_default(),
        });
    }
    if out.is_empty() { Err("there is no test case with a result in it".to_owned()) } else { Ok(out) }
}

/// An attribute or the text of a child, whatever the case of its letters.
fn value(node: roxmltree::Node<'_, '_>, names: &[&str]) -> Option<String> {
    names.iter().find_map(|name| {
        let attribute = node.attributes().find(|attribute| attribute.name().eq_ignore_ascii_case(name));
        let child = || node.children().find(|child| child.tag_name().name().eq_ignore_ascii_case(name))?.text();
        let text = attribute.map(|attribute| attribute.value()).or_else(child)?.trim();
        (!text.is_empty()).then(|| text.to_owned())
    })
}

/// Lines `Key: value` of PLCverif's text report; a case begins with its identifier.
fn plcverif(path: &str, text: &str) -> Result<Vec<Outside>, String> {
    let mut out: Vec<Outside> = Vec::new();
    let (mut id, mut source) = (String::new(), String::new());
    for line in text.lines() {
        let Some((key, value)) = line.trim_start_matches([' ', '*', '-', '|', '\t']).split_once(':') else { continue };
        let (key, value) = (key.trim().to_lowercase(), value.trim());
        match key.as_str() {
            "id" | "case id" | "verification case" | "verification case id" => value.clone_into(&mut id),
            "source file" | "source files" | "entry block" | "entry" => value.clone_into(&mut source),
            "result" | "verification result"
                if matches!(value.to_lowercase().as_str(), "satisfied" | "violated" | "unknown" | "error") =>
            {
                out.push(Outside {
                    tool: "PLCverif".to_owned(),
                    file: path.to_owned(),
                    suite: source.clone(),
                    case: id.clone(),
                    outcome: value.to_lowercase(),
                    message: String::new(),
                });
            }
            _ => {}
        }
    }
    if out.is_empty() { Err("it is no report that is known".to_owned()) } else { Ok(out) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn junit_tells_passed_from_failed_and_names_blocks() {
        let text = br#"<testsuites><testsuite name="PRG_TEST.fbValveTests"><testcase name="Opens" classname="PRG.FB_Valve_Tests"/>
            <testcase name="Closes" classname="PRG.FB_Valve_Tests"><failure message="expected TRUE"/></testcase></testsuite></testsuites>"#;
        let found = read("r.xml", text).expect("read");
        let outcomes: Vec<_> = found.iter().map(|result| (result.outcome.as_str(), result.message.as_str())).collect();
        assert_eq!(outcomes, [("passed", ""), ("failed", "expected TRUE")]);
        assert!(found[0].names().contains(&"fb_valve".to_owned()));
    }

    #[test]
    fn other_reports_are_told_by_their_form() {
        let xml = br#"<TestReport><TestScript Name="FB_Valve"><TestCase Name="Opens" Result="OK"/></TestScript></TestReport>"#;
        let found = read("r.xml", xml).expect("read");
        assert_eq!((found[0].suite.as_str(), found[0].outcome.as_str()), ("FB_Valve", "ok"));
        let text = b"PLCverif verification report\nID: case1\nEntry block: FB_Valve\nResult: Satisfied\n";
        assert_eq!(read("r.txt", text).expect("read")[0].outcome, "satisfied");
        assert!(read("r.xml", b"<html/>").is_err());
        assert!(read("r.txt", b"Result: fine").is_err());
    }
}
