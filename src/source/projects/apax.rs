//! SIMATIC AX's `apax.yml`. Of YAML, only `key: value` at the margin is read, and the keys of `dependencies`.

use super::{About, Draft, LibraryReference, ProjectKind, folder_name};
use crate::source::formats::Input;
use crate::source::paths;

/// Whether the file at `path` is the manifest of a SIMATIC AX project.
pub(super) fn is_manifest(path: &str) -> bool {
    matches!(paths::name(path), "apax.yml" | "apax.yaml")
}

/// The project that `input` tells of.
pub(super) fn read(input: &Input<'_>) -> Draft {
    let text = input.text;
    let name = scalar(text, "name").unwrap_or_else(|| folder_name(input.path));
    let mut draft = Draft::new(ProjectKind::SimaticAx, name, input.path);
    draft.about = About {
        version: scalar(text, "version"),
        author: scalar(text, "author"),
        description: scalar(text, "description"),
        ..About::default()
    };
    draft.libraries = dependencies(text);
    draft
}

/// The value of `key` at the margin, if it stands on the same line.
fn scalar(text: &str, key: &str) -> Option<String> {
    text.lines().find_map(|line| value_of(line, key)).filter(|value| !value.is_empty())
}

fn value_of(line: &str, key: &str) -> Option<String> {
    let value = line.strip_prefix(key)?.trim_start().strip_prefix(':')?;
    Some(unquoted(value.trim()))
}

fn unquoted(value: &str) -> String {
    for quote in ['"', '\''] {
        if let Some(inner) = value.strip_prefix(quote) {
            return inner.split(quote).next().unwrap_or(inner).to_owned();
        }
    }
    value.split(" #").next().unwrap_or(value).trim_end().to_owned()
}

fn dependencies(text: &str) -> Vec<LibraryReference> {
    let after = text.lines().skip_while(|line| value_of(line, "dependencies").is_none()).skip(1);
    let block = after.take_while(|line| line.is_empty() || line.starts_with([' ', '\t', '#']));
    let entry = |line: &str| {
        let line = line.trim();
        // A name may be quoted and may hold a colon only there.
        let (name, version) = line.rsplit_once(':').filter(|_| !line.starts_with('#'))?;
        let version = Some(unquoted(version.trim())).filter(|version| !version.is_empty());
        Some(LibraryReference { name: unquoted(name.trim()), version, ..LibraryReference::default() })
    };
    block.filter_map(entry).collect()
}
