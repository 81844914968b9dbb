//! Random blocks in Structured Text, small enough that all that they can do can be looked at.

use super::random::Random;

/// An integer type.
#[derive(Clone, Copy, Debug)]
pub(super) struct Kind {
    pub(super) name: &'static str,
    pub(super) width: u32,
    pub(super) signed: bool,
}

const KINDS: [Kind; 4] = [
    Kind { name: "INT", width: 16, signed: true },
    Kind { name: "USINT", width: 8, signed: false },
    Kind { name: "SINT", width: 8, signed: true },
    Kind { name: "UINT", width: 16, signed: false },
];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Use {
    Input,
    Output,
    State,
}

/// A variable of the block.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub(super) name: &'static str,
    pub(super) role: Use,
    pub(super) boolean: bool,
    pub(super) initial: i64,
    /// What the environment may choose, where it is an integer.
    pub(super) most: i64,
}

/// A block.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) kind: Kind,
    pub(super) variables: Vec<Variable>,
    pub(super) body: String,
    timer: bool,
    /// Whether its cycle may fault.
    pub(super) faulty: bool,
}

impl Block {
    pub(super) fn random(random: &mut Random) -> Self {
        let mut block = Self {
            kind: random.one(&KINDS),
            variables: Vec::new(),
            body: String::new(),
            timer: random.once_in(5),
            faulty: random.once_in(6),
        };
        let mut add = |name, role, boolean, initial, most| {
            block.variables.push(Variable { name, role, boolean, initial, most });
        };
        add("a", Use::Input, true, 0, 1);
        if random.once_in(2) {
            add("b", Use::Input, true, 0, 1);
        }
        if random.once_in(3) {
            add("n", Use::Input, false, 0, 1 + random.below(2) as i64);
        }
        add("q", Use::Output, true, random.below(2) as i64, 1);
        if random.once_in(2) {
            add("c", Use::Output, false, random.below(2) as i64, 0);
        }
        if random.once_in(2) {
            add("m", Use::State, true, 0, 1);
        }
        if random.once_in(3) {
            add("k", Use::State, false, random.below(3) as i64, 0);
        }
        let mut writer = Writer { random, block: &block, out: String::new() };
        if block.timer {
            let given = writer.truth(1);
            writer.out.push_str(&format!("t(IN := {given}, PT := T#{}0ms);\n", 1 + writer.random.below(2)));
        }
        for _ in 0..1 + writer.random.below(3) {
            writer.statement(2);
        }
        block.body = writer.out;
        block
    }

    /// The text of the block, with comments in front.
    pub(super) fn text(&self, name: &str) -> String {
        let declared = |role: Use, word: &str| {
            let mut out = format!("{word}\n");
            for variable in self.variables.iter().filter(|variable| variable.role == role) {
                let kind = self.kind.name;
                out += &match (variable.boolean, role) {
                    (true, _) => format!("    {} : BOOL := {};\n", variable.name, truth(variable.initial)),
                    (false, Use::Input) => format!("    {} : {kind} (0..{});\n", variable.name, variable.most),
                    (false, _) => format!("    {} : {kind} := {};\n", variable.name, variable.initial),
                };
            }
            if self.timer && role == Use::State {
                out += "    t : TON;\n";
            }
            out + "END_VAR\n"
        };
        format!(
            "FUNCTION_BLOCK {name}\n{}{}{}{}END_FUNCTION_BLOCK\n",
            declared(Use::Input, "VAR_INPUT"),
            declared(Use::Output, "VAR_OUTPUT"),
            declared(Use::State, "VAR"),
            self.body
        )
    }
}

fn truth(value: i64) -> &'static str {
    if value == 0 { "FALSE" } else { "TRUE" }
}

struct Writer<'r, 'b> {
    random: &'r mut Random,
    block: &'b Block,
    out: String,
}

impl Writer<'_, '_> {
    fn names(&self, boolean: bool, set: bool) -> Vec<&'static str> {
        let fits = |v: &&Variable| v.boolean == boolean && (!set || v.role != Use::Input);
        self.block.variables.iter().filter(fits).map(|v| v.name).collect()
    }

    fn truth(&mut self, depth: usize) -> String {
        let names = self.names(true, false);
        let numbers = self.names(false, false);
        match self.random.below(if depth == 0 { 3 } else { 8 }) {
            0..=2 => self.random.one(&names).to_owned(),
            3 => format!("NOT {}", self.random.one(&names)),
            4 | 5 => {
                let op = self.random.one(&["AND", "OR", "XOR"]);
                format!("({} {op} {})", self.truth(depth - 1), self.truth(depth - 1))
            }
            6 if self.block.timer => "t.Q".to_owned(),
            _ if numbers.is_empty() => self.random.one(&["TRUE", "FALSE"]).to_owned(),
            _ => {
                let op = self.random.one(&["<", "<=", "=", "<>", ">"]);
                format!("({} {op} {})", self.number(), self.random.below(4))
            }
        }
    }

    /// An integer that is small where its operands are.
    fn number(&mut self) -> String {
        let names = self.names(false, false);
        let x = self.random.one(&names);
        match self.random.below(if self.block.faulty { 9 } else { 8 }) {
            0 => self.random.below(4).to_string(),
            1 | 2 => x.to_owned(),
            3 => format!("MIN({x} + 1, {})", 1 + self.random.below(3)),
            4 => format!("({x} + 1) MOD {}", 2 + self.random.below(3)),
            5 => format!("SEL({}, {x}, {})", self.truth(0), self.random.below(4)),
            6 => format!("MAX({x}, {})", self.random.one(&names)),
            7 => format!("(3 - ({x} MOD 4))"),
            _ => format!("3 / {x}"),
        }
    }

    fn statement(&mut self, depth: usize) {
        let numbers = self.names(false, true);
        match self.random.below(if depth == 0 { 3 } else { 7 }) {
            0 if !numbers.is_empty() => {
                let (target, value) = (self.random.one(&numbers), self.number());
                self.out.push_str(&format!("{target} := {value};\n"));
            }
            0..=2 => {
                let names = self.names(true, true);
                let (target, value) = (self.random.one(&names), self.truth(2));
                self.out.push_str(&format!("{target} := {value};\n"));
            }
            3 if !numbers.is_empty() => {
                let of = self.random.one(&numbers);
                self.out.push_str(&format!("CASE {of} OF\n0:\n"));
                self.statement(depth - 1);
                self.out.push_str("1, 2:\n");
                self.statement(depth - 1);
                if self.random.once_in(2) {
                    self.out.push_str("ELSE\n");
                    self.statement(depth - 1);
                }
                self.out.push_str("END_CASE;\n");
            }
            _ => {
                let condition = self.truth(1);
                self.out.push_str(&format!("IF {condition} THEN\n"));
                self.statement(depth - 1);
                if self.random.once_in(2) {
                    self.out.push_str("ELSE\n");
                    self.statement(depth - 1);
                }
                self.out.push_str("END_IF;\n");
            }
        }
    }
}
