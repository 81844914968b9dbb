//! The same programs through a C compiler: its arithmetic and its control flow against the interpreter's.

use std::fmt::Write as _;
use std::process::Command;

use rungbook::machine::interpret::{Interpreter, Options as RunOptions};
use rungbook::machine::program::{Program, Role, SlotId};

use super::agree::{cases, input};
use super::choices::{Choices, stream};
use super::programs::program;
use super::render::{PRELUDE, Renderer, kind, number};

const LOOP_LIMIT: u64 = 6;
const CYCLES: usize = 20;

/// The runs of a program: its inputs by cycle and slot, and the lines that C must print.
struct Expected {
    inputs: Vec<Vec<(usize, u64)>>,
    lines: Vec<String>,
}

fn run(program: &Program, choices: &mut Choices<'_>) -> Expected {
    let mut interpreter = Interpreter::with(program, &RunOptions { loop_limit: LOOP_LIMIT });
    let mut expected = Expected { inputs: Vec::new(), lines: Vec::new() };
    for _ in 0..CYCLES {
        let is_input = |at: &usize| matches!(program.slots[*at].role, Role::Input | Role::Arbitrary);
        let inputs: Vec<(usize, u64)> =
            (0..program.slots.len()).filter(is_input).map(|at| (at, input(choices, program, at))).collect();
        for (at, value) in &inputs {
            interpreter.set(SlotId(*at as u32), *value);
        }
        expected.inputs.push(inputs);
        match interpreter.cycle() {
            Ok(()) => {
                let cells: Vec<String> = interpreter.memory().iter().map(|cell| format!("{cell:x}")).collect();
                expected.lines.push(cells.join(" "));
            }
            Err(at) => {
                expected.lines.push(format!("fault {} {}", kind(at.fault), number(at.place)));
                break;
            }
        }
    }
    expected
}

/// The function that runs program `n` on its inputs.
fn driver(n: usize, program: &Program, expected: &Expected) -> String {
    let count = program.slots.len();
    let mut text = format!(
        "static void p{n}_run(void) {{\ninit = p{n}_init; memcpy(m, init, sizeof p{n}_init);\n\
         if (setjmp(out)) {{ printf(\"fault %d %d\\n\", fault_kind, fault_place); return; }}\n\
         p{n}_startup({0});\n",
        program.this.0
    );
    for inputs in &expected.inputs {
        for (at, value) in inputs {
            let _ = write!(text, "m[{at}] = {value}ull; ");
        }
        for (slot, step) in &program.clocks {
            let _ = write!(text, "m[{0}] = (uint32_t)(m[{0}] + {step}); ", slot.0);
        }
        let _ = writeln!(text, "p{n}_cycle({}); dump({count});", program.this.0);
    }
    text + "}\n"
}

#[test]
fn programs_mean_the_same_compiled_by_a_c_compiler() {
    if Command::new("cc").arg("--version").output().is_err() {
        println!("skipped: no C compiler (`cc`) here");
        return;
    }
    let mut source = format!("{PRELUDE}#define AMOUNT(x) ((uint64_t)(x) & (~0ull >> (64 - 8 * sizeof(x))))\n");
    source += "static void dump(int n) { for (int i = 0; i < n; i++) printf(i ? \" %llx\" : \"%llx\", (unsigned long long)m[i]); putchar(10); }\n";
    let (mut lines, mut programs, mut calls) = (Vec::new(), Vec::new(), String::new());
    for n in 0..(cases(4_000) / 100).max(1) as usize {
        let stream = stream(n as u64, 3000);
        let mut choices = Choices::integers(&stream);
        let program = program(&mut choices);
        let expected = run(&program, &mut choices);
        source += &Renderer::new(&program, n, LOOP_LIMIT).program();
        source += &driver(n, &program, &expected);
        let _ = writeln!(calls, "p{n}_run();");
        lines.extend(expected.lines.into_iter().enumerate().map(|(cycle, line)| (n, cycle, line)));
        programs.push(program);
    }
    let _ = write!(source, "int main(void) {{\n{calls}return 0;\n}}\n");
    let folder = tempfile::tempdir().expect("a folder for the C file");
    let (file, binary) = (folder.path().join("programs.c"), folder.path().join("programs"));
    std::fs::write(&file, source).expect("the C file is written");
    let compiled =
        Command::new("cc").args(["-O0", "-w", "-fwrapv", "-o"]).args([&binary, &file]).output().expect("cc runs");
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let output = Command::new(&binary).output().expect("the compiled programs run");
    assert!(output.status.success(), "{:?}", output.status);
    let printed = String::from_utf8_lossy(&output.stdout);
    for ((n, cycle, expected), found) in lines.iter().zip(printed.lines()) {
        assert_eq!(found, expected, "cycle {cycle} of program {n}: {}", super::agree::listing(&programs[*n]));
    }
    assert_eq!(printed.lines().count(), lines.len());
    println!("{} programs, {} cycles", programs.len(), lines.len());
}
