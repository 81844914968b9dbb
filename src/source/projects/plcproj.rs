//! TwinCAT's `.plcproj`, an MSBuild project that names every object with `\` between folders.

use std::collections::BTreeMap;

use super::{About, Draft, LibraryReference, Member, ProjectKind};
use crate::source::formats::{Input, xml_notes};
use crate::source::note::Note;
use crate::source::paths;
use crate::source::xml::{Element, Xml};

/// The project that `input` tells of.
pub(super) fn read(input: &Input<'_>) -> (Draft, Vec<Note>) {
    let xml = Xml::parse(input.text, &[]);
    let mut draft = Draft::new(ProjectKind::TwinCat, paths::stem(input.path).to_owned(), input.path);
    if let Some(root) = xml.root() {
        if let Some(name) = property(root, "Name") {
            draft.name = name;
        }
        draft.about = about(root, &draft.name);
        draft.libraries = libraries(root);
        draft.members = members(root);
    }
    (draft, xml_notes(&xml))
}

fn property(root: Element<'_>, name: &str) -> Option<String> {
    root.children_named("PropertyGroup").find_map(|group| group.child_text(name))
}

fn about(root: Element<'_>, name: &str) -> About {
    About {
        title: property(root, "Title").filter(|title| title != name),
        version: property(root, "ProjectVersion"),
        company: property(root, "Company"),
        author: property(root, "Author"),
        description: property(root, "Description"),
        namespace: property(root, "DefaultNamespace"),
    }
}

fn items<'x>(root: Element<'x>, name: &'static str) -> impl Iterator<Item = Element<'x>> {
    root.children_named("ItemGroup").flat_map(move |group| group.children_named(name))
}

fn members(root: Element<'_>) -> Vec<Member> {
    let excluded: Vec<String> = items(root, "Folder")
        .filter(|folder| is_excluded(*folder))
        .filter_map(|folder| folder.value("Include"))
        .collect();
    items(root, "Compile").filter_map(|item| member(item, &excluded)).collect()
}

fn member(item: Element<'_>, excluded: &[String]) -> Option<Member> {
    let include = item.attribute("Include")?;
    let path = unescaped(&include.value);
    // A file from elsewhere says in `Link` where the project shows it.
    let shown = item.child_text("Link").unwrap_or_else(|| path.clone());
    let mut folder: Vec<String> =
        shown.split(['\\', '/']).filter(|part| !matches!(*part, "" | "." | "..")).map(str::to_owned).collect();
    folder.pop();
    let in_excluded =
        excluded.iter().any(|folder| paths::is_below(&shown.replace('\\', "/"), &folder.replace('\\', "/")));
    Some(Member {
        path,
        span: include.span,
        file: None,
        folder,
        exclude_from_build: in_excluded || is_excluded(item),
        description: None,
    })
}

fn is_excluded(item: Element<'_>) -> bool {
    item.child_text("ExcludeFromBuild").is_some_and(|value| value.eq_ignore_ascii_case("true"))
}

/// MSBuild writes special characters as `%28`.
fn unescaped(path: &str) -> String {
    let mut out = Vec::with_capacity(path.len());
    let mut rest = path.as_bytes();
    while let Some((first, after)) = rest.split_first() {
        let code = after
            .get(..2)
            .and_then(|hex| std::str::from_utf8(hex).ok())
            .and_then(|hex| u8::from_str_radix(hex, 16).ok());
        match (*first, code) {
            (b'%', Some(byte)) => {
                out.push(byte);
                rest = &after[2..];
            }
            (byte, _) => {
                out.push(byte);
                rest = after;
            }
        }
    }
    String::from_utf8(out).unwrap_or_else(|_| path.to_owned())
}

/// Libraries by name, placeholders with the version that they are resolved to.
fn libraries(root: Element<'_>) -> Vec<LibraryReference> {
    let resolved: BTreeMap<String, String> = items(root, "PlaceholderResolution")
        .filter_map(|item| Some((item.value("Include")?, item.child_text("Resolution")?)))
        .collect();
    let placeholders = items(root, "PlaceholderReference").filter_map(|item| {
        let name = item.value("Include")?;
        let text = resolved.get(&name).cloned().or_else(|| item.child_text("DefaultResolution"));
        let (_, version, company) = text.as_deref().map_or(("", None, None), library);
        Some(LibraryReference { name, version, company, namespace: item.child_text("Namespace") })
    });
    let direct = items(root, "LibraryReference").filter_map(|item| {
        let include = item.value("Include")?;
        let (name, version, company) = library(&include);
        Some(LibraryReference { name: name.to_owned(), version, company, namespace: item.child_text("Namespace") })
    });
    placeholders.chain(direct).collect()
}

/// `Name, version (Company)` or `Name,version,Company`; `*` and `newest` fix no version.
fn library(text: &str) -> (&str, Option<String>, Option<String>) {
    let (name, rest) = text.split_once(',').unwrap_or((text, ""));
    let (version, company) = match rest.split_once(['(', ',']) {
        Some((version, company)) => (version, company.trim_end_matches(')')),
        None => (rest, ""),
    };
    let some = |text: &str| Some(text.trim().to_owned()).filter(|text| !text.is_empty());
    (name.trim(), some(version).filter(|version| version != "*" && version != "newest"), some(company))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_to_name_a_library() {
        let some = |text: &str| Some(text.to_owned());
        assert_eq!(library("Tc2_Standard, * (Maker GmbH)"), ("Tc2_Standard", None, some("Maker GmbH")));
        assert_eq!(library("Base, 1.2.3.4 (Maker)"), ("Base", some("1.2.3.4"), some("Maker")));
        assert_eq!(library("Base Interfaces,newest,System"), ("Base Interfaces", None, some("System")));
        assert_eq!(library("Alone"), ("Alone", None, None));
    }

    #[test]
    fn escapes_of_the_build_system() {
        assert_eq!(unescaped("a%28b%29 100%.st"), "a(b) 100%.st");
        assert_eq!(unescaped("f%C3%BCr.TcPOU"), "für.TcPOU");
    }
}
