//! Test tables in XML: sessions of *STVS*, *exteta*, the CODESYS Test Manager. The file goes on as a table file; the
//! program that a session keeps beside its tables is source text.

use super::{Claim, Format, Input, Unwrapped, xml_notes};
use crate::source::xml::{Element, Xml};
use crate::text::{Object, ObjectKind};

/// Test tables in XML.
#[derive(Debug)]
pub(super) struct XmlTables;

impl Format for XmlTables {
    fn name(&self) -> &'static str {
        "test tables in XML"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["xml", "st"]
    }

    fn claims(&self, input: &Input<'_>) -> Claim {
        const MARKS: [&str; 3] = ["formal.iti.kit.edu/stvs", "<test-table", "<tabletestspec"];
        let is_xml = input.head().trim_start().starts_with('<');
        if is_xml && MARKS.iter().any(|mark| input.head().contains(mark)) { Claim::Sure } else { Claim::No }
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        let xml = Xml::parse(input.text, &[]);
        let sessions = xml.roots().filter(|root| root.name() == "session");
        let codes = sessions.filter_map(|session| session.child("code")?.child("plaintext"));
        Unwrapped {
            objects: codes.map(program).collect(),
            notes: xml_notes(&xml),
            tables: true,
            ..Unwrapped::default()
        }
    }
}

fn program(code: Element<'_>) -> Object {
    let mut object = Object::new(ObjectKind::Text, None, code.name_span());
    object.declaration = Some(code.text());
    object
}
