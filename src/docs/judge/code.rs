//! Code that was commented out.
//!
//! A line is code if it ends like a statement and is built like one (`:=`, a call, a declaration),
//! or if it is one of the words that open and close statements. Prose with semicolons has neither.
//! A comment is code if its first line is, and most of the others are.

/// Words that stand alone on a line of code.
const CLOSERS: [&str; 18] = [
    "END_IF",
    "END_FOR",
    "END_WHILE",
    "END_CASE",
    "END_REPEAT",
    "END_VAR",
    "END_STRUCT",
    "END_TYPE",
    "END_METHOD",
    "END_FUNCTION",
    "END_FUNCTION_BLOCK",
    "END_PROGRAM",
    "VAR_INPUT",
    "VAR_OUTPUT",
    "VAR_IN_OUT",
    "VAR",
    "RETURN",
    "ELSE",
];

/// Whether most of `text` is code, from its first line on.
pub(super) fn is_code(text: &str) -> bool {
    let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    let code = lines.iter().filter(|line| is_code_line(line)).count();
    lines.first().is_some_and(|line| is_code_line(line)) && code * 5 >= lines.len() * 3
}

/// Whether `line` is a line of code.
pub(in crate::docs) fn is_code_line(line: &str) -> bool {
    let line = without_remark(line.trim());
    if line.is_empty() {
        return false;
    }
    let bare = line.trim_end_matches(';').trim();
    if CLOSERS.contains(&bare) || is_section(bare) || is_pragma(line) {
        return true;
    }
    match line.strip_suffix(';') {
        Some(head) => is_assignment(head) || is_call(head) || is_declaration(head),
        None => is_control(line) || is_element(line),
    }
}

/// `VAR_EXTERNAL CONSTANT`
fn is_section(line: &str) -> bool {
    let mut words = line.split_whitespace();
    words
        .next()
        .is_some_and(|word| word.starts_with("VAR_") && word.chars().all(|c| c.is_ascii_uppercase() || c == '_'))
        && words.all(|word| matches!(word, "CONSTANT" | "RETAIN" | "PERSISTENT" | "NON_RETAIN"))
}

/// `{attribute …}`, also behind the star by which some compilers are told to read it.
fn is_pragma(line: &str) -> bool {
    let line = line.trim_start_matches(['*', '~']).trim();
    line.starts_with('{') && line.ends_with('}')
}

/// The line without the comment behind it.
fn without_remark(line: &str) -> &str {
    let end = line.find("//").into_iter().chain(line.find("(*").filter(|_| line.trim_end().ends_with("*)"))).min();
    let cut = end.map_or(line, |end| line[..end].trim_end());
    if cut.is_empty() { line } else { cut }
}

/// `target := …`, where the target is a variable with its members and indices.
fn is_assignment(head: &str) -> bool {
    let Some((target, value)) = head.split_once(":=") else { return false };
    let target = target.trim();
    let target = target.split_once(':').map_or(target, |(names, _)| names.trim());
    !value.trim().is_empty() && is_reference(target)
}

/// `name(…)`, possibly with a path before it.
fn is_call(head: &str) -> bool {
    let Some((name, arguments)) = head.split_once('(') else { return is_path_call(head) };
    head.trim_end().ends_with(')') && is_reference(name) && !name.is_empty() && !is_sentence(arguments)
}

/// `fb.Method` without parentheses is no call; only the words that stand alone are.
fn is_path_call(head: &str) -> bool {
    matches!(head.trim(), "EXIT" | "CONTINUE" | "RETURN")
}

/// `name, name : TYPE`, `name AT %I* : TYPE`.
fn is_declaration(head: &str) -> bool {
    let Some((names, type_)) = head.split_once(':') else { return false };
    let names = names.split(" AT ").next().unwrap_or("");
    let type_ = type_.trim();
    let words = type_.split_whitespace().count();
    let typed = type_.starts_with("ARRAY") || type_.starts_with("POINTER TO") || type_.starts_with("REFERENCE TO");
    names.split(',').all(|name| is_reference(name.trim())) && (typed || words == 1)
}

/// `IF … THEN`, `FOR … DO`, `CASE … OF`, with keywords in capitals.
fn is_control(line: &str) -> bool {
    let first = line.split([' ', '(', '\t']).next().unwrap_or("");
    let opens = matches!(first, "IF" | "ELSIF" | "FOR" | "WHILE" | "CASE" | "REPEAT" | "UNTIL");
    let closes = ["THEN", "DO", "OF", "END_REPEAT"].iter().any(|word| line.ends_with(word));
    opens && (closes || line.contains(":="))
}

/// `NAME := value,` as in an enumeration or an argument list.
fn is_element(line: &str) -> bool {
    let line = line.strip_suffix(',').unwrap_or(line);
    let Some((name, value)) = line.split_once(":=").or_else(|| line.split_once("=>")) else { return false };
    is_reference(name.trim()) && !value.trim().is_empty() && !value.trim().contains(' ')
}

/// A variable with its members and indices, without white space.
fn is_reference(text: &str) -> bool {
    let text = text.trim();
    let mut depth = 0_u32;
    let mut plain = String::new();
    for c in text.chars() {
        match c {
            '[' => depth += 1,
            ']' => depth = depth.saturating_sub(1),
            c if depth == 0 => plain.push(c),
            _ => {}
        }
    }
    let starts = plain.starts_with(|c: char| c.is_alphabetic() || c == '_' || c == '%');
    starts && plain.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '.' | '^' | '%' | '#' | '*'))
}

/// Whether the text between parentheses reads like words and not like arguments.
fn is_sentence(arguments: &str) -> bool {
    let inner = arguments.trim_end().trim_end_matches(')');
    !inner.contains(":=")
        && !inner.contains(',')
        && inner.split_whitespace().filter(|w| w.chars().all(char::is_alphabetic)).count() > 2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_and_declarations_are_code() {
        for line in [
            "nCount := nCount + 1;",
            "fbTimer(IN := TRUE, PT := T#5s);",
            "THIS^.Stop();",
            "aValues[i + 1].x := 0; // reset",
            "bReady, bBusy : BOOL;",
            "aData : ARRAY[0..9] OF INT;",
            "nMax : INT := 5;",
            "IF bReady THEN",
            "END_IF",
            "Red := 1,",
            "VAR_EXTERNAL CONSTANT",
            "{attribute 'hide'}",
        ] {
            assert!(is_code_line(line), "{line}");
        }
    }

    #[test]
    fn prose_is_none_whatever_it_ends_with() {
        for line in [
            "starts the motor; stops the belt;",
            "Note: this is slow;",
            "True if the cylinder is extended.",
            "if it is done then the output is set",
            "0 = off, 1 = on",
            "call Stop() before;",
            "value (see below for the limits);",
            "default := on after a restart",
        ] {
            assert!(!is_code_line(line), "{line}");
        }
    }

    #[test]
    fn an_example_below_prose_is_no_commented_code() {
        assert!(!is_code("Adds two numbers:\nx := Add(1, 2);\ny := Add(x, 2);"));
        assert!(is_code("x := Add(1, 2);\ny := Add(x, 2);\nthen"));
    }
}
