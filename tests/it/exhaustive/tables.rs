//! Random tables over a block's variables: their text, and what it means on values.

use super::blocks::{Block, Kind, Use};
use super::random::Random;
use super::words::{Item, Tau, Tree};

/// An expression of a cell.
#[derive(Clone, Debug)]
pub(super) enum Exp {
    Const(i64, bool),
    /// A variable of the block, so many cycles ago.
    Var(usize, usize),
    Global(usize),
    Not(Box<Exp>),
    Next(Box<Exp>),
    Compare(&'static str, Box<Exp>, Box<Exp>),
    Both(Box<Exp>, Box<Exp>),
    Either(Box<Exp>, Box<Exp>),
}

/// A cell.
#[derive(Clone, Debug)]
pub(super) enum Cell {
    Any,
    Is(Exp),
    Compare(&'static str, Exp),
    Between(i64, i64),
    Condition(Exp),
    All(Vec<Cell>),
    Trigger(Box<Cell>),
}

/// A column.
#[derive(Clone, Debug)]
pub(super) struct Column {
    pub(super) variable: usize,
    pub(super) assumption: bool,
}

/// A global variable of the table.
#[derive(Clone, Debug)]
pub(super) struct Global {
    pub(super) boolean: bool,
    /// It is at most this, and an integer is not negative.
    pub(super) most: i64,
}

/// A table.
#[derive(Clone, Debug)]
pub(super) struct Table {
    pub(super) tree: Tree,
    pub(super) columns: Vec<Column>,
    pub(super) cells: Vec<Vec<Cell>>,
    pub(super) globals: Vec<Global>,
}

/// What expressions read.
pub(super) struct Values<'a> {
    pub(super) kind: Kind,
    /// Of each variable, in this cycle, and in earlier ones.
    pub(super) history: &'a [Vec<i64>],
    pub(super) globals: &'a [i64],
}

impl Exp {
    pub(super) fn value(&self, of: &Values<'_>) -> i64 {
        match self {
            Self::Const(value, _) => *value,
            Self::Var(index, ago) => of.history[*ago][*index],
            Self::Global(index) => of.globals[*index],
            Self::Not(one) => 1 - one.value(of),
            Self::Next(one) => wrapped(of.kind, one.value(of) + 1),
            Self::Compare(op, one, other) => i64::from(compare(op, one.value(of), other.value(of))),
            Self::Both(one, other) => one.value(of) & other.value(of),
            Self::Either(one, other) => one.value(of) | other.value(of),
        }
    }

    fn text(&self, block: &Block) -> String {
        match self {
            Self::Const(value, true) => (if *value == 0 { "FALSE" } else { "TRUE" }).to_owned(),
            Self::Const(value, false) => value.to_string(),
            Self::Var(index, 0) => block.variables[*index].name.to_owned(),
            Self::Var(index, ago) => format!("{}[-{ago}]", block.variables[*index].name),
            Self::Global(index) => format!("p{index}"),
            Self::Not(one) => format!("NOT {}", one.text(block)),
            Self::Next(one) => format!("{} + 1", one.text(block)),
            Self::Compare(op, one, other) => format!("{} {op} {}", one.text(block), other.text(block)),
            Self::Both(one, other) => format!("({}) AND ({})", one.text(block), other.text(block)),
            Self::Either(one, other) => format!("({}) OR ({})", one.text(block), other.text(block)),
        }
    }
}

fn wrapped(kind: Kind, value: i64) -> i64 {
    let range = 1_i64 << kind.width;
    let value = value.rem_euclid(range);
    if kind.signed && value >= range / 2 { value - range } else { value }
}

fn compare(op: &str, one: i64, other: i64) -> bool {
    match op {
        "<" => one < other,
        "<=" => one <= other,
        ">" => one > other,
        ">=" => one >= other,
        "<>" => one != other,
        _ => one == other,
    }
}

impl Cell {
    /// Whether `own`, the value of the column's variable, is what the cell asks in the row's first cycle or a later one.
    pub(super) fn holds(&self, own: i64, first: bool, of: &Values<'_>) -> bool {
        match self {
            Self::Any => true,
            Self::Is(exp) => own == exp.value(of),
            Self::Compare(op, exp) => compare(op, own, exp.value(of)),
            Self::Between(low, high) => *low <= own && own <= *high,
            Self::Condition(exp) => exp.value(of) == 1,
            Self::All(cells) => cells.iter().all(|cell| cell.holds(own, first, of)),
            Self::Trigger(cell) => !first || cell.holds(own, first, of),
        }
    }

