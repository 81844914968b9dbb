//! What is done to a comment before it is read as Markdown.

use std::ops::Range;

use crate::docs::mapped::{Mapped, trim};

/// `text` without indentation that means nothing, and with a backslash before marks that are none.
pub(super) fn prepare(text: &Mapped) -> Mapped {
    let lines = text.lines();
    if let [line] = lines.as_slice() {
        let mut out = Mapped::beside(text);
        one_line(&mut out, text, trim(text.as_str(), line.clone()));
        return out;
    }
    let mut out = Mapped::beside(text);
    let mut lists = Lists::default();
    let mut fence: Option<String> = None;
    // Whether a line of text stands right above: then `>` is no quotation.
    let mut open_text = false;
    for (i, line) in lines.into_iter().enumerate() {
        if i > 0 {
            out.add("\n");
        }
        let part = &text.as_str()[line.clone()];
        let mark = fence_mark(part);
        if let Some(open) = &fence {
            let cut = indent_end(part, lists.base);
            out.append(text, line.start + cut..line.end);
            if mark.is_some_and(|mark| mark.starts_with(open.as_str()) && part.trim() == mark) {
                fence = None;
            }
            continue;
        }
        let cut = lists.cut(part);
        if let Some(mark) = mark {
            fence = Some(mark.to_owned());
            out.append(text, line.start + cut..line.end);
        } else {
            let quotes = part.trim_start().starts_with('>');
            if quotes && open_text {
                out.add("\\");
                out.append(text, line.start + cut..line.start + cut + 1);
                escape(&mut out, text, line.start + cut + 1..line.end);
            } else {
                escape(&mut out, text, line.start + cut..line.end);
            }
            open_text = !part.trim().is_empty() && (!quotes || open_text);
        }
    }
    out
}

/// A text of one line has no lists, headings and quotations: `- 5 V`, `+ (sign)`, `#1` begin with a sign.
fn one_line(out: &mut Mapped, text: &Mapped, line: Range<usize>) {
    let part = &text.as_str()[line.clone()];
    let digits = part.chars().take_while(char::is_ascii_digit).count();
    let number = digits > 0 && part[digits..].starts_with(['.', ')']);
    let at = if number { line.start + digits } else { line.start };
    let mark = part.starts_with(['-', '+', '#', '>', '=', '|', '~']) || part.starts_with("* ") || part == "*";
    out.append(text, line.start..at);
    if number || mark && !part.starts_with("~~") {
        out.add("\\");
        out.append(text, at..at + 1);
        escape(out, text, at + 1..line.end);
    } else {
        escape(out, text, at..line.end);
    }
}

/// `text` with a backslash before each `<`, so that it holds no HTML.
pub(super) fn without_html(text: &Mapped) -> Mapped {
    let mut out = Mapped::beside(text);
    let mut from = 0;
    for (at, _) in text.as_str().match_indices('<') {
        out.append(text, from..at);
        out.add("\\");
        from = at;
    }
    out.append(text, from..text.as_str().len());
    out
}

/// Which indentation is that of a list.
#[derive(Default)]
struct Lists {
    inside: bool,
    base: usize,
    blank: bool,
}

impl Lists {
    /// How many bytes of indentation to cut off `line`.
    fn cut(&mut self, line: &str) -> usize {
        let indent = width(line);
        let space = line.len() - line.trim_start().len();
        if space == line.len() {
            self.blank = true;
            return space;
        }
        let after_blank = std::mem::take(&mut self.blank);
        if is_item(line.trim_start()) {
            if !self.inside || indent < self.base {
                self.base = indent;
            }
            self.inside = true;
            return indent_end(line, self.base);
        }
        if self.inside && indent <= self.base && after_blank {
            self.inside = false;
        }
        if self.inside {
            // What hangs below an item stays; a lazy line goes on with the item anyway.
            return indent_end(line, self.base);
        }
        self.base = 0;
        space
    }
}

/// Columns of white space, a tab reaching to the next multiple of four.
fn width(line: &str) -> usize {
    let mut columns = 0;
    for c in line.chars() {
        match c {
            ' ' => columns += 1,
            '\t' => columns += 4 - columns % 4,
            _ => break,
        }
    }
    columns
}

/// Where the first `columns` columns of white space end.
fn indent_end(line: &str, columns: usize) -> usize {
    let mut seen = 0;
    for (at, c) in line.char_indices() {
        if seen >= columns {
            return at;
        }
        match c {
            ' ' => seen += 1,
            '\t' => seen += 4 - seen % 4,
            _ => return at,
        }
    }
    line.len()
}

