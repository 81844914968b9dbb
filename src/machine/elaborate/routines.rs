//! Routines: a body with the class of its instance, its parameters and locals. They are asked for by whoever calls them and
//! lowered one after the other.

use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use super::access::Spot;
use super::classes::{LayoutKey, edge_key, last_key};
use super::memory::{Placement, at};
use super::world::Code;
use super::{Elaborator, Lowered, Unsupported};
use crate::library::names::fold;
use crate::library::{ItemId, ItemKind, Section};
use crate::machine::program::{Location, Role, Routine, RoutineId, SlotId, Statement, StatementKind};
use crate::semantics::expr::{Expr, ExprKind, Op};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::{Type, apply};
use crate::syntax::NodeKind;
use crate::syntax::ast::{self, AstNode};
use crate::text::Place;

/// A variable.
pub(super) type Variable = Spot;

/// What a routine is made for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum RoutineKey {
    /// The body of an item, on an instance of a class.
    Code(ItemId, Option<ItemId>),
    /// What starts an instance of a class.
    Start(ItemId),
    /// What hands a call through a reference to the class's own method.
    Relay(usize, ItemId),
}

/// A parameter of a function or method, in the order of its declaration.
#[derive(Clone, Debug)]
pub(super) struct Parameter {
    pub(super) key: String,
    pub(super) section: Section,
    pub(super) spot: Spot,
    /// Whether a call may leave it out.
    pub(super) has_initial: bool,
}

/// The slots of a function or a method.
#[derive(Clone, Debug, Default)]
pub(super) struct Frame {
    pub(super) variables: BTreeMap<String, Spot>,
    pub(super) parameters: Vec<Parameter>,
    pub(super) result: Option<Spot>,
    locals: Vec<(SlotId, u32)>,
    dynamic: Vec<usize>,
}

/// Where lowering is.
#[derive(Clone, Debug)]
pub(super) struct Body {
    /// Whose text it is.
    pub(super) item: ItemId,
    /// The class of `THIS`.
    pub(super) class: Option<ItemId>,
    pub(super) frame: Option<Rc<Frame>>,
    pub(super) out: Vec<Statement>,
    /// The statement's place.
    pub(super) place: Option<Place>,
}

impl Body {
    pub(super) const fn nowhere() -> Self {
        Self { item: ItemId(0), class: None, frame: None, out: Vec::new(), place: None }
    }

    /// To evaluate a constant in the scope of an item.
    pub(super) const fn constant(item: ItemId, class: Option<ItemId>) -> Self {
        Self { item, class, frame: None, out: Vec::new(), place: None }
    }
}

impl<'c> Elaborator<'c> {
    pub(super) fn emit(&mut self, kind: StatementKind) {
        let place = self.body.place;
        self.body.out.push(Statement { kind, place });
    }

    /// The statements that `lower` emits.
    pub(super) fn block(&mut self, lower: impl FnOnce(&mut Self) -> Lowered<()>) -> Lowered<Vec<Statement>> {
        let outer = std::mem::take(&mut self.body.out);
        let lowered = lower(self);
        let inner = std::mem::replace(&mut self.body.out, outer);
        lowered.map(|()| inner)
    }

    /// The number of a routine, which will be lowered.
    pub(super) fn routine(&mut self, key: RoutineKey) -> RoutineId {
        if let Some(known) = self.routine_ids.get(&key) {
            return *known;
        }
        let id = RoutineId(u32::try_from(self.routines.len()).unwrap_or(u32::MAX));
        self.routines.push(None);
        self.routine_ids.insert(key, id);
        self.queue.push_back((key, id));
        id
    }

    /// Lowers every routine that was asked for.
    pub(super) fn work(&mut self) {
        while let Some((key, id)) = self.queue.pop_front() {
            let routine = self.lower(key);
            let routine = self.tell(routine);
            if let Some(slot) = self.routines.get_mut(id.0 as usize) {
                *slot = routine;
            }
        }
    }

    fn lower(&mut self, key: RoutineKey) -> Lowered<Routine> {
        match key {
            RoutineKey::Code(item, class) => self.lower_code(item, class),
            RoutineKey::Start(class) => {
                let name = format!("{}.$start", self.world.item(class).name);
                let outer = std::mem::replace(&mut self.body, Body::constant(class, Some(class)));
                let started = self.start_fields(class);
                let inner = std::mem::replace(&mut self.body, outer);
                started.map(|()| Routine { name, item: None, body: inner.out, locals: Vec::new() })
            }
            RoutineKey::Relay(dispatch, class) => self.lower_relay(dispatch, class),
        }
    }

