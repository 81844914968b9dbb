//! Traces as comma-separated values.
//!
//! Written: a column `cycle`, a column `time [ms]`, and one `Name : TYPE` for each signal; values are literals of IEC
//! 61131-3. Read: commas, semicolons or tabs. A column `cycle`, or none, means one row for each cycle; only a column `time`
//! (`time [s]`, `time [ms]`, `time [us]`, `time [ns]`; milliseconds unless it says) means samples, held until the next.

use super::samples::{Samples, cycles};
use super::{Kind, Known, Signal, Trace, Unreadable};
use crate::machine::program::Role;
use crate::semantics::scalar::Scalar;
use crate::semantics::show::{literal, parse, type_name, type_named};

/// Writes a trace.
#[must_use]
pub fn write(trace: &Trace) -> String {
    let mut out = csv::WriterBuilder::new().from_writer(Vec::new());
    let header = trace.signals.iter().map(|signal| match signal.kind.labels.is_empty() {
        true => format!("{} : {}", signal.name, type_name(signal.kind.scalar)),
        false => signal.name.clone(),
    });
    let header: Vec<String> = ["cycle".to_owned(), "time [ms]".to_owned()].into_iter().chain(header).collect();
    // Writing into memory cannot fail.
    let _ = out.write_record(&header);
    for cycle in 0..trace.cycles() {
        let nanos = cycle as u128 * u128::from(trace.cycle_time);
        let time = format!("{}.{:06}", nanos / 1_000_000, nanos % 1_000_000);
        let time = time.trim_end_matches('0').trim_end_matches('.').to_owned();
        let values = trace.signals.iter().map(|signal| literal(&signal.kind, signal.values[cycle]));
        let _ = out.write_record([(cycle + 1).to_string(), time].into_iter().chain(values));
    }
    let bytes = out.into_inner().unwrap_or_default();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Reads a trace.
///
/// # Errors
/// What cannot be read, with the line.
pub fn read(text: &str, known: &Known<'_>) -> Result<Trace, Unreadable> {
    let delimiter = delimiter(text);
    let mut reader = csv::ReaderBuilder::new().delimiter(delimiter).flexible(true).from_reader(text.as_bytes());
    let header: Vec<String> = reader.headers().map_err(wrong)?.iter().map(|cell| cell.trim().to_owned()).collect();
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(wrong)?;
        if record.iter().any(|cell| !cell.trim().is_empty()) {
            let line = record.position().map_or(0, csv::Position::line);
            rows.push((line, record.iter().map(|cell| cell.trim().to_owned()).collect::<Vec<_>>()));
        }
    }
    let sheet = Sheet { header, rows, decimal_comma: delimiter == b';' };
    sheet.trace(known)
}

fn wrong(error: csv::Error) -> Unreadable {
    Unreadable(format!("no comma-separated values: {error}"))
}

/// What separates the cells of the first line.
fn delimiter(text: &str) -> u8 {
    let line = text.lines().next().unwrap_or("");
    let count = |delimiter: u8| line.bytes().filter(|byte| *byte == delimiter).count();
    [b',', b';', b'\t'].into_iter().max_by_key(|delimiter| (count(*delimiter), *delimiter == b',')).unwrap_or(b',')
}

struct Sheet {
    header: Vec<String>,
    rows: Vec<(u64, Vec<String>)>,
    decimal_comma: bool,
}

impl Sheet {
    fn trace(&self, known: &Known<'_>) -> Result<Trace, Unreadable> {
        let is = |head: &str, word: &str| {
            let head = head.to_ascii_lowercase();
            head == word || head.starts_with(&format!("{word} [")) || head.starts_with(&format!("{word}["))
        };
        let time = self.header.iter().position(|head| is(head, "time"));
        let cycle = self.header.iter().position(|head| is(head, "cycle"));
        let times = match (cycle, time) {
            (None, Some(column)) => Some(self.times(column)?),
            _ => None,
        };
        let mut trace = Trace::new(known.name, known.cycle_time);
        for (column, head) in self.header.iter().enumerate() {
            if Some(column) == time || Some(column) == cycle || head.is_empty() {
                continue;
            }
            trace.signals.push(self.signal(column, head, times.as_deref(), known)?);
        }
        Ok(trace)
    }

