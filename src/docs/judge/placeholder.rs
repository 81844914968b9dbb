//! Comments that only hold the place of documentation.

/// What templates and hurried people leave, folded as [`fold`] does.
const PLACEHOLDERS: [&str; 44] = [
    "",
    "todo",
    "tbd",
    "tba",
    "fixme",
    "xxx",
    "na",
    "none",
    "empty",
    "comment",
    "comments",
    "a comment",
    "comment here",
    "your comment",
    "your comment here",
    "no comment",
    "nocomment",
    "add comment",
    "add comment here",
    "add your comment",
    "add your comment here",
    "add a comment",
    "insert comment here",
    "enter comment here",
    "description",
    "a description",
    "description here",
    "your description",
    "your description here",
    "add description",
    "add description here",
    "add a description",
    "add your description here",
    "enter description",
    "enter description here",
    "enter a description",
    "enter a description here",
    "insert description here",
    "no description",
    "documentation",
    "add documentation here",
    "beschreibung",
    "kommentar",
    "write documentation here",
];

/// Elements that templates leave empty.
const EMPTY: [&str; 6] = ["summary", "docu", "description", "remarks", "param", "returns"];

/// Whether `text` says nothing about what is called `name`.
pub(in crate::docs) fn is_placeholder(text: &str, name: &str) -> bool {
    if (1..=2).contains(&text.trim().chars().count()) {
        // A sign is a sign, as in `CHAR_MUL := 42; // *`.
        return false;
    }
    let bare = without_elements(text);
    let words = fold(&bare);
    if words.is_empty() && text.contains('<') {
        let inside = fold(text);
        return PLACEHOLDERS.contains(&inside.as_str()) || EMPTY.iter().any(|name| inside.contains(name));
    }
    if words.split(' ').count() > 8 {
        return false;
    }
    let words = words.strip_prefix("todo ").or_else(|| words.strip_prefix("brief ")).unwrap_or(&words);
    PLACEHOLDERS.contains(&words) || !name.is_empty() && fold(&bare) == fold(name)
}

/// Lower case words with one space between.
fn fold(text: &str) -> String {
    let folded: String = text.chars().map(|c| if c.is_alphanumeric() { c } else { ' ' }).collect();
    folded.to_lowercase().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The text without `<…>`.
fn without_elements(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(open) = rest.find('<') {
        let Some(close) = rest[open..].find('>') else { break };
        out.push_str(&rest[..open]);
        rest = &rest[open + close + 1..];
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::is_placeholder;

    #[test]
    fn what_templates_leave_is_a_placeholder() {
        for text in
            ["TODO: Add your comment here", "<Description>", "<summary>\nEnter description here.\n</summary>", "..."]
        {
            assert!(is_placeholder(text, "FB_Pump"), "{text}");
        }
    }

    #[test]
    fn the_name_repeated_says_nothing() {
        assert!(is_placeholder("FB_Pump", "FB_Pump"));
        assert!(is_placeholder("fb pump.", "FB_Pump"));
        assert!(!is_placeholder("A pump", "FB_Pump"));
        // Words made of a name are at least words.
        assert!(!is_placeholder("Position source", "PositionSource"));
    }

    #[test]
    fn a_task_is_no_placeholder() {
        assert!(!is_placeholder("TODO: handle a negative flow", "FB_Pump"));
    }
}
