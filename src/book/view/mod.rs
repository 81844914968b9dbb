//! What templates see. Only these types (and the records of evidence) derive `Serialize`.

pub mod coverage;
pub mod entity;
pub mod finding;
pub mod prose;
pub mod run;
pub mod table;

use serde::Serialize;

use coverage::Coverage;
use entity::{EntityLink, EntityView};
use finding::{CodeCount, FindingView, ReadingView, SkippedView};
use prose::{Block, Inline};

/// A whole manual, ready to be rendered.
#[derive(Clone, Debug, Serialize)]
pub struct Book {
    /// Title page.
    pub front: Front,
    /// The totals that every output quotes.
    pub totals: Totals,
    /// The narrative pages, in order.
    pub chapters: Vec<Chapter>,
    /// The libraries, in order.
    pub libraries: Vec<LibraryView>,
    /// The entities: by library, then folder, then kind, then name.
    pub entities: Vec<EntityView>,
    /// Entities by kind: the lists of the pages `function-blocks.html` and so on.
    pub kinds: Vec<KindList>,
    /// Everything with a name, sorted by it without regard to case.
    pub index: Vec<IndexEntry>,
    /// Documented and verified.
    pub coverage: Coverage,
    /// All findings, by file and place.
    pub findings: Vec<FindingView>,
    /// The same, counted by code.
    pub codes: Vec<CodeCount>,
    /// How the files were read, each way once.
    pub readings: Vec<ReadingView>,
    /// Files that are not in the manual although their kind is read.
    pub skipped: Vec<SkippedView>,
    /// Names that are used and belong to no file of this tree, with how often.
    pub externals: Vec<(String, usize)>,
    /// The pages that explain the codes that occur.
    pub explanations: Vec<Chapter>,
}

/// What the title page says. Strings are empty where nothing is known.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Front {
    /// What the document is: `Reference manual`, `Evidence report`.
    pub genre: String,
    /// Title.
    pub title: String,
    /// Subtitle.
    pub subtitle: String,
    /// The version of what is documented.
    pub version: String,
    /// `2026-11-22`.
    pub date: String,
    /// The commit of what is documented, shortened.
    pub commit: String,
    /// Author or company.
    pub author: String,
    /// `rungbook 0.1.0`.
    pub tool: String,
    /// BCP 47 language tag.
    pub language: String,
}

/// Counts that HTML, PDF, JSON and the console all quote.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Totals {
    /// Files that were read as source.
    pub files: usize,
    /// Files that were not, although their kind is read.
    pub files_skipped: usize,
    /// Files that are no PLC source.
    pub files_other: usize,
    /// Libraries.
    pub libraries: usize,
    /// Entities, members included.
    pub entities: usize,
    /// Those with documentation.
    pub documented: usize,
    /// Those without.
    pub undocumented: usize,
    /// Test tables.
    pub tables: usize,
    /// Test tables by verdict, in the order of the verdicts; only those that occur.
    pub verdicts: Vec<(String, usize)>,
    /// Findings of severity error.
    pub errors: usize,
    /// Findings of severity warning.
    pub warnings: usize,
    /// Findings of severity info.
    pub infos: usize,
}

/// A library.
#[derive(Clone, Debug, Serialize)]
pub struct LibraryView {
    /// Name.
    pub name: String,
    /// Its overview page below the site's root.
    pub url: String,
    /// The label in the PDF.
    pub label: String,
    /// Version; empty if unknown.
    pub version: String,
    /// Author or company; empty if unknown.
    pub author: String,
    /// `TwinCAT 3 project`, `folder`, …
    pub format: String,
    /// Where it lies below the tree's root; empty for the root itself.
    pub path: String,
    /// Its own description: its README or its project's description.
    pub description: Vec<Block>,
    /// Libraries that it refers to.
    pub references: Vec<String>,
    /// Its folders with their entities, in order.
    pub folders: Vec<FolderView>,
    /// How many entities, members included.
    pub entities: usize,
    /// How many of them have documentation.
    pub documented: usize,
    /// 0 to 100.
    pub documented_percent: usize,
    /// How many test tables.
    pub tables: usize,
}

/// A folder of a library: one page of the site.
#[derive(Clone, Debug, Serialize)]
pub struct FolderView {
    /// Path in the library, outermost first; empty for what lies at its top.
    pub path: Vec<String>,
    /// Its page below the site's root.
    pub url: String,
    /// Its entities, by kind and name.
    pub entities: Vec<Entry>,
}

/// A line in a list of entities.
#[derive(Clone, Debug, Serialize)]
pub struct Entry {
    /// The entity.
    pub link: EntityLink,
    /// Its kind's key.
    pub kind: &'static str,
    /// Its library's name.
    pub library: String,
    /// Its brief description.
    pub brief: Vec<Inline>,
    /// Whether it has documentation.
    pub documented: bool,
    /// How many test tables it has.
    pub tables: usize,
    /// `abstract`, `deprecated`, …
    pub badges: Vec<String>,
}

/// All entities of a kind.
#[derive(Clone, Debug, Serialize)]
pub struct KindList {
    /// The kind's key; `type` gathers structures, enumerations, unions, aliases and subranges.
    pub key: &'static str,
    /// `Function blocks`.
    pub title: &'static str,
    /// Its page below the site's root.
    pub url: String,
    /// The entities.
    pub entries: Vec<Entry>,
}

/// A line of the index.
#[derive(Clone, Debug, Serialize)]
pub struct IndexEntry {
    /// Name as declared.
    pub name: String,
    /// Its kind as a title shows it.
    pub kind_label: &'static str,
    /// Owner or library, to tell equal names apart.
    pub context: String,
    /// Below the site's root, with its anchor.
    pub url: String,
    /// The label in the PDF.
    pub label: String,
    /// The brief description as plain text.
    pub brief: String,
}

/// A narrative page.
#[derive(Clone, Debug, Serialize)]
pub struct Chapter {
    /// Its title.
    pub title: String,
    /// Its page below the site's root.
    pub url: String,
    /// The label in the PDF.
    pub label: String,
    /// What it says.
    pub content: Vec<Block>,
}
