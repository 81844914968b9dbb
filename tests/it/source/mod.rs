//! Tests of `source`: each format and each quirk on small files of our own, and the way back to the file.

mod codes;
mod codesys;
mod corpus;
mod dialects;
mod disk;
mod others;
mod plain;
mod plcopen;
mod projects;
mod span_map;
mod tree;
mod twincat;

use rungbook::diagnostic::Finding;
use rungbook::source::{Memory, Options, Tree, read_tree};
use rungbook::text::{Fragment, Object, Unit};

/// Reads `memory` with the usual options.
fn read(memory: &Memory) -> Tree {
    read_tree(memory, &Options::default(), &|_| {})
}

/// Reads one file and gives its unit.
fn unit(path: &str, bytes: impl AsRef<[u8]>) -> Unit {
    let tree = read(&Memory::new().with(path, bytes));
    assert_eq!(tree.units.len(), 1, "{:?}", tree.findings);
    tree.units[0].clone()
}

/// The names of the codes that were found, in order.
fn codes_of(findings: &[Finding]) -> Vec<&'static str> {
    findings.iter().map(|finding| finding.code.name).collect()
}

/// The object called `name` at any depth of `objects`.
fn find<'a>(objects: &'a [Object], name: &str) -> Option<&'a Object> {
    objects.iter().find_map(|object| {
        if object.name.as_deref() == Some(name) { Some(object) } else { find(&object.children, name) }
    })
}

/// The declaration's text.
fn declaration(object: &Object) -> &str {
    object.declaration.as_ref().map_or("", |fragment| &fragment.text)
}

/// All fragments of `unit`.
fn fragments(unit: &Unit) -> Vec<&Fragment> {
    fn of<'a>(object: &'a Object, out: &mut Vec<&'a Fragment>) {
        use rungbook::text::Body;
        out.extend(&object.declaration);
        out.extend(&object.documentation);
        match &object.body {
            Body::None => {}
            Body::St(body) | Body::Il(body) | Body::Other(_, body) => out.push(body),
        }
        for child in &object.children {
            of(child, out);
        }
    }
    let mut out = Vec::new();
    for object in &unit.objects {
        of(object, &mut out);
    }
    out
}
