//! Sequential function charts: what steps, transitions and actions mean in one call of the block, IEC 61131-3 §6.7.
//!
//! Where the chart comes from (text, PLCopen or TwinCAT XML) does not matter here; conditions and bodies are statements
//! already. A call does this, in order:
//!
//! 1. *Start.* In the first call the initial steps become active.
//! 2. *Evolution* (§6.7.5). Every transition whose steps before it are all active is tested, on the steps that are active at the
//!    beginning of the call. Of transitions that compete for a step the first one wins: by priority, then in the order of the
//!    text. All that fire do so together: the steps before them are left, then the steps behind them are entered. A step
//!    that is left and entered at once stays active.
//! 3. *Step times.* `T` of a step is zero in the call that enters it, goes on while it is active, and stands afterwards.
//! 4. *Actions* (§6.7.4, the block ACTION_CONTROL). From the steps' flags and the qualifiers follows whether an action is on.
//!    A Boolean variable is set to that. A body runs while its action is on, and once more in the call in which it goes off (the final
//!    scan); `P1` and `P0` run it once. The steps' own actions of CODESYS and TwinCAT come first: those of steps that are left, of steps
//!    that are entered, of steps that are active.
//!
//! So an input that lets a transition fire acts on the step behind it in the same call.

mod lower;
#[cfg(test)]
mod tests;

use super::program::{Location, Statement, Value};
use crate::semantics::scalar::Scalar;
use crate::text::Place;

pub use lower::statements;

/// A chart.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The steps.
    pub steps: Vec<Step>,
    /// The transitions, in the order of the text.
    pub transitions: Vec<Transition>,
    /// The actions, in the order in which they are done.
    pub actions: Vec<Action>,
}

/// A step.
#[derive(Clone, Debug)]
pub struct Step {
    /// Its name.
    pub name: String,
    /// Whether the chart begins here.
    pub initial: bool,
    /// Where it stands.
    pub place: Option<Place>,
}

/// A transition.
#[derive(Clone, Debug)]
pub struct Transition {
    /// The steps before it, as indices.
    pub from: Vec<usize>,
    /// The steps behind it.
    pub to: Vec<usize>,
    /// Less is tested earlier.
    pub priority: i128,
    /// What is done before the condition is evaluated.
    pub before: Vec<Statement>,
    /// The condition, a `BOOL`.
    pub condition: Value,
    /// Where it stands.
    pub place: Option<Place>,
}

/// An action, with all steps that it is associated with.
#[derive(Clone, Debug)]
pub struct Action {
    /// Its name.
    pub name: String,
    /// What it drives.
    pub target: Target,
    /// The associations.
    pub associations: Vec<Association>,
}

/// What an action drives.
#[derive(Clone, Debug)]
pub enum Target {
    /// A Boolean variable.
    Variable(Location),
    /// A body.
    Body(Vec<Statement>),
}

/// An action's block at a step.
#[derive(Clone, Debug)]
pub struct Association {
    /// The step, as an index.
    pub step: usize,
    /// The qualifier.
    pub qualifier: Qualifier,
    /// The time, a `TIME`, of a qualifier that has one.
    pub time: Option<Value>,
    /// Where it stands.
    pub place: Option<Place>,
}

/// An action qualifier, IEC 61131-3, table 57, or one of ours for what CODESYS and TwinCAT call a step's own actions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Qualifier {
    /// While the step is active.
    NonStored,
    /// Until it is reset.
    Stored,
    /// Resets.
    Reset,
    /// While the step is active, but not longer than the time.
    Limited,
    /// While the step is active, after the time.
    Delayed,
    /// In the call that enters the step.
    Pulse,
    /// The same, and a body runs once only.
    PulseRising,
    /// In the call that leaves the step; a body runs once.
    PulseFalling,
    /// After the time, until it is reset, even where the step is left before.
    StoredDelayed,
    /// After the time, if the step is active so long; until it is reset.
    DelayedStored,
    /// Until it is reset, but not longer than the time.
    StoredLimited,
    /// A step's own action of CODESYS and TwinCAT: in the call that leaves the step.
    OnExit,
    /// The same, in the call that enters the step.
    OnEntry,
    /// The same, in each call that finds the step active; without a final scan.
    Active,
}

