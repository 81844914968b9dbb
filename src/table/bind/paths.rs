//! Paths to variables: `Ext`, `Timer.Q`, `Points[3].X`, `GVL.Speed`, `Word.3`.

use super::shapes::Shape;
use super::{Binder, BoundVariable, Leaf, Result, Role, Stop};
use crate::diagnostic::Finding;
use crate::library::names::Found;
use crate::library::{ItemId, ItemKind, Section};
use crate::semantics::expr::{Expr, ExprKind, Op};
use crate::semantics::typing::types::{self, BOOL};
use crate::semantics::typing::{Operand, Type, constant, convert};
use crate::table::cell::ast::{Path, Step};
use crate::table::piece::Piece;
use crate::table::{cell, codes};
use crate::text::Place;
use crate::text::near::nearest;

/// A variable on the way along a path.
struct Way {
    text: String,
    shape: Shape,
    /// The item in which the type of what was reached stands.
    owner: ItemId,
    role: Role,
    root: (ItemId, usize),
}

/// Something wrong in a cell.
pub(super) fn stop(code: &'static crate::diagnostic::Code, place: Place, message: impl Into<String>) -> Box<Stop> {
    Box::new(Stop { finding: Finding::new(code, place, message), unsupported: false })
}

/// Something right that cannot be decided.
pub(super) fn undecided(place: Place, what: impl Into<String>) -> Box<Stop> {
    Box::new(Stop { finding: Finding::new(&codes::TABLE_UNSUPPORTED, place, what), unsupported: true })
}

