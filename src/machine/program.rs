//! The elaborated program: names, overloads, implicit conversions, inheritance and layouts are gone. What is left are
//! typed assignments over one flat memory of scalar slots, control flow, and calls of routines.
//!
//! *Memory.* Every variable is a range of slots: a structure its members in order, an array its elements (the last
//! dimension fastest), a string `STRING(n)` of n + 1 characters (`Bits(8)` or `Bits(16)`) closed by a zero, an instance of a
//! block a header slot (of type `Ref`, which gives it an address of its own) and its variables, inherited ones first. Local
//! variables of functions and methods are slots of the program too, since nothing recurses; they are set anew at each call.
//! In-outs, references, pointers and interface variables are slots of type `Ref`.

use crate::library::ItemId;
use crate::semantics::expr::{Expr, Fault};
use crate::semantics::scalar::Scalar;
use crate::text::Place;

/// An expression over memory.
pub type Value = Expr<Location>;

/// The number of a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SlotId(pub u32);

/// The number of a routine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RoutineId(pub u32);

/// A unit under test with all that it uses.
#[derive(Clone, Debug)]
pub struct Program {
    /// The name of the unit.
    pub name: String,
    /// The unit.
    pub unit: ItemId,
    /// The memory.
    pub slots: Vec<Slot>,
    /// The routines; a caller's number is no guide to its callees'.
    pub routines: Vec<Routine>,
    /// Runs once, before the first cycle: `FB_Init`, references with an initial target.
    pub startup: Vec<Statement>,
    /// Runs in each cycle: the unit's call.
    pub cycle: Vec<Statement>,
    /// The slot where the unit's own instance begins; `This` of its body.
    pub this: SlotId,
    /// The classes of the instances, by their header slot, ascending.
    pub instances: Vec<(SlotId, ItemId)>,
    /// At the beginning of each cycle, so much is added to the slot, modulo its width: `TIME()` and the timers' clocks.
    pub clocks: Vec<(SlotId, u64)>,
    /// The cycle time in nanoseconds.
    pub cycle_time: u64,
    /// What the verdict rests on besides the source: stubs, arbitrary outputs.
    pub assumptions: Vec<String>,
    /// Every item whose text the program is made from, ascending: what a verdict depends on.
    pub cone: Vec<ItemId>,
    /// The values, as bits, of every enumeration that a variable of [`Program::variables`] has.
    pub enumerations: std::collections::BTreeMap<ItemId, Vec<u64>>,
    /// The whole variables of the unit that tables may name, with their types, in the order of declaration.
    pub variables: Vec<NamedVariable>,
}

/// A variable that a table may name: a scalar one, or a part of a structure, an array or an instance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedVariable {
    /// The path as it is written: `Ext`, `Timer.Q`, `Points[3].X`.
    pub path: String,
    /// The slot.
    pub slot: SlotId,
    /// Its type.
    pub scalar: Scalar,
    /// The enumeration that the type is, if it is one.
    pub enumeration: Option<ItemId>,
    /// What it is for.
    pub role: Role,
}

/// What a slot is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// Set by the environment at the beginning of each cycle.
    Input,
    /// Read by the environment at the end of each cycle; it lasts from cycle to cycle.
    Output,
    /// Lasts from cycle to cycle.
    State,
    /// Set before it is read in each cycle or call; its value does not last.
    Temporary,
    /// Never changes.
    Constant,
    /// Set by the environment in each cycle to any value: an output of a block that has no source.
    Arbitrary,
}

/// A slot of memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Slot {
    /// The full path of what it belongs to.
    pub name: String,
    /// Its type.
    pub scalar: Scalar,
    /// Its value before the first cycle.
    pub initial: u64,
    /// What it is for.
    pub role: Role,
    /// The numbers that it may hold, where its type is a subrange; checked where it is assigned.
    pub range: Option<(i128, i128)>,
    /// Where it is declared.
    pub place: Option<Place>,
}

/// A body that is called.
#[derive(Clone, Debug)]
pub struct Routine {
    /// Its name, `FB_Cylinder`, `FB_Cylinder.Reset`.
    pub name: String,
    /// The item whose body it is.
    pub item: Option<ItemId>,
    /// What it does; [`Base::This`] is the instance that it is called on.
    pub body: Vec<Statement>,
    /// The slots that are set to their initial values at each call: locals, temporaries.
    pub locals: Vec<(SlotId, u32)>,
}

/// A scalar, or the beginning of a range of slots, in memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location {
    /// Where it begins.
    pub base: Base,
    /// So many slots further on.
    pub offset: u32,
    /// And so many elements further on.
    pub indices: Vec<Index>,
}

/// Where a location begins.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Base {
    /// At a slot of the program.
    Slot(SlotId),
    /// At the header of the instance that the routine is called on.
    This,
    /// Where this value, a [`Scalar::Ref`], refers to. Null is a fault.
    Referent(Box<Value>),
}

/// A step into an array.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Index {
    /// The index, an integer of any type.
    pub value: Value,
    /// The lowest index.
    pub low: i64,
    /// How many elements there are; outside is a fault.
    pub count: u32,
    /// How many slots an element has.
    pub stride: u32,
}