    fn text(&self, block: &Block) -> String {
        match self {
            Self::Any => "-".to_owned(),
            Self::Is(exp @ (Exp::Compare(..) | Exp::Both(..) | Exp::Either(..))) => format!("= ({})", exp.text(block)),
            Self::Is(exp) => exp.text(block),
            Self::Compare(op, exp) => format!("{op} {}", exp.text(block)),
            Self::Between(low, high) => format!("[{low}, {high}]"),
            Self::Condition(exp) => exp.text(block),
            Self::All(cells) => cells.iter().map(|cell| cell.text(block)).collect::<Vec<_>>().join(", "),
            Self::Trigger(cell) => format!("^{}", cell.text(block)),
        }
    }
}

impl Table {
    /// A random table; one that is meant strictly has seldom a row for ever, and asks more seldom for inputs.
    pub(super) fn random(random: &mut Random, block: &Block, strict: bool) -> Self {
        let mut writer = Writer { random, block, strict, globals: Vec::new() };
        let mut table = Self { tree: Tree::default(), columns: Vec::new(), cells: Vec::new(), globals: Vec::new() };
        let rows = 1 + writer.random.below(4);
        writer.tree(&mut table.tree, rows);
        if writer.random.once_in(4) {
            let boolean = writer.random.once_in(2);
            let most = if boolean { 1 } else { 1 + writer.random.below(2) as i64 };
            writer.globals.push(Global { boolean, most });
        }
        for (variable, of) in block.variables.iter().enumerate() {
            let (asked, assumption) = match of.role {
                Use::Input => (!writer.random.once_in(5), true),
                Use::Output => (!writer.random.once_in(6), false),
                Use::State => (writer.random.once_in(3), writer.random.once_in(3)),
            };
            if asked {
                table.columns.push(Column { variable, assumption });
            }
        }
        if table.columns.is_empty() {
            table.columns.push(Column { variable: 0, assumption: true });
        }
        for _ in 0..rows {
            let columns = table.columns.clone();
            table.cells.push(columns.iter().map(|column| writer.cell(column)).collect());
        }
        table.globals = writer.globals;
        table
    }

    /// The table in a comment.
    pub(super) fn text(&self, name: &str, block: &Block, strict: bool) -> String {
        let kind = block.kind.name;
        let mut heading = vec!["cycle 10ms".to_owned()];
        if strict {
            heading.push("strict".to_owned());
        }
        for (index, global) in self.globals.iter().enumerate() {
            heading.push(if global.boolean {
                format!("global p{index} : BOOL")
            } else {
                format!("global p{index} : {kind} with >= 0, <= {}", global.most)
            });
        }
        let mut out = format!("@gtt {name} ({})\n| # |", heading.join(", "));
        for column in &self.columns {
            let of = &block.variables[column.variable];
            let word = match (of.role, column.assumption) {
                (Use::Input, _) => "in",
                (Use::Output, _) => "out",
                (Use::State, true) => "state",
                (Use::State, false) => "state!",
            };
            out += &format!(" {word} {} |", of.name);
        }
        out += " dur | repeat |\n";
        out += &format!("|{}\n", "---|".repeat(self.columns.len() + 3));
        let mut marks = vec![(String::new(), String::new()); self.cells.len()];
        self.mark(&self.tree.top, &mut marks);
        for (row, cells) in self.cells.iter().enumerate() {
            let cells: Vec<String> = cells.iter().map(|cell| cell.text(block)).collect();
            let (begin, end) = &marks[row];
            let dur = self.tree.rows[row].text();
            out += &format!("| {} | {} | {dur} | {begin}{end} |\n", row + 1, cells.join(" | "));
        }
        out
    }

