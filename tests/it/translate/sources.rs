//! Random Structured Text through the parser and the elaborator: the interpreter and the transition system agree on what comes
//! out.

use std::fmt::Write as _;

use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use rungbook::machine::elaborate::Options as ElaborateOptions;
use rungbook::machine::translate::{Options, translate};

use super::agree::{Agreement, cases};
use super::choices::Choices;

const TYPES: [&str; 16] = [
    "BOOL", "INT", "USINT", "SINT", "UINT", "DINT", "UDINT", "LINT", "ULINT", "BYTE", "WORD", "DWORD", "LWORD", "REAL",
    "LREAL", "TIME",
];
const LOOP_LIMIT: u64 = 6;

fn is_bits(name: &str) -> bool {
    matches!(name, "BYTE" | "WORD" | "DWORD" | "LWORD")
}

fn is_real(name: &str) -> bool {
    name.ends_with("REAL")
}

/// A writer of random text.
struct Writer<'a, 'b> {
    choices: &'a mut Choices<'b>,
    loops: u32,
}

impl Writer<'_, '_> {
    fn literal(&mut self, of: &str) -> String {
        let number = if self.choices.once_in(4) { self.choices.below(128) } else { self.choices.below(4) };
        match of {
            "BOOL" => ["FALSE", "TRUE"][number as usize % 2].to_owned(),
            "TIME" => format!("T#{number}ms"),
            _ if is_real(of) => format!("{of}#{number}.{}", self.choices.below(10)),
            _ if is_bits(of) => format!("{of}#16#{number:X}"),
            _ if of.starts_with('U') || self.choices.once_in(2) => format!("{of}#{number}"),
            _ => format!("{of}#-{number}"),
        }
    }

    /// A variable of the type: an input, an output, a local one, one of another block, an element of an array.
    fn variable(&mut self, of: &str, writable: bool) -> String {
        match self.choices.below(if writable { 3 } else { 6 }) {
            0 => format!("q_{of}"),
            1 => format!("s_{of}"),
            2 if of == "INT" => format!("a[{}]", self.index(0)),
            2 => format!("t_{of}"),
            3 if of == "INT" => format!("p[{}].y", self.index(1)),
            4 if of == "BOOL" => "b.q".to_owned(),
            4 if of == "DINT" => "b.sum".to_owned(),
            _ => format!("i_{of}"),
        }
    }

    fn index(&mut self, low: u32) -> String {
        match self.choices.below(4) {
            0 => format!("{low} + USINT_TO_INT(i_USINT MOD 3)"),
            1 => format!("{}", low + self.choices.below(3)),
            2 => format!("{low} + BOOL_TO_INT({})", self.expression("BOOL", 1)),
            _ => "k".to_owned(),
        }
    }

    fn expression(&mut self, of: &str, depth: u32) -> String {
        if depth == 0 || self.choices.once_in(4) {
            return if self.choices.once_in(4) { self.literal(of) } else { self.variable(of, false) };
        }
        let deeper = depth - 1;
        let (a, b) = (self.expression(of, deeper), self.expression(of, deeper));
        match self.choices.below(10) {
            0 => {
                let condition = self.expression("BOOL", deeper);
                return format!("SEL({condition}, {a}, {b})");
            }
            1 if of != "TIME" => {
                let from = self.choices.one(&TYPES[..15]);
                if from != of {
                    return format!("{from}_TO_{of}({})", self.expression(from, deeper));
                }
            }
            2 if of != "BOOL" => return format!("{}({a}, {b})", self.choices.one(&["MIN", "MAX"])),
            3 if of != "BOOL" => return format!("LIMIT({a}, {b}, {})", self.expression(of, deeper)),
            _ => {}
        }
        match of {
            "BOOL" => self.truth(a, b, deeper),
            "TIME" => format!("({a} {} {b})", self.choices.one(&["+", "-"])),
            _ if is_real(of) => match self.choices.below(6) {
                0 => format!("SQRT({a})"),
                1 => format!("ABS({a})"),
                _ => format!("({a} {} {b})", self.choices.one(&["+", "-", "*", "/"])),
            },
            _ if is_bits(of) => match self.choices.below(4) {
                0 => format!("(NOT {a})"),
                1 => {
                    let function = self.choices.one(&["SHL", "SHR", "ROL", "ROR"]);
                    format!("{function}({a}, {})", self.expression("USINT", deeper))
                }
                _ => format!("({a} {} {b})", self.choices.one(&["AND", "OR", "XOR"])),
            },
            _ => match self.choices.below(8) {
                0 => format!("ABS({a})"),
                1 => format!("({a} / {b})"),
                2 => format!("({a} MOD {})", self.literal(of)),
                3 if !of.starts_with('U') => format!("(-{a})"),
                _ => format!("({a} {} {b})", self.choices.one(&["+", "-", "*"])),
            },
        }
    }

    fn truth(&mut self, a: String, b: String, depth: u32) -> String {
        match self.choices.below(6) {
            0 => format!("(NOT {a})"),
            1 => format!("({a} {} {b})", self.choices.one(&["AND_THEN", "OR_ELSE"])),
            2 => format!("({a} {} {b})", self.choices.one(&["AND", "OR", "XOR"])),
            _ => {
                let of = self.choices.one(&TYPES[1..]);
                let sign = self.choices.one(&["=", "<>", "<", "<=", ">", ">="]);
                format!("({} {sign} {})", self.expression(of, depth), self.expression(of, depth))
            }
        }
    }

    fn block(&mut self, depth: u32) -> String {
        (0..1 + self.choices.below(4)).map(|_| self.statement(depth)).collect()
    }

