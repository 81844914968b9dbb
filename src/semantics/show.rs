//! Values as people write them: literals of IEC 61131-3 from bits and back.

use super::scalar::{DateKind, Scalar};

/// A scalar type, with the names of values where it is an enumeration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Kind {
    /// The type.
    pub scalar: Scalar,
    /// The names of values.
    pub labels: Vec<(u64, String)>,
}

impl From<Scalar> for Kind {
    fn from(scalar: Scalar) -> Self {
        Self { scalar, labels: Vec::new() }
    }
}

/// The elementary types by name.
const TYPES: &[(&str, Scalar)] = &[
    ("BOOL", Scalar::Bool),
    ("SINT", Scalar::Int { signed: true, width: 8 }),
    ("INT", Scalar::Int { signed: true, width: 16 }),
    ("DINT", Scalar::Int { signed: true, width: 32 }),
    ("LINT", Scalar::Int { signed: true, width: 64 }),
    ("USINT", Scalar::Int { signed: false, width: 8 }),
    ("UINT", Scalar::Int { signed: false, width: 16 }),
    ("UDINT", Scalar::Int { signed: false, width: 32 }),
    ("ULINT", Scalar::Int { signed: false, width: 64 }),
    ("BYTE", Scalar::Bits(8)),
    ("WORD", Scalar::Bits(16)),
    ("DWORD", Scalar::Bits(32)),
    ("LWORD", Scalar::Bits(64)),
    ("REAL", Scalar::Real(32)),
    ("LREAL", Scalar::Real(64)),
    ("TIME", Scalar::Time(32)),
    ("LTIME", Scalar::Time(64)),
    ("DATE", Scalar::Date(DateKind::Date, 32)),
    ("LDATE", Scalar::Date(DateKind::Date, 64)),
    ("TIME_OF_DAY", Scalar::Date(DateKind::TimeOfDay, 32)),
    ("LTOD", Scalar::Date(DateKind::TimeOfDay, 64)),
    ("DATE_AND_TIME", Scalar::Date(DateKind::DateAndTime, 32)),
    ("LDT", Scalar::Date(DateKind::DateAndTime, 64)),
];

/// The elementary type of that name.
#[must_use]
pub fn type_named(name: &str) -> Option<Scalar> {
    TYPES.iter().find(|(other, _)| other.eq_ignore_ascii_case(name)).map(|(_, scalar)| *scalar)
}

/// The name of a type.
#[must_use]
pub fn type_name(scalar: Scalar) -> &'static str {
    if let Scalar::Fixed { .. } = scalar {
        return "REAL";
    }
    TYPES.iter().find(|(_, other)| *other == scalar).map_or("POINTER", |(name, _)| name)
}

/// A value as a literal: `TRUE`, `-5`, `16#FF`, `2.5`, `T#1s500ms`, or the name of an enumeration's value.
#[must_use]
pub fn literal(kind: &Kind, bits: u64) -> String {
    if let Some((_, label)) = kind.labels.iter().find(|(value, _)| *value == bits) {
        return label.clone();
    }
    match kind.scalar {
        Scalar::Bool => if bits == 0 { "FALSE" } else { "TRUE" }.to_owned(),
        Scalar::Bits(width) => format!("16#{bits:0digits$X}", digits = width as usize / 4),
        Scalar::Int { .. } => kind.scalar.number(bits).to_string(),
        Scalar::Real(32) => real(f64::from(f32::from_bits(bits as u32)), &f32::from_bits(bits as u32)),
        Scalar::Real(_) => real(f64::from_bits(bits), &f64::from_bits(bits)),
        Scalar::Fixed { digits, .. } => super::fixed::literal(digits, kind.scalar.number(bits)),
        Scalar::Time(32) => format!("T#{}", duration(bits.into(), 1_000_000)),
        Scalar::Time(_) => format!("LTIME#{}", duration(bits.into(), 1)),
        Scalar::Date(date, width) => moment(date, width, bits),
        Scalar::Ref => {
            if bits == 0 {
                "NULL".to_owned()
            } else {
                format!("@{}", bits - 1)
            }
        }
    }
}

/// Whole numbers keep their point, so that they read as `REAL`.
fn real(value: f64, shown: &dyn std::fmt::Debug) -> String {
    match value {
        _ if value.is_nan() => "NaN".to_owned(),
        _ if value.is_infinite() => if value > 0.0 { "+INF" } else { "-INF" }.to_owned(),
        _ => format!("{shown:?}"),
    }
}