    fn mark(&self, items: &[Item], marks: &mut [(String, String)]) {
        for item in items {
            let Item::Block(block, _) = *item else { continue };
            let (tau, body) = &self.tree.blocks[block];
            let (first, last) = (self.edge(item, true), self.edge(item, false));
            marks[first].0.push_str("{ ");
            self.mark(body, marks);
            let text = tau.text();
            marks[last].1.push_str(&format!("}} x {text} "));
        }
    }

    /// The first or the last row of an item.
    fn edge(&self, item: &Item, first: bool) -> usize {
        match *item {
            Item::Row(row, _) => row,
            Item::Block(block, _) | Item::Begun(block, _) => {
                let body = &self.tree.blocks[block].1;
                self.edge(if first { &body[0] } else { &body[body.len() - 1] }, first)
            }
        }
    }
}

struct Writer<'r, 'b> {
    random: &'r mut Random,
    block: &'b Block,
    strict: bool,
    globals: Vec<Global>,
}

impl Writer<'_, '_> {
    fn tau(&mut self, last: bool) -> Tau {
        let low = self.random.below(3) as u32;
        let high = if self.random.once_in(if self.strict { 2 } else { 3 }) {
            None
        } else {
            Some(low + self.random.below(3) as u32)
        };
        let omega = self.random.once_in(if self.strict {
            24
        } else if last {
            4
        } else {
            16
        });
        Tau { low, high, omega, flag: !omega && self.random.once_in(4) }
    }

    fn tree(&mut self, tree: &mut Tree, rows: usize) {
        for row in 0..rows {
            let tau = if self.random.once_in(3) {
                Tau { low: 1, high: Some(1), omega: false, flag: false }
            } else {
                self.tau(row + 1 == rows)
            };
            tree.rows.push(tau);
            tree.top.push(Item::Row(row, 0));
        }
        for _ in 0..2 {
            if !self.random.once_in(3) {
                continue;
            }
            let first = self.random.below(tree.top.len());
            let count = 1 + self.random.below(tree.top.len() - first);
            let tau = self.tau(first + count == tree.top.len());
            let block = Item::Block(tree.blocks.len(), 0);
            let body = tree.top.splice(first..first + count, [block]).collect();
            tree.blocks.push((tau, body));
        }
    }

    fn cell(&mut self, column: &Column) -> Cell {
        let cell = self.plain(column, true);
        if matches!(cell, Cell::Any | Cell::All(_)) || !self.random.once_in(8) {
            cell
        } else {
            Cell::Trigger(Box::new(cell))
        }
    }

    fn plain(&mut self, column: &Column, many: bool) -> Cell {
        let boolean = self.block.variables[column.variable].boolean;
        let mut operand = self.operand(boolean, column);
        // Assertions that ask little, so that runs get deep into the table.
        let asks = self.random.once_in(if column.assumption && !self.strict { 1 } else { 2 });
        match self.random.below(12) {
            0..=2 => Cell::Any,
            _ if !asks => Cell::Any,
            3..=5 => Cell::Is(if boolean { Exp::Const(self.random.below(2) as i64, true) } else { operand }),
            6 if boolean => Cell::Is(Exp::Not(Box::new(operand))),
            6 | 7 if !boolean => {
                let low = self.random.below(3) as i64;
                Cell::Between(low, low + self.random.below(3) as i64)
            }
            8 => self.condition(boolean, column),
            9 if many => Cell::All(vec![self.plain(column, false), self.plain(column, false)]),
            10 if boolean => Cell::Compare("<>", operand),
            _ if boolean => Cell::Is(operand),
            _ => {
                if self.random.once_in(3) {
                    operand = Exp::Next(Box::new(operand));
                }
                Cell::Compare(self.random.one(&["<", "<=", "=", "<>", ">", ">="]), operand)
            }
        }
    }