    /// The body of a block, program, function, method, action or accessor.
    fn lower_code(&mut self, item: ItemId, class: Option<ItemId>) -> Lowered<Routine> {
        self.cone.insert(item);
        let declared = self.world.item(item);
        let is_block = class.is_some() && declared.parent.is_none();
        let frame = if is_block || declared.kind == ItemKind::Action { None } else { Some(self.frame(item, class)?) };
        let name = match class {
            Some(class) if declared.parent.is_some() => format!("{}.{}", self.world.item(class).name, declared.name),
            _ => declared.name.clone(),
        };
        let mut locals = frame.as_ref().map(|frame| frame.locals.clone()).unwrap_or_default();
        if is_block {
            locals.extend(self.temporaries(item)?);
        }
        let place = self.world.place_of(item);
        let body = Body { item, class, frame: frame.clone(), out: Vec::new(), place };
        let outer = std::mem::replace(&mut self.body, body);
        let lowered = self.lower_parts(item, class.filter(|_| is_block), frame.as_deref());
        let inner = std::mem::replace(&mut self.body, outer);
        lowered.map(|()| Routine { name, item: Some(item), body: inner.out, locals })
    }

    fn lower_parts(&mut self, item: ItemId, block: Option<ItemId>, frame: Option<&Frame>) -> Lowered<()> {
        if let Some(class) = block {
            self.edges(item, class)?;
        }
        if let Some(frame) = frame {
            let decls = self.decls(item);
            for number in &frame.dynamic {
                let spot = frame.variables.get(&fold(decls[*number].name)).cloned();
                if let Some(spot) = spot {
                    let started = self.start(item, &decls[*number], &spot);
                    self.tell(started);
                }
            }
        }
        if self.stub(item).is_some_and(|stub| stub.arbitrary) {
            return Ok(());
        }
        match self.world.code(item) {
            Code::Empty => Ok(()),
            Code::Other(what) => {
                let message = format!("`{}` has {what}", self.world.item(item).name);
                Err(Unsupported::new(what, self.world.place_of(item), message)
                    .help("give it a stub in the configuration"))
            }
            Code::Text(bodies) => {
                bodies.into_iter().for_each(|body| self.lower_body(body));
                Ok(())
            }
        }
    }

    fn lower_body(&mut self, body: ast::Body<'c>) {
        let broken = body.node().descendants().find(|node| node.kind() == NodeKind::Error);
        if let Some(node) = broken {
            let error = self.unsupported("text that cannot be read", node, "this text cannot be read");
            self.errors.push(error);
        }
        if body.is_chart() {
            let lowered = self.chart(body);
            self.tell(lowered);
            return;
        }
        let statements: Vec<ast::Statement<'c>> = body.statements().collect();
        self.statements(statements.into_iter());
    }

    /// What a call finds out of `R_EDGE` and `F_EDGE` inputs: a slot that holds in the cycle of the edge.
    fn edges(&mut self, item: ItemId, class: ItemId) -> Lowered<()> {
        let layout = self.layout(LayoutKey::Class(class))?;
        let this = Spot::this(self.instance_type(class));
        for field in layout.fields.iter().filter(|field| field.owner == item) {
            let Some(rising) = field.decl.and_then(|decl| decl.edge) else { continue };
            let hidden = |key: &str| layout.fields.iter().find(|field| field.key == key).map(|field| this.field(field));
            let (Some(edge), Some(last)) = (hidden(&edge_key(&field.key)), hidden(&last_key(&field.key))) else {
                continue;
            };
            let now = this.field(field).read();
            let before = last.read();
            let (high, low) = if rising { (now.clone(), before) } else { (before, now.clone()) };
            let low = apply(Op::Not, Scalar::Bool, vec![low], None);
            let value = apply(Op::And, Scalar::Bool, vec![high, low], None);
            self.emit(StatementKind::Assign { target: edge.location, value, range: None });
            self.emit(StatementKind::Assign { target: last.location, value: now, range: None });
        }
        Ok(())
    }

    /// The slots of a block's `VAR_TEMP`, which all of its instances share, since they do not last.
    fn temporaries(&mut self, item: ItemId) -> Lowered<Vec<(SlotId, u32)>> {
        let mut locals = Vec::new();
        for (n, decl) in self.decls(item).iter().enumerate() {
            if decl.section == Section::Temp && !self.is_constant_scalar(item, n)? {
                let spot = self.static_variable(item, n, Role::Temporary)?;
                let size = self.known_size(&spot.type_)?;
                if let crate::machine::program::Base::Slot(slot) = spot.location.base {
                    locals.push((slot, size));
                }
            }
        }
        Ok(locals)
    }

