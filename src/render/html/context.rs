//! Where a page stands, and so how it writes the addresses of others.

use tera::Value;

use super::escape;
use super::value::{markup, record};
use crate::book::view::entity::{EntityLink, TypePart};
use crate::book::view::prose::Href;

/// A page's place below the site's root.
#[derive(Clone, Debug)]
pub(super) struct Place {
    /// The way from the page to the root: `./`, `../`, `../../`, …
    root: String,
}

impl Place {
    /// Of the page with this path.
    pub(super) fn of(path: &str) -> Self {
        let path = path.split('#').next().unwrap_or_default();
        let depth = path.matches('/').count();
        Self { root: if depth == 0 { "./".to_owned() } else { "../".repeat(depth) } }
    }

    /// The way to the root. Never empty, so that no path can pass for a scheme.
    pub(super) fn root(&self) -> &str {
        &self.root
    }

    /// The address of `url`, which is below the root.
    pub(super) fn href(&self, url: &str) -> String {
        format!("{}{url}", self.root)
    }

    /// The address that `href` means, if there is one.
    pub(super) fn target(&self, href: &Href) -> Option<String> {
        match href {
            Href::Page { url, .. } => Some(self.href(url)),
            Href::External { url } => escape::is_external(url).then(|| url.clone()),
            Href::Broken { .. } => None,
        }
    }

    /// A link for templates: `name`, `kind`, `href` (or none).
    pub(super) fn link(&self, link: &EntityLink) -> Value {
        record! {
            name: link.name.as_str(),
            kind: link.kind_label,
            href: link.to.as_ref().and_then(|to| self.target(to)),
        }
    }

    /// A type's text as markup, its names linked.
    pub(super) fn type_(&self, parts: &[TypePart]) -> Value {
        let mut out = String::new();
        for part in parts {
            match part.to.as_ref().and_then(|to| self.target(to)) {
                Some(href) => push_link(&mut out, &href, &escape::text(&part.text)),
                None => escape::push(&mut out, &part.text),
            }
        }
        markup(&out)
    }
}

impl Place {
    /// A drawing's `<svg>`, its links led from this page: they come as addresses below the root.
    ///
    /// A drawing with links is a group for those who cannot see it: an image must hold nothing that takes the focus.
    pub(super) fn drawing(&self, svg: &str) -> String {
        const LINK: &str = "<a href=\"";
        let mut pieces = svg.split(LINK);
        let mut out = pieces.next().unwrap_or_default().to_owned();
        for piece in pieces {
            out.push_str(LINK);
            if !piece.starts_with('#') && !escape::is_external(piece) {
                out.push_str(&self.root);
            }
            out.push_str(piece);
        }
        if svg.contains(LINK) { out.replacen("role=\"img\"", "role=\"group\"", 1) } else { out }
    }
}

/// Appends a link to `href` around `inner`, which is markup.
pub(super) fn push_link(out: &mut String, href: &str, inner: &str) {
    out.push_str("<a href=\"");
    escape::push(out, href);
    out.push_str(if escape::is_external(href) { "\" rel=\"noopener noreferrer\">" } else { "\">" });
    out.push_str(inner);
    out.push_str("</a>");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_relative_to_the_page() {
        assert_eq!(Place::of("index.html").href("a/b.html#c"), "./a/b.html#c");
        assert_eq!(Place::of("a/b/c.html#x/y").href("d.html"), "../../d.html");
    }

    #[test]
    fn links_in_drawings_are_relative_to_the_page() {
        let svg = "<svg role=\"img\"><a href=\"x/y.html#z\"><a href=\"#here\"></svg>";
        let expected = "<svg role=\"group\"><a href=\"../x/y.html#z\"><a href=\"#here\"></svg>";
        assert_eq!(Place::of("a/b.html").drawing(svg), expected);
        assert_eq!(Place::of("a.html").drawing("<svg role=\"img\"></svg>"), "<svg role=\"img\"></svg>");
    }

    #[test]
    fn a_forbidden_scheme_is_no_target() {
        let url = "javascript:alert(1)".to_owned();
        assert_eq!(Place::of("x.html").target(&Href::External { url: url.clone() }), None);
        let page = Href::Page { url, label: String::new() };
        assert_eq!(Place::of("x.html").target(&page).as_deref(), Some("./javascript:alert(1)"));
    }
}
