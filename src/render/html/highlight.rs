//! Structured Text to coloured markup, by syntect and the syntax definition of the theme.
//!
//! The definition's scopes come down to the classes that listings use ([`RunClass`]), so that a signature, a fenced
//! example and a listing look alike and one style sheet colours them all.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::str::FromStr;
use std::sync::LazyLock;

use syntect::parsing::{ParseState, Scope, ScopeStack, SyntaxDefinition, SyntaxSet, SyntaxSetBuilder};
use syntect::util::LinesWithEndings;

use super::context::push_link;
use super::error::Error;
use super::escape;
use crate::book::view::entity::RunClass;
use crate::render::theme::Theme;

const FILE: &str = "themes/syntax/structured-text.sublime-syntax";

/// A longer line is shown without colours: the patterns are tried at every place of a line.
const LONGEST_LINE: usize = 4000;

/// Scope prefixes and their classes; the first that fits a scope decides.
const CLASSES: &[(&str, RunClass)] = &[
    ("comment", RunClass::Comment),
    ("meta.preprocessor", RunClass::Pragma),
    ("string", RunClass::String),
    ("constant.numeric", RunClass::Number),
    ("constant.language", RunClass::Keyword),
    ("keyword.operator.word", RunClass::Keyword),
    ("keyword.operator", RunClass::Operator),
    ("keyword", RunClass::Keyword),
    ("storage.modifier", RunClass::Keyword),
    ("storage.type", RunClass::Type),
    ("entity.name", RunClass::Name),
];

/// Addresses by the name in lower case that shall be linked.
pub(super) type Links = BTreeMap<String, String>;

/// The highlighter of Structured Text.
pub(super) struct Highlighter {
    syntaxes: Cow<'static, SyntaxSet>,
    classes: Vec<(Scope, RunClass)>,
}

/// The definition that the tool brings, compiled once: that takes longer than the pages of a small tree.
static OWN: LazyLock<Result<SyntaxSet, String>> =
    LazyLock::new(|| compile(Theme::default().text(FILE).unwrap_or_default()));

fn compile(definition: &str) -> Result<SyntaxSet, String> {
    let definition = SyntaxDefinition::load_from_str(definition, true, Some("Structured Text"))
        .map_err(|error| error.to_string())?;
    let mut builder = SyntaxSetBuilder::new();
    builder.add(definition);
    Ok(builder.build())
}

impl Highlighter {
    /// From the text of a syntax definition.
    pub(super) fn new(definition: &str) -> Result<Self, Error> {
        let error = |message: String| Error::Syntax { file: FILE.to_owned(), message };
        let syntaxes = if Theme::default().text(FILE) == Some(definition) {
            OWN.as_ref().map(Cow::Borrowed).map_err(Clone::clone)
        } else {
            compile(definition).map(Cow::Owned)
        };
        let syntaxes = syntaxes.map_err(error)?;
        let scope = |(prefix, class): &(&str, RunClass)| Scope::from_str(prefix).map(|scope| (scope, *class));
        let classes = CLASSES.iter().map(scope).collect::<Result<_, _>>().map_err(|e| error(format!("{e:?}")))?;
        Ok(Self { syntaxes, classes })
    }

    /// The name of the file that [`Self::new`] wants.
    pub(super) const fn file() -> &'static str {
        FILE
    }

    /// Whether a fence of this language is Structured Text.
    pub(super) fn knows(language: &str) -> bool {
        matches!(language, "st" | "iecst" | "iec-st" | "scl" | "structured-text" | "iec61131" | "pascal-st")
    }

    /// `code` as markup, with the names in `links` linked.
    pub(super) fn highlight(&self, code: &str, links: &Links) -> String {
        let mut out = String::with_capacity(code.len() * 2);
        let Some(syntax) = self.syntaxes.syntaxes().first() else {
            escape::push(&mut out, code);
            return out;
        };
        let mut state = ParseState::new(syntax);
        let mut stack = ScopeStack::new();
        for line in LinesWithEndings::from(code) {
            self.push_line(&mut out, line, &mut state, &mut stack, links);
        }
        out
    }

    fn push_line(&self, out: &mut String, line: &str, state: &mut ParseState, stack: &mut ScopeStack, links: &Links) {
        let ops = if line.len() > LONGEST_LINE { Ok(Vec::new()) } else { state.parse_line(line, &self.syntaxes) };
        // A pattern that exceeds the engine's limit costs a line its colours, not its text.
        let ops = ops.unwrap_or_default();
        let mut pending = Pending { class: None, text: String::new() };
        let mut at = 0;
        for (next, op) in ops {
            if next > at {
                self.push_piece(out, &mut pending, &line[at..next], stack, links);
                at = next;
            }
            if stack.apply(&op).is_err() {
                *stack = ScopeStack::new();
            }
        }
        self.push_piece(out, &mut pending, &line[at..], stack, links);
        pending.flush(out, links);
    }

    fn push_piece(&self, out: &mut String, pending: &mut Pending, piece: &str, stack: &ScopeStack, links: &Links) {
        let class = self.class(stack);
        if class != pending.class {
            pending.flush(out, links);
            pending.class = class;
        }
        pending.text.push_str(piece);
    }

    fn class(&self, stack: &ScopeStack) -> Option<RunClass> {
        let class_of = |scope: &Scope| self.classes.iter().find(|(prefix, _)| prefix.is_prefix_of(*scope));
        stack.as_slice().iter().find_map(class_of).map(|(_, class)| *class)
    }
}

