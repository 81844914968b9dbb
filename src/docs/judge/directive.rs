//! Instructions to tools, which keep their data in comments.
//!
//! CODESYS V2.3 writes `@KEY@:…` and `@OBJECTFLAGS := …` into its exports, Automation Studio `#CMD#;`
//! into columns that it hides, and generators mark their regions with `<Name>` and `</Name>`.

/// Whether `text` is nothing but such an instruction.
pub(in crate::docs) fn is_directive(text: &str) -> bool {
    let text = text.trim();
    text.starts_with("@KEY@") || is_flag(text) || is_command(text) || is_region(text)
}

/// `@NAME := …`, `$NAME=…`
fn is_flag(text: &str) -> bool {
    let flag = text.strip_prefix('@').and_then(|rest| rest.split_once(":="));
    let column = text.strip_prefix('$').and_then(|rest| rest.split_once('='));
    let name = flag.or(column).map_or("", |(name, _)| name.trim());
    !name.is_empty() && name.chars().all(|c| c.is_ascii_uppercase() || c == '_')
}

/// `#NAME#;`, also several.
fn is_command(text: &str) -> bool {
    let command = |part: &str| {
        let name = part.trim().strip_prefix('#').and_then(|rest| rest.strip_suffix('#')).unwrap_or("");
        !name.is_empty() && name.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_')
    };
    let mut parts = text.split(';').filter(|part| !part.trim().is_empty()).peekable();
    parts.peek().is_some() && parts.all(command)
}

/// One tag of an element on a line of its own, and nothing else.
fn is_region(text: &str) -> bool {
    let inner = text.strip_prefix('<').and_then(|rest| rest.strip_suffix('>'));
    let name = inner.map_or("", |inner| inner.trim_matches('/'));
    let word = |name: &str| name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '.' | '-'));
    !name.is_empty() && word(name) && (text.starts_with("</") || name.chars().filter(|c| c.is_uppercase()).count() > 1)
}

#[cfg(test)]
mod tests {
    use super::is_directive;

    #[test]
    fn data_of_tools_is_told_from_prose() {
        for text in [
            "@KEY@:DESCRIPTION",
            "@OBJECTFLAGS := '0, 8'",
            "#CMD#;",
            "#PAR#; #OMIT#;",
            "$GROUP=Pumps,$CAT=All",
            "</DataRegion>",
            "<DataRegion>",
        ] {
            assert!(is_directive(text), "{text}");
        }
        for text in ["#1", "@param x", "<Description>", "<0.5 mm>", "C#", "# #"] {
            assert!(!is_directive(text), "{text}");
        }
    }
}
