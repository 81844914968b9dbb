//! The compact form of a program: absolute addresses where they are known, places as numbers.

use crate::library::ItemId;
use crate::machine::program::TextOrder;
use crate::semantics::eval::FaultAt;
use crate::semantics::expr::{Fault, Op};
use crate::semantics::scalar::Scalar;
use crate::text::Place;

/// A compact program.
#[derive(Debug)]
pub(super) struct Code {
    pub(super) initial: Vec<u64>,
    pub(super) scalars: Vec<Scalar>,
    pub(super) routines: Vec<Body>,
    pub(super) startup: Vec<Do>,
    pub(super) cycle: Vec<Do>,
    pub(super) this: u32,
    pub(super) clocks: Vec<(u32, u64, Scalar)>,
    /// The classes of instances by their headers, ascending.
    pub(super) instances: Vec<(u32, ItemId)>,
    pub(super) places: Vec<Option<Place>>,
    pub(super) loop_limit: u64,
}

/// A routine.
#[derive(Debug)]
pub(super) struct Body {
    pub(super) statements: Vec<Do>,
    pub(super) locals: Vec<(u32, u32)>,
}

/// The number of a place in [`Code::places`].
pub(super) type PlaceId = u32;

/// A fault and the number of its place in one word, so that a result fits into two registers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop(u64);

const FAULTS: [Fault; 5] =
    [Fault::DivisionByZero, Fault::IndexOutOfBounds, Fault::SubrangeViolation, Fault::LoopLimit, Fault::NullReference];

impl Stop {
    #[cold]
    pub(super) fn new(fault: Fault, place: PlaceId) -> Self {
        let number = FAULTS.iter().position(|other| *other == fault).unwrap_or(0);
        Self(u64::from(place) << 8 | number as u64)
    }
}

impl Code {
    /// The fault as others see it.
    pub(super) fn explain(&self, stop: Stop) -> FaultAt {
        let fault = FAULTS[(stop.0 & 0xFF) as usize % FAULTS.len()];
        FaultAt { fault, place: self.places.get((stop.0 >> 8) as usize).copied().flatten() }
    }
}

/// An expression.
#[derive(Debug)]
pub(super) enum Node {
    Const(u64),
    /// The value of a slot.
    Slot(u32),
    /// The value of a slot so far behind the header of `THIS`.
    Member(u32),
    Load(Box<Address>),
    AddressOf(Box<Address>),
    /// Complement of a `BOOL`.
    Not(Box<Node>),
    /// Whether a whole number is this one.
    Is(Box<Node>, u64),
    Unary(Op, Scalar, Scalar, Box<Node>),
    Binary(Box<Binary>),
    Select(Box<[Node; 3]>),
    AndThen(Box<[Node; 2]>),
    OrElse(Box<[Node; 2]>),
    If(Box<[Node; 3]>),
}

/// An operator with two operands.
#[derive(Debug)]
pub(super) struct Binary {
    pub(super) op: Op,
    pub(super) of: Scalar,
    pub(super) left: Node,
    pub(super) right: Node,
    pub(super) place: PlaceId,
}

/// An address that is computed.
#[derive(Debug)]
pub(super) struct Address {
    pub(super) base: Start,
    pub(super) offset: u32,
    pub(super) steps: Vec<Step>,
}

/// Where an address begins.
#[derive(Debug)]
pub(super) enum Start {
    Slot(u32),
    This,
    Referent(Node, PlaceId),
}

/// A step into an array.
#[derive(Debug)]
pub(super) struct Step {
    pub(super) value: Number,
    pub(super) low: i128,
    pub(super) count: u32,
    pub(super) stride: u32,
    pub(super) place: PlaceId,
}

/// An expression that is read as a number.
#[derive(Debug)]
pub(super) struct Number {
    pub(super) node: Node,
    pub(super) scalar: Scalar,
}

/// A statement.
#[derive(Debug)]
pub(super) enum Do {
    SetSlot(u32, Node, PlaceId),
    SetMember(u32, Node, PlaceId),
    Set(Box<Set>),
    Copy { target: Box<Address>, source: Box<Address>, length: u32, place: PlaceId },
    Reset { target: Box<Address>, length: u32, place: PlaceId },
    If(Box<If>),
    Case(Box<Case>),
    For(Box<For>),
    Loop(Box<Loop>),
    Exit,
    Continue,
    Return,
    Call { routine: u32, this: Option<Box<Address>>, place: PlaceId },
    Dispatch(Box<Dispatch>),
    Text(Box<TextDo>, PlaceId),
    Fail(Stop),
}

/// An assignment with a computed address or a subrange.
#[derive(Debug)]
pub(super) struct Set {
    pub(super) target: Address,
    pub(super) value: Number,
    pub(super) range: Option<(i128, i128)>,
    pub(super) place: PlaceId,
}

#[derive(Debug)]
pub(super) struct If {
    pub(super) condition: Node,
    pub(super) then: Vec<Do>,
    pub(super) otherwise: Vec<Do>,
}

#[derive(Debug)]
pub(super) struct Case {
    pub(super) selector: Number,
    pub(super) arms: Vec<Arm>,
    pub(super) otherwise: Vec<Do>,
}

/// An arm of `CASE`.
#[derive(Debug)]
pub(super) struct Arm {
    pub(super) labels: Vec<(i128, i128)>,
    pub(super) body: Vec<Do>,
}

#[derive(Debug)]
pub(super) struct For {
    pub(super) control: Address,
    pub(super) scalar: Scalar,
    pub(super) from: Number,
    pub(super) to: Number,
    pub(super) by: Number,
    pub(super) body: Vec<Do>,
    /// How often the body may be done.
    pub(super) limit: u64,
    pub(super) place: PlaceId,
}

#[derive(Debug)]
pub(super) struct Loop {
    pub(super) body: Vec<Do>,
    pub(super) after: Vec<Do>,
    pub(super) place: PlaceId,
}

#[derive(Debug)]
pub(super) struct Dispatch {
    pub(super) target: Node,
    /// Routines by class, ascending.
    pub(super) routines: Vec<(ItemId, u32)>,
    pub(super) place: PlaceId,
}

/// A string in memory.
#[derive(Debug)]
pub(super) struct Area {
    pub(super) first: Address,
    pub(super) capacity: u32,
}

/// An operation on strings.
#[derive(Debug)]
pub(super) enum TextDo {
    Make(Area, Make),
    Measure(Address, Scalar, Measure),
}

/// What makes a string.
#[derive(Debug)]
pub(super) enum Make {
    Assign(Area),
    Literal(Vec<u64>),
    Concat(Area, Area),
    Left(Area, Number),
    Right(Area, Number),
    Mid(Area, Number, Number),
    Insert(Area, Area, Number),
    Delete(Area, Number, Number),
    Replace(Area, Area, Number, Number),
}

/// What makes a number of strings.
#[derive(Debug)]
pub(super) enum Measure {
    Compare(TextOrder, Area, Area),
    Length(Area),
    Find(Area, Area),
}
