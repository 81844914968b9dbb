//! Recorded runs: what the variables held at the end of each cycle.
//!
//! A trace comes from the interpreter, or from a file that another tool has written; it is shown as a timing diagram and written
//! as CSV and VCD. Cycles are numbered from 1 in everything that people read.

pub mod csv;
pub mod diagram;
pub mod lane;
mod samples;
#[cfg(test)]
mod tests;
pub mod vcd;

use super::interpret::Interpreter;
use super::program::{NamedVariable, Role};
pub use crate::semantics::show::Kind;

/// A recorded run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trace {
    /// What has run.
    pub name: String,
    /// The length of a cycle in nanoseconds.
    pub cycle_time: u64,
    /// What was recorded.
    pub signals: Vec<Signal>,
}

/// A variable over time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signal {
    /// The path as it is written.
    pub name: String,
    /// How its bits are read.
    pub kind: Kind,
    /// What the variable is for.
    pub role: Role,
    /// Its bits, one for a cycle.
    pub values: Vec<u64>,
}

/// Why a recorded file cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unreadable(pub String);

impl std::fmt::Display for Unreadable {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(&self.0)
    }
}

/// What is known about a recorded file from elsewhere.
pub struct Known<'a> {
    /// What has run.
    pub name: &'a str,
    /// The length of a cycle in nanoseconds.
    pub cycle_time: u64,
    /// The kind of a variable, by its path in lower case; `None` leaves it to what the file says.
    pub kind: &'a dyn Fn(&str) -> Option<Kind>,
}

impl Trace {
    /// An empty trace.
    #[must_use]
    pub fn new(name: impl Into<String>, cycle_time: u64) -> Self {
        Self { name: name.into(), cycle_time, signals: Vec::new() }
    }

    /// How many cycles it has.
    #[must_use]
    pub fn cycles(&self) -> usize {
        self.signals.iter().map(|signal| signal.values.len()).min().unwrap_or(0)
    }

    /// The signal of that name; names are not case-sensitive. What a file calls `Main.Fb.Q` is found as `Fb.Q` and as `Q`, if
    /// nothing else is.
    #[must_use]
    pub fn signal(&self, name: &str) -> Option<&Signal> {
        let same = self.signals.iter().find(|signal| signal.name.eq_ignore_ascii_case(name));
        same.or_else(|| {
            let tail = format!(".{}", name.to_ascii_lowercase());
            let mut ends = self.signals.iter().filter(|signal| signal.name.to_ascii_lowercase().ends_with(&tail));
            ends.next().filter(|_| ends.next().is_none())
        })
    }
}

/// Records variables of an interpreter.
#[derive(Clone, Debug)]
pub struct Recorder {
    variables: Vec<NamedVariable>,
    trace: Trace,
}

impl Recorder {
    /// A recorder of `variables`, with the names of their values where they are enumerations.
    #[must_use]
    pub fn new(
        name: &str,
        cycle_time: u64,
        variables: Vec<NamedVariable>,
        labels: &dyn Fn(&NamedVariable) -> Vec<(u64, String)>,
    ) -> Self {
        let signal = |variable: &NamedVariable| Signal {
            name: variable.path.clone(),
            kind: Kind { scalar: variable.scalar, labels: labels(variable) },
            role: variable.role,
            values: Vec::new(),
        };
        let signals = variables.iter().map(signal).collect();
        Self { trace: Trace { name: name.to_owned(), cycle_time, signals }, variables }
    }

    /// Keeps what the variables hold now, as one more cycle.
    pub fn record(&mut self, run: &Interpreter) {
        for (variable, signal) in self.variables.iter().zip(&mut self.trace.signals) {
            signal.values.push(run.get(variable.slot));
        }
    }

    /// What was recorded.
    #[must_use]
    pub fn finish(self) -> Trace {
        self.trace
    }
}