    /// A condition over anything, or a Boolean that equals one.
    fn condition(&mut self, boolean: bool, column: &Column) -> Cell {
        let mut one = || {
            let of_numbers = self.block.variables.iter().any(|v| !v.boolean);
            let left = self.variable(!of_numbers, column);
            let right = self.operand(!of_numbers, column);
            let op = if of_numbers {
                self.random.one(&["<", "<=", "=", "<>", ">", ">="])
            } else {
                self.random.one(&["=", "<>"])
            };
            Exp::Compare(op, Box::new(left), Box::new(right))
        };
        let (first, second) = (one(), one());
        let exp = match self.random.below(4) {
            0 => Exp::Both(Box::new(first), Box::new(second)),
            1 => Exp::Either(Box::new(first), Box::new(second)),
            _ => first,
        };
        if boolean && self.random.once_in(2) { Cell::Is(exp) } else { Cell::Condition(exp) }
    }

    /// A variable, now or a while ago; the column's own where there is no other of the type.
    fn variable(&mut self, boolean: bool, column: &Column) -> Exp {
        let fits = |index: &usize| {
            let variable = &self.block.variables[*index];
            variable.boolean == boolean
        };
        let all: Vec<usize> = (0..self.block.variables.len()).filter(fits).collect();
        let index = if all.is_empty() { column.variable } else { self.random.one(&all) };
        let ago = if self.random.once_in(3) { 1 + self.random.below(2) } else { 0 };
        Exp::Var(index, ago)
    }

    fn operand(&mut self, boolean: bool, column: &Column) -> Exp {
        let globals: Vec<usize> = (0..self.globals.len()).filter(|g| self.globals[*g].boolean == boolean).collect();
        if !globals.is_empty() && self.random.once_in(2) {
            return Exp::Global(self.random.one(&globals));
        }
        if self.random.once_in(2) {
            return Exp::Const(self.random.below(if boolean { 2 } else { 4 }) as i64, boolean);
        }
        self.variable(boolean, column)
    }
}

impl Exp {
    fn depth(&self) -> usize {
        match self {
            Self::Const(..) | Self::Global(_) => 0,
            Self::Var(_, ago) => *ago,
            Self::Not(one) | Self::Next(one) => one.depth(),
            Self::Compare(_, one, other) | Self::Both(one, other) | Self::Either(one, other) => {
                one.depth().max(other.depth())
            }
        }
    }
}

impl Cell {
    fn depth(&self) -> usize {
        match self {
            Self::Any | Self::Between(..) => 0,
            Self::Is(exp) | Self::Compare(_, exp) | Self::Condition(exp) => exp.depth(),
            Self::All(cells) => cells.iter().map(Self::depth).max().unwrap_or(0),
            Self::Trigger(cell) => cell.depth(),
        }
    }
}

impl Table {
    /// How many cycles it looks back.
    pub(super) fn depth(&self) -> usize {
        self.cells.iter().flatten().map(Cell::depth).max().unwrap_or(0)
    }
}

impl Exp {
    /// Whether all that it reads of this cycle is what `set` says of.
    fn reads_only(&self, set: &dyn Fn(usize) -> bool) -> bool {
        match self {
            Self::Const(..) | Self::Global(_) => true,
            Self::Var(index, ago) => *ago > 0 || set(*index),
            Self::Not(one) | Self::Next(one) => one.reads_only(set),
            Self::Compare(_, one, other) | Self::Both(one, other) | Self::Either(one, other) => {
                one.reads_only(set) && other.reads_only(set)
            }
        }
    }
}

impl Cell {
    /// The same of a cell of a column over the variable `own`.
    pub(super) fn reads_only(&self, own: usize, set: &dyn Fn(usize) -> bool) -> bool {
        match self {
            Self::Any => true,
            Self::Between(..) => set(own),
            Self::Is(exp) | Self::Compare(_, exp) => set(own) && exp.reads_only(set),
            Self::Condition(exp) => exp.reads_only(set),
            Self::All(cells) => cells.iter().all(|cell| cell.reads_only(own, set)),
            Self::Trigger(cell) => cell.reads_only(own, set),
        }
    }
}
