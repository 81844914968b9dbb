//! Lists of requirements: ReqIF 1.x (OMG), CSV, StrictDoc. Only what a traceability matrix needs is read: identifier, title, and the
//! reason why a requirement needs no block, where the list gives one.

use crate::text::decode;

/// A requirement.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Requirement {
    /// Its identifier, as `@req` writes it.
    pub id: String,
    /// Its title, or the beginning of its text.
    pub title: String,
    /// Why no block meets it; empty if one has to.
    pub justification: String,
}

/// The requirements in a file; its name says which form it has.
///
/// # Errors
/// If the file has none of the forms, or no requirement in it.
pub fn read(path: &str, bytes: &[u8]) -> Result<Vec<Requirement>, String> {
    let text = decode::decode(bytes).text;
    let name = path.to_ascii_lowercase();
    let found = if name.ends_with(".csv") {
        csv(&text)?
    } else if name.ends_with(".reqif") || name.ends_with(".xml") {
        reqif(&text)?
    } else if name.ends_with(".sdoc") {
        strictdoc(&text)
    } else {
        return Err("its name ends neither in `.csv` nor in `.reqif` nor in `.sdoc`".to_owned());
    };
    if found.is_empty() { Err("there is no requirement in it".to_owned()) } else { Ok(found) }
}

const ID: [&str; 6] = ["id", "uid", "identifier", "requirement", "req", "reqif.foreignid"];
const TITLE: [&str; 7] = ["title", "name", "reqif.chaptername", "reqif.name", "summary", "text", "reqif.text"];
const WHY: [&str; 4] = ["justification", "exception", "reason", "rationale for exception"];

/// The first of `names` that a column or attribute is called.
fn position(columns: &[String], names: &[&str]) -> Option<usize> {
    names.iter().find_map(|name| columns.iter().position(|column| column == name))
}

fn csv(text: &str) -> Result<Vec<Requirement>, String> {
    let head = text.lines().next().unwrap_or("");
    let delimiter =
        [b';', b'\t', b','].into_iter().max_by_key(|d| head.bytes().filter(|b| b == d).count()).unwrap_or(b',');
    let mut reader = csv::ReaderBuilder::new().delimiter(delimiter).flexible(true).from_reader(text.as_bytes());
    let headers = reader.headers().map_err(|error| error.to_string())?;
    let headers: Vec<String> = headers.iter().map(|name| name.trim().to_lowercase()).collect();
    let id = position(&headers, &ID).ok_or("no column is called `id`")?;
    let (title, why) = (position(&headers, &TITLE), position(&headers, &WHY));
    let mut out = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|error| error.to_string())?;
        let cell = |index: Option<usize>| index.and_then(|index| record.get(index)).unwrap_or("").trim().to_owned();
        let requirement = Requirement { id: cell(Some(id)), title: cell(title), justification: cell(why) };
        if !requirement.id.is_empty() {
            out.push(requirement);
        }
    }
    Ok(out)
}

/// The objects of specifications; names of attributes stand in the definitions that their values refer to.
fn reqif(text: &str) -> Result<Vec<Requirement>, String> {
    let xml = roxmltree::Document::parse(text).map_err(|error| error.to_string())?;
    let tag = |node: &roxmltree::Node<'_, '_>, name: &str| node.tag_name().name() == name;
    let definition = |reference: &str| {
        let found = xml.descendants().find(|node| node.attribute("IDENTIFIER") == Some(reference));
        found.and_then(|node| node.attribute("LONG-NAME")).unwrap_or("").to_lowercase()
    };
    let mut out = Vec::new();
    for object in xml.descendants().filter(|node| tag(node, "SPEC-OBJECT")) {
        let (mut names, mut values) = (Vec::new(), Vec::new());
        for value in object.descendants().filter(|node| node.tag_name().name().starts_with("ATTRIBUTE-VALUE-")) {
            let reference = value.descendants().find(|node| node.tag_name().name().ends_with("-REF"));
            let reference = reference.and_then(|node| node.text()).unwrap_or("").trim();
            let holder = value.children().find(|node| tag(node, "THE-VALUE"));
            let words = holder.map(|holder| {
                holder.descendants().filter(roxmltree::Node::is_text).filter_map(|node| node.text()).collect::<String>()
            });
            names.push(definition(reference));
            values.push(value.attribute("THE-VALUE").map(str::to_owned).or(words).unwrap_or_default());
        }
        let get = |wanted: &[&str]| position(&names, wanted).map_or_else(String::new, |index| fold(&values[index]));
        let own = get(&ID);
        let identifier = object.attribute("IDENTIFIER").unwrap_or("").to_owned();
        let long = object.attribute("LONG-NAME").unwrap_or("");
        let title = get(&TITLE);
        let title = if title.is_empty() { fold(long) } else { title };
        out.push(Requirement { id: if own.is_empty() { identifier } else { own }, title, justification: get(&WHY) });
    }
    Ok(out)
}

