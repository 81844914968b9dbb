//! Literals of IEC 61131-3: numbers in any base, typed ones, durations.

use super::ast::LiteralValue;

/// The elementary types that may stand before `#`, numbers first.
const INTEGER_TYPES: [&str; 12] =
    ["SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT", "BYTE", "WORD", "DWORD", "LWORD"];
const REAL_TYPES: [&str; 2] = ["REAL", "LREAL"];
const DATE_TYPES: [&str; 10] = ["D", "DATE", "LD", "LDATE", "TOD", "TIME_OF_DAY", "LTOD", "DT", "DATE_AND_TIME", "LDT"];

/// What a word before `#` announces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Prefix {
    Bool,
    Integer,
    Real,
    Time {
        long: bool,
    },
    Date,
    /// The name of an enum type.
    Enum,
}

/// What the word `name` before `#` announces.
pub(super) fn prefix(name: &str) -> Prefix {
    let upper = name.to_ascii_uppercase();
    match upper.as_str() {
        "BOOL" | "BOOLEAN" => Prefix::Bool,
        "T" | "TIME" => Prefix::Time { long: false },
        "LT" | "LTIME" => Prefix::Time { long: true },
        name if INTEGER_TYPES.contains(&name) => Prefix::Integer,
        name if REAL_TYPES.contains(&name) => Prefix::Real,
        name if DATE_TYPES.contains(&name) => Prefix::Date,
        _ => Prefix::Enum,
    }
}

/// A number without sign: `12`, `1_000`, `16#FF`, `1.5`, `1.5E-3`.
pub(super) fn number(text: &str, ty: Option<String>) -> Result<LiteralValue, String> {
    let digits: String = text.chars().filter(|c| *c != '_').collect();
    if let Some((base, rest)) = digits.split_once('#') {
        return based(base, rest).map(|value| LiteralValue::Int(value, ty));
    }
    if digits.contains(['.', 'e', 'E']) {
        let value: f64 = digits.parse().map_err(|_| format!("`{text}` is no number"))?;
        return Ok(LiteralValue::Real(format!("{value:?}"), ty));
    }
    if ty.as_deref().is_some_and(|ty| REAL_TYPES.contains(&ty)) {
        let value: f64 = digits.parse().map_err(|_| format!("`{text}` is no number"))?;
        return Ok(LiteralValue::Real(format!("{value:?}"), ty));
    }
    digits.parse().map(|value| LiteralValue::Int(value, ty)).map_err(|_| format!("`{text}` is too large a number"))
}

fn based(base: &str, digits: &str) -> Result<i128, String> {
    let base = base.parse::<u32>().ok().filter(|base| [2, 8, 10, 16].contains(base));
    let base = base.ok_or("a number's base is 2, 8, 10 or 16")?;
    i128::from_str_radix(digits, base).map_err(|_| format!("`{digits}` is no number to the base {base}"))
}

const UNITS: [(&str, i128); 25] = [
    ("d", 86_400_000_000_000),
    ("day", 86_400_000_000_000),
    ("days", 86_400_000_000_000),
    ("h", 3_600_000_000_000),
    ("hour", 3_600_000_000_000),
    ("hours", 3_600_000_000_000),
    ("m", 60_000_000_000),
    ("min", 60_000_000_000),
    ("minute", 60_000_000_000),
    ("minutes", 60_000_000_000),
    ("s", 1_000_000_000),
    ("sec", 1_000_000_000),
    ("secs", 1_000_000_000),
    ("second", 1_000_000_000),
    ("seconds", 1_000_000_000),
    ("ms", 1_000_000),
    ("msec", 1_000_000),
    ("millisecond", 1_000_000),
    ("milliseconds", 1_000_000),
    ("us", 1_000),
    ("µs", 1_000),
    ("μs", 1_000),
    ("microsecond", 1_000),
    ("microseconds", 1_000),
    ("ns", 1),
];

/// The nanoseconds of one `unit`, if it is one of time.
pub(in crate::table) fn unit(unit: &str) -> Option<i128> {
    let lower = unit.to_lowercase();
    UNITS.iter().find(|(name, _)| *name == lower).map(|(_, nanos)| *nanos)
}

/// A time in nanoseconds: `500ms`, `1s500ms`, `1.5 s`, `1h_30m`; without sign and without `T#`.
pub(in crate::table) fn time(text: &str) -> Option<i128> {
    let text: String = text.chars().filter(|c| *c != '_').collect();
    let mut rest = text.trim();
    let mut total: i128 = 0;
    if rest.is_empty() {
        return None;
    }
    while !rest.is_empty() {
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        let (number, after) = rest.split_at(digits);
        let after = after.trim_start();
        let letters = after.find(|c: char| !c.is_alphabetic()).unwrap_or(after.len());
        let (name, after) = after.split_at(letters);
        total = total.checked_add(scaled(number, unit(name)?)?)?;
        rest = after.trim_start();
    }
    Some(total)
}

/// `number` (digits with at most one point) times `unit`, if that is whole.
fn scaled(number: &str, unit: i128) -> Option<i128> {
    let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
    if whole.is_empty() || !fraction.bytes().all(|b| b.is_ascii_digit()) || fraction.len() > 18 {
        return None;
    }
    let value = whole.parse::<i128>().ok()?.checked_mul(unit)?;
    if fraction.is_empty() {
        return Some(value);
    }
    let scale = 10_i128.pow(u32::try_from(fraction.len()).ok()?);
    let part = fraction.parse::<i128>().ok()?.checked_mul(unit)?;
    (part % scale == 0).then(|| value + part / scale)
}

/// Nanoseconds as people write them: the largest unit that gives a whole number.
#[must_use]
pub fn time_text(nanos: i128) -> String {
    let units =
        [("h", 3_600_000_000_000), ("min", 60_000_000_000), ("s", 1_000_000_000), ("ms", 1_000_000), ("us", 1_000)];
    match units.iter().find(|(_, unit)| nanos % unit == 0 && nanos != 0) {
        Some((name, unit)) => format!("{}{name}", nanos / unit),
        None if nanos == 0 => "0ms".to_owned(),
        None => format!("{nanos}ns"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_is_the_sum_of_its_parts() {
        assert_eq!(time("1s500ms"), Some(1_500_000_000));
        assert_eq!(time("1.5 s"), Some(1_500_000_000));
        assert_eq!(time("2sec"), Some(2_000_000_000));
        assert_eq!(time("200 ms"), Some(200_000_000));
        assert_eq!(time("1h_30m"), Some(5_400_000_000_000));
        for wrong in ["", "5", "ms", "5 parsecs", ".5s", "1.5ns"] {
            assert_eq!(time(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn a_number_may_be_written_to_any_base() {
        assert_eq!(number("16#F_F", None), Ok(LiteralValue::Int(255, None)));
        assert_eq!(number("2#101", None), Ok(LiteralValue::Int(5, None)));
        assert_eq!(number("1.50", None), Ok(LiteralValue::Real("1.5".to_owned(), None)));
        assert!(number("3#1", None).is_err());
        assert!(number("2#2", None).is_err());
    }
}
