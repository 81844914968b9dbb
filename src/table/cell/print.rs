//! A cell back to text: in plain ASCII, which every reader of the room reads again, or with the signs of the papers.

use super::ast::{Arg, BinaryOp, Chunk, ChunkKind, Constraint, Expr, ExprKind, Path, Predicate, Step, UnaryOp};
use super::expression::unary_precedence;

/// Which signs to print.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// `<=`, `^TRUE`, `-`.
    Ascii,
    /// `≤`, `√TRUE`, `–`.
    Signs,
}

/// The cell in the given signs.
#[must_use]
pub fn constraint(constraint: &Constraint, style: Style) -> String {
    constraint.chunks.iter().map(|part| chunk(part, style)).collect::<Vec<_>>().join(", ")
}

/// The expression in the given signs.
#[must_use]
pub fn expression(expr: &Expr, style: Style) -> String {
    let mut printer = Printer { out: String::new(), style };
    printer.expr(expr, 0);
    printer.out
}

/// One part of a cell in the given signs.
#[must_use]
pub fn chunk(chunk: &Chunk, style: Style) -> String {
    let mut printer = Printer { out: String::new(), style };
    printer.chunk(chunk);
    printer.out
}

/// A path as it is written.
#[must_use]
pub fn path(path: &Path) -> String {
    let mut printer = Printer { out: String::new(), style: Style::Ascii };
    printer.path(path);
    printer.out
}

/// The sign of an operator.
#[must_use]
pub const fn operator(op: BinaryOp, style: Style) -> &'static str {
    match (op, style) {
        (BinaryOp::Implies, Style::Ascii) => "->",
        (BinaryOp::Implies, Style::Signs) => "→",
        (BinaryOp::Or, _) => "OR",
        (BinaryOp::Xor, _) => "XOR",
        (BinaryOp::And, _) => "AND",
        (BinaryOp::Eq, _) => "=",
        (BinaryOp::Ne, Style::Ascii) => "<>",
        (BinaryOp::Ne, Style::Signs) => "≠",
        (BinaryOp::Lt, _) => "<",
        (BinaryOp::Le, Style::Ascii) => "<=",
        (BinaryOp::Le, Style::Signs) => "≤",
        (BinaryOp::Gt, _) => ">",
        (BinaryOp::Ge, Style::Ascii) => ">=",
        (BinaryOp::Ge, Style::Signs) => "≥",
        (BinaryOp::Add, _) => "+",
        (BinaryOp::Sub, _) => "-",
        (BinaryOp::Mul, _) => "*",
        (BinaryOp::Div, _) => "/",
        (BinaryOp::Mod, _) => "MOD",
        (BinaryOp::Power, _) => "**",
    }
}

struct Printer {
    out: String,
    style: Style,
}

impl Printer {
    fn push(&mut self, text: &str) {
        self.out.push_str(text);
    }

    fn sign(&mut self, ascii: &str, sign: &str) {
        self.push(if self.style == Style::Ascii { ascii } else { sign });
    }

    fn chunk(&mut self, chunk: &Chunk) {
        match &chunk.kind {
            ChunkKind::Any => self.sign("-", "–"),
            ChunkKind::Value(expr) | ChunkKind::Condition(expr) => self.expr(expr, 0),
            ChunkKind::Compare(op, expr) => {
                self.push(operator(*op, self.style));
                self.push(" ");
                self.expr(expr, 0);
            }
            ChunkKind::Interval(interval) => {
                self.push(if interval.low_closed { "[" } else { "(" });
                self.end(interval.low.as_ref());
                self.push(", ");
                self.end(interval.high.as_ref());
                self.push(if interval.high_closed { "]" } else { ")" });
            }
            ChunkKind::Trigger(inner) => {
                self.sign("^", "√");
                self.chunk(inner);
            }
            ChunkKind::Guarded(arms) => {
                self.push("if");
                for arm in arms {
                    self.push(" :: ");
                    self.expr(&arm.guard, BinaryOp::Implies.precedence() + 1);
                    self.sign(" -> ", " → ");
                    self.chunk(&arm.then);
                }
                self.push(" fi");
            }
            ChunkKind::Predicate(predicate) => self.push(predicate_name(predicate)),
        }
    }