    fn statement(&mut self, depth: u32) -> String {
        match self.choices.below(14) {
            4 | 5 if depth > 0 => {
                let mut text = format!("IF {} THEN\n{}", self.expression("BOOL", 2), self.block(depth - 1));
                if self.choices.once_in(2) {
                    let _ = write!(text, "ELSIF {} THEN\n{}", self.expression("BOOL", 2), self.block(depth - 1));
                }
                if self.choices.once_in(2) {
                    let _ = write!(text, "ELSE\n{}", self.block(depth - 1));
                }
                text + "END_IF\n"
            }
            6 if depth > 0 => {
                let mut text = format!("CASE {} OF\n", self.expression("INT", 2));
                let labels = ["-1:\n", "0, 5:\n", "1..3:\n", "7..100, 200:\n"];
                for label in labels.iter().take(1 + self.choices.below(4) as usize) {
                    let _ = write!(text, "{label}{}", self.block(depth - 1));
                }
                if self.choices.once_in(2) {
                    let _ = write!(text, "ELSE\n{}", self.block(depth - 1));
                }
                text + "END_CASE\n"
            }
            7..=9 if depth > 0 && self.loops < 2 => {
                self.loops += 1;
                let text = self.repetition(depth - 1);
                self.loops -= 1;
                text
            }
            10 if self.loops > 0 => {
                let jump = self.choices.one(&["EXIT", "CONTINUE", "RETURN"]);
                format!("IF {} THEN {jump}; END_IF\n", self.expression("BOOL", 2))
            }
            11 => format!("b(x := {}, go := {});\n", self.expression("DINT", 2), self.expression("BOOL", 2)),
            12 => format!("s_INT := F({}, {});\n", self.expression("INT", 2), self.expression("BOOL", 1)),
            13 => format!(
                "tim(IN := {}, PT := {}, Q => q_BOOL, ET => q_TIME);\n",
                self.expression("BOOL", 2),
                self.literal("TIME")
            ),
            _ => {
                let of = self.choices.one(&TYPES);
                format!("{} := {};\n", self.variable(of, true), self.expression(of, 3))
            }
        }
    }

    fn repetition(&mut self, depth: u32) -> String {
        match self.choices.below(3) {
            0 => {
                let (from, to, by) = match self.choices.below(4) {
                    0 => ("0", "2", "1"),
                    1 => ("3", "0", "-1"),
                    2 => ("1", "5", "2"),
                    _ => ("0", "s_INT MOD 5", "1"),
                };
                format!("FOR k := {from} TO {to} BY {by} DO\n{}END_FOR\n", self.block(depth))
            }
            1 => format!("WHILE {} DO\n{}END_WHILE\n", self.expression("BOOL", 2), self.block(depth)),
            _ => format!("REPEAT\n{}UNTIL {} END_REPEAT\n", self.block(depth), self.expression("BOOL", 2)),
        }
    }
}

/// A random block with everything that it uses.
fn source(choices: &mut Choices<'_>) -> String {
    let mut text = "TYPE POINT : STRUCT x : BOOL; y : INT; END_STRUCT END_TYPE\n\
        FUNCTION F : INT VAR_INPUT a : INT; c : BOOL; END_VAR VAR n : INT := 3; END_VAR\n\
        IF c THEN F := a + n; RETURN; END_IF n := n * 2; F := n - a; END_FUNCTION\n\
        FUNCTION_BLOCK OTHER VAR_INPUT x : DINT; go : BOOL; END_VAR VAR_OUTPUT q : BOOL; sum : DINT; END_VAR\n\
        IF go THEN sum := sum + x; END_IF q := sum > 10; END_FUNCTION_BLOCK\n\
        FUNCTION_BLOCK MAIN\n"
        .to_owned();
    for (section, letter) in [("VAR_INPUT", 'i'), ("VAR_OUTPUT", 'q'), ("VAR", 's'), ("VAR_TEMP", 't')] {
        let _ = writeln!(text, "{section}");
        for of in TYPES {
            let _ = writeln!(text, "{letter}_{of} : {of};");
        }
        let _ = writeln!(text, "END_VAR");
    }
    text +=
        "VAR a : ARRAY[0..2] OF INT := [1, 2, 3]; p : ARRAY[1..3] OF POINT; b : OTHER; k : INT; tim : TON; END_VAR\n";
    let body = Writer { choices, loops: 0 }.block(3);
    text + &body + "END_FUNCTION_BLOCK\n"
}

#[test]
fn sources_mean_the_same_interpreted_and_translated() {
    let count = (cases(400) / 10).max(1);
    let config = ProptestConfig {
        cases: count,
        max_shrink_iters: 2_000,
        max_shrink_time: 120_000,
        failure_persistence: None,
        ..Default::default()
    };
    let cycles = std::cell::Cell::new(0);
    let result = TestRunner::new(config).run(&prop::collection::vec(any::<u32>(), 0..1500), |stream| {
        let mut choices = Choices::new(&stream);
        let text = source(&mut choices);
        let program = crate::elaborate::with(&text, "MAIN", &ElaborateOptions::default()).1;
        let program = program.map_err(|errors| TestCaseError::fail(format!("{errors:#?}\n{text}")))?;
        let options = Options { loop_limit: LOOP_LIMIT, ..Options::default() };
        let translated = translate(&program, &options).map_err(|error| TestCaseError::fail(format!("{error:?}")))?;
        let agreement = Agreement { program: &program, translated: &translated, loop_limit: LOOP_LIMIT, cycles: 20 };
        let done = agreement.check(&mut choices).map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        cycles.set(cycles.get() + done.0);
        Ok(())
    });
    println!("{count} sources, {} cycles", cycles.get());
    if let Err(error) = result {
        panic!("{error}");
    }
}
