//! Columns: what their cells speak of, and whether the header says the truth about it.

use super::paths::stop;
use super::shapes::{called, spelled};
use super::{Binder, Leaf, Result, Role};
use crate::diagnostic::Finding;
use crate::semantics::typing::{Operand, Type};
use crate::table::codes;
use crate::table::model::{Column, ColumnKind, Subject};
use crate::text::Place;

impl Binder<'_> {
    /// Binds every column; one that cannot be bound spoils its rows.
    pub(super) fn bind_columns(&mut self) {
        let table = self.table;
        // Plain ones first: projections may name them by the names that the table gives them.
        self.subjects = vec![None; table.columns.len()];
        for plain in [true, false] {
            for (index, column) in table.columns.iter().enumerate() {
                if matches!(column.subject, Subject::Variable(_)) == plain {
                    match self.subject(column) {
                        Ok(subject) => {
                            self.check_header(column, &subject);
                            self.subjects[index] = Some(subject);
                        }
                        Err(stop) => self.report(*stop),
                    }
                }
            }
        }
    }

    fn subject(&mut self, column: &Column) -> Result<Vec<Operand<Leaf>>> {
        match &column.subject {
            Subject::Variable(path) => match self.variable(path, 0, column.place)? {
                Some(operand) => Ok(vec![operand]),
                None => Err(self.unknown(path, column.place)),
            },
            Subject::Projection(exprs) => {
                exprs.iter().map(|expr| self.operand(expr, None, None, column.place.file)).collect()
            }
        }
    }

    /// Whether the header's kind and type are those of the variable.
    fn check_header(&mut self, column: &Column, subject: &[Operand<Leaf>]) {
        let [operand] = subject else { return };
        self.check_type(column, operand);
        let Subject::Variable(_) = column.subject else { return };
        let Operand::Typed(expr, _) = operand else { return };
        let mut role = None;
        expr.leaves(&mut |leaf| {
            if let Leaf::Variable { index, .. } = *leaf {
                role = Some(self.variables[index].role);
            }
        });
        let (what, kind) = match (column.kind, role) {
            (ColumnKind::Input, Some(Role::Output)) => ("an output", "assumes what its own output is; write `out`"),
            (ColumnKind::Input, Some(Role::Internal)) => {
                ("a variable of its own", "assumes what it is: say so by `state`, or assert it by `state!`")
            }
            (ColumnKind::Output | ColumnKind::StateAssertion, Some(Role::Input)) => {
                ("an input", "asserts what its environment does; write `in`")
            }
            _ => return,
        };
        let unit = &self.catalogue.item(self.unit).name;
        let message = format!("`{}` is {what} of `{unit}`, and the column {kind}", column.name);
        self.findings.push(Finding::new(&codes::TABLE_DIRECTION, column.place, message));
    }

    fn check_type(&mut self, column: &Column, operand: &Operand<Leaf>) {
        let (Some(declared), Operand::Typed(_, actual)) = (&column.ty, operand) else { return };
        let same = match self.named_type(&declared.text) {
            Some(Type::Enumeration { item, .. }) => {
                matches!(actual, Type::Enumeration { item: other, .. } if item == *other)
            }
            Some(type_) => type_.scalar() == actual.scalar(),
            // Old tables call any enumeration `ENUM`.
            None => declared.text.eq_ignore_ascii_case("ENUM"),
        };
        if !same {
            let message = format!(
                "the header says that `{}` is `{}`, and it is `{}`",
                column.name,
                declared.text,
                called(actual)
            );
            self.findings.push(Finding::new(&codes::TABLE_DECLARED_TYPE, declared.place, message));
        }
    }

    /// The type that a table calls so.
    pub(super) fn named_type(&self, name: &str) -> Option<Type> {
        if let Some(scalar) = spelled(name) {
            return Some(Type::Scalar(scalar));
        }
        match self.shape(name, self.unit) {
            super::shapes::Shape::Scalar(type_) => Some(type_),
            _ => None,
        }
    }

    /// A type that a table names and nothing has.
    pub(super) fn no_type(&self, name: &str, place: Place) -> Box<super::Stop> {
        let enums = self.catalogue.items.iter().filter(|item| item.kind == crate::library::ItemKind::Enum);
        let names = ["BOOL", "INT", "DINT", "UINT", "REAL", "LREAL", "TIME", "WORD", "BYTE"].into_iter();
        let near = crate::text::near::nearest(name, names.chain(enums.map(|item| item.name.as_str())));
        let mut stop = stop(&codes::TABLE_TYPE, place, format!("no type is named `{name}`"));
        stop.finding.help.extend(near.map(|near| format!("`{near}` is one")));
        stop
    }
}
