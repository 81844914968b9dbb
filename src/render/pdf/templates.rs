//! The embedded templates, and the user's that stand in for them.

use std::collections::BTreeMap;

/// The template that typst starts with.
pub(super) const MAIN: &str = "templates/pdf/manual.typ";

/// Every embedded file: name and text, sorted by name.
pub static EMBEDDED: &[(&str, &str)] = &[
    ("templates/pdf/annex.typ", include_str!("../../../templates/pdf/annex.typ")),
    ("templates/pdf/code.tmTheme", include_str!("../../../templates/pdf/code.tmTheme")),
    ("templates/pdf/entity.typ", include_str!("../../../templates/pdf/entity.typ")),
    ("templates/pdf/front.typ", include_str!("../../../templates/pdf/front.typ")),
    ("templates/pdf/library.typ", include_str!("../../../templates/pdf/library.typ")),
    ("templates/pdf/manual.typ", include_str!("../../../templates/pdf/manual.typ")),
    ("templates/pdf/prose.typ", include_str!("../../../templates/pdf/prose.typ")),
    ("templates/pdf/style.typ", include_str!("../../../templates/pdf/style.typ")),
    ("templates/pdf/table.typ", include_str!("../../../templates/pdf/table.typ")),
    (
        "themes/syntax/structured-text.sublime-syntax",
        include_str!("../../../themes/syntax/structured-text.sublime-syntax"),
    ),
];

/// All files by name: the embedded ones, with the user's in their place or beside them.
pub(super) fn files(overrides: &BTreeMap<String, String>) -> BTreeMap<String, Vec<u8>> {
    let embedded = EMBEDDED.iter().map(|(name, text)| ((*name).to_owned(), text.as_bytes().to_vec()));
    let users = overrides.iter().map(|(name, text)| (name.clone(), text.as_bytes().to_vec()));
    embedded.chain(users).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_sorted_and_unique() {
        assert!(EMBEDDED.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert!(EMBEDDED.iter().any(|(name, _)| *name == MAIN));
    }

    #[test]
    fn a_users_file_replaces_and_adds() {
        let mine = [(MAIN.to_owned(), "mine".to_owned()), ("templates/pdf/more.typ".to_owned(), "more".to_owned())];
        let files = files(&mine.into());
        assert_eq!(files.get(MAIN).map(Vec::as_slice), Some(b"mine".as_slice()));
        assert_eq!(files.len(), EMBEDDED.len() + 1);
    }
}