    fn end(&mut self, end: Option<&Expr>) {
        match end {
            Some(expr) => self.expr(expr, 0),
            None => self.sign("-", "∞"),
        }
    }

    fn expr(&mut self, expr: &Expr, minimum: u8) {
        match &expr.kind {
            ExprKind::Own => {}
            ExprKind::Literal(literal) => self.push(&literal.text),
            ExprKind::EnumValue { ty, name } => {
                self.push(ty);
                self.push("#");
                self.push(name);
            }
            ExprKind::Name(path) => self.path(path),
            ExprKind::Past(path, count) => {
                self.path(path);
                self.push(&format!("[-{count}]"));
            }
            ExprKind::Unary(op, inner) => self.unary(*op, inner, minimum),
            ExprKind::Binary(op, left, right) => self.binary(*op, left, right, minimum),
            ExprKind::Call { name, args } => self.call(name, args),
            ExprKind::Guarded(arms) => self.guarded(arms),
        }
    }

    fn unary(&mut self, op: UnaryOp, inner: &Expr, minimum: u8) {
        let parentheses = minimum > unary_precedence();
        if parentheses {
            self.push("(");
        }
        self.push(match op {
            UnaryOp::Minus => "-",
            UnaryOp::Plus => "+",
            UnaryOp::Not => "NOT ",
        });
        // Two signs in a row would read as something else.
        let nested = matches!(inner.kind, ExprKind::Unary(UnaryOp::Minus | UnaryOp::Plus, _));
        self.expr(inner, if nested { u8::MAX } else { unary_precedence() });
        if parentheses {
            self.push(")");
        }
    }

    fn binary(&mut self, op: BinaryOp, left: &Expr, right: &Expr, minimum: u8) {
        let precedence = op.precedence();
        let parentheses = precedence < minimum;
        if parentheses {
            self.push("(");
        }
        let implies = op == BinaryOp::Implies;
        self.expr(left, precedence + u8::from(implies));
        if left.kind != ExprKind::Own {
            self.push(" ");
        }
        self.push(operator(op, self.style));
        self.push(" ");
        self.expr(right, precedence + u8::from(!implies));
        if parentheses {
            self.push(")");
        }
    }

    fn call(&mut self, name: &str, args: &[Arg]) {
        self.push(name);
        self.push("(");
        for (i, arg) in args.iter().enumerate() {
            if i > 0 {
                self.push(", ");
            }
            if let Some(name) = &arg.name {
                self.push(name);
                self.push(" := ");
            }
            self.expr(&arg.value, 0);
        }
        self.push(")");
    }

    /// A guarded command inside an expression; its parentheses keep it from being read as the whole cell.
    fn guarded(&mut self, arms: &[(Expr, Expr)]) {
        self.push("(if");
        for (guard, then) in arms {
            self.push(" :: ");
            self.expr(guard, BinaryOp::Implies.precedence() + 1);
            self.sign(" -> ", " → ");
            self.expr(then, 0);
        }
        self.push(" fi)");
    }

    fn path(&mut self, path: &Path) {
        if let Some(run) = &path.run {
            self.push(run);
            self.push("::");
        }
        self.push(&path.name);
        for step in &path.steps {
            match step {
                Step::Member(name) => {
                    self.push(".");
                    self.push(name);
                }
                Step::Index(indices) => {
                    self.push("[");
                    for (i, index) in indices.iter().enumerate() {
                        if i > 0 {
                            self.push(", ");
                        }
                        self.expr(index, 0);
                    }
                    self.push("]");
                }
            }
        }
    }
}

/// The name of a predicate, as a cell writes it.
#[must_use]
pub fn predicate_name(predicate: &Predicate) -> &str {
    match predicate {
        Predicate::Compare(BinaryOp::Le) => "leq",
        Predicate::Compare(BinaryOp::Ge) => "geq",
        Predicate::Compare(BinaryOp::Ne) => "neq",
        Predicate::Compare(BinaryOp::Gt) => "gt",
        Predicate::Compare(BinaryOp::Lt) => "lt",
        Predicate::Compare(_) => "eq",
        Predicate::Function(name) => name,
    }
}
