//! reStructuredText, as far as CODESYS LibDoc and plcdoc use it.
//!
//! Field lists become tags (`:return: text`; plcdoc writes `:var_in BOOL bExecute: text`), directives
//! notes and code blocks, roles and references links, adorned titles headings; the rest is near
//! enough to Markdown to be read as that. Comments (`.. text`) are left out, as Sphinx does.

mod inline;

use std::ops::Range;

use super::draft::{Draft, Part};
use super::tag_names::{Slot, slot};
use crate::docs::mapped::{Mapped, trim};

/// Fields that describe a parameter; the last word before the colon is its name.
const PARAMS: [(&str, &str); 16] = [
    ("var_in", "in"),
    ("var_input", "in"),
    ("var_out", "out"),
    ("var_output", "out"),
    ("var_inout", "in,out"),
    ("var_in_out", "in,out"),
    ("var", ""),
    ("param", ""),
    ("parameter", ""),
    ("arg", ""),
    ("argument", ""),
    ("in", "in"),
    ("input", "in"),
    ("out", "out"),
    ("output", "out"),
    ("inout", "in,out"),
];

/// Whether a field of plcdoc's kind is in `text`.
pub(super) fn has_typed_fields(text: &str) -> bool {
    text.lines().any(|line| field(line).is_some_and(|field| field.name.starts_with("var")))
}

/// Whether `text` has a field list, a directive or a role.
pub(super) fn is_used(text: &str) -> bool {
    let known = |field: Field<'_>| slot(field.name).is_some() || PARAMS.iter().any(|(name, _)| *name == field.name);
    text.lines().any(|line| directive(line).is_some() || field(line).is_some_and(known)) || inline::has_role(text)
}

/// Reads `text` into `draft`.
pub(super) fn read(text: &Mapped, draft: &mut Draft) {
    let text = &inline::markdown(text);
    let lines = text.lines();
    let mut prose = Mapped::beside(text);
    let mut i = 0;
    while i < lines.len() {
        let line = &text.as_str()[lines[i].clone()];
        if let Some(found) = directive(line) {
            flush(&mut prose, draft);
            i = read_directive(text, &lines, i, &found, draft);
        } else if let Some(found) = field(line) {
            flush(&mut prose, draft);
            i = read_field(text, &lines, i, &found, draft);
        } else if line.trim_start().starts_with(".. ") || line.trim() == ".." {
            i = block_end(text, &lines, i);
        } else if line.trim_end().ends_with("::") && block_end(text, &lines, i) > i + 1 {
            let kept = line.trim_end().len() - 1 - usize::from(line.trim() == "::");
            add_line(&mut prose, text, lines[i].start..lines[i].start + kept);
            let end = block_end(text, &lines, i);
            add_code(&mut prose, text, &lines[i + 1..end], "");
            i = end;
        } else if let Some(level) = lines.get(i + 1).and_then(|next| adornment(text, &lines[i], next)) {
            prose.add(if level == 1 { "\n\n# " } else { "\n\n## " });
            prose.append(text, trim(text.as_str(), lines[i].clone()));
            prose.add("\n\n");
            i += 2;
        } else {
            add_line(&mut prose, text, lines[i].clone());
            i += 1;
        }
    }
    flush(&mut prose, draft);
}

fn flush(prose: &mut Mapped, draft: &mut Draft) {
    let empty = Mapped::beside(prose);
    draft.body(std::mem::replace(prose, empty));
}

fn add_line(out: &mut Mapped, text: &Mapped, range: Range<usize>) {
    if !out.as_str().is_empty() {
        out.add("\n");
    }
    out.append(text, range);
}

/// `:name argument: text`
struct Field<'a> {
    name: &'a str,
    argument: &'a str,
    /// Offset of the text in the line.
    rest: usize,
}

fn field(line: &str) -> Option<Field<'_>> {
    let inner = line.trim_start().strip_prefix(':')?;
    let (head, rest) = inner.split_once(':')?;
    let spaced = rest.is_empty() || rest.starts_with([' ', '\t']);
    let (name, argument) = head.split_once(' ').unwrap_or((head, ""));
    let word = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphabetic() || c == '_' || c == '-');
    (spaced && word).then(|| Field { name, argument, rest: line.len() - rest.len() })
}

/// `.. name:: argument`
struct Directive<'a> {
    name: &'a str,
    /// Offset of the argument in the line.
    argument: usize,
}

fn directive(line: &str) -> Option<Directive<'_>> {
    let inner = line.trim_start().strip_prefix(".. ")?.trim_start();
    let (name, rest) = inner.split_once("::")?;
    let word = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | ':'));
    word.then(|| Directive { name, argument: line.len() - rest.len() })
}

fn indent(text: &Mapped, line: &Range<usize>) -> usize {
    let part = &text.as_str()[line.clone()];
    part.len() - part.trim_start().len()
}

