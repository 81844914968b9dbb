//! Traces as value change dumps, IEEE 1364 §18, which waveform viewers read.
//!
//! Time is in nanoseconds, a cycle's values stand at its beginning, and a last time stamp ends the last cycle. `BOOL` is a wire
//! of one bit, a `REAL` a real, everything else a wire of its width in two's complement. A comment for each signal says its
//! type. In names, `[` and `]` are written `(` and `)`, since brackets select bits there. A file of another tool is sampled at the
//! beginning of each cycle.

use std::collections::BTreeMap;
use std::io;

use vcd::{Command, Header, IdCode, ScopeItem, TimescaleUnit, Value, VarType};

use super::samples::{MOST, Samples, cycles};
use super::{Kind, Known, Signal, Trace, Unreadable};
use crate::machine::program::Role;
use crate::semantics::scalar::Scalar;
use crate::semantics::show::{type_name, type_named};

/// The word that begins our comments.
const MARK: &str = "rungbook";

/// Writes a trace.
#[must_use]
pub fn write(trace: &Trace) -> Vec<u8> {
    let mut out = Vec::new();
    // Writing into memory cannot fail.
    let _ = dump(trace, &mut out);
    out
}

fn word(name: &str) -> String {
    name.chars()
        .map(|c| match c {
            '[' => '(',
            ']' => ')',
            c if c.is_whitespace() => '_',
            c => c,
        })
        .collect()
}

fn dump(trace: &Trace, out: &mut Vec<u8>) -> io::Result<()> {
    let mut writer = vcd::Writer::new(out);
    for signal in &trace.signals {
        let name = word(&signal.name);
        writer.comment(&format!("{MARK} {name} : {}", type_name(signal.kind.scalar)))?;
    }
    writer.timescale(1, TimescaleUnit::NS)?;
    writer.add_module(&word(&trace.name))?;
    let mut codes = Vec::new();
    for signal in &trace.signals {
        let (name, width) = (word(&signal.name), signal.kind.scalar.width());
        codes.push(match signal.kind.scalar {
            Scalar::Real(_) | Scalar::Fixed { .. } => writer.add_var(VarType::Real, 64, &name, None)?,
            _ => writer.add_wire(width, &name)?,
        });
    }
    writer.upscope()?;
    writer.enddefinitions()?;
    for cycle in 0..trace.cycles() {
        let changed = |signal: &Signal| cycle == 0 || signal.values[cycle] != signal.values[cycle - 1];
        let mut stamped = false;
        for (signal, code) in trace.signals.iter().zip(&codes) {
            if changed(signal) {
                if !stamped {
                    writer.timestamp(cycle as u64 * trace.cycle_time)?;
                    stamped = true;
                }
                change(&mut writer, *code, signal.kind.scalar, signal.values[cycle])?;
            }
        }
    }
    writer.timestamp(trace.cycles() as u64 * trace.cycle_time)
}

fn change(writer: &mut vcd::Writer<&mut Vec<u8>>, code: IdCode, scalar: Scalar, bits: u64) -> io::Result<()> {
    match scalar {
        Scalar::Bool => writer.change_scalar(code, bits != 0),
        Scalar::Real(32) => writer.change_real(code, f64::from(f32::from_bits(bits as u32))),
        Scalar::Real(_) => writer.change_real(code, f64::from_bits(bits)),
        Scalar::Fixed { digits, .. } => {
            let one = 10f64.powi(i32::try_from(digits).unwrap_or(0));
            writer.change_real(code, scalar.number(bits) as f64 / one)
        }
        _ => {
            let bit = |at: u32| Value::from(bits >> at & 1 == 1);
            writer.change_vector(code, (0..scalar.width()).rev().map(bit))
        }
    }
}

/// What the header says about a variable.
struct Variable {
    name: String,
    kind: Kind,
    values: Samples<u64>,
}

/// Reads a trace.
///
/// # Errors
/// What cannot be read, with the line; a value that is unknown (`x`, `z`) counts as none.
pub fn read(text: &[u8], known: &Known<'_>) -> Result<Trace, Unreadable> {
    let mut parser = vcd::Parser::new(text);
    let header = parser.parse_header().map_err(|error| Unreadable(format!("no value change dump: {error}")))?;
    let unit = nanos(&header)?;
    let mut variables = variables(&header, known);
    let (mut now, mut first, mut last) = (0, None, 0);
    for command in &mut parser {
        let command = command.map_err(|error| Unreadable(format!("no value change dump: {error}")))?;
        match command {
            Command::Timestamp(stamp) => {
                now = u64::try_from(u128::from(stamp) * unit / 1000).unwrap_or(u64::MAX);
                first.get_or_insert(now);
                last = now;
            }
            Command::ChangeScalar(code, value) => {
                let bits = match value {
                    Value::V0 => Some(0),
                    Value::V1 => Some(1),
                    Value::X | Value::Z => None,
                };
                note(&mut variables, code, now, bits)?;
            }
            Command::ChangeVector(code, vector) => {
                let bits = vector.iter().try_fold(0_u64, |bits, value| match value {
                    Value::V0 => Some(bits << 1),
                    Value::V1 => Some(bits << 1 | 1),
                    Value::X | Value::Z => None,
                });
                note(&mut variables, code, now, bits)?;
            }
            Command::ChangeReal(code, value) => note_real(&mut variables, code, now, value),
            _ => {}
        }
    }
    let first = first.unwrap_or(0);
    // The last stamp ends the last cycle where something changes before it, and is a cycle of its own where something
    // changes at it.
    let changes_last = variables.values().flatten().any(|v| v.values.values.last().is_some_and(|(at, _)| *at == last));
    let count = if changes_last {
        cycles(first, last, known.cycle_time)
    } else {
        usize::try_from((last - first).div_ceil(known.cycle_time.max(1))).unwrap_or(usize::MAX)
    };
    gather(variables, first, count.min(MOST + 1), known)
}