/// A duration of `count` units, each of so many nanoseconds: `1m30s`, `5ms`, `0ms`.
fn duration(count: u128, unit: u128) -> String {
    const PARTS: [(&str, u128); 7] = [
        ("d", 86_400_000_000_000),
        ("h", 3_600_000_000_000),
        ("m", 60_000_000_000),
        ("s", 1_000_000_000),
        ("ms", 1_000_000),
        ("us", 1_000),
        ("ns", 1),
    ];
    let mut rest = count * unit;
    let mut out = String::new();
    for (name, nanos) in PARTS {
        if rest >= nanos {
            out.push_str(&format!("{}{name}", rest / nanos));
            rest %= nanos;
        }
    }
    if out.is_empty() { "0ms".to_owned() } else { out }
}

fn moment(kind: DateKind, width: u32, bits: u64) -> String {
    let long = if width == 64 { "L" } else { "" };
    let (seconds, fraction) = match (kind, width) {
        (DateKind::TimeOfDay, 32) => (bits / 1000, format!(".{:03}", bits % 1000)),
        (_, 32) => (bits, String::new()),
        _ => (bits / 1_000_000_000, format!(".{:09}", bits % 1_000_000_000)),
    };
    let fraction = fraction.trim_end_matches('0').trim_end_matches('.');
    let (days, of_day) = (seconds / 86_400, seconds % 86_400);
    let clock = format!("{:02}:{:02}:{:02}{fraction}", of_day / 3600, of_day / 60 % 60, of_day % 60);
    let (year, month, day) = civil(days);
    match kind {
        DateKind::Date => format!("{long}D#{year:04}-{month:02}-{day:02}"),
        DateKind::TimeOfDay => format!("{long}TOD#{clock}"),
        DateKind::DateAndTime => format!("{long}DT#{year:04}-{month:02}-{day:02}-{clock}"),
    }
}

/// The date of a day since 1970-01-01 (Hinnant, *chrono-compatible low-level date algorithms*, `civil_from_days`).
const fn civil(days: u64) -> (u64, u64, u64) {
    let shifted = days + 719_468;
    let era = shifted / 146_097;
    let of_era = shifted % 146_097;
    let year = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year + year / 4 - year / 100);
    let shifted_month = (5 * of_year + 2) / 153;
    let day = of_year - (153 * shifted_month + 2) / 5 + 1;
    let month = if shifted_month < 10 { shifted_month + 3 } else { shifted_month - 9 };
    let year = year + era * 400 + if month <= 2 { 1 } else { 0 };
    (year, month, day)
}

/// The bits that a text means: what [`literal`] writes, and plain numbers.
#[must_use]
pub fn parse(kind: &Kind, text: &str) -> Option<u64> {
    let text = text.trim();
    let label = text.rsplit(['.', '#']).next().unwrap_or(text);
    if let Some((value, _)) = kind.labels.iter().find(|(_, name)| name.eq_ignore_ascii_case(label)) {
        return Some(*value);
    }
    match kind.scalar {
        Scalar::Bool => truth(text),
        Scalar::Real(32) => Some(u64::from(float(text)?.parse::<f32>().ok()?.to_bits())),
        Scalar::Real(_) => Some(float(text)?.parse::<f64>().ok()?.to_bits()),
        Scalar::Fixed { digits, width } => super::fixed::parse(digits, width, &float(text)?),
        Scalar::Time(32) if text.contains('#') => u32::try_from(nanos(text)? / 1_000_000).ok().map(u64::from),
        Scalar::Time(_) if text.contains('#') => u64::try_from(nanos(text)?).ok(),
        Scalar::Date(..) if text.contains('#') => None,
        scalar => {
            let number = whole(text)?;
            let bits = scalar.bits(number);
            (scalar.number(bits) == number || (scalar.is_signed() && bits as i128 == number)).then_some(bits)
        }
    }
}

fn truth(text: &str) -> Option<u64> {
    match text.to_ascii_uppercase().as_str() {
        "TRUE" | "T" | "1" | "1.0" | "BOOL#TRUE" | "BOOL#1" => Some(1),
        "FALSE" | "F" | "0" | "0.0" | "BOOL#FALSE" | "BOOL#0" => Some(0),
        _ => None,
    }
}

fn float(text: &str) -> Option<String> {
    let plain = text.rsplit('#').next()?.replace('_', "");
    Some(match plain.to_ascii_uppercase().as_str() {
        "+INF" | "INF" => "inf".to_owned(),
        "-INF" => "-inf".to_owned(),
        _ => plain,
    })
}

/// `-5`, `16#FF`, `2#1010`, `INT#7`, `INT#16#7`.
fn whole(text: &str) -> Option<i128> {
    let text = text.replace('_', "");
    let mut parts: Vec<&str> = text.split('#').collect();
    let digits = parts.pop()?;
    let radix = match parts.last() {
        Some(&"2") => 2,
        Some(&"8") => 8,
        Some(&"16") => 16,
        _ => 10,
    };
    i128::from_str_radix(digits, radix).ok()
}

