//! CODESYS objects as text files, as export scripts write them: `.pou .dut .gvl .itf` and more.
//!
//! Some scripts divide a file by comments such as `(*#-#-…---Declaration---…#-#*)` and
//! `(*#-#-…---Implementation---…#-#*)`; files without such comments are Structured Text as a whole.

use super::keyword::leading;
use super::plain::whole_text;
use super::{Claim, Format, Input, Setting, Unwrapped};
use crate::text::{Body, Fragment, Object, ObjectKind, Span, Vendor};

/// CODESYS objects as text.
#[derive(Debug)]
pub(super) struct CodesysText;

impl Format for CodesysText {
    fn name(&self) -> &'static str {
        "CODESYS text"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["pou", "dut", "gvl", "itf", "prg", "fun", "fb", "var", "typ"]
    }

    fn claims(&self, input: &Input<'_>) -> Claim {
        if input.setting == Setting::BAndR || input.head().trim_start().starts_with('<') {
            return Claim::No;
        }
        let divided = divisions(input.text).next().is_some();
        if divided || leading(input.text).is_some() { Claim::Likely } else { Claim::No }
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        let object = divided(input.text).unwrap_or_else(|| whole_text(input));
        Unwrapped { objects: vec![object], vendor: Vendor::Codesys, ..Unwrapped::default() }
    }
}

/// The comments that divide `text`: what each announces, and where it stands with its line end.
fn divisions(text: &str) -> impl Iterator<Item = (&str, Span)> {
    text.match_indices("(*#-#-").filter_map(move |(start, _)| {
        let rest = &text[start..];
        // Such a comment is one short line.
        let line = &rest[..rest.floor_char_boundary(200)];
        let comment = &rest[..line.find("#*)")? + 3];
        let what = comment.split("---").nth(1)?;
        let after = &rest[comment.len()..];
        let line_end = if after.starts_with("\r\n") { 2 } else { usize::from(after.starts_with('\n')) };
        Some((what, Span::from(start..start + comment.len() + line_end)))
    })
}

fn divided(text: &str) -> Option<Object> {
    let marks: Vec<_> = divisions(text).collect();
    let part = |what: &str| -> Option<Fragment> {
        let found = marks.iter().position(|(name, _)| *name == what)?;
        let end = marks.get(found + 1).map_or(text.len(), |(_, span)| span.start as usize);
        let span = Span::from(marks[found].1.end as usize..end);
        Some(Fragment::verbatim(span.of(text), span.start))
    };
    let declaration = part("Declaration")?;
    let start = declaration.map.offset(0);
    let (kind, name) = leading(&declaration.text).map_or((ObjectKind::Text, None), |found| (found.kind, found.name));
    let (name, span) = name.map_or((None, Span::at(start)), |(name, span)| (Some(name), span.shifted(start)));
    let mut object = Object::new(kind, name, span);
    object.declaration = Some(declaration);
    object.body = part("Implementation").map_or(Body::None, Body::St);
    Some(object)
}
