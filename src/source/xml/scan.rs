//! Splits XML into tags and what stands between them; whatever is no tag is text.

use super::Problem;
use crate::text::Span;

/// One piece of an XML text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Token {
    /// `<name …>`, with its attributes; `empty` for `<name …/>`.
    Open { name: Span, attributes: (u32, u32), empty: bool, span: Span },
    /// `</name>`.
    Close { name: Span, span: Span },
    /// Character data that is neither markup nor a CDATA section.
    Text(Span),
    /// A CDATA section: all of it, and what it holds.
    Cdata(Span, Span),
    /// A comment, a processing instruction, a document type.
    Other(Span),
}

/// An attribute: its name, and its value without the quotes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct RawAttribute {
    pub(super) name: Span,
    pub(super) value: Span,
}

/// The scanner; an iterator over [`Token`]s that collects attributes and problems beside.
pub(super) struct Scanner<'t> {
    text: &'t str,
    at: usize,
    end: usize,
    pub(super) attributes: Vec<RawAttribute>,
    pub(super) problems: Vec<Problem>,
    /// The last search for the end of a CDATA section: from where, and what it found.
    cdata_end: Option<(usize, Option<usize>)>,
}

impl<'t> Scanner<'t> {
    pub(super) fn new(text: &'t str, span: Span) -> Self {
        let range = span.range();
        let end = range.end.min(text.len());
        Self { text, at: range.start, end, attributes: Vec::new(), problems: Vec::new(), cdata_end: None }
    }

    /// Goes on at `at`.
    pub(super) fn seek(&mut self, at: u32) {
        self.at = at as usize;
    }

    fn rest(&self) -> &'t str {
        &self.text[self.at..self.end]
    }

    fn problem(&mut self, span: Span, message: impl Into<String>) {
        Problem::add(&mut self.problems, span, message);
    }

    /// Everything up to and with `close`; without one, everything up to the end, and a problem.
    fn until(&mut self, start: usize, open: usize, close: &str, what: &str) -> (Span, Span) {
        let inner = start + open;
        let found = if close == "]]>" { self.end_of_cdata(inner) } else { self.offset_of(inner, close) };
        let (inner_end, end) = match found {
            Some(found) => (found, found + close.len()),
            None => {
                self.problem(Span::from(start..inner), format!("the {what} is not closed"));
                (self.end, self.end)
            }
        };
        self.at = end;
        (Span::from(start..end), Span::from(inner..inner_end))
    }

    fn offset_of(&self, from: usize, what: &str) -> Option<usize> {
        self.text[from..self.end].find(what).map(|found| from + found)
    }

    /// The next `]]>`. Remembered, because sections that are not closed are searched again and again.
    fn end_of_cdata(&mut self, from: usize) -> Option<usize> {
        if let Some((searched, found)) = self.cdata_end
            && searched <= from
            && found.is_none_or(|found| from <= found)
        {
            return found;
        }
        let found = self.offset_of(from, "]]>");
        self.cdata_end = Some((from, found));
        found
    }

    fn text_up_to_the_next_tag(&mut self) -> Token {
        let start = self.at;
        // A `<` that opens nothing is text, so the search starts behind it.
        let skip = usize::from(self.rest().starts_with('<'));
        let length = self.text[start + skip..self.end].find('<').map_or(self.end - start, |found| found + skip);
        self.at = start + length;
        let span = Span::from(start..self.at);
        self.check_references(span);
        Token::Text(span)
    }

    /// A problem for each `&` that begins no entity of XML itself.
    pub(super) fn check_references(&mut self, span: Span) {
        let text = span.of(self.text);
        for (at, _) in text.match_indices('&') {
            if self.problems.len() >= super::MAX_PROBLEMS {
                return;
            }
            if super::text::reference(&text[at..]).is_none() {
                let here = span.start + u32::try_from(at).unwrap_or(0);
                self.problem(Span::new(here, here + 1), "`&` begins no character of XML; it is kept as it stands");
            }
        }
    }

    fn close_tag(&mut self) -> Option<Token> {
        let start = self.at;
        let name_end = name_end(&self.text[..self.end], start + 2);
        let after = skip_space(&self.text[..self.end], name_end);
        if name_end == start + 2 || self.text.as_bytes().get(after) != Some(&b'>') || after >= self.end {
            return None;
        }
        self.at = after + 1;
        Some(Token::Close { name: Span::from(start + 2..name_end), span: Span::from(start..self.at) })
    }

    fn open_tag(&mut self) -> Option<Token> {
        let (start, text) = (self.at, &self.text[..self.end]);
        let bytes = text.as_bytes();
        let name_end = name_end(text, start + 1);
        if name_end == start + 1 {
            return None;
        }
        let first = self.attributes.len();
        let mut at = name_end;
        let empty = loop {
            let next = skip_space(text, at);
            match bytes.get(next) {
                Some(b'>') => {
                    at = next + 1;
                    break false;
                }
                Some(b'/') if bytes.get(next + 1) == Some(&b'>') => {
                    at = next + 2;
                    break true;
                }
                _ => {}
            }
            match attribute(text, next) {
                Some((attribute, end)) if next > at => {
                    self.attributes.push(attribute);
                    at = end;
                }
                _ => {
                    self.attributes.truncate(first);
                    return None;
                }
            }
        };
        self.at = at;
        for i in first..self.attributes.len() {
            self.check_references(self.attributes[i].value);
        }
        let attributes = (index(first), index(self.attributes.len()));
        Some(Token::Open { name: Span::from(start + 1..name_end), attributes, empty, span: Span::from(start..at) })
    }

    /// `<!DOCTYPE … [ … ]>`, skipped as a whole.
    fn doctype(&mut self) -> Token {
        let start = self.at;
        let (mut depth, mut quote, mut end) = (0_u32, None, self.end);
        for (i, byte) in self.rest().bytes().enumerate() {
            match (quote, byte) {
                (Some(open), _) if open == byte => quote = None,
                (Some(_), _) => {}
                (None, b'"' | b'\'') => quote = Some(byte),
                (None, b'[') => depth += 1,
                (None, b']') => depth = depth.saturating_sub(1),
                (None, b'>') if depth == 0 => {
                    end = start + i + 1;
                    break;
                }
                (None, _) => {}
            }
        }
        self.at = end;
        let span = Span::from(start..end);
        let message = "the file declares a document type, whose entities are not expanded".to_owned();
        self.problems.push(Problem { span, message, doctype: true });
        Token::Other(span)
    }
}