/// Whether the line opens an item of a list.
fn is_item(line: &str) -> bool {
    let bullet = line.starts_with(['-', '*', '+']).then_some(1);
    let digits = line.chars().take_while(char::is_ascii_digit).count();
    let number =
        (1..=9).contains(&digits).then_some(digits).filter(|n| line[*n..].starts_with(['.', ')'])).map(|n| n + 1);
    bullet.or(number).is_some_and(|n| line[n..].is_empty() || line[n..].starts_with([' ', '\t']))
}

fn fence_mark(line: &str) -> Option<&str> {
    let line = line.trim();
    let mark = line.chars().next().filter(|c| matches!(c, '`' | '~'))?;
    let len = line.chars().take_while(|c| *c == mark).count();
    (len >= 3 && !line[len..].contains('`')).then(|| &line[..len])
}

/// Appends a line, with a backslash before what only looks like a mark.
fn escape(out: &mut Mapped, text: &Mapped, line: Range<usize>) {
    let part = &text.as_str()[line.clone()];
    let mut from = 0;
    let mut code = false;
    let mut before = None;
    let mut skip = 0;
    for (at, c) in part.char_indices() {
        let after = part[at + c.len_utf8()..].chars().next();
        if c == '`' {
            code = !code;
        }
        if at < skip {
            continue;
        }
        if !code
            && c == 'h'
            && opens_address(&part[..at])
            && let Some(len) = address(&part[at..])
        {
            out.append(text, line.start + from..line.start + at);
            out.add("<");
            out.append(text, line.start + at..line.start + at + len);
            out.add(">");
            (from, skip) = (at + len, at + len);
            continue;
        }
        if !code && is_literal(before, c, after, part[..at].trim().is_empty()) {
            out.append(text, line.start + from..line.start + at);
            out.add("\\");
            from = at;
        }
        before = Some(c);
    }
    out.append(text, line.start + from..line.end);
}

/// Whether a bare address may begin behind `before`: no link of Markdown is open there.
fn opens_address(before: &str) -> bool {
    let space = before.is_empty() || before.ends_with(char::is_whitespace);
    let definition = before.trim_start().starts_with('[') && before.trim_end().ends_with("]:");
    (space || before.ends_with('(') && !before.ends_with("](") || before.ends_with(':')) && !definition
}

/// The length of the address that `text` begins with.
fn address(text: &str) -> Option<usize> {
    let rest = text.strip_prefix("https://").or_else(|| text.strip_prefix("http://"))?;
    let end = rest.find(|c: char| c.is_whitespace() || matches!(c, '<' | '>' | '"' | '`' | '|')).unwrap_or(rest.len());
    let mut kept = rest[..end].trim_end_matches(['.', ',', ';', ':', '!', '?', '\'']);
    if kept.ends_with(')') && !kept.contains('(') {
        kept = kept.trim_end_matches(')');
    }
    (!kept.is_empty()).then(|| text.len() - rest.len() + kept.len())
}

/// Whether `c` is itself here and no mark of Markdown.
fn is_literal(before: Option<char>, c: char, after: Option<char>, first: bool) -> bool {
    let word = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | ')' | '(' | ']'));
    match c {
        // A product.
        '*' => before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | ')' | ']')) && word(after),
        // A comparison at the beginning of a line.
        '>' => first && after.is_some_and(|c| c == '=' || c.is_ascii_digit()),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::FileId;

    fn prepared(text: &str) -> String {
        let mut mapped = Mapped::new(FileId(0));
        mapped.push(text, 0);
        prepare(&mapped).as_str().to_owned()
    }

    #[test]
    fn indentation_is_no_code() {
        assert_eq!(prepared("Brief\n\n\t\tDetail\n      more"), "Brief\n\nDetail\nmore");
    }

    #[test]
    fn lists_keep_their_shape() {
        assert_eq!(prepared("    - a\n      - b\n\n        more\n\nend"), "- a\n  - b\n\n    more\n\nend");
    }

    #[test]
    fn a_fence_keeps_its_indentation() {
        assert_eq!(prepared("```\n    x := 1;\n```\n    y"), "```\n    x := 1;\n```\ny");
    }

    #[test]
    fn a_quotation_stands_apart() {
        assert_eq!(prepared("> quoted\n> too"), "> quoted\n> too");
        assert_eq!(prepared("  < becomes a\n  > becomes b"), "< becomes a\n\\> becomes b");
    }

    #[test]
    fn a_product_is_no_emphasis() {
        assert_eq!(prepared("a*b*c and *this*"), "a\\*b\\*c and *this*");
    }
}