/// Text of one class that is not written yet.
struct Pending {
    class: Option<RunClass>,
    text: String,
}

impl Pending {
    fn flush(&mut self, out: &mut String, links: &Links) {
        let text = std::mem::take(&mut self.text);
        let body = text.trim_end_matches(['\r', '\n']);
        match self.class {
            _ if body.is_empty() => {}
            Some(class) => push_span(out, class, &escape::text(body)),
            None => push_names(out, body, links),
        }
        escape::push(out, &text[body.len()..]);
    }
}

/// The class of a style sheet for a run: a letter, since a large manual has millions of them. Operators have none.
const fn css_class(class: RunClass) -> Option<char> {
    match class {
        RunClass::Keyword => Some('k'),
        RunClass::Type => Some('t'),
        RunClass::Comment => Some('c'),
        RunClass::Pragma => Some('p'),
        RunClass::String => Some('s'),
        RunClass::Number => Some('n'),
        RunClass::Name => Some('x'),
        RunClass::Operator => None,
    }
}

/// Appends a run around `inner`, which is markup.
pub(super) fn push_span(out: &mut String, class: RunClass, inner: &str) {
    match css_class(class) {
        Some(class) => {
            out.push_str("<i class=\"");
            out.push(class);
            out.push_str("\">");
            out.push_str(inner);
            out.push_str("</i>");
        }
        None => out.push_str(inner),
    }
}

/// Appends plain text, its names linked where `links` knows them.
fn push_names(out: &mut String, text: &str, links: &Links) {
    if links.is_empty() {
        return escape::push(out, text);
    }
    let is_word = |c: char| c == '_' || c.is_alphanumeric();
    let mut rest = text;
    while let Some(start) = rest.find(is_word) {
        let end = rest[start..].find(|c| !is_word(c)).map_or(rest.len(), |n| start + n);
        let (before, word) = (&rest[..start], &rest[start..end]);
        escape::push(out, before);
        match links.get(&word.to_lowercase()) {
            Some(href) => push_link(out, href, &escape::text(word)),
            None => escape::push(out, word),
        }
        rest = &rest[end..];
    }
    escape::push(out, rest);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::theme::Theme;

    fn shown(code: &str) -> String {
        let theme = Theme::default();
        let highlighter = Highlighter::new(theme.text(FILE).expect("the syntax is embedded")).unwrap();
        let links = Links::from([("fb_drive".to_owned(), "./d.html".to_owned())]);
        // `[k:IF]` reads better than an element.
        let html = highlighter.highlight(code, &links);
        html.replace("<i class=\"", "[").replace("</i>", "]").replace("\">", ":")
    }

    #[test]
    fn words_of_the_language_are_found_in_any_case() {
        assert_eq!(shown("if a then"), "[k:if] a [k:then]");
        assert_eq!(shown("x : Bool := TRUE;"), "x : [t:Bool] := [k:TRUE];");
        assert_eq!(shown("iffy THENCE"), "iffy THENCE");
    }

    #[test]
    fn literals_are_numbers() {
        for literal in ["T#1h30m", "LTIME#-2.5s", "16#FF", "INT#16#7F", "D#2026-01-31", "TOD#12:30:00", "1.5e-3"] {
            assert_eq!(shown(literal), format!("[n:{literal}]"));
        }
        for literal in ["%IX0.1", "%q*", "%MD4", "E_State#Idle", "2#1010_0011", "BOOL#TRUE"] {
            assert_eq!(shown(literal), format!("[n:{literal}]"));
        }
        assert_eq!(shown("1..5"), "[n:1]..[n:5]");
    }

    #[test]
    fn comments_nest_and_span_lines() {
        assert_eq!(shown("(* a (* b *)\nc *) d"), "[c:(* a (* b *)]\n[c:c *)] d");
        assert_eq!(shown("a // b (* c\nd"), "a [c:// b (* c]\nd");
    }

    #[test]
    fn strings_and_pragmas_end_where_they_should() {
        assert_eq!(shown("'a$'b' c"), "[s:&#39;a$&#39;b&#39;] c");
        assert_eq!(shown("'open\nx"), "[s:&#39;open]\nx");
        assert_eq!(shown("{attribute 'x}y'} z"), "[p:{attribute &#39;x}y&#39;}] z");
    }

    #[test]
    fn declared_names_stand_out_and_known_names_are_linked() {
        assert_eq!(
            shown("FUNCTION_BLOCK ABSTRACT FB_A EXTENDS FB_Drive"),
            "[k:FUNCTION_BLOCK] [k:ABSTRACT] [x:FB_A] [k:EXTENDS] <a href=\"./d.html:FB_Drive</a>"
        );
    }

    #[test]
    fn markup_in_code_stays_text() {
        assert_eq!(shown("'</script>' <b>"), "[s:&#39;&lt;/script&gt;&#39;] &lt;b&gt;");
    }
}