impl Binder<'_> {
    /// The variable of the unit or of the program that a path leads to, `ago` cycles before; `None` where its first name is
    /// none of a variable.
    pub(super) fn variable(&mut self, path: &Path, ago: u32, place: Place) -> Result<Option<Operand<Leaf>>> {
        let Some((mut way, rest)) = self.start(path, place)? else { return Ok(None) };
        if rest.is_empty()
            && let Some(constant) = self.constant_variable(&way, place)
        {
            return Ok(Some(constant));
        }
        for (at, step) in rest.iter().enumerate() {
            if at + 1 == rest.len()
                && let (Step::Member(bit), Shape::Scalar(type_)) = (step, &way.shape)
                && let Ok(bit) = bit.parse::<u32>()
            {
                let type_ = type_.clone();
                return self.bit(&way, &type_, bit, ago, place).map(Some);
            }
            way = self.step(way, step, place)?;
        }
        let Shape::Scalar(type_) = way.shape.clone() else { return Err(self.no_scalar(&way, place)) };
        Ok(Some(self.read(&way, type_, ago, place)))
    }

    /// The values of an enumeration as bits, with their names.
    pub(super) fn labels(&self, type_: &Type) -> Vec<(u64, String)> {
        let scalar = type_.scalar().unwrap_or(BOOL);
        self.values(type_).into_iter().map(|(name, number)| (scalar.bits(number), name)).collect()
    }

    /// The declared initial value; that of the type where it is no constant, or the variable is a part of another one.
    fn initial(&mut self, way: &Way, type_: &Type, place: Place) -> u64 {
        let first = self.values(type_).first().map_or(0, |(_, number)| *number);
        let least = type_.range().map_or(first, |(low, high)| 0.clamp(low, high));
        let default = type_.scalar().map_or(0, |scalar| scalar.bits(least));
        let whole = !way.text.contains(['[', '.']) || way.role == Role::Global;
        match self.constant_value(way, place).map(Operand::settled) {
            Some(Ok((Expr { kind: ExprKind::Const(bits), .. }, _))) if whole => bits,
            _ => default,
        }
    }

    /// The value of a variable that is declared as a constant, where its initial value is an expression over such.
    fn constant_variable(&mut self, way: &Way, place: Place) -> Option<Operand<Leaf>> {
        self.catalogue.item(way.root.0).variables.get(way.root.1).filter(|variable| variable.constant)?;
        self.constant_value(way, place)
    }

    /// What a variable is declared to begin with.
    fn constant_value(&mut self, way: &Way, place: Place) -> Option<Operand<Leaf>> {
        let variable = self.catalogue.item(way.root.0).variables.get(way.root.1)?;
        let Shape::Scalar(type_) = &way.shape else { return None };
        // A constant that is made of itself has no value.
        if self.calls.contains(&way.text) {
            return None;
        }
        let text = variable.initial.as_deref()?;
        let piece = Piece::verbatim(place.file, text, 0);
        let expr = cell::parse_expression(&piece, &cell::Context::default()).ok()?;
        self.calls.push(way.text.clone());
        let value = self.operand(&expr, None, Some(type_), place.file);
        self.calls.pop();
        let converted = convert::assigned(value.ok()?, type_).ok()?;
        let is_constant = matches!(converted.expr.kind, ExprKind::Const(_));
        is_constant.then(|| Operand::Typed(Expr { place: Some(place), ..converted.expr }, type_.clone()))
    }

    fn read(&mut self, way: &Way, type_: Type, ago: u32, place: Place) -> Operand<Leaf> {
        let scalar = type_.scalar().unwrap_or(BOOL);
        let known = self.by_path.get(&way.text).copied();
        let index = known.unwrap_or_else(|| {
            let enumeration = match &type_ {
                Type::Enumeration { item, .. } => *item,
                _ => None,
            };
            let (path, range, labels) = (way.text.clone(), type_.range(), self.labels(&type_));
            let initial = self.initial(way, &type_, place);
            self.by_path.insert(path.clone(), self.variables.len());
            self.variables.push(BoundVariable {
                path,
                scalar,
                enumeration,
                labels,
                range,
                initial,
                role: way.role,
                root: way.root,
                place,
            });
            self.variables.len() - 1
        });
        let kind = ExprKind::Read(Leaf::Variable { index, ago });
        Operand::Typed(Expr { kind, scalar, place: Some(place) }, type_)
    }

    fn bit(&mut self, way: &Way, type_: &Type, bit: u32, ago: u32, place: Place) -> Result<Operand<Leaf>> {
        let scalar = type_.scalar().filter(|scalar| types::is_whole(*scalar));
        let Some(scalar) = scalar.filter(|scalar| bit < scalar.width()) else {
            let message =
                format!("`{}` is of type `{}`, which has no bit {bit}", way.text, super::shapes::called(type_));
            return Err(stop(&codes::TABLE_TYPE, place, message));
        };
        let Operand::Typed(word, _) = self.read(way, type_.clone(), ago, place) else {
            return Err(undecided(place, "this bit"));
        };
        let operands = vec![word, constant(scalar, u64::from(bit), None)];
        Ok(Operand::of(Expr { kind: ExprKind::Apply(Op::Bit, operands), scalar: BOOL, place: Some(place) }))
    }

    /// The variable that the path begins with, and the steps behind it.
    fn start<'p>(&self, path: &'p Path, place: Place) -> Result<Option<(Way, &'p [Step])>> {
        if path.run.is_some() {
            return Err(undecided(place, "a variable of one of several runs"));
        }
        let unit = self.catalogue.item(self.unit);
        let function = matches!(unit.kind, ItemKind::Function | ItemKind::Method);
        if function && unit.name.eq_ignore_ascii_case(&path.name) {
            let type_ = unit.type_.as_ref().map_or("", |type_| type_.text.as_str());
            let (shape, root) = (self.shape(type_, self.unit), (self.unit, usize::MAX));
            let way = Way { text: unit.name.clone(), shape, owner: self.unit, role: Role::Output, root };
            return Ok(Some((way, &path.steps)));
        }
        match self.names.member(self.catalogue, self.unit, &path.name) {
            Some(Found::Variable(owner, index)) => {
                let role = role(self.catalogue.item(owner).variables[index].section);
                return Ok(Some((self.declared_variable(owner, index, role, ""), &path.steps)));
            }
            Some(Found::Item(_)) => {
                return Err(undecided(place, format!("`{}`, which is a member that is called", path.name)));
            }
            None => {}
        }
        Ok(self.global(path))
    }

    /// `GVL.Speed`, or `Speed`.
    fn global<'p>(&self, path: &'p Path) -> Option<(Way, &'p [Step])> {
        let scope = self.scope(self.unit);
        if let (Some(list), Some((Step::Member(name), rest))) =
            (self.names.top(self.catalogue, &path.name, scope), path.steps.split_first())
        {
            let item = self.catalogue.item(list);
            let holds_variables = matches!(item.kind, ItemKind::GlobalVariables | ItemKind::Program);
            if let Some(Found::Variable(owner, index)) = self.names.member(self.catalogue, list, name)
                && holds_variables
            {
                return Some((self.declared_variable(owner, index, Role::Global, &item.name), rest));
            }
        }
        match self.names.global(self.catalogue, &path.name, scope) {
            Some(Found::Variable(owner, index)) => {
                let list = self.catalogue.item(owner).name.clone();
                Some((self.declared_variable(owner, index, Role::Global, &list), &path.steps))
            }
            _ => None,
        }
    }

    fn declared_variable(&self, owner: ItemId, index: usize, role: Role, list: &str) -> Way {
        let variable = &self.catalogue.item(owner).variables[index];
        let type_ = variable.type_.as_ref().map_or("", |type_| type_.text.as_str());
        let text = if list.is_empty() { variable.name.clone() } else { format!("{list}.{}", variable.name) };
        Way { text, shape: self.shape(type_, owner), owner, role, root: (owner, index) }
    }

    fn step(&self, way: Way, step: &Step, place: Place) -> Result<Way> {
        match (step, &way.shape) {
            (Step::Member(name), Shape::Members(item)) => match self.names.member(self.catalogue, *item, name) {
                Some(Found::Variable(owner, index)) => {
                    let variable = &self.catalogue.item(owner).variables[index];
                    let type_ = variable.type_.as_ref().map_or("", |type_| type_.text.as_str());
                    let shape = self.shape(type_, owner);
                    Ok(Way { text: format!("{}.{}", way.text, variable.name), shape, owner, ..way })
                }
                Some(Found::Item(_)) => Err(undecided(place, format!("`{}.{name}`, which is called", way.text))),
                None => Err(self.no_member(&way, name, &self.member_names(*item), place)),
            },
            (Step::Member(name), Shape::Standard(block)) => match block.variable(name) {
                Some((name, type_)) => {
                    let shape = self.shape(type_, way.owner);
                    Ok(Way { text: format!("{}.{name}", way.text), shape, ..way })
                }
                None => {
                    let names: Vec<&str> = block.variables.iter().map(|(name, _)| *name).collect();
                    Err(self.no_member(&way, name, &names, place))
                }
            },
            (Step::Index(indices), Shape::Array(dimensions, element)) => {
                let text = self.element(&way, indices, dimensions, place)?;
                let shape = self.shape(element, way.owner);
                Ok(Way { text, shape, ..way })
            }
            (Step::Member(name), _) => {
                Err(stop(&codes::TABLE_UNKNOWN_NAME, place, format!("`{}` has no member `{name}`", way.text)))
            }
            (Step::Index(_), _) => Err(stop(&codes::TABLE_TYPE, place, format!("`{}` is no array", way.text))),
        }
    }

    fn element(
        &self,
        way: &Way,
        indices: &[crate::table::cell::ast::Expr],
        dimensions: &[(i64, u32)],
        place: Place,
    ) -> Result<String> {
        if indices.len() != dimensions.len() {
            let message = format!("`{}` has {} dimensions", way.text, dimensions.len());
            return Err(stop(&codes::TABLE_TYPE, place, message));
        }
        let mut numbers = Vec::new();
        for (index, (low, count)) in indices.iter().zip(dimensions) {
            let text = crate::table::cell::print::expression(index, crate::table::cell::print::Style::Ascii);
            let Some(number) = self.number(&text, self.unit) else {
                return Err(undecided(place, format!("the index `{text}`, which is no constant")));
            };
            let (low, end) = (i128::from(*low), i128::from(*low) + i128::from(*count));
            if number < low || number >= end {
                let message = format!("the index {number} is outside of `{}`", way.text);
                let help = format!("it goes from {low} to {}", end - 1);
                let mut stop = stop(&codes::TABLE_TYPE, place, message);
                stop.finding.help.push(help);
                return Err(stop);
            }
            numbers.push(number.to_string());
        }
        Ok(format!("{}[{}]", way.text, numbers.join(",")))
    }

    fn member_names(&self, item: ItemId) -> Vec<&str> {
        let lineage = crate::library::names::lineage(self.catalogue, item);
        let items = lineage.into_iter().map(|id| self.catalogue.item(id));
        items.flat_map(|item| &item.variables).map(|variable| variable.name.as_str()).collect()
    }

    fn no_member(&self, way: &Way, name: &str, names: &[&str], place: Place) -> Box<Stop> {
        let mut stop = stop(&codes::TABLE_UNKNOWN_NAME, place, format!("`{}` has no member `{name}`", way.text));
        let near = nearest(name, names.iter().copied());
        stop.finding.help.extend(near.map(|near| format!("`{}.{near}` is one", way.text)));
        stop
    }

    fn no_scalar(&self, way: &Way, place: Place) -> Box<Stop> {
        let (what, help) = match &way.shape {
            Shape::Members(item) => {
                let first = self
                    .member_names(*item)
                    .first()
                    .map(|name| format!("name one of its variables: `{}.{name}`", way.text));
                (format!("of type `{}`", self.catalogue.item(*item).name), first)
            }
            Shape::Standard(block) => {
                let name = block.variables[0].0;
                (format!("of type `{}`", block.name), Some(format!("name one of its variables: `{}.{name}`", way.text)))
            }
            Shape::Array(dimensions, _) => {
                let lowest: Vec<String> = dimensions.iter().map(|(low, _)| low.to_string()).collect();
                ("an array".to_owned(), Some(format!("name one of its elements: `{}[{}]`", way.text, lowest.join(","))))
            }
            Shape::Other(what) => return undecided(place, format!("`{}`, which is {what}", way.text)),
            Shape::Scalar(_) => (String::new(), None),
        };
        let mut stop = stop(&codes::TABLE_TYPE, place, format!("`{}` is {what}, which is no single value", way.text));
        stop.finding.help.extend(help);
        stop
    }

    /// All names that a cell could mean: variables of the unit, columns, global variables of the table.
    pub(super) fn candidates(&self) -> Vec<&str> {
        let mut out = self.member_names(self.unit);
        out.extend(self.table.columns.iter().map(|column| column.name.as_str()));
        out.extend(self.table.globals.iter().map(|global| global.name.as_str()));
        out
    }
}

const fn role(section: Section) -> Role {
    match section {
        Section::Input => Role::Input,
        Section::Output => Role::Output,
        Section::InOut => Role::InOut,
        Section::External | Section::Global => Role::Global,
        _ => Role::Internal,
    }
}
