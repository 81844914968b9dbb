//! The embedded templates and style files, and the user's files that stand in for them.
//!
//! A file's name is its path below the repository, such as `templates/html/entity.html` or `themes/style.css`. A
//! user's file of the same name under `rungbook/` replaces it; one of another name is an addition, which a replaced
//! template may include.

use std::collections::BTreeMap;

/// Every embedded file: name and text, sorted by name.
pub static EMBEDDED: &[(&str, &str)] = &[
    ("templates/html/base.html", include_str!("../../templates/html/base.html")),
    ("templates/html/chapter.html", include_str!("../../templates/html/chapter.html")),
    ("templates/html/components.html", include_str!("../../templates/html/components.html")),
    ("templates/html/coverage.html", include_str!("../../templates/html/coverage.html")),
    ("templates/html/entity.html", include_str!("../../templates/html/entity.html")),
    ("templates/html/files.html", include_str!("../../templates/html/files.html")),
    ("templates/html/findings.html", include_str!("../../templates/html/findings.html")),
    ("templates/html/folder.html", include_str!("../../templates/html/folder.html")),
    ("templates/html/front.html", include_str!("../../templates/html/front.html")),
    ("templates/html/kind.html", include_str!("../../templates/html/kind.html")),
    ("templates/html/library.html", include_str!("../../templates/html/library.html")),
    ("templates/html/names.html", include_str!("../../templates/html/names.html")),
    ("templates/html/search.html", include_str!("../../templates/html/search.html")),
    ("themes/early.js", include_str!("../../themes/early.js")),
    ("themes/icon.svg", include_str!("../../themes/icon.svg")),
    ("themes/rungbook.js", include_str!("../../themes/rungbook.js")),
    ("themes/search.js", include_str!("../../themes/search.js")),
    ("themes/style.css", include_str!("../../themes/style.css")),
    (
        "themes/syntax/structured-text.sublime-syntax",
        include_str!("../../themes/syntax/structured-text.sublime-syntax"),
    ),
];

/// The files that a renderer works with.
#[derive(Clone, Debug, Default)]
pub struct Theme {
    overrides: BTreeMap<String, String>,
}

impl Theme {
    /// The embedded files, with the user's in their place.
    #[must_use]
    pub fn new(overrides: BTreeMap<String, String>) -> Self {
        Self { overrides }
    }

    /// The text of the file `name`.
    #[must_use]
    pub fn text(&self, name: &str) -> Option<&str> {
        let embedded = || EMBEDDED.iter().find(|(n, _)| *n == name).map(|(_, text)| *text);
        self.overrides.get(name).map(String::as_str).or_else(embedded)
    }

    /// Name and text of every file whose name begins with `folder`, sorted by name.
    pub fn files<'a>(&'a self, folder: &'a str) -> impl Iterator<Item = (&'a str, &'a str)> {
        let embedded = EMBEDDED.iter().copied();
        let overrides = self.overrides.iter().map(|(name, text)| (name.as_str(), text.as_str()));
        let all: BTreeMap<&str, &str> = embedded.chain(overrides).collect();
        all.into_iter().filter(move |(name, _)| name.starts_with(folder))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn embedded_names_are_sorted_and_unique() {
        assert!(EMBEDDED.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn a_users_file_replaces_and_adds() {
        let overrides = [("themes/style.css", "a{}"), ("themes/logo.svg", "<svg/>")];
        let theme = Theme::new(overrides.map(|(n, t)| (n.to_owned(), t.to_owned())).into());
        assert_eq!(theme.text("themes/style.css"), Some("a{}"));
        assert!(theme.files("themes/").any(|(name, _)| name == "themes/logo.svg"));
        assert!(theme.text("themes/rungbook.js").is_some());
        assert_eq!(theme.text("themes/none.css"), None);
        assert!(theme.files("templates/html/").all(|(name, _)| name.ends_with(".html")));
    }
}
