//! `rungbook table instances`: concrete test tables from a generalized one.

use super::{How, InstancesArgs, convert};
use crate::cli::report::progress::Progress;
use crate::cli::{Exit, Failure, say, tree};
use crate::library::ItemKind;
use crate::pipeline::Project;
use crate::table::form::{self, Form};
use crate::table::instances::{self, NoInstance, Options, Strategy, tcunit};
use crate::table::{AttachedTable, Table};

pub(super) fn run(args: &InstancesArgs) -> Result<Exit, Failure> {
    let progress = Progress::new(args.tree.quiet);
    let (project, _) = tree::read(&args.tree, None, &progress)?;
    progress.event(crate::pipeline::Event::Done);
    let attached = find(&project, &args.table)?;
    let (table, no_block) = (&attached.table, || Failure(format!("the block of `{}` is not known", args.table)));
    let bound = attached.bound.as_ref().ok_or_else(no_block)?;
    let unit = project.catalogue.item(bound.unit);
    let strategy = match args.by {
        How::Covering => Strategy::Covering,
        How::Boundary => Strategy::Boundary,
        How::Pairwise => Strategy::Pairwise,
        How::Random => Strategy::Random,
    };
    let options = Options { strategy, count: args.count, seed: args.seed, forever: args.forever };
    let found = match instances::instances(table, bound, &options) {
        Ok(found) => found,
        Err(error) => return none(&project, attached, &error),
    };
    if args.to.as_deref() == Some("tcunit") {
        let program = unit.kind == ItemKind::Program;
        convert::output(&args.output, tcunit::suite(table, bound, &found, &unit.name, program).as_bytes())?;
    } else {
        let form = match (&args.to, args.output.as_os_str() == "-") {
            (None, true) => Form::Pipe,
            (to, _) => convert::form(to.as_deref(), &args.output.to_string_lossy())?,
        };
        let tables: Result<Vec<Table>, String> =
            found.iter().map(|instance| instances::table(table, bound, instance, &unit.name)).collect();
        let tables = tables.map_err(Failure)?;
        let written = form::write(form, &tables.iter().collect::<Vec<_>>()).map_err(Failure)?;
        written.lost.iter().for_each(|lost| say(&format!("left out: {lost}")));
        convert::output(&args.output, &written.content)?;
    }
    say(&format!("{} instances of `{}`", found.len(), table.name));
    Ok(Exit::Ok)
}

/// The table of that name, or the only one of that file.
fn find<'p>(project: &'p Project, wanted: &str) -> Result<&'p AttachedTable, Failure> {
    let file = |attached: &AttachedTable| project.files.get(attached.table.place.file).path.clone();
    let named = project.tables.iter().filter(|attached| attached.table.name.eq_ignore_ascii_case(wanted));
    let in_file = project.tables.iter().filter(|attached| file(attached) == wanted.replace('\\', "/"));
    let found: Vec<&AttachedTable> = named.chain(in_file).collect();
    match found.as_slice() {
        [one] => Ok(one),
        [] => {
            let near = crate::text::near::nearest(wanted, project.tables.iter().map(|a| a.table.name.as_str()));
            let near = near.map_or_else(String::new, |near| format!("; `{near}` is one"));
            Err(Failure(format!("`{wanted}` is neither a table of this tree nor a file that holds one{near}")))
        }
        several => {
            let names: Vec<&str> = several.iter().map(|attached| attached.table.name.as_str()).collect();
            Err(Failure(format!("`{wanted}` is several tables: {}", names.join(", "))))
        }
    }
}

/// Says why there is no instance, with the places of the cells that contradict.
fn none(project: &Project, attached: &AttachedTable, error: &NoInstance) -> Result<Exit, Failure> {
    let table = &attached.table;
    match error {
        NoInstance::Unusable(message) => Err(Failure(format!("`{}` has no instances: {message}", table.name))),
        NoInstance::Undecided => Err(Failure(format!("`{}`: no instance was found in time", table.name))),
        NoInstance::Contradiction(cells) => {
            say(&format!("`{}` has no instance; these cells contradict:", table.name));
            let effective = table.effective();
            for (row, column) in cells {
                let Some(cell) = effective[*row][*column] else { continue };
                let at = project.files.line_column(cell.place);
                let file = &project.files.get(cell.place.file).path;
                let (row, column) = (&table.rows()[*row].id, &table.columns[*column].name);
                say(&format!("  {file}:{}:{}: row `{row}`, `{column}`: {}", at.line, at.column, cell.text));
            }
            Ok(Exit::Findings)
        }
    }
}