fn gather(
    variables: BTreeMap<IdCode, Vec<Variable>>,
    first: u64,
    count: usize,
    known: &Known<'_>,
) -> Result<Trace, Unreadable> {
    let mut trace = Trace::new(known.name, known.cycle_time);
    for variable in variables.into_values().flatten() {
        let values = variable.values.held(first, known.cycle_time, count)?;
        trace.signals.push(Signal { name: variable.name, kind: variable.kind, role: Role::Output, values });
    }
    Ok(trace)
}

/// The unit of time in picoseconds.
fn nanos(header: &Header) -> Result<u128, Unreadable> {
    let (count, unit) = header.timescale.unwrap_or((1, TimescaleUnit::NS));
    let unit = match unit {
        TimescaleUnit::S => 1_000_000_000_000,
        TimescaleUnit::MS => 1_000_000_000,
        TimescaleUnit::US => 1_000_000,
        TimescaleUnit::NS => 1000,
        TimescaleUnit::PS => 1,
        _ => return Err(Unreadable("the time scale is finer than a picosecond".to_owned())),
    };
    Ok(u128::from(count) * unit)
}

fn variables(header: &Header, known: &Known<'_>) -> BTreeMap<IdCode, Vec<Variable>> {
    let mut comments = BTreeMap::new();
    for item in &header.items {
        if let ScopeItem::Comment(text) = item {
            let said = text.trim().strip_prefix(MARK).and_then(|rest| rest.trim().split_once(" : "));
            if let Some((name, ty)) = said {
                comments.insert(name.trim().to_ascii_lowercase(), type_named(ty.trim()));
            }
        }
    }
    let mut out = BTreeMap::new();
    collect(&header.items, "", 0, &mut |code, name, kind, width| {
        let path = name.replace('(', "[").replace(')', "]");
        let declared = comments.get(&name.to_ascii_lowercase()).copied().flatten().map(Kind::from);
        let kind = (known.kind)(&path.to_ascii_lowercase()).or(declared).unwrap_or_else(|| by_width(kind, width));
        let values = Samples { name: path.clone(), values: Vec::new() };
        out.entry(code).or_insert_with(Vec::new).push(Variable { name: path, kind, values });
    });
    out
}

/// The variables by their paths below the outermost scope.
fn collect(items: &[ScopeItem], path: &str, depth: usize, found: &mut dyn FnMut(IdCode, String, VarType, u32)) {
    let join = |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
    for item in items {
        match item {
            ScopeItem::Scope(scope) => {
                let below = if depth == 0 { String::new() } else { join(&scope.identifier) };
                collect(&scope.items, &below, depth + 1, found);
            }
            ScopeItem::Var(var) => found(var.code, join(&var.reference), var.var_type, var.size),
            _ => {}
        }
    }
}

fn by_width(kind: VarType, width: u32) -> Kind {
    let bits = [8, 16, 32].into_iter().find(|bits| width <= *bits).unwrap_or(64);
    match kind {
        VarType::Real => Scalar::Real(64),
        VarType::Integer => Scalar::Int { signed: true, width: bits },
        _ if width == 1 => Scalar::Bool,
        _ => Scalar::Int { signed: false, width: bits },
    }
    .into()
}

fn note(
    variables: &mut BTreeMap<IdCode, Vec<Variable>>,
    code: IdCode,
    now: u64,
    bits: Option<u64>,
) -> Result<(), Unreadable> {
    for variable in variables.get_mut(&code).into_iter().flatten() {
        let Some(bits) = bits else {
            if variable.values.values.is_empty() {
                continue;
            }
            return Err(Unreadable(format!("`{}` becomes unknown at {now} ns", variable.name)));
        };
        let bits = crate::semantics::eval::mask(variable.kind.scalar, bits);
        variable.values.values.push((now, bits));
    }
    Ok(())
}

fn note_real(variables: &mut BTreeMap<IdCode, Vec<Variable>>, code: IdCode, now: u64, value: f64) {
    for variable in variables.get_mut(&code).into_iter().flatten() {
        let bits = match variable.kind.scalar {
            Scalar::Real(32) => u64::from((value as f32).to_bits()),
            Scalar::Real(_) => value.to_bits(),
            scalar => crate::semantics::eval::unary(
                crate::semantics::expr::Op::Convert,
                scalar,
                Scalar::Real(64),
                value.to_bits(),
            ),
        };
        variable.values.values.push((now, bits));
    }
}
