//! The model as one JSON file, for other programs: `rungbook build --json`.
//!
//! A flat list of entities, members included, beside the tables, the findings, the skipped files and
//! the totals. [`SCHEMA`] describes it; a test validates what is written against it.

use serde::Serialize;

use super::view::entity::{CoreView, EntityView, SectionView, TypePart};
use super::view::finding::{FindingView, ReadingView, SkippedView};
use super::view::prose::Inline;
use super::view::{Book, Front, Totals};

/// The JSON Schema of the file (draft 2020-12).
pub const SCHEMA: &str = include_str!("model.schema.json");

/// The version of the format; a change that old readers cannot read raises it.
pub const VERSION: u32 = 1;

#[derive(Serialize)]
struct Model<'a> {
    format_version: u32,
    generator: &'a str,
    front: &'a Front,
    totals: &'a Totals,
    libraries: Vec<Library<'a>>,
    entities: Vec<Entity<'a>>,
    tables: Vec<Table<'a>>,
    findings: &'a [FindingView],
    readings: &'a [ReadingView],
    skipped: &'a [SkippedView],
    externals: Vec<External<'a>>,
}

#[derive(Serialize)]
struct Library<'a> {
    name: &'a str,
    version: &'a str,
    author: &'a str,
    format: &'a str,
    path: &'a str,
    references: &'a [String],
}

#[derive(Serialize)]
struct Entity<'a> {
    kind: &'a str,
    name: &'a str,
    qualified_name: &'a str,
    library: &'a str,
    namespace: &'a [String],
    folder: &'a [String],
    parent: Option<&'a str>,
    file: &'a str,
    line: u32,
    documented: bool,
    brief: String,
    badges: &'a [String],
    #[serde(rename = "type")]
    type_: String,
    extends: Vec<&'a str>,
    implements: Vec<&'a str>,
    variables: Vec<Variable<'a>>,
    page: &'a str,
}

#[derive(Serialize)]
struct Variable<'a> {
    section: &'a str,
    name: &'a str,
    #[serde(rename = "type")]
    type_: String,
    initial: &'a str,
    address: &'a str,
    badges: &'a [String],
    brief: String,
    line: u32,
}

#[derive(Serialize)]
struct Table<'a> {
    name: &'a str,
    entity: &'a str,
    file: &'a str,
    line: u32,
    verdict: &'a str,
    rows: usize,
    columns: Vec<Column<'a>>,
    errors: &'a [String],
}

#[derive(Serialize)]
struct Column<'a> {
    group: &'a str,
    name: &'a str,
}

#[derive(Serialize)]
struct External<'a> {
    name: &'a str,
    uses: usize,
}

/// The model of `book`, with a line break at its end.
///
/// # Panics
/// Never: every key is a string, and no map is involved.
#[must_use]
pub fn render(book: &Book) -> String {
    let model = Model {
        format_version: VERSION,
        generator: &book.front.tool,
        front: &book.front,
        totals: &book.totals,
        libraries: book.libraries.iter().map(library).collect(),
        entities: book.entities.iter().flat_map(entities).collect(),
        tables: book.entities.iter().flat_map(tables).collect(),
        findings: &book.findings,
        readings: &book.readings,
        skipped: &book.skipped,
        externals: book.externals.iter().map(|(name, uses)| External { name, uses: *uses }).collect(),
    };
    let mut text = serde_json::to_string_pretty(&model).expect("views have string keys only");
    text.push('\n');
    text
}

fn library(view: &super::view::LibraryView) -> Library<'_> {
    Library {
        name: &view.name,
        version: &view.version,
        author: &view.author,
        format: &view.format,
        path: &view.path,
        references: &view.references,
    }
}

fn entities(view: &EntityView) -> impl Iterator<Item = Entity<'_>> {
    let members = view.members.iter().map(|member| (&member.core, Some(view.core.qualified_name.as_str())));
    std::iter::once((&view.core, None)).chain(members).map(|(core, parent)| entity(view, core, parent))
}

fn entity<'a>(view: &'a EntityView, core: &'a CoreView, parent: Option<&'a str>) -> Entity<'a> {
    let related = |key: &str| {
        let own = view.relations.iter().filter(|relation| parent.is_none() && relation.key == key);
        own.flat_map(|relation| relation.links.iter().map(|link| link.name.as_str())).collect()
    };
    Entity {
        kind: core.kind,
        name: &core.name,
        qualified_name: &core.qualified_name,
        library: &view.library_name,
        namespace: &view.namespace,
        folder: &view.folder,
        parent,
        file: &core.file,
        line: core.line,
        documented: core.documented,
        brief: Inline::plain(&core.brief),
        badges: &core.badges,
        type_: text(&core.type_),
        extends: related("extends"),
        implements: related("implements"),
        variables: core.sections.iter().flat_map(variables).collect(),
        page: &core.url,
    }
}

fn variables(section: &SectionView) -> impl Iterator<Item = Variable<'_>> {
    section.variables.iter().filter(|variable| variable.inherited_from.is_none()).map(|variable| Variable {
        section: section.key,
        name: &variable.name,
        type_: text(&variable.type_),
        initial: &variable.initial,
        address: &variable.address,
        badges: &variable.badges,
        brief: Inline::plain(&variable.brief),
        line: variable.line,
    })
}

fn text(parts: &[TypePart]) -> String {
    parts.iter().map(|part| part.text.as_str()).collect()
}

fn tables(view: &EntityView) -> impl Iterator<Item = Table<'_>> {
    view.tables.iter().map(|table| Table {
        name: &table.name,
        entity: &view.core.qualified_name,
        file: &table.file,
        line: table.line,
        verdict: table.verdict.key,
        rows: table.rows.len(),
        columns: table.columns.iter().map(|column| Column { group: column.group, name: &column.name }).collect(),
        errors: &table.errors,
    })
}
