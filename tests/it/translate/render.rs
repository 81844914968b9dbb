//! A program in C: memory as an array of 64-bit cells, types as C's own, control flow as C's own. GNU's statement expressions keep
//! the order of evaluation; a fault leaves by `longjmp`.

use std::fmt::Write as _;

use rungbook::machine::program::{Base, Location, Program, Routine, Statement, StatementKind, Value};
use rungbook::semantics::expr::{Expr, ExprKind, Fault, Op};
use rungbook::semantics::scalar::Scalar;
use rungbook::text::Place;

/// What every file begins with.
pub(super) const PRELUDE: &str = r"
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <setjmp.h>
typedef __int128 num;
static uint64_t m[4096];
static const uint64_t *init;
static jmp_buf out;
static int fault_kind, fault_place;
static void fail(int kind, int place) { fault_kind = kind; fault_place = place; longjmp(out, 1); }
static uint32_t step(num v, num low, uint32_t count, uint32_t stride, int place) {
    if (v < low || v - low >= count) fail(1, place);
    return (uint32_t)(v - low) * stride;
}
static uint32_t referent(uint64_t a, int place) { if (a == 0) fail(4, place); return (uint32_t)a - 1; }
static void range(num v, num low, num high, int place) { if (v < low || v > high) fail(2, place); }
static int64_t sdiv(int64_t a, int64_t b, int p) { if (!b) fail(0, p); return b == -1 ? -(uint64_t)a : a / b; }
static int64_t srem(int64_t a, int64_t b, int p) { if (!b) fail(0, p); return b == -1 ? 0 : a % b; }
static uint64_t udiv(uint64_t a, uint64_t b, int p) { if (!b) fail(0, p); return a / b; }
static uint64_t urem(uint64_t a, uint64_t b, int p) { if (!b) fail(0, p); return a % b; }
static uint64_t shl(uint64_t a, uint64_t n) { return n > 63 ? 0 : a << n; }
static uint64_t shr(uint64_t a, uint64_t n) { return n > 63 ? 0 : a >> n; }
static int64_t sar(int64_t a, uint64_t n) { return a >> (n > 63 ? 63 : n); }
static uint64_t rol(uint64_t a, uint64_t n, unsigned w) {
    n %= w;
    uint64_t all = w == 64 ? ~0ull : (1ull << w) - 1;
    return n ? ((a << n) | (a >> (w - n))) & all : a;
}
static uint64_t ror(uint64_t a, uint64_t n, unsigned w) { return rol(a, w - n % w, w); }
";

pub(super) struct Renderer<'a> {
    program: &'a Program,
    /// What the program's functions are called.
    number: usize,
    names: u32,
    loop_limit: u64,
}

/// The C type of a scalar.
fn type_of(scalar: Scalar) -> String {
    match scalar {
        Scalar::Bool => "_Bool".to_owned(),
        _ => format!("{}int{}_t", if scalar.is_signed() { "" } else { "u" }, scalar.width()),
    }
}

/// The unsigned type of the same width.
fn raw_of(scalar: Scalar) -> String {
    if scalar == Scalar::Bool { "_Bool".to_owned() } else { format!("uint{}_t", scalar.width()) }
}

pub(super) fn kind(fault: Fault) -> u32 {
    match fault {
        Fault::DivisionByZero => 0,
        Fault::IndexOutOfBounds => 1,
        Fault::SubrangeViolation => 2,
        Fault::LoopLimit => 3,
        Fault::NullReference => 4,
    }
}

pub(super) fn number(place: Option<Place>) -> u32 {
    place.map_or(0, |place| place.span.start)
}

impl<'a> Renderer<'a> {
    pub(super) const fn new(program: &'a Program, number: usize, loop_limit: u64) -> Self {
        Self { program, number, names: 0, loop_limit }
    }

    fn name(&mut self) -> String {
        self.names += 1;
        format!("x{}", self.names)
    }