/// A duration literal in nanoseconds: `T#1s500ms`, `LTIME#2.5us`.
fn nanos(text: &str) -> Option<i128> {
    let mut rest = text.split_once('#')?.1.replace('_', "").to_ascii_lowercase();
    let negative = rest.starts_with('-');
    if negative {
        rest.remove(0);
    }
    let mut total = 0_i128;
    let mut rest = rest.as_str();
    if rest.is_empty() {
        return None;
    }
    while !rest.is_empty() {
        let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.')?;
        let (number, tail) = rest.split_at(end);
        let end = tail.find(|c: char| c.is_ascii_digit()).unwrap_or(tail.len());
        let (unit, tail) = tail.split_at(end);
        total += part(number, unit)?;
        rest = tail;
    }
    Some(if negative { -total } else { total })
}

fn part(number: &str, unit: &str) -> Option<i128> {
    let unit: i128 = match unit {
        "d" => 86_400_000_000_000,
        "h" => 3_600_000_000_000,
        "m" => 60_000_000_000,
        "s" => 1_000_000_000,
        "ms" => 1_000_000,
        "us" => 1_000,
        "ns" => 1,
        _ => return None,
    };
    let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
    let mut total = whole.parse::<i128>().ok()?.checked_mul(unit)?;
    let mut digit_unit = unit;
    for digit in fraction.chars() {
        digit_unit /= 10;
        total += i128::from(digit.to_digit(10)?) * digit_unit;
    }
    Some(total)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(name: &str, bits: u64) -> String {
        literal(&type_named(name).expect("a type").into(), bits)
    }

    fn read(name: &str, text: &str) -> Option<u64> {
        parse(&type_named(name).expect("a type").into(), text)
    }

    #[test]
    fn literals_are_those_of_the_standard() {
        assert_eq!(shown("BOOL", 1), "TRUE");
        assert_eq!(shown("INT", 0xFFFF), "-1");
        assert_eq!(shown("WORD", 0xAB), "16#00AB");
        assert_eq!(shown("REAL", 1.0_f32.to_bits().into()), "1.0");
        assert_eq!(shown("REAL", 0.1_f32.to_bits().into()), "0.1");
        assert_eq!(shown("LREAL", f64::NAN.to_bits()), "NaN");
        assert_eq!(shown("TIME", 0), "T#0ms");
        assert_eq!(shown("TIME", 90_005), "T#1m30s5ms");
        assert_eq!(shown("LTIME", 1_500), "LTIME#1us500ns");
        assert_eq!(shown("DATE", 951_782_400), "D#2000-02-29");
        assert_eq!(shown("TIME_OF_DAY", 3_661_500), "TOD#01:01:01.5");
        assert_eq!(shown("DATE_AND_TIME", 951_868_799), "DT#2000-02-29-23:59:59");
        assert_eq!(shown("LDT", 1_000_000_000), "LDT#1970-01-01-00:00:01");
    }

    #[test]
    fn what_is_shown_is_read_back() {
        let cases: [(&str, &[u64]); 7] = [
            ("BOOL", &[0, 1]),
            ("SINT", &[0, 127, 128, 255]),
            ("ULINT", &[0, u64::MAX]),
            ("DWORD", &[0, 0xFFFF_FFFF]),
            ("LREAL", &[0, 0x3FF8_0000_0000_0000, 0x7FF0_0000_0000_0000, 1]),
            ("TIME", &[0, 5, 86_400_000, 4_294_967_295]),
            ("LTIME", &[0, 1, 1_234_567_891, u64::MAX]),
        ];
        for (name, values) in cases {
            for bits in values {
                assert_eq!(read(name, &shown(name, *bits)), Some(*bits), "{name} {bits}");
            }
        }
    }

    #[test]
    fn other_spellings_are_read_and_wrong_ones_are_not() {
        assert_eq!(read("INT", "INT#16#7F"), Some(127));
        assert_eq!(read("TIME", "T#1.5s"), Some(1500));
        assert_eq!(read("TIME", "250"), Some(250));
        assert_eq!(read("SINT", "200"), Some(200));
        for (name, text) in [("INT", "70000"), ("USINT", "-1"), ("BOOL", "yes"), ("TIME", "T#5x"), ("TIME", "T#")] {
            assert_eq!(read(name, text), None, "{name} {text}");
        }
        let lamp = Kind { scalar: Scalar::Int { signed: true, width: 16 }, labels: vec![(2, "Green".to_owned())] };
        assert_eq!(parse(&lamp, "E_Lamp.green"), Some(2));
        assert_eq!(literal(&lamp, 2), "Green");
        assert_eq!(literal(&lamp, 3), "3");
    }
}
