//! The traceability matrix: requirement, block, table, verdict; its holes, and the exceptions that somebody justified.

use std::collections::BTreeMap;

use super::record::Record;
use super::requirements::Requirement;

/// A line of the matrix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// The requirement.
    pub requirement: Requirement,
    /// The blocks that say `@req`, with their tables and verdicts.
    pub blocks: Vec<Block>,
    /// Whether it is met, and if not why.
    pub state: State,
}

/// A block in the matrix.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// The qualified name.
    pub name: String,
    /// Its tables with the words of their verdicts.
    pub tables: Vec<(String, &'static str)>,
}

/// How a requirement stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum State {
    /// Every table of every block is verified, and each block has one.
    Verified,
    /// A table is violated.
    Violated,
    /// A block says that it meets it, and not all is verified.
    Open,
    /// No block meets it, and the list says why.
    Justified,
    /// No block meets it.
    Hole,
}

impl State {
    /// The word.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Verified => "verified",
            Self::Violated => "violated",
            Self::Open => "not verified",
            Self::Justified => "justified exception",
            Self::Hole => "hole",
        }
    }
}

/// The matrix: requirements in the order of their list, then those that only comments name.
///
/// `tags` are the identifiers behind `@req`, each with the block that it stands at.
#[must_use]
pub fn matrix(requirements: &[Requirement], tags: &[(String, String)], records: &[&Record]) -> Vec<Line> {
    let mut tables: BTreeMap<&str, Vec<(String, &'static str)>> = BTreeMap::new();
    for record in records {
        if let Some(block) = &record.claim.block {
            let line = (record.claim.table.name.clone(), record.verdict.word());
            tables.entry(&block.name).or_default().push(line);
        }
    }
    let listed = |id: &str| requirements.iter().any(|requirement| requirement.id == id);
    let mut unlisted: Vec<&String> = tags.iter().map(|(id, _)| id).filter(|id| !listed(id)).collect();
    unlisted.sort();
    unlisted.dedup();
    let extra = unlisted.into_iter().map(|id| Requirement { id: id.clone(), ..Requirement::default() });
    let line = |requirement: Requirement| {
        let mut names: Vec<&String> =
            tags.iter().filter(|(id, _)| *id == requirement.id).map(|(_, block)| block).collect();
        names.sort();
        names.dedup();
        let block = |name: &String| Block {
            name: name.clone(),
            tables: tables.get(name.as_str()).cloned().unwrap_or_default(),
        };
        let blocks: Vec<Block> = names.into_iter().map(block).collect();
        Line { state: state(&requirement, &blocks), requirement, blocks }
    };
    requirements.iter().cloned().chain(extra).map(line).collect()
}

fn state(requirement: &Requirement, blocks: &[Block]) -> State {
    let mut verdicts = blocks.iter().flat_map(|block| &block.tables).map(|(_, verdict)| *verdict);
    if blocks.is_empty() {
        return if requirement.justification.is_empty() { State::Hole } else { State::Justified };
    }
    if verdicts.clone().any(|verdict| verdict == "violated") {
        return State::Violated;
    }
    let bare = blocks.iter().any(|block| block.tables.is_empty());
    if bare || verdicts.any(|verdict| verdict != "verified") { State::Open } else { State::Verified }
}