    /// The whole program: `p<n>_startup`, `p<n>_cycle`, `p<n>_init`.
    pub(super) fn program(&mut self) -> String {
        let (program, n) = (self.program, self.number);
        let mut text = String::new();
        let initial: Vec<String> = program.slots.iter().map(|slot| format!("{}ull", slot.initial)).collect();
        let _ = writeln!(text, "static const uint64_t p{n}_init[] = {{{}}};", initial.join(","));
        for index in 0..program.routines.len() {
            let _ = writeln!(text, "static void p{n}_r{index}(uint32_t this);");
        }
        for (index, routine) in program.routines.iter().enumerate() {
            text += &self.routine(index, routine);
        }
        for (name, body) in [("startup", &program.startup), ("cycle", &program.cycle)] {
            let _ = writeln!(text, "static void p{n}_{name}(uint32_t this) {{\n{}}}", self.block(body));
        }
        text
    }

    fn routine(&mut self, index: usize, routine: &Routine) -> String {
        let mut text = format!("static void p{}_r{index}(uint32_t this) {{\n", self.number);
        for (first, length) in &routine.locals {
            let at = first.0;
            let _ = writeln!(text, "memcpy(m + {at}, init + {at}, {length} * sizeof *m);");
        }
        text + &self.block(&routine.body) + "}\n"
    }

    fn block(&mut self, statements: &[Statement]) -> String {
        statements.iter().map(|statement| self.statement(statement)).collect()
    }

    fn statement(&mut self, statement: &Statement) -> String {
        let place = number(statement.place);
        match &statement.kind {
            StatementKind::Assign { target, value, range } => {
                let (v, a) = (self.name(), self.name());
                let check = range.map_or(String::new(), |(low, high)| {
                    format!("range((num){v}, {}, {}, {place}); ", wide(low), wide(high))
                });
                let (scalar, raw) = (type_of(value.scalar), raw_of(value.scalar));
                let (value, target) = (self.value(value), self.location(target));
                format!("{{ {scalar} {v} = {value}; uint32_t {a} = {target}; {check}m[{a}] = ({raw}){v}; }}\n")
            }
            StatementKind::Copy { target, source, length } => {
                let (a, b) = (self.name(), self.name());
                let (source, target) = (self.location(source), self.location(target));
                format!(
                    "{{ uint32_t {a} = {source}; uint32_t {b} = {target}; memmove(m + {b}, m + {a}, {length} * sizeof *m); }}\n"
                )
            }
            StatementKind::Reset { target, length } => {
                let a = self.name();
                let target = self.location(target);
                format!("{{ uint32_t {a} = {target}; memcpy(m + {a}, init + {a}, {length} * sizeof *m); }}\n")
            }
            StatementKind::If { condition, then, otherwise } => {
                let condition = self.value(condition);
                format!("if ({condition}) {{\n{}}} else {{\n{}}}\n", self.block(then), self.block(otherwise))
            }
            StatementKind::Case { selector, arms, otherwise } => {
                let v = self.name();
                let mut text = format!("{{ num {v} = {};\n", self.value(selector));
                for arm in arms {
                    let test =
                        |(low, high): &(i128, i128)| format!("({v} >= {} && {v} <= {})", wide(*low), wide(*high));
                    let tests: Vec<String> = arm.labels.iter().map(test).collect();
                    let _ = write!(text, "if ({}) {{\n{}}} else ", tests.join(" || "), self.block(&arm.body));
                }
                text + &format!("{{\n{}}} }}\n", self.block(otherwise))
            }
            StatementKind::For { control, scalar, from, to, by, body } => {
                self.counted((control, *scalar), (from, to, by), body, place)
            }
            StatementKind::Loop { body, after } => self.endless(body, after, place),
            StatementKind::Exit => "break;\n".to_owned(),
            StatementKind::Continue => "continue;\n".to_owned(),
            StatementKind::Return => "return;\n".to_owned(),
            StatementKind::Call { routine, this } => {
                let this = this.as_ref().map_or("this".to_owned(), |this| self.location(this));
                format!("p{}_r{}({this});\n", self.number, routine.0)
            }
            StatementKind::Dispatch { target, routines } => {
                let a = self.name();
                let mut text = format!("{{ uint32_t {a} = referent({}, {place});\n", self.value(target));
                for (slot, class) in &self.program.instances {
                    if let Some((_, routine)) = routines.iter().find(|(other, _)| other == class) {
                        let _ = writeln!(text, "if ({a} == {}) p{}_r{}({a}); else", slot.0, self.number, routine.0);
                    }
                }
                text + &format!("fail(4, {place}); }}\n")
            }
            StatementKind::Text(_) => unreachable!("programs for C have no strings"),
            StatementKind::Fail(fault) => format!("fail({}, {place});\n", kind(*fault)),
        }
    }

