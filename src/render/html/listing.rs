//! A listing as markup: lines with anchors, coloured tokens, linked names. A large manual is mostly listings, so the
//! markup is short.

use super::context::{Place, push_link};
use super::escape;
use super::highlight::push_span;
use crate::book::view::entity::{Run, SourceView};

/// The anchor of `line` in the listing `index` of a page.
pub(super) fn line_anchor(index: usize, line: u32) -> String {
    format!("s{index}-L{line}")
}

/// The anchor on a page with these listings of a line of a file, if one of them shows it.
pub(super) fn find_line(sources: &[SourceView], file: &str, line: u32) -> Option<String> {
    let shows = |source: &SourceView| {
        let lines = u32::try_from(source.text.lines().count()).unwrap_or(u32::MAX);
        source.file == file && line >= source.first_line && line - source.first_line < lines
    };
    sources.iter().position(shows).map(|index| line_anchor(index, line))
}

/// How many lines a listing has.
pub(super) fn line_count(source: &SourceView) -> usize {
    source.text.lines().count()
}

/// The lines of `source`, the listing `index` of its page.
pub(super) fn lines(source: &SourceView, index: usize, place: &Place) -> String {
    let mut writer = Writer { out: String::with_capacity(source.text.len() * 3), index, line: source.first_line };
    writer.number();
    let text = source.text.strip_suffix('\n').unwrap_or(&source.text);
    let mut at = 0;
    for run in &source.runs {
        let (start, end) = (run.start as usize, (run.end as usize).min(text.len()));
        // Runs that overlap or cut a character are left out: the text matters more than its colours.
        let Some(token) = text.get(start..end).filter(|token| start >= at && !token.is_empty()) else { continue };
        writer.plain(&text[at..start]);
        writer.token(token, run, link_of(source, run, place).as_deref());
        at = end;
    }
    writer.plain(&text[at..]);
    writer.out
}

fn link_of(source: &SourceView, run: &Run, place: &Place) -> Option<String> {
    run.link.and_then(|link| source.links.get(link as usize)).map(|url| place.href(url))
}

struct Writer {
    out: String,
    index: usize,
    line: u32,
}

impl Writer {
    /// The beginning of a line: its anchor. The style sheet counts the lines and shows the number there.
    fn number(&mut self) {
        self.out.push_str("<a id=\"");
        self.out.push_str(&line_anchor(self.index, self.line));
        self.out.push_str("\"></a>");
    }

    fn new_line(&mut self) {
        self.out.push('\n');
        self.line = self.line.saturating_add(1);
        self.number();
    }

    fn plain(&mut self, text: &str) {
        for (i, part) in text.split('\n').enumerate() {
            if i > 0 {
                self.new_line();
            }
            escape::push(&mut self.out, part);
        }
    }

    /// A token; one that spans lines is cut at their ends.
    fn token(&mut self, text: &str, run: &Run, href: Option<&str>) {
        for (i, part) in text.split('\n').enumerate() {
            if i > 0 {
                self.new_line();
            }
            let part = part.trim_end_matches('\r');
            if part.is_empty() {
                continue;
            }
            match href {
                Some(href) => push_link(&mut self.out, href, &escape::text(part)),
                None => push_span(&mut self.out, run.class, &escape::text(part)),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::book::view::entity::RunClass;

    fn source(text: &str, runs: &[(u32, u32, RunClass, Option<u32>)]) -> SourceView {
        SourceView {
            title: "Body".to_owned(),
            anchor: String::new(),
            file: "a.st".to_owned(),
            first_line: 9,
            text: text.to_owned(),
            runs: runs.iter().map(|&(start, end, class, link)| Run { start, end, class, link }).collect(),
            links: vec!["b.html#x".to_owned()],
            note: None,
        }
    }

    /// Line numbers and spans in a short form.
    fn shown(source: &SourceView) -> String {
        let html = lines(source, 0, &Place::of("p.html"));
        let numbers = (9..20).fold(html, |html, n| html.replace(&format!("<a id=\"s0-L{n}\"></a>"), &format!("{n}|")));
        numbers.replace("<i class=\"", "[").replace("</i>", "]").replace("\">", ":")
    }

    #[test]
    fn a_comment_over_lines_is_cut_at_their_ends() {
        let source = source("a (* b\r\nc *) <d\n", &[(2, 12, RunClass::Comment, None)]);
        assert_eq!(shown(&source), "9|a [c:(* b]\n10|[c:c *)] &lt;d");
    }

    #[test]
    fn names_are_linked() {
        let source = source("x : B;", &[(4, 5, RunClass::Name, Some(0))]);
        assert_eq!(shown(&source), "9|x : <a href=\"./b.html#x:B</a>;");
    }

    #[test]
    fn wrong_runs_lose_colour_and_not_text() {
        let bad = [(3, 2, RunClass::Name, None), (0, 1, RunClass::Name, Some(7)), (5, 900, RunClass::Type, None)];
        assert_eq!(shown(&source("äbcdef", &bad)), "9|äbcd[t:ef]");
    }

    #[test]
    fn a_line_is_found_in_the_listing_that_shows_it() {
        let sources = [source("a\nb", &[])];
        assert_eq!(find_line(&sources, "a.st", 10).as_deref(), Some("s0-L10"));
        assert_eq!(find_line(&sources, "a.st", 11), None);
        assert_eq!(find_line(&sources, "b.st", 10), None);
    }
}
