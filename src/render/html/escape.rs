//! Text to HTML and to script, so that it stays text.

/// Appends `text`, escaped for element content and quoted attributes alike. Control characters that HTML does not
/// admit become U+FFFD.
pub(super) fn push(out: &mut String, text: &str) {
    let mut plain_from = 0;
    for (at, byte) in text.bytes().enumerate() {
        let entity = match byte {
            b'&' => "&amp;",
            b'<' => "&lt;",
            b'>' => "&gt;",
            b'"' => "&quot;",
            b'\'' => "&#39;",
            b'\r' => "",
            b'\t' | b'\n' | 0x20..=0x7e | 0x80.. => continue,
            _ => "\u{fffd}",
        };
        out.push_str(&text[plain_from..at]);
        out.push_str(entity);
        plain_from = at + 1;
    }
    out.push_str(&text[plain_from..]);
}

/// `text`, escaped as [`push`] does.
pub(super) fn text(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + text.len() / 8);
    push(&mut out, text);
    out
}

/// A JSON string that is also a JavaScript string, safe inside a `<script>` element: no `<`, no line separator.
pub(super) fn script_string(text: &str) -> String {
    let json = serde_json::Value::from(text).to_string();
    json.replace('<', "\\u003c").replace('\u{2028}', "\\u2028").replace('\u{2029}', "\\u2029")
}

/// Whether `url` is an address elsewhere that a page may link to.
pub(super) fn is_external(url: &str) -> bool {
    let lower = url.get(..8).unwrap_or(url).to_ascii_lowercase();
    ["https://", "http://", "mailto:"].iter().any(|scheme| lower.starts_with(scheme))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_means_markup_is_left() {
        assert_eq!(text("a<b>&\"'\r\u{1}\u{7f}ü\n"), "a&lt;b&gt;&amp;&quot;&#39;\u{fffd}\u{fffd}ü\n");
    }

    #[test]
    fn a_script_string_cannot_end_the_script() {
        let out = script_string("</script><!--\u{2028}\"\\");
        assert_eq!(out, "\"\\u003c/script>\\u003c!--\\u2028\\\"\\\\\"");
    }

    #[test]
    fn only_three_schemes_lead_elsewhere() {
        assert!(is_external("HTTPS://example.org") && is_external("mailto:a@b.c") && is_external("http://x"));
        for url in ["javascript:alert(1)", "data:text/html,x", "//host/x", "file:///etc", "", " https://x"] {
            assert!(!is_external(url), "{url}");
        }
    }
}
