//! Findings the way rustc prints them: code, place, source line, help.

use std::io::IsTerminal;

use annotate_snippets::renderer::DecorStyle;
use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use crate::cli::print;
use crate::diagnostic::{Finding, Severity};
use crate::text::{Files, Place, Span};

/// Lines longer than this (in bytes) are shown as a place only.
const LONG_LINE: usize = 400;

/// Prints findings, in colour on a terminal.
pub(crate) fn findings<'a>(findings: impl Iterator<Item = &'a Finding>, files: &Files) {
    let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    let reporter = Reporter::new(colour);
    let mut out = String::new();
    for finding in findings {
        out.push_str(&reporter.render(finding, files));
        out.push_str("\n\n");
        if out.len() > 1 << 16 {
            print(&out);
            out.clear();
        }
    }
    print(&out);
}

/// How many findings there are, in a line; `count` counts those of a severity.
pub(crate) fn counts(count: impl Fn(Severity) -> usize) -> String {
    let [errors, warnings, infos] = [Severity::Error, Severity::Warning, Severity::Info].map(count);
    format!("{errors} errors, {warnings} warnings, {infos} infos; `rungbook explain CODE` tells what one means\n")
}

/// Renders findings.
pub(crate) struct Reporter {
    renderer: Renderer,
}

impl Reporter {
    /// With colours or without.
    pub(crate) fn new(colour: bool) -> Self {
        let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
        Self { renderer: renderer.decor_style(DecorStyle::Ascii) }
    }

    /// One finding.
    pub(crate) fn render(&self, finding: &Finding, files: &Files) -> String {
        let title = level(finding.severity).primary_title(finding.message.as_str()).id(finding.code.name);
        let mut group = match window(finding.place, files) {
            Some(window) => title.element(window.snippet(AnnotationKind::Primary, "")),
            None => title.element(annotate_snippets::Origin::path(origin(finding.place, files))),
        };
        for label in &finding.labels {
            if let Some(window) = window(label.place, files) {
                group = group.element(window.snippet(AnnotationKind::Context, &label.message));
            }
        }
        let help = finding.help.iter().map(|text| Group::with_title(Level::HELP.secondary_title(text.as_str())));
        let groups: Vec<Group<'_>> = std::iter::once(group).chain(help).collect();
        self.renderer.render(&groups)
    }
}

fn level(severity: Severity) -> Level<'static> {
    match severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Info => Level::INFO,
    }
}

fn origin(place: Place, files: &Files) -> String {
    let at = files.line_column(place);
    format!("{}:{}:{}", files.get(place.file).path, at.line, at.column)
}

/// The lines around a place: findings quote these, not whole files.
struct Window<'a> {
    path: &'a str,
    text: &'a str,
    line: usize,
    span: Span,
}

impl<'a> Window<'a> {
    fn snippet(&self, kind: AnnotationKind, label: &'a str) -> Snippet<'a, annotate_snippets::Annotation<'a>> {
        let mut annotation = kind.span(self.span.range());
        if !label.is_empty() {
            annotation = annotation.label(label);
        }
        Snippet::source(self.text).line_start(self.line).path(self.path).annotation(annotation)
    }
}

/// `None` where there is no text to quote.
fn window(place: Place, files: &Files) -> Option<Window<'_>> {
    let file = files.get(place.file);
    if file.text.is_empty() {
        return None;
    }
    let line = file.lines.line(place.span.start);
    let start = file.lines.line_start(line) as usize;
    let rest = file.text.get(start..)?;
    let end = rest.find(['\n', '\r']).map_or(file.text.len(), |at| start + at);
    let text = file.text.get(start..end)?;
    if text.len() > LONG_LINE {
        return None;
    }
    let from = (place.span.start as usize).clamp(start, end) - start;
    let to = (place.span.end as usize).clamp(start + from, end) - start;
    let span = Span::from(from..to.max(from));
    Some(Window { path: &file.path, text, line: line as usize, span })
}