/// The line after the block that is indented below line `i`.
fn block_end(text: &Mapped, lines: &[Range<usize>], i: usize) -> usize {
    let own = indent(text, &lines[i]);
    let blank = |line: &Range<usize>| text.as_str()[line.clone()].trim().is_empty();
    let mut end = i + 1;
    for (j, line) in lines.iter().enumerate().skip(i + 1) {
        if !blank(line) {
            if indent(text, line) <= own {
                break;
            }
            end = j + 1;
        }
    }
    end
}

/// The argument and the block below it as one text.
fn content(text: &Mapped, first: Range<usize>, rest: &[Range<usize>]) -> Mapped {
    let mut out = text.trimmed(first);
    for line in rest {
        add_line(&mut out, text, line.clone());
    }
    out
}

fn read_field(text: &Mapped, lines: &[Range<usize>], i: usize, field: &Field<'_>, draft: &mut Draft) -> usize {
    let end = block_end(text, lines, i);
    let body = content(text, lines[i].start + field.rest..lines[i].end, &lines[i + 1..end]);
    let lower = field.name.to_ascii_lowercase();
    if let Some((_, direction)) = PARAMS.iter().find(|(name, _)| *name == lower) {
        let argument = field.argument.trim();
        let name = argument.rsplit([' ', '\t']).next().unwrap_or("").trim_matches('`');
        let line = &text.as_str()[lines[i].clone()];
        let at = lines[i].start + line[..field.rest].rfind(name).unwrap_or(0);
        let note = if direction.is_empty() { argument[..argument.len() - name.len()].trim() } else { direction };
        draft.param(&text.slice(at..at + name.len()), note, &body);
    } else if let Some(found) = slot(&lower) {
        draft.put(&found, body);
    } else if !body.is_blank() {
        draft.fact(field.name, &body);
    }
    end
}

fn read_directive(text: &Mapped, lines: &[Range<usize>], i: usize, found: &Directive<'_>, draft: &mut Draft) -> usize {
    let end = block_end(text, lines, i);
    let argument = trim(text.as_str(), lines[i].start + found.argument..lines[i].end);
    let is_option = |line: &&Range<usize>| field(&text.as_str()[(*line).clone()]).is_some();
    let options = lines[i + 1..end].iter().take_while(is_option).count();
    let block = &lines[i + 1 + options..end];
    match found.name {
        "code" | "code-block" | "sourcecode" | "literalinclude" | "parsed-literal" | "math" | "table" | "csv-table"
        | "list-table" => {
            let mut code = Mapped::beside(text);
            let language = text.as_str()[argument].trim().to_lowercase();
            let is_code = matches!(found.name, "code" | "code-block" | "sourcecode");
            add_code(&mut code, text, block, if is_code { &language } else { "" });
            draft.body(code);
        }
        "image" | "figure" => {
            let mut image = Mapped::beside(text);
            image.add("![](<");
            image.append(text, argument);
            image.add(">)");
            draft.body(image);
            draft.body(content(text, lines[i].end..lines[i].end, block));
        }
        "rubric" | "topic" | "admonition" => {
            let title = text.as_str()[argument].to_owned();
            let body = content(text, lines[i].end..lines[i].end, block);
            draft.parts.push(Part::Note { style: "remark", title, text: body });
        }
        name => {
            let body = content(text, argument, block);
            match slot(name).unwrap_or(Slot::Body) {
                Slot::Param { .. } => draft.put(&Slot::Body, body),
                found => draft.put(&found, body),
            }
        }
    }
    end
}

/// Adds a fence with the lines, less the indentation that they share.
fn add_code(out: &mut Mapped, text: &Mapped, lines: &[Range<usize>], language: &str) {
    let blank = |line: &&Range<usize>| text.as_str()[(*line).clone()].trim().is_empty();
    let first = lines.iter().take_while(blank).count();
    let shared = lines.iter().filter(|line| !blank(line)).map(|line| indent(text, line)).min().unwrap_or(0);
    out.add("\n\n````");
    out.add(language);
    for line in &lines[first..] {
        out.add("\n");
        out.append(text, line.start + shared.min(line.len())..line.end);
    }
    out.add("\n````\n\n");
}

/// The level of a title on `line` that `next` underlines.
fn adornment(text: &Mapped, line: &Range<usize>, next: &Range<usize>) -> Option<u8> {
    let title = text.as_str()[line.clone()].trim();
    let under = text.as_str()[next.clone()].trim();
    let mark = under.chars().next().filter(|c| "=-~^\"+*#".contains(*c))?;
    let long = under.chars().count() >= title.chars().count().max(3);
    (!title.is_empty() && long && under.chars().all(|c| c == mark)).then_some(if mark == '=' { 1 } else { 2 })
}
