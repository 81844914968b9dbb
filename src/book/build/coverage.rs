//! How much is documented and verified: every output quotes these numbers.

use std::collections::BTreeMap;

use super::{Context, links, tables};
use crate::book::view::coverage::{Coverage, CoverageRow, Hole};
use crate::library::{ItemId, ItemKind};

/// Coverage of the top-level items `order` with their members.
pub(crate) fn coverage(context: &Context<'_>, order: &[ItemId]) -> Coverage {
    let mut coverage = Coverage::default();
    let mut kinds: BTreeMap<usize, CoverageRow> = BTreeMap::new();
    for top in order {
        let name = folder_name(context, *top);
        if coverage.by_folder.last().is_none_or(|row| row.name != name) {
            coverage.by_folder.push(CoverageRow { name, ..CoverageRow::default() });
        }
        for id in std::iter::once(*top).chain(members(context, *top)) {
            let counted = count(context, id);
            let kind = context.catalogue().item(id).kind;
            let rank = ItemKind::ALL.iter().position(|k| *k == kind).unwrap_or(usize::MAX);
            let of_kind = kinds
                .entry(rank)
                .or_insert_with(|| CoverageRow { name: kind.label().to_owned(), ..CoverageRow::default() });
            add(of_kind, &counted);
            add(&mut coverage.total, &counted);
            coverage.by_folder.iter_mut().last().into_iter().for_each(|row| add(row, &counted));
            holes(context, id, &mut coverage);
        }
    }
    coverage.by_kind = kinds.into_values().collect();
    coverage.total.name = "All".to_owned();
    let rows = coverage.by_folder.iter_mut().chain(&mut coverage.by_kind).chain(std::iter::once(&mut coverage.total));
    rows.for_each(percentages);
    coverage
}

/// The members of a top-level item that count: all but accessors.
pub(crate) fn members<'a>(context: &Context<'a>, top: ItemId) -> impl Iterator<Item = ItemId> + use<'a> {
    let catalogue = context.catalogue();
    catalogue.item(top).children.iter().copied().filter(|child| !catalogue.item(*child).kind.is_accessor())
}

fn folder_name(context: &Context<'_>, id: ItemId) -> String {
    let item = context.catalogue().item(id);
    let library = &context.catalogue().libraries[item.library.0 as usize].name;
    std::iter::once(library.as_str()).chain(item.folder.iter().map(String::as_str)).collect::<Vec<_>>().join(" / ")
}

/// Whether an item has documentation. What there is to say of a task stands in its settings.
pub(crate) fn is_documented(context: &Context<'_>, id: ItemId) -> bool {
    let task = context.catalogue().item(id).kind == ItemKind::Task;
    task || context.input.docs.item(id).doc.is_some()
}

fn count(context: &Context<'_>, id: ItemId) -> CoverageRow {
    let item = context.catalogue().item(id);
    let documented = &context.input.docs.variables[id.0 as usize];
    let public = item.variables.iter().zip(documented).filter(|(variable, _)| variable.section.is_interface());
    let (mut variables, mut variables_documented) = (0, 0);
    for (_, entry) in public {
        variables += 1;
        variables_documented += usize::from(entry.doc.is_some());
    }
    let own = |i: &&usize| context.input.tables[**i].item == Some(id);
    let tables: Vec<&usize> =
        context.tables.get(&context.catalogue().top(id)).into_iter().flatten().filter(own).collect();
    let verified = tables.iter().filter(|i| tables::known(context, ***i).key == "verified").count();
    CoverageRow {
        entities: 1,
        documented: usize::from(is_documented(context, id)),
        variables,
        variables_documented,
        tables: tables.len(),
        verified,
        ..CoverageRow::default()
    }
}

fn add(row: &mut CoverageRow, more: &CoverageRow) {
    row.entities += more.entities;
    row.documented += more.documented;
    row.variables += more.variables;
    row.variables_documented += more.variables_documented;
    row.tables += more.tables;
    row.verified += more.verified;
}

fn percentages(row: &mut CoverageRow) {
    row.documented_percent = percent(row.documented, row.entities);
    row.variables_percent = percent(row.variables_documented, row.variables);
    row.verified_percent = percent(row.verified, row.tables);
}

/// Rounded down, so that 100 means all; 100 where there is nothing.
pub(crate) fn percent(part: usize, whole: usize) -> usize {
    (part * 100).checked_div(whole).unwrap_or(100)
}

fn holes(context: &Context<'_>, id: ItemId, coverage: &mut Coverage) {
    let item = context.catalogue().item(id);
    let hole = |what: &str| {
        let at = context.input.files.line_column(item.place);
        Hole {
            link: links::qualified(context, id),
            what: what.to_owned(),
            file: context.input.files.get(item.place.file).path.clone(),
            line: at.line,
        }
    };
    if !is_documented(context, id) {
        coverage.undocumented.push(hole(item.kind.label()));
    }
    for i in context.tables.get(&context.catalogue().top(id)).into_iter().flatten() {
        let table = &context.input.tables[*i];
        if table.item == Some(id) && tables::known(context, *i).key != "verified" {
            let at = context.input.files.line_column(table.table.place);
            let mut hole = hole(&format!("test table {}", table.table.name));
            hole.file.clone_from(&context.input.files.get(table.table.place.file).path);
            hole.line = at.line;
            coverage.unverified.push(hole);
        }
    }
}
