//! From the catalogue to a program: names are looked up, types resolved, layouts made, bodies lowered.
//!
//! Routines are made for a body and the class of the instance that it is called on, so that a method that a derived block
//! overrides is found without a table; only calls through references and interfaces are left to the run. A function that is
//! called in an expression is called before it: what was evaluated further left is kept in temporary slots where a call could
//! change it, so that the order of evaluation is that of the text.
//!
//! Nothing here stops at the first construct that is not modelled: each is told with its place, and the rest goes on.

mod access;
mod addresses;
mod arguments;
mod calls;
mod cases;
mod classes;
mod conditional;
mod constants;
mod control;
mod dispatch;
mod elements;
mod expressions;
mod finish;
mod functions;
mod initial;
mod lookup;
mod memory;
mod operators;
mod pointers;
mod properties;
mod routines;
mod sfc;
mod shelf;
mod statements;
mod texts;
mod types;
mod unit;
mod world;

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::rc::Rc;

use super::program::{Program, Routine, RoutineId, Slot, SlotId, Statement};
use crate::library::names::Names;
use crate::library::{Catalogue, ItemId};
use crate::semantics::typing::{Operand, Type, TypeError};
use crate::syntax::Node;
use crate::text::Place;

use classes::Layout;
use routines::{Body, Frame, RoutineKey};
use shelf::Shelf;
use world::{Decl, World};

/// How a unit is elaborated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// The cycle time in nanoseconds.
    pub cycle_time: u64,
    /// The most slots that a unit may have.
    pub memory_limit: u32,
    /// Values of constants, as literals, by their names (`N` or `GVL.N`): they replace those of the source.
    pub constants: BTreeMap<String, String>,
    /// Blocks that have no source.
    pub stubs: Vec<Stub>,
    /// The symbols that `{IF defined (…)}` finds defined.
    pub symbols: BTreeSet<String>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            cycle_time: 10_000_000,
            memory_limit: 1 << 20,
            constants: BTreeMap::new(),
            stubs: Vec::new(),
            symbols: BTreeSet::new(),
        }
    }
}

/// What stands for blocks that have no source: an assumption of every verdict on what uses them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stub {
    /// Declarations in Structured Text, with bodies or without.
    pub text: String,
    /// Whether the outputs of these blocks have any value in each cycle, whatever the bodies do.
    pub arbitrary: bool,
}

/// A construct that is not modelled.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Unsupported {
    /// Where; `None` for the text of a standard block or a stub.
    pub place: Option<Place>,
    /// What kind of construct it is, without names, so that reasons can be counted.
    pub construct: &'static str,
    /// What exactly, in one line.
    pub message: String,
    /// What would help; empty if nothing.
    pub help: String,
}

impl Unsupported {
    fn new(construct: &'static str, place: Option<Place>, message: impl Into<String>) -> Self {
        Self { place, construct, message: message.into(), help: String::new() }
    }

    fn help(mut self, help: impl Into<String>) -> Self {
        self.help = help.into();
        self
    }
}

impl From<TypeError> for Unsupported {
    fn from(error: TypeError) -> Self {
        let help = error.help.unwrap_or_default();
        Self { place: error.place, construct: "types that do not fit", message: error.message, help }
    }
}

/// What lowering gives.
type Lowered<T> = Result<T, Unsupported>;

/// The program of `unit`: a function block, class, program or function.
///
/// # Errors
/// Everything in it, and in what it uses, that is not modelled.
pub fn elaborate(
    catalogue: &Catalogue,
    names: &Names,
    unit: ItemId,
    options: &Options,
) -> Result<Program, Vec<Unsupported>> {
    let texts = options.stubs.iter().map(|stub| ("stub", stub.text.as_str()));
    let stubs = Shelf::parse(texts);
    let standard = shelf::standard();
    let parts = [(catalogue, names), (&stubs.catalogue, &stubs.names), (&standard.catalogue, &standard.names)];
    let world = World::new(&parts, &options.symbols);
    let mut elaborator = Elaborator::new(world, options);
    let faults = stubs.faults.iter().map(|fault| Unsupported::new("a stub that cannot be read", None, fault.clone()));
    elaborator.errors.extend(faults);
    elaborator.program(unit)
}