fn fold(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// `[REQUIREMENT]` (and other nodes) of StrictDoc: lines `UID: …`, `TITLE: …`; only those with an identifier count.
fn strictdoc(text: &str) -> Vec<Requirement> {
    let mut out: Vec<Requirement> = Vec::new();
    let mut open = false;
    for line in text.lines() {
        let line = line.trim_end();
        if line.starts_with('[') && line.ends_with(']') {
            open = !line.starts_with("[/") && !line.starts_with("[[") && line != "[DOCUMENT]" && line != "[SECTION]";
            if open {
                out.push(Requirement::default());
            }
            continue;
        }
        let (Some((key, value)), Some(last), true) = (line.split_once(':'), out.last_mut(), open) else { continue };
        let field = match key {
            "UID" => &mut last.id,
            "TITLE" => &mut last.title,
            "STATEMENT" if last.title.is_empty() => &mut last.title,
            "JUSTIFICATION" | "EXCEPTION" => &mut last.justification,
            _ => continue,
        };
        value.trim().trim_start_matches(">>>").clone_into(field);
    }
    out.retain(|requirement| !requirement.id.is_empty());
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ids(found: &[Requirement]) -> Vec<(&str, &str, &str)> {
        found.iter().map(|r| (r.id.as_str(), r.title.as_str(), r.justification.as_str())).collect()
    }

    #[test]
    fn csv_finds_its_columns_and_its_separator() {
        let found =
            read("r.csv", b"Title;ID;Justification\n\"Stop; at once\";R-1;\nLamp;R-2;mechanical\n").expect("read");
        assert_eq!(ids(&found), [("R-1", "Stop; at once", ""), ("R-2", "Lamp", "mechanical")]);
        assert!(read("r.csv", b"a,b\n1,2\n").is_err());
    }

    #[test]
    fn strictdoc_reads_nodes_with_an_identifier() {
        let text = "[DOCUMENT]\nTITLE: Spec\n\n[REQUIREMENT]\nUID: R-1\nTITLE: Stop\nSTATEMENT: >>>\nIt stops.\n<<<\n\n[REQUIREMENT]\nSTATEMENT: None\n";
        let found = read("r.sdoc", text.as_bytes()).expect("read");
        assert_eq!(ids(&found), [("R-1", "Stop", "")]);
    }

    #[test]
    fn reqif_names_attributes_through_their_definitions() {
        let text = r#"<REQ-IF xmlns="http://www.omg.org/spec/ReqIF/20110401/reqif.xsd"><CORE-CONTENT><SPEC-TYPES><SPEC-OBJECT-TYPE>
            <ATTRIBUTE-DEFINITION-STRING IDENTIFIER="d1" LONG-NAME="ReqIF.ForeignID"/>
            <ATTRIBUTE-DEFINITION-XHTML IDENTIFIER="d2" LONG-NAME="ReqIF.Text"/></SPEC-OBJECT-TYPE></SPEC-TYPES><SPEC-OBJECTS>
            <SPEC-OBJECT IDENTIFIER="_1"><VALUES><ATTRIBUTE-VALUE-STRING THE-VALUE="R-1"><DEFINITION>
            <ATTRIBUTE-DEFINITION-STRING-REF>d1</ATTRIBUTE-DEFINITION-STRING-REF></DEFINITION></ATTRIBUTE-VALUE-STRING>
            <ATTRIBUTE-VALUE-XHTML><DEFINITION><ATTRIBUTE-DEFINITION-XHTML-REF>d2</ATTRIBUTE-DEFINITION-XHTML-REF></DEFINITION>
            <THE-VALUE><div>It <b>stops</b>.</div></THE-VALUE></ATTRIBUTE-VALUE-XHTML></VALUES></SPEC-OBJECT>
            <SPEC-OBJECT IDENTIFIER="_2" LONG-NAME="Lamp"/></SPEC-OBJECTS></CORE-CONTENT></REQ-IF>"#;
        let found = read("r.reqif", text.as_bytes()).expect("read");
        assert_eq!(ids(&found), [("R-1", "It stops.", ""), ("_2", "Lamp", "")]);
    }
}
