//! A block as a transition system for other tools: elaborated, translated, written out.

use std::fmt::Write as _;

use super::Project;
use crate::library::ItemId;
use crate::logic::blast::blast;
use crate::logic::system::System;
use crate::logic::write;
use crate::machine::elaborate::{self, elaborate};
use crate::machine::fixed;
use crate::machine::translate::{self, Translated, translate};
use crate::prove::decide::together;
use crate::text::Place;

/// The form to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// BTOR2, by words.
    Btor2,
    /// SMV as nuXmv reads it, by words.
    Smv,
    /// AIGER 1.9, by bits, as text.
    AigerText,
    /// AIGER 1.9, by bits, binary.
    Aiger,
}

/// The units that have this name.
#[must_use]
pub fn units(project: &Project, name: &str) -> Vec<ItemId> {
    let named =
        project.catalogue.iter().filter(|(_, item)| item.parent.is_none() && item.name.eq_ignore_ascii_case(name));
    named.map(|(id, _)| id).collect()
}

/// The transition system of a unit.
///
/// # Errors
/// Each construct that is not modelled, as a message with its place.
pub fn system(project: &Project, unit: ItemId) -> Result<Translated, Vec<String>> {
    let asked = &project.asked;
    let cycle = asked.cycle.and_then(|nanos| u64::try_from(nanos).ok()).filter(|nanos| *nanos > 0);
    let default = elaborate::Options::default();
    let options = elaborate::Options {
        cycle_time: cycle.unwrap_or(default.cycle_time),
        stubs: asked.stubs.iter().map(|(_, stub)| stub.clone()).collect(),
        ..default
    };
    let mut program = elaborate(&project.catalogue, &project.names, unit, &options).map_err(|list| {
        list.into_iter().map(|one| located(project, one.place, &one.message, &one.help)).collect::<Vec<_>>()
    })?;
    if let Some(reading) = asked.fixed {
        fixed::read(&mut program, reading);
    }
    let options = translate::Options { loop_limit: asked.loop_limit, ..translate::Options::default() };
    translate(&program, &options)
        .map_err(|one| vec![located(project, one.place, &format!("{} is not modelled", one.what), "")])
}

/// A message with the place that it speaks of.
fn located(project: &Project, place: Option<Place>, message: &str, help: &str) -> String {
    let mut text = String::new();
    if let Some(place) = place {
        let at = project.files.line_column(place);
        let _ = write!(text, "{}:{}:{}: ", project.files.get(place.file).path, at.line, at.column);
    }
    text.push_str(message);
    if !help.is_empty() {
        let _ = write!(text, "; {help}");
    }
    text
}

/// A block with its table as binary AIGER, with one bad literal, that some obligation fails, without constraints and
/// with a first value for every latch, because not every tool reads others.
#[must_use]
pub fn obligation(system: &System) -> Vec<u8> {
    let system = together(system);
    let blasted = blast(&system);
    let mut names = write::Names::of(&system, &blasted);
    names.constraints.clear();
    let model = blasted.model.folded();
    if model.latches.len() > blasted.latches.len() {
        names.latches.push("constrained so far".to_owned());
    }
    let free = model.latches.iter().zip(&names.latches).filter(|(latch, _)| latch.initial.is_none());
    let chosen: Vec<String> = free.map(|(_, name)| format!("first {name}")).collect();
    let begun = model.with_first_values();
    if begun.latches.len() > model.latches.len() {
        names.inputs.extend(chosen);
        names.latches.push("begun".to_owned());
    }
    write::binary(&begun, &names)
}

/// The bytes of the file. Operators that the form does not have are written with those that it has.
#[must_use]
pub fn bytes(translated: &Translated, form: Form) -> Vec<u8> {
    let system = &translated.system;
    match form {
        Form::Btor2 => write::btor2(system).into_bytes(),
        Form::Smv => write::smv(system).into_bytes(),
        Form::AigerText | Form::Aiger => {
            let blasted = blast(system);
            let names = write::Names::of(system, &blasted);
            match form {
                Form::AigerText => write::ascii(&blasted.model, &names).into_bytes(),
                _ => write::binary(&blasted.model, &names),
            }
        }
    }
}
