//! Checks the artefact of a record again from the sources that lie beside it, years later and on another machine: block and
//! table are read anew, and `recheck/` is asked.

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::time::Duration;

use super::{Asked, Project, artefact, ready};
use crate::config::{ConfigFile, Settings};
use crate::evidence::record::{Artefact, ArtefactKind, Claim, Record};
use crate::machine::elaborate::Stub;
use crate::recheck::invariant;
use crate::recheck::replay::{End, Environment};
use crate::semantics::fixed::Reading;
use crate::source::Memory;
use crate::table::model::Quantity;

/// How long one certificate may take.
const LIMIT: Duration = Duration::from_secs(600);

/// Checks artefacts against one set of sources, by their paths below `sources/`.
#[derive(Default)]
pub struct Checker {
    /// The first claim, and the sources as they are read under its options.
    project: OnceCell<(Claim, Project)>,
}

impl Checker {
    /// Checks `artefact` of `record`.
    ///
    /// # Errors
    /// Why it does not hold, or cannot be checked.
    pub fn check(&self, record: &Record, artefact: &Artefact, files: &BTreeMap<String, Vec<u8>>) -> Result<(), String> {
        let claim = &record.claim;
        let same = |(known, _): &&(Claim, Project)| known.cycle_ns == claim.cycle_ns && known.options == claim.options;
        let known = self.project.get().filter(|known| same(known));
        if let Some((_, project)) = known {
            return Self::held(project, claim, artefact);
        }
        // The first record's reading is kept; one under other options is read for itself.
        match self.project.set((claim.clone(), read(files, claim)?)) {
            Ok(()) => Self::held(&self.project.get().ok_or("the sources cannot be read")?.1, claim, artefact),
            Err((_, own)) => Self::held(&own, claim, artefact),
        }
    }

    fn held(project: &Project, claim: &Claim, artefact: &Artefact) -> Result<(), String> {
        let table = table_of(project, claim)?;
        match artefact.kind {
            ArtefactKind::Certificate => certificate(project, table, artefact),
            ArtefactKind::Run => run(project, table, artefact),
        }
    }
}

/// The tree of the bundle's sources, under the options of the claim.
fn read(files: &BTreeMap<String, Vec<u8>>, claim: &Claim) -> Result<Project, String> {
    let mut fs = Memory::new();
    for (path, bytes) in files {
        if let Some(path) = path.strip_prefix("sources/") {
            fs = fs.with(path, bytes);
        }
    }
    let mut settings = Settings::new(ConfigFile::default()).map_err(|error| error.message)?;
    settings.tables.all.cycle = claim.cycle_ns.map(i128::from);
    for (name, value) in &claim.options {
        if let Some(name) = name.strip_prefix("const ") {
            let value = quantity(value).ok_or_else(|| format!("the option `const {name}` cannot be read"))?;
            settings.tables.all.constants.insert(name.to_owned(), value);
        }
    }
    let mut project = super::read(&fs, "release", &settings, &|_| {});
    project.asked = Asked {
        strict: claim.options.contains_key("strict"),
        loop_limit: claim.options.get("loop-limit").and_then(|limit| limit.parse().ok()).unwrap_or(1_000),
        fixed: claim.options.get("fixed").map(|text| Reading::parse(text)).transpose()?,
        stubs: claim.options.iter().filter_map(|(name, text)| stub(name, text)).collect(),
        ..project.asked
    };
    Ok(project)
}

fn stub(name: &str, text: &str) -> Option<(String, Stub)> {
    let name = name.strip_prefix("stub ")?;
    Some((name.to_owned(), super::stub(name, text)))
}

/// What the claim writes for a time constant: `Cycles(10)`, `Nanos(2000000)`.
fn quantity(text: &str) -> Option<Quantity> {
    let (kind, number) = text.strip_suffix(')')?.split_once('(')?;
    let number = number.parse().ok()?;
    match kind {
        "Cycles" => Some(Quantity::Cycles(number)),
        "Nanos" => Some(Quantity::Nanos(number)),
        _ => None,
    }
}

/// The table that the claim speaks of.
fn table_of(project: &Project, claim: &Claim) -> Result<usize, String> {
    let fits = |index: &usize| {
        let attached = &project.tables[*index];
        let same_block = match (&claim.block, attached.item) {
            (Some(block), Some(item)) => project.catalogue.qualified_name(item) == block.name,
            (None, None) => true,
            _ => false,
        };
        same_block
            && attached.table.name == claim.table.name
            && project.files.get(attached.table.place.file).path == claim.table.file
    };
    (0..project.tables.len())
        .find(fits)
        .ok_or_else(|| format!("the sources hold no table `{}` for its block", claim.table.name))
}

fn certificate(project: &Project, table: usize, artefact: &Artefact) -> Result<(), String> {
    let ready = ready::ready(project, table)?;
    let system = ready.system();
    let certificate = artefact::read_certificate(system, &artefact.value)?;
    invariant::check(system, &certificate, &invariant::within(LIMIT))
        .map_err(|rejection| format!("the certificate is rejected: {rejection:?}"))
}

fn run(project: &Project, table: usize, artefact: &Artefact) -> Result<(), String> {
    let ready = ready::ready(project, table)?;
    let bits = |value: &serde_json::Value| value.as_u64().ok_or("a value is no number");
    let globals = artefact.value["globals"].as_array().ok_or("it has no global variables")?;
    let globals = globals.iter().map(|global| bits(&global["bits"])).collect::<Result<Vec<u64>, _>>()?;
    let inputs = artefact.value["inputs"].as_array().ok_or("it has no inputs")?;
    let columns = inputs
        .iter()
        .map(|input| input["bits"].as_array().ok_or("an input has no values")?.iter().map(bits).collect())
        .collect::<Result<Vec<Vec<u64>>, &str>>()?;
    let names: Vec<&str> = inputs.iter().map(|input| input["name"].as_str().unwrap_or_default()).collect();
    if names != ready.input_names() {
        return Err("its inputs are not those of the block".to_owned());
    }
    let length = artefact.value["cycles"].as_array().map_or(0, Vec::len);
    let cycle = |index: usize| columns.iter().map(|column| column.get(index).copied().unwrap_or(0)).collect();
    let inputs = (0..length).map(cycle).collect();
    let environment = Environment { globals, slots: ready.input_slots(), inputs };
    if artefact.value["end"]["kind"] == "never-ends" {
        let from = artefact.value["end"]["from"].as_u64().and_then(|from| usize::try_from(from.checked_sub(1)?).ok());
        let from = from.ok_or("it does not say where it repeats itself")?;
        return ready
            .repeats(&environment, from)
            .map_err(|error| format!("the run does not go on for ever when it is played again: {error}"));
    }
    match ready.replay(&environment).map_err(|missing| missing.to_string())?.end {
        End::Lost(_) | End::Fault(_) => Ok(()),
        other => Err(format!("the run does not violate the table when it is played again: {other:?}")),
    }
}
