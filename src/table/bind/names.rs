//! What a name in a cell means: a global variable of the table, a column, a variable, a value of an enumeration.

use super::paths::stop;
use super::{Binder, Leaf, Result, Stop};
use crate::library::names::fold;
use crate::library::{ItemId, ItemKind};
use crate::semantics::expr::{Expr, ExprKind};
use crate::semantics::typing::{Operand, Type, constant};
use crate::table::cell::ast::{Path, Step};
use crate::table::cell::print;
use crate::table::codes;
use crate::text::Place;
use crate::text::near::nearest;

impl Binder<'_> {
    /// What a path means, `ago` cycles before. `expected` is the type that it is compared with: a value of an enumeration that
    /// is expected hides a variable of its name and of another type.
    pub(super) fn name(
        &mut self,
        path: &Path,
        ago: u32,
        expected: Option<&Type>,
        place: Place,
    ) -> Result<Operand<Leaf>> {
        let found = self.meant(path, ago, expected, place);
        if path.is_plain()
            && ago == 0
            && let Some(type_ @ Type::Enumeration { .. }) = expected
            && let Ok(Operand::Typed(_, other)) = &found
            && other != type_
            && let Some(value) = self.enumerator(type_, &path.name, place)
        {
            return Ok(value);
        }
        found
    }

    fn meant(&mut self, path: &Path, ago: u32, expected: Option<&Type>, place: Place) -> Result<Operand<Leaf>> {
        if let Some(frame) = self.frames.last() {
            let input = frame.iter().find(|(name, _)| path.is_plain() && name.eq_ignore_ascii_case(&path.name));
            return match (input, path.steps.as_slice()) {
                (Some((_, argument)), _) => Ok(argument.clone().at(Some(place))),
                (None, []) => self.short(&path.name, expected, place),
                _ => Err(self.unknown(path, place)),
            };
        }
        // Compared with an enumeration, a name is one of its values, also where a variable of another type has it.
        if let Some(type_ @ Type::Enumeration { .. }) = expected
            && path.is_plain()
            && self.table.global(&path.name).is_none()
            && let Some(value) = self.enumerator(type_, &path.name, place)
        {
            return Ok(value);
        }
        if path.is_plain()
            && let Some(found) = self.global_or_column(path, ago, place)?
        {
            return Ok(found);
        }
        if let Some(found) = self.variable(path, ago, place)? {
            return Ok(found);
        }
        match (path.run.is_none(), path.steps.as_slice()) {
            (true, []) => self.short(&path.name, expected, place),
            (true, [steps @ .., Step::Member(value)]) => {
                let mut type_ = path.name.clone();
                for step in steps {
                    let Step::Member(name) = step else { return Err(self.unknown(path, place)) };
                    type_ = format!("{type_}.{name}");
                }
                match self.enumeration_named(&type_) {
                    Some(id) => self.value_of(id, value, place),
                    None => Err(self.unknown(path, place)),
                }
            }
            _ => Err(self.unknown(path, place)),
        }
    }

    fn global_or_column(&mut self, path: &Path, ago: u32, place: Place) -> Result<Option<Operand<Leaf>>> {
        if let Some(index) = self.table.globals.iter().position(|g| g.name.eq_ignore_ascii_case(&path.name)) {
            return match self.globals.get(index).cloned().flatten() {
                Some(type_) => {
                    let scalar = type_.scalar().unwrap_or(crate::semantics::scalar::Scalar::Bool);
                    let kind = ExprKind::Read(Leaf::Global(index));
                    Ok(Some(Operand::Typed(Expr { kind, scalar, place: Some(place) }, type_)))
                }
                None => {
                    let message = format!("the type of the global variable `{}` is not known", path.name);
                    let mut stop = stop(&codes::TABLE_TYPE, place, message);
                    stop.finding.help.push(format!("declare it: `global {} : INT`", path.name));
                    Err(stop)
                }
            };
        }
        let Some(column) = self.table.column(&path.name) else { return Ok(None) };
        let table = self.table;
        match &table.columns[column].subject {
            super::super::model::Subject::Variable(subject) if subject == path => Ok(None),
            super::super::model::Subject::Variable(subject) => self.name(subject, ago, None, place).map(Some),
            super::super::model::Subject::Projection(_) if ago > 0 => {
                Err(super::paths::undecided(place, format!("the past of the projection `{}`", path.name)))
            }
            super::super::model::Subject::Projection(_) => match self.subjects.get(column) {
                Some(Some(subjects)) if subjects.len() == 1 => Ok(Some(subjects[0].clone().at(Some(place)))),
                _ => Ok(None),
            },
        }
    }

    /// `Colour#GREEN`.
    pub(super) fn qualified(&mut self, type_: &str, value: &str, place: Place) -> Result<Operand<Leaf>> {
        match self.enumeration_named(type_) {
            Some(id) => self.value_of(id, value, place),
            None => {
                let enums = self.catalogue.items.iter().filter(|item| item.kind == ItemKind::Enum);
                let near = nearest(type_, enums.map(|item| item.name.as_str()));
                let mut stop = stop(&codes::TABLE_UNKNOWN_NAME, place, format!("no enumeration is named `{type_}`"));
                stop.finding.help.extend(near.map(|near| format!("`{near}#{value}` names one")));
                Err(stop)
            }
        }
    }

    pub(super) fn enumeration_named(&self, name: &str) -> Option<ItemId> {
        let parts: Vec<&str> = name.split('.').collect();
        match self.names.path(self.catalogue, &parts, self.scope(self.unit)) {
            Some(crate::library::names::Found::Item(id)) if self.catalogue.item(id).kind == ItemKind::Enum => Some(id),
            _ => None,
        }
    }

    fn value_of(&self, id: ItemId, value: &str, place: Place) -> Result<Operand<Leaf>> {
        let type_ = self.enumeration(id);
        match self.enumerator(&type_, value, place) {
            Some(found) => Ok(found),
            None => Err(self.no_value(&type_, value, place)),
        }
    }

    /// The value of that name.
    fn enumerator(&self, type_: &Type, value: &str, place: Place) -> Option<Operand<Leaf>> {
        let scalar = type_.scalar()?;
        let values = self.values(type_);
        let (_, number) = values.iter().find(|(name, _)| name.eq_ignore_ascii_case(value))?;
        Some(Operand::Typed(constant(scalar, scalar.bits(*number), Some(place)), type_.clone()))
    }

    fn no_value(&self, type_: &Type, value: &str, place: Place) -> Box<Stop> {
        let values = self.values(type_);
        let mut stop = stop(&codes::TABLE_UNKNOWN_NAME, place, format!("`{type_}` has no value `{value}`"));
        let near = nearest(value, values.iter().map(|(name, _)| name.as_str()));
        stop.finding.help.extend(near.map(|near| format!("`{near}` is one")));
        stop
    }

    /// `GREEN`: of the type that it is compared with, or of the only enumeration that has it.
    fn short(&mut self, name: &str, expected: Option<&Type>, place: Place) -> Result<Operand<Leaf>> {
        if let Some(type_ @ Type::Enumeration { .. }) = expected {
            return match self.enumerator(type_, name, place) {
                Some(found) => Ok(found),
                None if self.enumerators_named(name).is_empty() => Err(self.unknown_value(type_, name, place)),
                None => Err(self.no_value(type_, name, place)),
            };
        }
        let mut found = self.enumerators_named(name);
        let own = self.catalogue.item(self.unit).library;
        if found.iter().any(|(id, _)| self.catalogue.item(*id).library == own) {
            found.retain(|(id, _)| self.catalogue.item(*id).library == own);
        }
        match found.as_slice() {
            [] => match self.inline(name, place) {
                Some(value) => Ok(value),
                None => Err(self.unknown(&Path::plain(name), place)),
            },
            [(id, _)] => self.value_of(*id, name, place),
            [(a, _), (b, _), ..] => {
                let (a, b) = (&self.catalogue.item(*a).name, &self.catalogue.item(*b).name);
                let message = format!("`{name}` is a value of `{a}` and of `{b}`");
                let mut stop = stop(&codes::TABLE_UNKNOWN_NAME, place, message);
                stop.finding.help.push(format!("write `{a}#{name}` or `{b}#{name}`"));
                Err(stop)
            }
        }
    }

    /// A value of an enumeration that is declared with a variable of the unit.
    fn inline(&self, name: &str, place: Place) -> Option<Operand<Leaf>> {
        let lineage = crate::library::names::lineage(self.catalogue, self.unit);
        let variables = lineage.into_iter().flat_map(|id| self.catalogue.item(id).variables.iter());
        let inline = variables.filter_map(|variable| variable.type_.as_ref()).filter(|t| t.text.starts_with('('));
        inline.into_iter().find_map(|type_| match self.shape(&type_.text, self.unit) {
            super::shapes::Shape::Scalar(type_) => self.enumerator(&type_, name, place),
            _ => None,
        })
    }

    /// The enumerations that have a value of that name.
    fn enumerators_named(&mut self, name: &str) -> Vec<(ItemId, usize)> {
        let catalogue = self.catalogue;
        let all = self.enumerators.get_or_insert_with(|| {
            let mut all: std::collections::BTreeMap<String, Vec<(ItemId, usize)>> = std::collections::BTreeMap::new();
            for (id, item) in catalogue.iter().filter(|(_, item)| item.kind == ItemKind::Enum) {
                for (index, variable) in item.variables.iter().enumerate() {
                    all.entry(fold(&variable.name)).or_default().push((id, index));
                }
            }
            all
        });
        all.get(&fold(name)).cloned().unwrap_or_default()
    }

    fn unknown_value(&self, type_: &Type, name: &str, place: Place) -> Box<Stop> {
        let values = self.values(type_);
        let names = values.iter().map(|(name, _)| name.as_str()).chain(self.candidates());
        let near = nearest(name, names).map(str::to_owned);
        let mut stop = stop(&codes::TABLE_UNKNOWN_NAME, place, format!("nothing is named `{name}`"));
        stop.finding.help.extend(near.map(|near| format!("`{near}` is the nearest name")));
        stop
    }

    /// That a path leads nowhere.
    pub(super) fn unknown(&self, path: &Path, place: Place) -> Box<Stop> {
        let unit = &self.catalogue.item(self.unit).name;
        let message = format!("`{unit}` has no variable `{}`", print::path(path));
        let mut stop = stop(&codes::TABLE_UNKNOWN_NAME, place, message);
        // A column may have the very name that its variable should have.
        let others = self.candidates().into_iter().filter(|name| !name.eq_ignore_ascii_case(&path.name));
        let near = nearest(&path.name, others);
        stop.finding.help.extend(near.map(|near| format!("`{near}` is the nearest name")));
        stop
    }
}