/// Work in progress.
struct Elaborator<'c> {
    world: World<'c>,
    options: &'c Options,
    errors: Vec<Unsupported>,
    slots: Vec<Slot>,
    routines: Vec<Option<Routine>>,
    routine_ids: BTreeMap<RoutineKey, RoutineId>,
    queue: VecDeque<(RoutineKey, RoutineId)>,
    frames: BTreeMap<RoutineKey, Rc<Frame>>,
    decls: BTreeMap<ItemId, Rc<Vec<Decl<'c>>>>,
    types: BTreeMap<(ItemId, usize), Type>,
    open_types: BTreeSet<(ItemId, usize)>,
    constants: BTreeMap<(ItemId, usize), Option<Operand<super::program::Location>>>,
    open_constants: BTreeSet<(ItemId, usize)>,
    enum_values: BTreeMap<ItemId, Rc<Vec<(String, i128)>>>,
    structures: Vec<types::StructureDef<'c>>,
    structure_ids: BTreeMap<(usize, u32), u32>,
    layouts: BTreeMap<classes::LayoutKey, Rc<Layout<'c>>>,
    open_layouts: BTreeSet<classes::LayoutKey>,
    defaults: BTreeMap<classes::LayoutKey, Rc<initial::Defaults>>,
    statics: BTreeMap<(ItemId, usize), routines::Variable>,
    addresses: BTreeMap<String, routines::Variable>,
    program_instances: BTreeMap<ItemId, SlotId>,
    /// Slots of globals and addresses: first, length, what they are.
    globals: Vec<finish::Global>,
    instances: Vec<(SlotId, ItemId)>,
    clocks: Vec<(SlotId, u64)>,
    clock_slots: BTreeMap<u32, SlotId>,
    startup: Vec<Statement>,
    dispatches: Vec<dispatch::Pending>,
    extended: Option<BTreeSet<ItemId>>,
    cone: BTreeSet<ItemId>,
    assumptions: BTreeSet<String>,
    body: Body,
}

impl<'c> Elaborator<'c> {
    fn new(world: World<'c>, options: &'c Options) -> Self {
        Self {
            extended: None,
            world,
            options,
            errors: Vec::new(),
            slots: Vec::new(),
            routines: Vec::new(),
            routine_ids: BTreeMap::new(),
            queue: VecDeque::new(),
            frames: BTreeMap::new(),
            decls: BTreeMap::new(),
            types: BTreeMap::new(),
            open_types: BTreeSet::new(),
            constants: BTreeMap::new(),
            open_constants: BTreeSet::new(),
            enum_values: BTreeMap::new(),
            structures: Vec::new(),
            structure_ids: BTreeMap::new(),
            layouts: BTreeMap::new(),
            open_layouts: BTreeSet::new(),
            defaults: BTreeMap::new(),
            statics: BTreeMap::new(),
            addresses: BTreeMap::new(),
            program_instances: BTreeMap::new(),
            globals: Vec::new(),
            instances: Vec::new(),
            clocks: Vec::new(),
            clock_slots: BTreeMap::new(),
            startup: Vec::new(),
            dispatches: Vec::new(),
            cone: BTreeSet::new(),
            assumptions: BTreeSet::new(),
            body: Body::nowhere(),
        }
    }

    /// Keeps what is not modelled, and goes on.
    fn tell<T>(&mut self, lowered: Lowered<T>) -> Option<T> {
        lowered.map_err(|error| self.errors.push(error)).ok()
    }

    fn place(&self, node: Node<'_>) -> Option<Place> {
        self.world.place(node)
    }

    /// A construct that is not modelled, at `node`.
    fn unsupported(&self, construct: &'static str, node: Node<'_>, message: impl Into<String>) -> Unsupported {
        Unsupported::new(construct, self.place(node), message)
    }

    /// Something that the text leaves out.
    fn incomplete(&self, node: Node<'_>) -> Unsupported {
        self.unsupported("text that cannot be read", node, "the statement is incomplete")
    }

    /// The variables that the item declares.
    fn decls(&mut self, item: ItemId) -> Rc<Vec<Decl<'c>>> {
        if let Some(known) = self.decls.get(&item) {
            return Rc::clone(known);
        }
        let found = Rc::new(self.world.declared(item));
        self.decls.insert(item, Rc::clone(&found));
        self.cone.insert(item);
        found
    }
}
