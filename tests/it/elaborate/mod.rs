//! Elaboration: small programs, run by the interpreter; what is not modelled, with its place; real trees.

mod blocks;
mod calls;
mod corpus;
mod memory;
mod objects;
mod refused;
mod statements;

use rungbook::library::{Catalogue, ItemId};
use rungbook::machine::elaborate::{Options, Unsupported, elaborate};
use rungbook::machine::interpret::Interpreter;
use rungbook::machine::program::Program;
use rungbook::pipeline::Project;

use crate::support::project;

/// The top-level item called `name`.
pub(crate) fn item(catalogue: &Catalogue, name: &str) -> ItemId {
    let mut found = catalogue.iter().filter(|(_, item)| item.parent.is_none() && item.name == name);
    found.next().map(|(id, _)| id).expect("a unit of this name")
}

/// A unit of a tree of one text, elaborated.
pub(crate) fn with(text: &str, unit: &str, options: &Options) -> (Project, Result<Program, Vec<Unsupported>>) {
    let project = project(&[("a.st", text)], "");
    let id = item(&project.catalogue, unit);
    let program = elaborate(&project.catalogue, &project.names, id, options);
    (project, program)
}

/// A program that runs, with its variables by name.
pub(crate) struct Machine {
    pub(crate) program: Program,
    run: Interpreter,
}

impl Machine {
    /// The unit of a text.
    pub(crate) fn new(text: &str, unit: &str) -> Self {
        Self::with(text, unit, &Options::default())
    }

    pub(crate) fn with(text: &str, unit: &str, options: &Options) -> Self {
        let program = with(text, unit, options).1.expect("everything is modelled");
        Self { run: Interpreter::new(&program), program }
    }

    fn slot(&self, path: &str) -> usize {
        let found = self.program.variables.iter().position(|variable| variable.path.eq_ignore_ascii_case(path));
        found.unwrap_or_else(|| panic!("no variable `{path}` in {:?}", self.program.variables))
    }

    /// Sets an input.
    pub(crate) fn set(&mut self, path: &str, number: i128) -> &mut Self {
        let variable = &self.program.variables[self.slot(path)];
        self.run.set(variable.slot, variable.scalar.bits(number));
        self
    }

    /// The number that a variable holds.
    pub(crate) fn get(&self, path: &str) -> i128 {
        let variable = &self.program.variables[self.slot(path)];
        variable.scalar.number(self.run.get(variable.slot))
    }

    /// The bits of a variable.
    pub(crate) fn bits(&self, path: &str) -> u64 {
        self.run.get(self.program.variables[self.slot(path)].slot)
    }

    /// One cycle without a fault.
    pub(crate) fn cycle(&mut self) -> &mut Self {
        self.run.cycle().expect("no fault");
        self
    }

    /// One cycle, which ends in a fault.
    pub(crate) fn fault(&mut self) -> rungbook::semantics::expr::Fault {
        self.run.cycle().expect_err("a fault").fault
    }
}

/// What a function of one expression gives: the type of its result, its text.
pub(crate) fn eval(type_: &str, expression: &str) -> i128 {
    let text = format!("FUNCTION F : {type_}\nF := {expression};\nEND_FUNCTION\n");
    Machine::new(&text, "F").cycle().get("F")
}
