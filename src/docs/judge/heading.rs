//! Headings of groups: `Inputs`, `Local variables`, `Structure types`.

/// Words that headings of sections are made of, in English and German.
const WORDS: [&str; 78] = [
    "in",
    "input",
    "inputs",
    "out",
    "output",
    "outputs",
    "inout",
    "in_out",
    "inouts",
    "var",
    "vars",
    "var_input",
    "var_output",
    "var_in_out",
    "variable",
    "variables",
    "variablen",
    "local",
    "locals",
    "lokale",
    "internal",
    "intern",
    "interne",
    "private",
    "public",
    "protected",
    "global",
    "globals",
    "globale",
    "temp",
    "temporary",
    "static",
    "statics",
    "constant",
    "constants",
    "konstanten",
    "parameter",
    "parameters",
    "param",
    "params",
    "interface",
    "interfaces",
    "type",
    "types",
    "structure",
    "structures",
    "struct",
    "structs",
    "enum",
    "enums",
    "enumeration",
    "enumerations",
    "function",
    "functions",
    "block",
    "blocks",
    "functionblock",
    "functionblocks",
    "fb",
    "fbs",
    "instance",
    "instances",
    "instanzen",
    "method",
    "methods",
    "property",
    "properties",
    "declaration",
    "declarations",
    "eingänge",
    "ausgänge",
    "eingang",
    "ausgang",
    "members",
    "fields",
    "retain",
    "and",
    "und",
];

/// Whether `text` is one line of nothing but such words.
pub(in crate::docs) fn is_heading(text: &str) -> bool {
    let text = text.trim();
    let mut words = text.split(|c: char| !(c.is_alphanumeric() || c == '_')).filter(|word| !word.is_empty()).peekable();
    !text.contains('\n') && words.peek().is_some() && words.all(|word| WORDS.contains(&word.to_lowercase().as_str()))
}

#[cfg(test)]
mod tests {
    use super::is_heading;

    #[test]
    fn a_heading_has_no_other_word() {
        assert!(is_heading("Structure types"));
        assert!(is_heading("IN / OUT:"));
        assert!(!is_heading("Inputs of the valve"));
        assert!(!is_heading("Outputs\n\nand more"));
    }
}
