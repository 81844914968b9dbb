//! What a proof covered, as records keep it: a table that proves nothing must look like it.

use serde::{Deserialize, Serialize};

/// What a proof covered.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coverage {
    /// Rows that some run reaches.
    pub rows: Ratio,
    /// Statements that some run within the table executes.
    pub statements: Ratio,
    /// Ways of branches that some run within the table takes.
    pub branches: Ratio,
    /// Outputs that no row which a run reaches constrains.
    pub free_outputs: Vec<String>,
    /// Outputs that some rows constrain and some do not.
    pub free_cells: Vec<FreeCells>,
    /// Why the verdict proves nothing; empty where it proves something.
    pub vacuous: Vec<String>,
    /// Each row, statement and way of a branch with its fate.
    pub items: Vec<Item>,
    /// The runs that show what is reached.
    pub witnesses: Vec<Witness>,
    /// Small changes to the block that the table catches or not, where they were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mutants: Option<Mutants>,
}

/// So many of so many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ratio {
    /// How many.
    pub hit: u64,
    /// Of how many.
    pub total: u64,
}

/// Rows that leave an output free.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FreeCells {
    /// The output.
    pub output: String,
    /// The rows.
    pub rows: Vec<String>,
}

/// What can be reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// A row of the table.
    Row,
    /// A statement of the block.
    Statement,
    /// A way of a branch of the block.
    Branch,
}

/// A row, a statement, or a way of a branch.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Item {
    /// What it is.
    pub kind: Kind,
    /// The row's name, the beginning of the statement, or the condition with the way.
    pub name: String,
    /// The file, below the root of the tree.
    pub file: String,
    /// The line, from 1.
    pub line: u32,
    /// What is known of it.
    pub fate: Fate,
}

/// What is known of an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "word", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Fate {
    /// A run comes there.
    Reached {
        /// Which of [`Coverage::witnesses`].
        witness: usize,
        /// In which cycle, from 1.
        cycle: usize,
    },
    /// No run ever does: it was proven, and the proof was checked again.
    Never,
    /// No run of so many cycles does.
    NotWithin {
        /// How many.
        cycles: usize,
    },
}

/// A run that shows what is reached. It was played on the interpreter and on the game of the table.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Witness {
    /// The table's global variables: name and value.
    pub globals: Vec<(String, String)>,
    /// The names of the inputs.
    pub inputs: Vec<String>,
    /// Stretches of cycles with the same inputs.
    pub stretches: Vec<Stretch>,
}

/// Some cycles with the same inputs.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stretch {
    /// How many.
    pub cycles: u64,
    /// The values, in the order of the inputs.
    pub values: Vec<String>,
}

/// Small changes to the block, each held against the table.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mutants {
    /// How many changes there could have been; where it is more than [`Mutants::list`] has, every so-manieth was taken.
    pub possible: u64,
    /// The changes, in the order of the source.
    pub list: Vec<Mutant>,
}

/// A small change to the block.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mutant {
    /// The file, below the root of the tree.
    pub file: String,
    /// The line, from 1.
    pub line: u32,
    /// What was changed.
    pub change: String,
    /// What became of it.
    pub outcome: Outcome,
}

/// What became of a mutant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "word", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Outcome {
    /// It violates the table.
    Caught {
        /// In which cycle, from 1.
        cycle: usize,
    },
    /// It conforms to the table, in runs of every length.
    Survived,
    /// No run of so many cycles violates the table.
    NotCaught {
        /// How many.
        cycles: usize,
    },
    /// It does the same as the block: nothing could catch it.
    Equivalent,
    /// It is not modelled, or no table can be bound to it.
    Unsupported,
}

impl Mutants {
    /// Those that were caught, of those that could have been.
    #[must_use]
    pub fn score(&self) -> Ratio {
        let count = |wanted: &dyn Fn(Outcome) -> bool| self.list.iter().filter(|m| wanted(m.outcome)).count() as u64;
        let hit = count(&|outcome| matches!(outcome, Outcome::Caught { .. }));
        let out = count(&|outcome| matches!(outcome, Outcome::Equivalent | Outcome::Unsupported));
        Ratio { hit, total: self.list.len() as u64 - out }
    }

    /// Those that were not caught and could have been.
    pub fn survivors(&self) -> impl Iterator<Item = &Mutant> {
        self.list.iter().filter(|mutant| matches!(mutant.outcome, Outcome::Survived | Outcome::NotCaught { .. }))
    }
}

impl Outcome {
    /// In words.
    #[must_use]
    pub fn text(self) -> String {
        match self {
            Self::Caught { cycle } => format!("caught in cycle {cycle}"),
            Self::Survived => "survives: it conforms to the table".to_owned(),
            Self::NotCaught { cycles } => format!("survives: no violation in the first {cycles} cycles"),
            Self::Equivalent => "equivalent: it does the same as the block".to_owned(),
            Self::Unsupported => "not modelled".to_owned(),
        }
    }
}

impl Fate {
    /// In words.
    #[must_use]
    pub fn text(self) -> String {
        match self {
            Self::Reached { cycle, .. } => format!("in cycle {cycle}"),
            Self::Never => "never".to_owned(),
            Self::NotWithin { cycles } => format!("not in {cycles} cycles"),
        }
    }
}

impl Coverage {
    /// The items of a kind, and how many of them are reached.
    #[must_use]
    pub fn ratio(items: &[Item], kind: Kind) -> Ratio {
        let own = || items.iter().filter(|item| item.kind == kind);
        let hit = own().filter(|item| matches!(item.fate, Fate::Reached { .. })).count();
        Ratio { hit: hit as u64, total: own().count() as u64 }
    }

    /// What is not reached.
    pub fn missed(&self) -> impl Iterator<Item = &Item> {
        self.items.iter().filter(|item| !matches!(item.fate, Fate::Reached { .. }))
    }

    /// All in a line: `rows 4/4 · statements 12/13 · branches 7/8 · unconstrained: Alarm in rows 3`.
    #[must_use]
    pub fn line(&self) -> String {
        let ratio = |name: &str, ratio: Ratio| format!("{name} {}/{}", ratio.hit, ratio.total);
        let mut parts =
            vec![ratio("rows", self.rows), ratio("statements", self.statements), ratio("branches", self.branches)];
        parts.extend(self.mutants.as_ref().map(|mutants| ratio("mutants caught", mutants.score())));
        let mut free = self.free_outputs.clone();
        free.extend(self.free_cells.iter().map(|cells| {
            let rows = if cells.rows.len() == 1 { "row" } else { "rows" };
            format!("{} in {rows} {}", cells.output, cells.rows.join(", "))
        }));
        if !free.is_empty() {
            parts.push(format!("unconstrained: {}", free.join("; ")));
        }
        parts.join(" · ")
    }
}
