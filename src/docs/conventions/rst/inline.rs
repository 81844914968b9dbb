//! Roles and references of reStructuredText as Markdown.

use std::ops::Range;

use crate::docs::mapped::Mapped;

/// Whether a role such as `` :ref:`X` `` is in `text`.
pub(super) fn has_role(text: &str) -> bool {
    text.match_indices(":`").any(|(at, _)| role_start(text, at).is_some())
}

/// `text` with roles, references and targets as Markdown.
pub(super) fn markdown(text: &Mapped) -> Mapped {
    let source = text.as_str();
    let mut out = Mapped::beside(text);
    let mut from = 0;
    let mut at = 0;
    while let Some(open) = source[at..].find('`').map(|found| at + found) {
        if source[open..].starts_with("``") {
            // Code is the same in both.
            let len = source[open..].chars().take_while(|c| *c == '`').count();
            let mark = &source[open..open + len];
            at = source[open + len..].find(mark).map_or(source.len(), |end| open + len + end + len);
            continue;
        }
        let Some(close) = source[open + 1..].find(['`', '\n']).map(|end| open + 1 + end) else { break };
        if !source[close..].starts_with('`') || close == open + 1 {
            at = close;
            continue;
        }
        let role = (open > 0).then(|| role_start(source, open - 1)).flatten();
        let reference = source[close + 1..].starts_with('_');
        if role.is_none() && !reference {
            at = close + 1;
            continue;
        }
        out.append(text, from..role.unwrap_or(open));
        add_reference(&mut out, text, open + 1..close, role.is_some());
        at = close + 1 + source[close + 1..].chars().take_while(|c| *c == '_').count();
        from = at;
    }
    out.append(text, from..source.len());
    out
}

/// Where the role that ends with the colon at `colon` begins: `:name` or `:domain:name`.
fn role_start(text: &str, colon: usize) -> Option<usize> {
    let head = text[..colon + 1].strip_suffix(':')?;
    let start = head
        .rfind(|c: char| !(c.is_ascii_alphanumeric() || matches!(c, ':' | '_' | '-')))
        .map_or(0, |at| at + head[at..].chars().next().map_or(1, char::len_utf8));
    (head[start..].starts_with(':') && head.len() > start + 1).then_some(start)
}

/// `text <target>` or a name alone.
fn add_reference(out: &mut Mapped, text: &Mapped, range: Range<usize>, role: bool) {
    let inner = &text.as_str()[range.clone()];
    let target = inner.rfind('<').filter(|_| inner.ends_with('>'));
    match target {
        Some(at) => {
            out.add("[");
            out.append(text, range.start..range.start + inner[..at].trim_end().len());
            out.add("](");
            out.append(text, range.start + at..range.end);
            out.add(")");
        }
        None if role => {
            out.add("[`");
            out.append(text, range);
            out.add("`]");
        }
        None => out.append(text, range),
    }
}