    fn counted(
        &mut self,
        (control, scalar): (&Location, Scalar),
        (from, to, by): (&Value, &Value, &Value),
        body: &[Statement],
        place: u32,
    ) -> String {
        let [n, t, b, a, c] = [(); 5].map(|()| self.name());
        let constant = |value: &Value| match value.kind {
            ExprKind::Const(bits) => Some(value.scalar.number(bits)),
            _ => None,
        };
        let turns = match (constant(from), constant(to), constant(by)) {
            (Some(from), Some(to), Some(by)) if by != 0 => ((to - from) / by + 1).max(0),
            _ => 0,
        };
        let limit = turns.max(i128::from(self.loop_limit));
        let (from, to, by, at) = (self.value(from), self.value(to), self.value(by), self.location(control));
        let (raw, own) = (raw_of(scalar), type_of(scalar));
        format!(
            "{{ num {n} = {from}; num {t} = {to}; num {b} = {by}; if (!{b}) fail(3, {place});\n\
             uint32_t {a} = {at}; m[{a}] = ({raw}){n}; num {c} = 0;\n\
             for (; {b} > 0 ? {n} <= {t} : {n} >= {t}; {n} = ({own})m[{a}] + {b}, m[{a}] = ({raw}){n}) {{\n\
             if (++{c} > {limit}ll) fail(3, {place});\n{}}} }}\n",
            self.block(body)
        )
    }

    /// `continue` in the body goes to `after`, so that the body is a loop of one turn of its own.
    fn endless(&mut self, body: &[Statement], after: &[Statement], place: u32) -> String {
        let (c, left) = (self.name(), self.name());
        let (body, after, limit) = (self.block(body), self.block(after), self.loop_limit);
        format!(
            "{{ int {c} = 0; int {left} = 0; for (;;) {{ if (++{c} > {limit}) fail(3, {place});\n\
             {left} = 1; do {{ {left} = 1;\n{body}{left} = 0; break; }} while (({left} = 0));\n\
             if ({left}) break;\n{after}}} }}\n"
        )
    }

    fn location(&mut self, location: &Location) -> String {
        let a = self.name();
        let base = match &location.base {
            Base::Slot(slot) => slot.0.to_string(),
            Base::This => "this".to_owned(),
            Base::Referent(value) => format!("referent({}, {})", self.value(value), number(value.place)),
        };
        let mut text = format!("({{ uint32_t {a} = {base}; {a} += {};", location.offset);
        for index in &location.indices {
            let (value, at) = (self.value(&index.value), number(index.value.place));
            let _ = write!(text, " {a} += step({value}, {}ll, {}u, {}u, {at});", index.low, index.count, index.stride);
        }
        text + &format!(" {a}; }})")
    }

    fn value(&mut self, value: &Value) -> String {
        let own = type_of(value.scalar);
        match &value.kind {
            ExprKind::Const(bits) => format!("(({own}){bits}ull)"),
            ExprKind::Read(location) => format!("(({own})m[{}])", self.location(location)),
            ExprKind::Address(location) => format!("(({own})({} + 1))", self.location(location)),
            ExprKind::AndThen(a, b) => format!("({} && {})", self.value(a), self.value(b)),
            ExprKind::OrElse(a, b) => format!("({} || {})", self.value(a), self.value(b)),
            ExprKind::If(a, b, c) => {
                let (a, b, c) = (self.value(a), self.value(b), self.value(c));
                format!("(({own})({a} ? {b} : {c}))")
            }
            ExprKind::Apply(op, operands) => self.operator(*op, value, operands),
        }
    }