    fn times(&self, column: usize) -> Result<Vec<u64>, Unreadable> {
        let head = self.header[column].to_ascii_lowercase();
        let unit = [("[s]", 1e9), ("[us]", 1e3), ("[ns]", 1.0)].into_iter().find(|(unit, _)| head.contains(unit));
        let unit = unit.map_or(1e6, |(_, nanos)| nanos);
        let mut out: Vec<u64> = Vec::new();
        for (line, row) in &self.rows {
            let text = row.get(column).map_or("", String::as_str);
            let value = self.decimal(text).parse::<f64>().ok().filter(|value| *value >= 0.0 && value.is_finite());
            let value = value.ok_or_else(|| Unreadable(format!("line {line}: `{text}` is no time")))?;
            let nanos = (value * unit).round() as u64;
            if out.last().is_some_and(|last| *last > nanos) {
                return Err(Unreadable(format!("line {line}: the time goes back")));
            }
            out.push(nanos);
        }
        Ok(out)
    }

    fn decimal(&self, text: &str) -> String {
        if self.decimal_comma { text.replace(',', ".") } else { text.to_owned() }
    }

    fn signal(
        &self,
        column: usize,
        head: &str,
        times: Option<&[u64]>,
        known: &Known<'_>,
    ) -> Result<Signal, Unreadable> {
        let (name, declared) = match head.split_once(':') {
            Some((name, ty)) => (name.trim(), type_named(ty.trim())),
            None => (head, None),
        };
        let texts: Vec<String> =
            self.rows.iter().map(|(_, row)| self.decimal(row.get(column).map_or("", String::as_str))).collect();
        let kind = (known.kind)(&name.to_ascii_lowercase())
            .or_else(|| declared.map(Kind::from))
            .unwrap_or_else(|| guess(&texts));
        let mut values = Vec::new();
        for ((line, _), text) in self.rows.iter().zip(&texts) {
            let wrong = || {
                let ty = type_name(kind.scalar);
                Unreadable(format!("line {line}: `{text}` is no value of `{name}`, which is of type {ty}"))
            };
            values.push(parse(&kind, text).ok_or_else(wrong)?);
        }
        if let Some(times) = times {
            let (first, last) = (times.first().copied().unwrap_or(0), times.last().copied().unwrap_or(0));
            let samples = Samples { name: name.to_owned(), values: times.iter().copied().zip(values).collect() };
            let count = if times.is_empty() { 0 } else { cycles(first, last, known.cycle_time) };
            values = samples.held(first, known.cycle_time, count)?;
        }
        Ok(Signal { name: name.to_owned(), kind, role: Role::Output, values })
    }
}

/// The kind of a column that nobody has declared, by its values: numbers, durations, or names.
fn guess(texts: &[String]) -> Kind {
    const TRIED: [Scalar; 5] = [
        Scalar::Int { signed: true, width: 64 },
        Scalar::Int { signed: false, width: 64 },
        Scalar::Time(64),
        Scalar::Real(64),
        Scalar::Bits(64),
    ];
    let words = ["TRUE", "FALSE", "T", "F"];
    if !texts.is_empty() && texts.iter().all(|text| words.iter().any(|word| word.eq_ignore_ascii_case(text))) {
        return Scalar::Bool.into();
    }
    let fits = |scalar: &Scalar| texts.iter().all(|text| parse(&Kind::from(*scalar), text).is_some());
    if let Some(scalar) = TRIED.into_iter().find(fits) {
        return scalar.into();
    }
    let mut names: Vec<&String> = Vec::new();
    for text in texts {
        if !names.iter().any(|name| name.eq_ignore_ascii_case(text)) {
            names.push(text);
        }
    }
    let labels = (0..).zip(names).map(|(value, name)| (value, name.clone())).collect();
    Kind { scalar: Scalar::Int { signed: true, width: 64 }, labels }
}