impl Iterator for Scanner<'_> {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        let start = self.at;
        if start >= self.end {
            return None;
        }
        let rest = self.rest();
        let token = match rest.as_bytes() {
            [b'<', b'!', b'[', ..] if rest.starts_with("<![CDATA[") => {
                let (span, inner) = self.until(start, 9, "]]>", "CDATA section");
                Some(Token::Cdata(span, inner))
            }
            [b'<', b'!', b'-', b'-', ..] => Some(Token::Other(self.until(start, 4, "-->", "comment").0)),
            [b'<', b'!', ..] if rest.starts_with("<!DOCTYPE") => Some(self.doctype()),
            [b'<', b'?', ..] => Some(Token::Other(self.until(start, 2, "?>", "processing instruction").0)),
            [b'<', b'/', ..] => self.close_tag(),
            [b'<', ..] => self.open_tag(),
            _ => return Some(self.text_up_to_the_next_tag()),
        };
        Some(token.unwrap_or_else(|| {
            self.problem(Span::from(start..start + 1), "`<` begins no tag; it is kept as text");
            self.text_up_to_the_next_tag()
        }))
    }
}

fn attribute(text: &str, at: usize) -> Option<(RawAttribute, usize)> {
    let bytes = text.as_bytes();
    let end = name_end(text, at);
    let equals = skip_space(text, end);
    if end == at || bytes.get(equals) != Some(&b'=') {
        return None;
    }
    let open = skip_space(text, equals + 1);
    let quote = *bytes.get(open).filter(|byte| matches!(byte, b'"' | b'\''))?;
    let value = open + 1;
    let length = text[value..].find(char::from(quote))?;
    let close = value + length;
    // A `<` in a value means that its quote is missing, and what follows is another tag.
    if text[value..close].contains('<') {
        return None;
    }
    Some((RawAttribute { name: Span::from(at..end), value: Span::from(value..close) }, close + 1))
}

/// Where the name that begins at `at` ends; `at` itself if there is none.
fn name_end(text: &str, at: usize) -> usize {
    let Some(rest) = text.get(at..) else { return at };
    let starts = rest.starts_with(|c: char| c.is_alphabetic() || c == '_' || c == ':');
    if !starts {
        return at;
    }
    let inner = |c: char| c.is_alphanumeric() || matches!(c, '_' | ':' | '-' | '.' | '\u{B7}');
    at + rest.find(|c| !inner(c)).unwrap_or(rest.len())
}

fn skip_space(text: &str, at: usize) -> usize {
    let Some(rest) = text.get(at..) else { return at };
    at + rest.find(|c| !matches!(c, ' ' | '\t' | '\r' | '\n')).unwrap_or(rest.len())
}

pub(super) fn index(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}