    /// The operands in order, each in a variable of its own, then the operator.
    fn operator(&mut self, op: Op, value: &Value, operands: &[Expr<Location>]) -> String {
        let mut text = "({ ".to_owned();
        let mut names = Vec::new();
        for operand in operands {
            let name = self.name();
            let _ = write!(text, "{} {name} = {}; ", type_of(operand.scalar), self.value(operand));
            names.push(name);
        }
        let (own, of) = (type_of(value.scalar), operands[0].scalar);
        let result = apply(op, of, value, &names);
        text + &format!("({own})({result}); }})")
    }
}

/// A number of any size up to 64 bits and a little more.
fn wide(number: i128) -> String {
    let (high, low) = (number.div_euclid(1 << 32), number.rem_euclid(1 << 32));
    format!("((num){high}ll * 4294967296ll + {low}ll)")
}

fn apply(op: Op, of: Scalar, value: &Value, x: &[String]) -> String {
    let place = number(value.place);
    let (a, b) = (&x[0], x.get(1).unwrap_or(&x[0]));
    let raw = raw_of(of);
    let sign = if of.is_signed() { "s" } else { "u" };
    match op {
        Op::Neg if of == Scalar::Bool => a.clone(),
        Op::Neg => format!("-{a}"),
        Op::Not if of == Scalar::Bool => format!("!{a}"),
        Op::Not => format!("~{a}"),
        // Of one bit, a sum is a difference is an exclusive or.
        Op::Add | Op::Sub if of == Scalar::Bool => format!("{a} ^ {b}"),
        Op::Add => format!("{a} + {b}"),
        Op::Sub => format!("{a} - {b}"),
        Op::Mul => format!("(uint64_t){a} * (uint64_t){b}"),
        Op::Div => format!("{sign}div({a}, {b}, {place})"),
        Op::Mod => format!("{sign}rem({a}, {b}, {place})"),
        Op::And => x.join(" & "),
        Op::Or => format!("{a} | {b}"),
        Op::Xor => format!("{a} ^ {b}"),
        Op::Eq => format!("{a} == {b}"),
        Op::Lt => format!("{a} < {b}"),
        Op::Le => format!("{a} <= {b}"),
        // A negative amount is a large one in its own width.
        Op::Shl | Op::Shr | Op::Rol | Op::Ror | Op::Sar => shift(op, of, &raw, a, b),
        Op::Abs if of.is_signed() => format!("{a} < 0 ? -{a} : {a}"),
        Op::Select => format!("{a} ? {b} : {}", x[2]),
        Op::Bit => format!("((uint64_t){a} >> {b}) & 1"),
        Op::Convert => match (of, value.scalar) {
            (Scalar::Time(32), Scalar::Time(64)) => format!("(uint64_t){a} * 1000000u"),
            (Scalar::Time(64), Scalar::Time(32)) => format!("{a} / 1000000u"),
            _ => a.clone(),
        },
        _ => a.clone(),
    }
}

fn shift(op: Op, of: Scalar, raw: &str, a: &str, b: &str) -> String {
    let width = of.width();
    match op {
        Op::Shl => format!("shl({a}, AMOUNT({b}))"),
        Op::Shr => format!("shr(({raw}){a}, AMOUNT({b}))"),
        Op::Rol => format!("rol(({raw}){a}, AMOUNT({b}), {width})"),
        Op::Ror => format!("ror(({raw}){a}, AMOUNT({b}), {width})"),
        _ if of == Scalar::Bool => a.to_owned(),
        _ => format!("sar((int{width}_t){a}, AMOUNT({b}))"),
    }
}