    /// The slots of a function, method or accessor.
    pub(super) fn frame(&mut self, item: ItemId, class: Option<ItemId>) -> Lowered<Rc<Frame>> {
        let key = RoutineKey::Code(item, class);
        if let Some(known) = self.frames.get(&key) {
            return Ok(Rc::clone(known));
        }
        let mut frame = Frame::default();
        let prefix = self.world.qualified_name(item);
        for (n, decl) in self.decls(item).iter().enumerate() {
            if matches!(decl.section, Section::External | Section::Stat | Section::Inst)
                || self.is_constant_scalar(item, n)?
            {
                continue;
            }
            let type_ = self.type_of(item, n)?;
            self.size(&type_, decl.var)?;
            let values = self.initial_values(item, decl, &type_)?;
            let role = if decl.constant { Role::Constant } else { Role::Temporary };
            let name = format!("{prefix}.{}", decl.name);
            let placement = Placement { name, role, place: self.place(decl.var.node()) };
            let slot = self.put(&type_, &values.values, &placement)?;
            let spot = Spot { location: at(slot), type_, constant: decl.constant };
            let length = u32::try_from(values.values.len()).unwrap_or(u32::MAX);
            if matches!(decl.section, Section::Input | Section::InOut | Section::Output) {
                let has_initial = decl.section != Section::InOut;
                let parameter =
                    Parameter { key: fold(decl.name), section: decl.section, spot: spot.clone(), has_initial };
                frame.parameters.push(parameter);
            }
            if !matches!(decl.section, Section::Input | Section::InOut) {
                frame.locals.push((slot, length));
                if values.dynamic {
                    frame.dynamic.push(n);
                }
            }
            frame.variables.insert(fold(decl.name), spot);
        }
        self.add_result(item, &prefix, &mut frame)?;
        let frame = Rc::new(frame);
        self.frames.insert(key, Rc::clone(&frame));
        Ok(frame)
    }

    /// The slot of the result, under the name of the function; a setter's input, under the name of the property.
    fn add_result(&mut self, item: ItemId, prefix: &str, frame: &mut Frame) -> Lowered<()> {
        let declared = self.world.item(item);
        let typed = match declared.kind {
            ItemKind::Getter | ItemKind::Setter => self.world.parent(item).unwrap_or(item),
            _ => item,
        };
        let Some(type_) = self.world.header_type(typed) else { return Ok(()) };
        if type_.node().text().eq_ignore_ascii_case("VOID") {
            return Ok(());
        }
        let type_ = self.resolve(type_, typed)?;
        let values = self.defaults(&type_)?.values;
        let name = fold(&self.world.item(typed).name);
        let arbitrary = self.stub(item).is_some_and(|stub| stub.arbitrary);
        let role = if arbitrary { Role::Arbitrary } else { Role::Temporary };
        let placement = Placement { name: prefix.to_owned(), role, place: self.world.place_of(typed) };
        let slot = self.put(&type_, &values, &placement)?;
        let spot = Spot { location: at(slot), type_, constant: false };
        frame.variables.entry(name.clone()).or_insert_with(|| spot.clone());
        if declared.kind == ItemKind::Setter {
            frame.parameters.push(Parameter { key: name, section: Section::Input, spot, has_initial: false });
        } else {
            if !arbitrary {
                frame.locals.push((slot, u32::try_from(values.len()).unwrap_or(u32::MAX)));
            }
            frame.result = Some(spot);
        }
        Ok(())
    }

    /// Calls what starts an instance.
    pub(super) fn call_start(&mut self, class: ItemId, location: &Location) {
        let routine = self.routine(RoutineKey::Start(class));
        self.emit(StatementKind::Call { routine, this: Some(location.clone()) });
    }

    /// A variable that is in no instance and in no frame: static, temporary of a block, global.
    pub(super) fn static_variable(&mut self, item: ItemId, n: usize, role: Role) -> Lowered<Spot> {
        if let Some(known) = self.statics.get(&(item, n)) {
            return Ok(known.clone());
        }
        let decls = self.decls(item);
        let decl = decls[n];
        let (slot, type_) = self.put_declared(item, n, &decl, role)?;
        let spot = Spot { location: at(slot), type_, constant: decl.constant };
        self.statics.insert((item, n), spot.clone());
        let values = self.initial_values(item, &decl, &spot.type_)?;
        if values.dynamic && role != Role::Temporary {
            self.at_start(item, None, |this| this.start(item, &decl, &spot))?;
        }
        Ok(spot)
    }

    /// Statements for the start of the program, lowered in the scope of an item.
    pub(super) fn at_start(
        &mut self,
        item: ItemId,
        class: Option<ItemId>,
        lower: impl FnOnce(&mut Self) -> Lowered<()>,
    ) -> Lowered<()> {
        let outer = std::mem::replace(&mut self.body, Body::constant(item, class));
        let lowered = lower(self);
        let inner = std::mem::replace(&mut self.body, outer);
        self.startup.extend(inner.out);
        lowered
    }
}

impl Spot {
    /// The instance that a routine is called on.
    pub(super) const fn this(type_: Type) -> Self {
        let location = Location { base: crate::machine::program::Base::This, offset: 0, indices: Vec::new() };
        Self { location, type_, constant: false }
    }

    /// The value of a scalar variable.
    pub(super) fn read(&self) -> Expr<Location> {
        let scalar = self.type_.scalar().unwrap_or(Scalar::Ref);
        Expr { kind: ExprKind::Read(self.location.clone()), scalar, place: None }
    }

    /// Its address.
    pub(super) fn address(&self) -> Expr<Location> {
        Expr { kind: ExprKind::Address(self.location.clone()), scalar: Scalar::Ref, place: None }
    }

    /// A pointer to it, as a type.
    pub(super) fn pointer_type(&self) -> Type {
        Type::Reference { target: Arc::new(self.type_.clone()), implicit: false }
    }
}
