//! Literals of durations and moments: `T#1d2h3.5s`, `D#2026-02-28`, `TOD#12:30:15.25`, `DT#2026-02-28-12:30:15`.
//!
//! Days are counted from 1970-01-01 in the proleptic Gregorian calendar, by Howard Hinnant's `days_from_civil`.

use super::literal::{Constant, date_type};
use super::types::{LTIME, TIME};
use crate::semantics::scalar::DateKind;

const NANOS: u128 = 1_000_000_000;
const UNITS: [(&str, u128); 7] = [
    ("d", 86_400 * NANOS),
    ("h", 3_600 * NANOS),
    ("ms", 1_000_000),
    ("us", 1_000),
    ("ns", 1),
    ("m", 60 * NANOS),
    ("s", NANOS),
];

/// A literal's prefix without `#`, in upper case, and its value in lower case without underscores.
fn parts(text: &str) -> Result<(String, String), String> {
    let (prefix, value) = text.split_once('#').ok_or_else(|| format!("`{text}` has no type"))?;
    Ok((prefix.to_ascii_uppercase(), value.replace('_', "").to_ascii_lowercase()))
}

fn bits(count: u128, long: bool, text: &str) -> Result<u64, String> {
    let limit = if long { u128::from(u64::MAX) } else { u128::from(u32::MAX) };
    u64::try_from(count).ok().filter(|_| count <= limit).ok_or_else(|| format!("`{text}` is too large for its type"))
}

/// `T#…`, `LTIME#…`. A `TIME` counts milliseconds; what is finer is cut.
pub(super) fn duration(text: &str) -> Result<Constant, String> {
    let (prefix, value) = parts(text)?;
    if prefix.starts_with("S5") {
        return Err(format!("`{text}`: `S5TIME` is not modelled"));
    }
    if value.starts_with('-') {
        return Err(format!("`{text}`: durations are not negative"));
    }
    let long = prefix.starts_with('L');
    let nanos = nanoseconds(value.trim_start_matches('+'), text)?;
    let count = if long { nanos } else { nanos / 1_000_000 };
    Ok(Constant::Typed(if long { LTIME } else { TIME }, bits(count, long, text)?))
}

fn nanoseconds(mut value: &str, text: &str) -> Result<u128, String> {
    let wrong = || format!("`{text}` is no duration");
    let mut sum = 0_u128;
    if value.is_empty() {
        return Err(wrong());
    }
    while !value.is_empty() {
        let digits = value.find(|c: char| !c.is_ascii_digit() && c != '.').ok_or_else(wrong)?;
        let (number, rest) = value.split_at(digits);
        let end = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
        let (unit, rest) = rest.split_at(end);
        let (_, unit) = UNITS.iter().find(|(name, _)| *name == unit).ok_or_else(wrong)?;
        let part = scaled(number, *unit).ok_or_else(wrong)?;
        sum = sum.checked_add(part).ok_or_else(wrong)?;
        value = rest;
    }
    Ok(sum)
}

/// A decimal number of units, cut to whole nanoseconds.
fn scaled(number: &str, unit: u128) -> Option<u128> {
    let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
    let whole = if whole.is_empty() { 0 } else { whole.parse::<u64>().ok()? };
    let fraction = &fraction[..fraction.len().min(12)];
    let digits = u32::try_from(fraction.len()).ok()?;
    let part = if fraction.is_empty() { 0 } else { fraction.parse::<u128>().ok()? * unit / 10_u128.pow(digits) };
    u128::from(whole).checked_mul(unit)?.checked_add(part)
}

/// Days from 1970-01-01 to a date; `None` for one that there is not.
fn days(year: i64, month: i64, day: i64) -> Option<u128> {
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let lengths = [31, if leap { 29 } else { 28 }, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let length = *lengths.get(usize::try_from(month.checked_sub(1)?).ok()?)?;
    if !(1..=length).contains(&day) || !(1970..=9999).contains(&year) {
        return None;
    }
    let shifted = if month <= 2 { year - 1 } else { year };
    let era = shifted / 400;
    let of_era = shifted - era * 400;
    let of_year = (153 * (if month > 2 { month - 3 } else { month + 9 }) + 2) / 5 + day - 1;
    let day_of_era = of_era * 365 + of_era / 4 - of_era / 100 + of_year;
    u128::try_from(era * 146_097 + day_of_era - 719_468).ok()
}

fn date_nanos(value: &str) -> Option<u128> {
    let numbers: Option<Vec<i64>> = value.split('-').map(|part| part.parse().ok()).collect();
    match numbers?.as_slice() {
        [year, month, day] => days(*year, *month, *day).map(|days| days * 86_400 * NANOS),
        _ => None,
    }
}

fn time_nanos(value: &str) -> Option<u128> {
    let mut parts = value.split(':');
    let (hour, minute, second) = (parts.next()?, parts.next()?, parts.next().unwrap_or("0"));
    let (hour, minute) = (hour.parse::<u128>().ok()?, minute.parse::<u128>().ok()?);
    let second = scaled(second, NANOS)?;
    let fits = hour < 24 && minute < 60 && second < 60 * NANOS && parts.next().is_none();
    fits.then_some((hour * 60 + minute) * 60 * NANOS + second)
}

/// `D#2026-02-28`.
pub(super) fn date(text: &str) -> Result<Constant, String> {
    let (prefix, value) = parts(text)?;
    let long = prefix.starts_with('L');
    let nanos = date_nanos(&value).ok_or_else(|| format!("`{text}` is no date"))?;
    let count = if long { nanos } else { nanos / NANOS };
    Ok(Constant::Typed(date_type(DateKind::Date, long), bits(count, long, text)?))
}

/// `TOD#12:30:15.25`.
pub(super) fn time_of_day(text: &str) -> Result<Constant, String> {
    let (prefix, value) = parts(text)?;
    let long = prefix.starts_with('L');
    let nanos = time_nanos(&value).ok_or_else(|| format!("`{text}` is no time of day"))?;
    let count = if long { nanos } else { nanos / 1_000_000 };
    Ok(Constant::Typed(date_type(DateKind::TimeOfDay, long), bits(count, long, text)?))
}

/// `DT#2026-02-28-12:30:15`.
pub(super) fn date_and_time(text: &str) -> Result<Constant, String> {
    let (prefix, value) = parts(text)?;
    let wrong = || format!("`{text}` is no date and time");
    if prefix == "DTL" {
        return Err(format!("`{text}`: `DTL` is not modelled"));
    }
    let long = prefix.starts_with('L');
    let (date, time) = value.rsplit_once('-').ok_or_else(wrong)?;
    let nanos = date_nanos(date).zip(time_nanos(time)).map(|(date, time)| date + time).ok_or_else(wrong)?;
    let count = if long { nanos } else { nanos / NANOS };
    Ok(Constant::Typed(date_type(DateKind::DateAndTime, long), bits(count, long, text)?))
}
