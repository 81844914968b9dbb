//! Which type converts into which without a word, by the rules of CODESYS: from smaller to larger, with the sign kept.
//! Conversions that its compiler only warns of (a loss, a change of sign) do not count.

/// The types that a value of each type converts into, besides itself; each line is closed under its own steps.
const WIDER: &[(&str, &[&str])] = &[
    ("SINT", &["INT", "DINT", "LINT", "REAL", "LREAL"]),
    ("INT", &["DINT", "LINT", "REAL", "LREAL"]),
    ("DINT", &["LINT", "LREAL"]),
    ("USINT", &["UINT", "UDINT", "ULINT", "INT", "DINT", "LINT", "REAL", "LREAL"]),
    ("UINT", &["UDINT", "ULINT", "DINT", "LINT", "REAL", "LREAL"]),
    ("UDINT", &["ULINT", "LINT", "LREAL"]),
    ("BYTE", &["WORD", "DWORD", "LWORD"]),
    ("WORD", &["DWORD", "LWORD"]),
    ("DWORD", &["LWORD"]),
    ("REAL", &["LREAL"]),
    ("TIME", &["LTIME"]),
];

/// Whether every value of type `from` becomes one of type `to` without a word of the user's and without loss.
#[must_use]
pub fn converts(from: &str, to: &str) -> bool {
    let (from, to) = (normal(from), normal(to));
    if from == to {
        return true;
    }
    if let (Some(a), Some(b)) = (length(&from), length(&to)) {
        return a <= b;
    }
    WIDER.iter().any(|(name, wider)| *name == from && wider.contains(&to.as_str()))
}

/// Whether both are one type, whatever the letters and the white space.
#[must_use]
pub fn same(a: &str, b: &str) -> bool {
    normal(a) == normal(b)
}

fn normal(type_: &str) -> String {
    type_.split_whitespace().collect::<String>().to_uppercase()
}

/// The length of a string type; 80 where none is given.
fn length(type_: &str) -> Option<u32> {
    let rest = type_.strip_prefix("STRING")?;
    if rest.is_empty() {
        return Some(80);
    }
    let inner = rest.strip_prefix('(').and_then(|rest| rest.strip_suffix(')'));
    let inner = inner.or_else(|| rest.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')))?;
    inner.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::converts;

    #[test]
    fn conversions_keep_every_value() {
        for (from, to) in [("INT", "dint"), ("STRING", "STRING(120)"), ("BYTE", "LWORD"), ("USINT", "INT"), ("X", "x")]
        {
            assert!(converts(from, to), "{from} to {to}");
        }
        for (from, to) in
            [("DINT", "INT"), ("DINT", "REAL"), ("INT", "UINT"), ("STRING", "STRING(20)"), ("BOOL", "INT")]
        {
            assert!(!converts(from, to), "{from} to {to}");
        }
    }
}
