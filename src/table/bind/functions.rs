//! Functions that a table brings along. They are Structured Text; one whose body sets its result once, by an expression over
//! its inputs, is written out where it is called. Others are read and printed, and cannot be decided.

use super::paths::{stop, undecided};
use super::{Binder, Leaf, Result, Stop};
use crate::library::ItemKind;
use crate::semantics::typing::{Operand, Type, convert, functions};
use crate::syntax::ast::{AstNode, Declaration, Pou, SectionKind, SourceFile, Statement};
use crate::syntax::{Entry, Options, parse};
use crate::table::cell::ast::{Expr, ExprKind};
use crate::table::cell::{self, Context};
use crate::table::codes;
use crate::table::model::Function;
use crate::table::piece::Piece;
use crate::text::Place;
use crate::text::near::nearest;

/// A function that is one expression.
struct Inline {
    inputs: Vec<(String, String)>,
    result: String,
    body: Expr,
}

impl Binder<'_> {
    /// A call of a function of the table; `None` if it has none of that name.
    pub(super) fn call_own(
        &mut self,
        name: &str,
        arguments: Vec<Operand<Leaf>>,
        place: Place,
    ) -> Result<Option<Operand<Leaf>>> {
        let table = self.table;
        let Some(function) = table.functions.iter().find(|function| function.name.eq_ignore_ascii_case(name)) else {
            return Ok(None);
        };
        let Some(inline) = inline(function) else {
            return Err(undecided(place, format!("the function `{name}`, whose body is more than one expression")));
        };
        if self.calls.iter().any(|called| called.eq_ignore_ascii_case(name)) {
            return Err(stop(&codes::TABLE_TYPE, place, format!("`{name}` calls itself")));
        }
        if inline.inputs.len() != arguments.len() {
            let message = format!("`{name}` takes {} arguments and gets {}", inline.inputs.len(), arguments.len());
            return Err(stop(&codes::TABLE_TYPE, place, message));
        }
        let mut given = Vec::new();
        for ((input, type_), argument) in inline.inputs.iter().zip(arguments) {
            let type_ = self.named_type(type_).ok_or_else(|| self.no_type(type_, function.place))?;
            given.push((input.clone(), self.converted(argument, type_, place)?));
        }
        self.calls.push(name.to_owned());
        let result = self.inlined(&inline.body, &given, place);
        self.calls.pop();
        let type_ = self.named_type(&inline.result).ok_or_else(|| self.no_type(&inline.result, function.place))?;
        self.converted(result?, type_, place).map(Some)
    }

    fn converted(&self, operand: Operand<Leaf>, type_: Type, place: Place) -> Result<Operand<Leaf>> {
        let converted = convert::assigned(operand, &type_).map_err(|error| {
            let mut stop = stop(&codes::TABLE_TYPE, place, error.message);
            stop.finding.help.extend(error.help);
            stop
        })?;
        Ok(Operand::Typed(converted.expr, type_))
    }

    /// The body with the arguments for the inputs. It sees nothing else but functions and values of enumerations.
    fn inlined(&mut self, body: &Expr, given: &[(String, Operand<Leaf>)], place: Place) -> Result<Operand<Leaf>> {
        self.frames.push(given.to_vec());
        let result = self.operand(body, None, None, place.file);
        self.frames.pop();
        // What is wrong inside the function is told where it is called.
        result.map_err(|mut stop| {
            stop.finding.place = place;
            stop
        })
    }

    /// The position of a formal argument.
    pub(super) fn position(&self, function: &str, formal: &str) -> Option<usize> {
        let own = self.table.functions.iter().find(|other| other.name.eq_ignore_ascii_case(function));
        match own {
            Some(own) => {
                let inputs = inline(own)?.inputs;
                inputs.iter().position(|(name, _)| name.eq_ignore_ascii_case(formal))
            }
            None => functions::position(function, formal),
        }
    }

    /// That nothing of that name can be called in a cell.
    pub(super) fn no_function(&self, name: &str, place: Place) -> Box<Stop> {
        let found = self.names.top(self.catalogue, name, self.scope(self.unit));
        if found.is_some_and(|id| self.catalogue.item(id).kind == ItemKind::Function) {
            return undecided(place, format!("a call of `{name}`, a function of the program"));
        }
        let own = self.table.functions.iter().map(|function| function.name.as_str());
        let standard =
            ["SEL", "MIN", "MAX", "LIMIT", "MUX", "ABS", "SQRT", "EXPT", "TRUNC", "SHL", "SHR", "ROL", "ROR"];
        let near = nearest(name, own.chain(standard));
        let mut stop = stop(&codes::TABLE_UNKNOWN_NAME, place, format!("no function is named `{name}`"));
        stop.finding.help.extend(near.map(|near| format!("`{near}` is one")));
        stop
    }
}

/// The function, if its body is one assignment to its result.
fn inline(function: &Function) -> Option<Inline> {
    let parsed = parse(function.text.as_str(), Entry::File, &Options::default());
    let file = SourceFile::cast(parsed.tree.root())?;
    let pou: Pou<'_> = file.declarations().find_map(|declaration| match declaration {
        Declaration::Pou(pou) => Some(pou),
        _ => None,
    })?;
    let mut inputs = Vec::new();
    for section in pou.var_sections() {
        if section.kind() != SectionKind::Input {
            return None;
        }
        for variable in section.variables() {
            let type_ = variable.type_()?.node().text().to_owned();
            inputs.extend(variable.names().map(|name| (name.text().to_owned(), type_.clone())));
        }
    }
    let statements: Vec<Statement<'_>> = pou.body()?.statements().collect();
    let [Statement::Assign(assignment)] = statements.as_slice() else { return None };
    let target = assignment.target()?.node().text();
    if !target.trim().eq_ignore_ascii_case(&function.name) {
        return None;
    }
    let value = assignment.value()?.node().span();
    let text = value.of(&function.text);
    let piece = Piece::verbatim(function.place.file, text, function.place.span.start.saturating_add(value.start));
    let body = cell::parse_expression(&piece, &Context::default()).ok()?;
    let mut past = false;
    body.walk(&mut |expr| past |= matches!(expr.kind, ExprKind::Past(..)));
    let result = pou.return_type()?.node().text().to_owned();
    (!past).then_some(Inline { inputs, result, body })
}