impl Qualifier {
    /// The qualifier that is written so.
    #[must_use]
    pub fn named(text: &str) -> Option<Self> {
        Some(match text.to_ascii_uppercase().as_str() {
            "N" => Self::NonStored,
            "S" => Self::Stored,
            "R" => Self::Reset,
            "L" => Self::Limited,
            "D" => Self::Delayed,
            "P" => Self::Pulse,
            "P1" => Self::PulseRising,
            "P0" => Self::PulseFalling,
            "SD" => Self::StoredDelayed,
            "DS" => Self::DelayedStored,
            "SL" => Self::StoredLimited,
            "ON_EXIT" => Self::OnExit,
            "ON_ENTRY" => Self::OnEntry,
            "ACTIVE" => Self::Active,
            _ => return None,
        })
    }

    /// Whether it has a time.
    #[must_use]
    pub const fn is_timed(self) -> bool {
        matches!(self, Self::Limited | Self::Delayed | Self::StoredDelayed | Self::DelayedStored | Self::StoredLimited)
    }

    /// Of a step's own actions, which are done before all others, the place in their order.
    #[must_use]
    pub const fn own(self) -> Option<usize> {
        match self {
            Self::OnExit => Some(0),
            Self::OnEntry => Some(1),
            Self::Active => Some(2),
            _ => None,
        }
    }

    /// Whether it lasts until it is reset.
    #[must_use]
    pub const fn is_stored(self) -> bool {
        matches!(self, Self::Stored | Self::StoredDelayed | Self::DelayedStored | Self::StoredLimited)
    }
}

/// A variable that a chart needs besides those that the text declares. Each is zero at first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hidden {
    /// Its key, unique in the chart; no text can write it.
    pub key: String,
    /// Its type.
    pub scalar: Scalar,
    /// Whether it is a clock: a `TIME` to which the cycle time is added at the beginning of each cycle.
    pub is_clock: bool,
}

/// The key of a step's flag `X`.
#[must_use]
pub fn active_key(step: &str) -> String {
    format!("{}$x", step.to_lowercase())
}

/// The key of a step's time `T`.
#[must_use]
pub fn time_key(step: &str) -> String {
    format!("{}$t", step.to_lowercase())
}

/// What is said about an action without its statements: enough to know the chart's variables.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outline {
    /// The names of the steps.
    pub steps: Vec<String>,
    /// How many transitions there are.
    pub transitions: usize,
    /// The qualifiers of each action's associations.
    pub actions: Vec<Vec<Qualifier>>,
}

impl Chart {
    /// Its outline.
    #[must_use]
    pub fn outline(&self) -> Outline {
        let qualifiers = |action: &Action| action.associations.iter().map(|each| each.qualifier).collect();
        Outline {
            steps: self.steps.iter().map(|step| step.name.clone()).collect(),
            transitions: self.transitions.len(),
            actions: self.actions.iter().map(qualifiers).collect(),
        }
    }
}

impl Outline {
    /// The variables that the chart needs, in an order that depends on the outline alone.
    #[must_use]
    pub fn hidden(&self) -> Vec<Hidden> {
        let bool = |key: String| Hidden { key, scalar: Scalar::Bool, is_clock: false };
        let time = |key: String, is_clock| Hidden { key, scalar: Scalar::Time(32), is_clock };
        let mut out = vec![bool("started$".to_owned())];
        for step in &self.steps {
            let name = step.to_lowercase();
            out.extend([active_key(step), format!("{name}$was"), format!("{name}$claimed")].map(bool));
            out.extend([time(time_key(step), false), time(format!("{name}$clock"), true)]);
        }
        out.extend((0..self.transitions).map(|n| bool(format!("fires${n}"))));
        for (action, qualifiers) in self.actions.iter().enumerate() {
            out.extend([format!("on${action}"), format!("pulse${action}"), format!("before${action}")].map(bool));
            for (n, qualifier) in qualifiers.iter().enumerate() {
                let id = format!("{action}${n}");
                if qualifier.is_stored() {
                    out.push(bool(format!("stored${id}")));
                }
                if qualifier.is_timed() {
                    out.extend([format!("timed${id}"), format!("over${id}")].map(bool));
                    out.push(time(format!("clock${id}"), true));
                }
            }
        }
        out
    }
}
