//! XHTML as PLCopen XML embeds it: code as text, documentation as Markdown.

use crate::source::fragment::FragmentBuilder;
use crate::source::xml::{Element, Mixed};
use crate::text::{Fragment, Span};

/// The code inside `element`: its text, with a line for each paragraph.
pub(super) fn code(element: Element<'_>) -> Fragment {
    let mut out = FragmentBuilder::new();
    lines(element, &mut out);
    out.finish(element.content().start)
}

fn lines(element: Element<'_>, out: &mut FragmentBuilder) {
    for piece in element.mixed() {
        match piece {
            Mixed::Text(text) => {
                out.fragment(&text);
            }
            Mixed::Element(child) => {
                lines(child, out);
                if matches!(child.name(), "p" | "div" | "br" | "li") && !out.is_empty() {
                    out.standing_for("\n", child.name_span());
                }
            }
        }
    }
}

/// The documentation inside `element` or its `xhtml`, without white space around it; `None` where it is blank.
pub(super) fn markdown(element: Element<'_>) -> Option<Fragment> {
    let element = element.child("xhtml").unwrap_or(element);
    let mut out = FragmentBuilder::new();
    blocks(element, &mut out);
    let fragment = out.finish(element.content().start);
    let start = fragment.text.len() - fragment.text.trim_start().len();
    let end = fragment.text.trim_end().len();
    let mut trimmed = FragmentBuilder::new();
    trimmed.piece(&fragment, start, end);
    (start < end).then(|| trimmed.finish(element.content().start))
}

fn blocks(element: Element<'_>, out: &mut FragmentBuilder) {
    for piece in element.mixed() {
        match piece {
            Mixed::Text(text) => {
                out.fragment(&text);
            }
            Mixed::Element(child) => block(child, out),
        }
    }
}

fn block(child: Element<'_>, out: &mut FragmentBuilder) {
    let (breaks, before, after) = match child.name() {
        "p" | "div" | "ul" | "ol" | "table" => (2, "", ""),
        "br" => (1, "", ""),
        "li" => (1, "- ", ""),
        "h1" | "h2" | "h3" | "h4" | "h5" | "h6" => (2, "## ", ""),
        "pre" => (2, "```\n", "\n```"),
        "b" | "strong" => (0, "**", "**"),
        "i" | "em" => (0, "*", "*"),
        "code" | "tt" => (0, "`", "`"),
        _ => (0, "", ""),
    };
    let span = child.name_span();
    line_breaks(breaks, span, out);
    out.standing_for(before, span);
    blocks(child, out);
    out.standing_for(after, span);
    if breaks == 2 {
        line_breaks(2, span, out);
    }
}

/// Adds as many line ends as are missing to `wanted`; none at the beginning.
fn line_breaks(wanted: usize, span: Span, out: &mut FragmentBuilder) {
    for _ in out.trailing_line_ends()..wanted {
        if !out.is_empty() {
            out.standing_for("\n", span);
        }
    }
}