/// A statement with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// What it does.
    pub kind: StatementKind,
    /// Where it stands; `None` for what the elaboration added.
    pub place: Option<Place>,
}

/// The forms of a statement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StatementKind {
    /// Sets a scalar. A value outside `range` is a fault.
    Assign {
        /// What is set.
        target: Location,
        /// To what, of the target's type.
        value: Value,
        /// The target's subrange.
        range: Option<(i128, i128)>,
    },
    /// Copies a range of slots of the same types; the ranges may overlap.
    Copy {
        /// Where to.
        target: Location,
        /// Where from.
        source: Location,
        /// How many slots.
        length: u32,
    },
    /// Sets slots to their initial values.
    Reset {
        /// The first one.
        target: Location,
        /// How many.
        length: u32,
    },
    /// `IF`; `ELSIF` is nested.
    If {
        /// The condition, a `BOOL`.
        condition: Value,
        /// What is done if it holds.
        then: Vec<Statement>,
        /// What is done if not.
        otherwise: Vec<Statement>,
    },
    /// `CASE`: the first arm with a range in which the number lies.
    Case {
        /// The selector, an integer.
        selector: Value,
        /// What is done for which numbers.
        arms: Vec<Arm>,
        /// `ELSE`.
        otherwise: Vec<Statement>,
    },
    /// `FOR`: `control := from`, then while it has not passed `to`: the body, `control := control + by`. `from`, `to` and
    /// `by` are evaluated once, before `control` is set; the comparison is made on numbers before they are cut to the width,
    /// so that it ends where the type does.
    For {
        /// The control variable, an integer.
        control: Location,
        /// Its type.
        scalar: Scalar,
        /// The first value.
        from: Value,
        /// The last one.
        to: Value,
        /// The step; zero is a [`Fault::LoopLimit`].
        by: Value,
        /// The body.
        body: Vec<Statement>,
    },
    /// A loop that only `Exit` and `Return` leave: `WHILE` and `REPEAT` are such with an `IF … THEN Exit`. `Continue` goes to
    /// `after`, which is done after each iteration of the body.
    Loop {
        /// The body.
        body: Vec<Statement>,
        /// What follows each iteration: the test of `REPEAT`.
        after: Vec<Statement>,
    },
    /// Leaves the innermost loop.
    Exit,
    /// Goes on with the next iteration of the innermost loop.
    Continue,
    /// Leaves the routine.
    Return,
    /// Calls a routine; its inputs have been assigned before, its outputs are read after.
    Call {
        /// Which.
        routine: RoutineId,
        /// The instance that it is called on.
        this: Option<Location>,
    },
    /// Calls a method by the class of the instance that `target` refers to. Null is a fault.
    Dispatch {
        /// A [`Scalar::Ref`] to an instance.
        target: Value,
        /// The routines by class.
        routines: Vec<(ItemId, RoutineId)>,
    },
    /// An operation on strings.
    Text(Box<TextOperation>),
    /// Stops the run with a fault.
    Fail(Fault),
}

/// An arm of `CASE`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arm {
    /// Closed ranges of numbers.
    pub labels: Vec<(i128, i128)>,
    /// What is done.
    pub body: Vec<Statement>,
}

/// A string in memory: `capacity + 1` slots. Operations fill what is behind the closing zero with zeros.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Text {
    /// The first character.
    pub location: Location,
    /// How many characters it holds, the closing zero not counted.
    pub capacity: u32,
}

/// An operation on strings. A result that is longer than its target is cut.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextOperation {
    /// `target := source`.
    Assign(Text, Text),
    /// `target := literal`, as character codes without the closing zero.
    Literal(Text, Vec<u16>),
    /// A `BOOL` for the order of two strings by character codes.
    Compare {
        /// The result, a `BOOL`.
        target: Location,
        /// Which comparison.
        order: TextOrder,
        /// The left one.
        left: Text,
        /// The right one.
        right: Text,
    },
    /// `LEN`, into an integer of the type.
    Length(Location, Scalar, Text),
    /// `CONCAT` of two.
    Concat(Text, Text, Text),
    /// `LEFT(source, count)`.
    Left(Text, Text, Value),
    /// `RIGHT(source, count)`.
    Right(Text, Text, Value),
    /// `MID(source, length, position)`, position from 1.
    Mid(Text, Text, Value, Value),
    /// `FIND(haystack, needle)`: the position from 1, or 0, into an integer of the type.
    Find(Location, Scalar, Text, Text),
    /// `INSERT(first, second, position)`: `second` behind the character at `position` of `first`.
    Insert(Text, Text, Text, Value),
    /// `DELETE(source, length, position)`.
    Delete(Text, Text, Value, Value),
    /// `REPLACE(first, second, length, position)`.
    Replace(Text, Text, Text, Value, Value),
}

/// A comparison of strings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TextOrder {
    /// `=`
    Equal,
    /// `<`
    Less,
    /// `<=`
    LessOrEqual,
}
