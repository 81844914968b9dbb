//! How much is documented and verified, as pages see it.

use serde::Serialize;

use super::entity::EntityLink;

/// Counts, and the list of holes.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Coverage {
    /// By folder, in the order of the libraries and their folders.
    pub by_folder: Vec<CoverageRow>,
    /// By kind.
    pub by_kind: Vec<CoverageRow>,
    /// Everything.
    pub total: CoverageRow,
    /// What has no documentation.
    pub undocumented: Vec<Hole>,
    /// Test tables without a verdict.
    pub unverified: Vec<Hole>,
}

/// A line of a coverage table. Percentages are rounded down, so that 100 means all.
#[derive(Clone, Debug, Default, Serialize)]
pub struct CoverageRow {
    /// Folder or kind.
    pub name: String,
    /// Entities, members included.
    pub entities: usize,
    /// Those with documentation.
    pub documented: usize,
    /// 0 to 100; 100 where there is nothing to document.
    pub documented_percent: usize,
    /// Variables of interfaces, fields and values.
    pub variables: usize,
    /// Those with documentation.
    pub variables_documented: usize,
    /// 0 to 100.
    pub variables_percent: usize,
    /// Test tables.
    pub tables: usize,
    /// Those verified.
    pub verified: usize,
    /// 0 to 100.
    pub verified_percent: usize,
}

/// Something that is missing.
#[derive(Clone, Debug, Serialize)]
pub struct Hole {
    /// The entity.
    pub link: EntityLink,
    /// What is missing.
    pub what: String,
    /// File below the tree's root.
    pub file: String,
    /// Line, from 1.
    pub line: u32,
}
