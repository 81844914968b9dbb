//! Files for other tools, read by them: `berkeley-abc` and `yosys` (AIGER), `btorsim` and the Python module `bitwuzla`
//! (BTOR2), `NuSMV` or `nuXmv` (SMV). What is not there is skipped, with a word.

use std::io::Write;
use std::path::Path;
use std::process::Command;

use rungbook::logic::blast::blast;
use rungbook::logic::system::{Input, Labelled, State, System};
use rungbook::logic::term::{Op, Term, mask};
use rungbook::logic::write::{Names, ascii, binary, btor2, smv};

/// Runs a tool and gives what it prints; `None`, with a word, where it is not there.
fn tool(name: &str, arguments: &[&str]) -> Option<String> {
    match Command::new(name).args(arguments).output() {
        Ok(output) => {
            Some(String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr))
        }
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "skipped: a file read by `{name}` ({error})");
            None
        }
    }
}

fn labelled(term: Term, name: &str) -> Labelled {
    Labelled { term, name: name.to_owned(), origin: None }
}

struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, end: usize) -> usize {
        usize::try_from(self.next() % end as u64).unwrap_or(0)
    }
}

const WIDTHS: [u32; 5] = [8, 6, 1, 5, 32];

/// A system that uses every operator on states and inputs of several widths.
pub(super) fn rich(seed: u64) -> System {
    let mut numbers = Numbers(seed | 1);
    let mut system = System::default();
    for (index, width) in [8, 1, 32].into_iter().enumerate() {
        let name = format!("in {index}");
        let variable = system.pool.variable(width, &name);
        system.inputs.push(Input { variable, name, origin: None });
    }
    let mut terms: Vec<Term> = system.inputs.iter().map(|input| input.variable).collect();
    for (index, width) in WIDTHS.into_iter().enumerate() {
        let name = format!("state.{index}");
        let variable = system.pool.variable(width, &name);
        let initial = Some(system.pool.constant(width, numbers.next()));
        system.states.push(State { variable, name, initial, next: variable, origin: None });
        terms.push(variable);
    }
    for step in 0..60 {
        let new = step_of(&mut system, &mut numbers, &terms, step);
        terms.push(new);
    }
    for index in 0..WIDTHS.len() {
        let (a, b) = (terms[terms.len() - 1 - index], terms[numbers.below(terms.len())]);
        let (a, b) = (fit(&mut system, a, WIDTHS[index]), fit(&mut system, b, WIDTHS[index]));
        system.states[index].next = system.pool.xor(a, b);
    }
    for (index, term) in terms.iter().enumerate().skip(8) {
        system.outputs.push(labelled(*term, &format!("out {index}")));
    }
    system
}

fn fit(system: &mut System, term: Term, width: u32) -> Term {
    let own = system.pool.width(term);
    if own < width { system.pool.sign_extend(term, width) } else { system.pool.extract(term, width - 1, 0) }
}

fn step_of(system: &mut System, numbers: &mut Numbers, terms: &[Term], step: usize) -> Term {
    let (a, b) = (terms[numbers.below(terms.len())], terms[numbers.below(terms.len())]);
    let c = terms[numbers.below(terms.len())];
    let width = system.pool.width(a);
    let b = fit(system, b, width);
    let binary = [
        Op::And,
        Op::Or,
        Op::Xor,
        Op::Add,
        Op::Sub,
        Op::Mul,
        Op::Udiv,
        Op::Sdiv,
        Op::Urem,
        Op::Srem,
        Op::Shl,
        Op::Lshr,
        Op::Ashr,
        Op::Eq,
        Op::Ult,
        Op::Ule,
        Op::Slt,
        Op::Sle,
    ];
    let floats = [Op::FloatAdd, Op::FloatLt, Op::FloatLe, Op::FloatEq];
    match step % 26 {
        at @ 0..18 => system.pool.apply(binary[at], &[a, b]),
        18 => system.pool.not(a),
        19 => system.pool.neg(a),
        20 => {
            let condition = fit(system, c, 1);
            system.pool.ite(condition, a, b)
        }
        21 => {
            let (a, b) = (fit(system, a, 6), fit(system, b, 8));
            system.pool.concat(a, b)
        }
        22 => system.pool.extract(a, width - 1, width / 2),
        23 => system.pool.zero_extend(a, (width + 3).min(64)),
        24 => system.pool.sign_extend(a, (width + 2).min(64)),
        _ => {
            let (a, b) = (fit(system, a, 32), fit(system, b, 32));
            system.pool.apply(floats[numbers.below(floats.len())], &[a, b])
        }
    }
}

/// Random inputs for so many cycles.
fn inputs(system: &System, numbers: &mut Numbers, cycles: usize) -> Vec<Vec<u64>> {
    let cycle = |numbers: &mut Numbers| {
        let widths = system.inputs.iter().map(|input| system.pool.width(input.variable));
        widths.map(|width| numbers.next() & mask(width)).collect()
    };
    (0..cycles).map(|_| cycle(numbers)).collect()
}

/// The system with its inputs forced by a constraint to a run's, and two obligations: that after the run every output is
/// what it is in the run, which holds, and that some output is not, which fails in the last cycle.
fn forced(system: &System, inputs: &[Vec<u64>]) -> System {
    let run = system.simulate(&[], inputs);
    let mut out = system.clone();
    let pool = &mut out.pool;
    let (count, zero, one) = (pool.variable(8, "cycle"), pool.constant(8, 0), pool.constant(8, 1));
    let next = pool.add(count, one);
    let mut forced = pool.truth(true);
    for (cycle, values) in inputs.iter().enumerate() {
        let number = pool.constant(8, cycle as u64);
        let now = pool.eq(count, number);
        for (input, value) in system.inputs.iter().zip(values) {
            let value = pool.constant(pool.width(input.variable), *value);
            let (same, not) = (pool.eq(input.variable, value), pool.not(now));
            let kept = pool.or(not, same);
            forced = pool.and(forced, kept);
        }
    }
    let last = pool.constant(8, inputs.len() as u64 - 1);
    let end = pool.eq(count, last);
    let mut same = pool.truth(true);
    for (output, value) in system.outputs.iter().zip(&run[inputs.len() - 1].outputs) {
        let value = pool.constant(pool.width(output.term), *value);
        let equal = pool.eq(output.term, value);
        same = pool.and(same, equal);
    }
    let (right, not_same) = (pool.implies(end, same), pool.not(same));
    let wrong = pool.implies(end, not_same);
    out.states.push(State { variable: count, name: "cycle".to_owned(), initial: Some(zero), next, origin: None });
    out.constraints.push(labelled(forced, "the inputs of the run"));
    out.obligations = vec![labelled(right, "right"), labelled(wrong, "wrong")];
    out
}

fn path(folder: &Path, name: &str, bytes: impl AsRef<[u8]>) -> String {
    let path = folder.join(name);
    std::fs::write(&path, bytes).expect("a file in a folder of our own");
    path.to_string_lossy().into_owned()
}

/// Whether ABC reaches the bad state within so many cycles, and in which.
fn abc(file: &str, cycles: usize) -> Option<String> {
    tool("berkeley-abc", &["-q", &format!("read_aiger {file}; fold; bmc3 -F {cycles}")])
}

#[test]
fn abc_sees_the_same_values_in_binary_aiger() {
    let folder = tempfile::tempdir().expect("a folder");
    for seed in 1..=6 {
        let mut numbers = Numbers(seed * 0x9e37_79b9);
        let system = rich(seed * 77);
        let inputs = inputs(&system, &mut numbers, 5);
        let system = forced(&system, &inputs);
        for (index, fails) in [(0, false), (1, true)] {
            let blasted = blast(&system.cone(&[index]).system);
            let bytes = binary(&blasted.model, &Names::default());
            let file = path(folder.path(), &format!("{seed}{index}.aig"), bytes);
            let Some(said) = abc(&file, 6) else { return };
            let expected = if fails { "was asserted in frame 4" } else { "No output" };
            assert!(said.contains(expected), "seed {seed}, {expected}: {said}");
        }
    }
}

#[test]
fn yosys_reads_ascii_aiger_as_binary_aiger() {
    let folder = tempfile::tempdir().expect("a folder");
    let system = rich(5);
    let mut system = forced(&system, &inputs(&system, &mut Numbers(7), 3));
    // This reader miscounts the lines of constraints in the ASCII form.
    system.constraints.clear();
    let blasted = blast(&system);
    let names = Names::of(&system, &blasted);
    let text = path(folder.path(), "a.aag", ascii(&blasted.model, &names));
    let bytes = path(folder.path(), "b.aig", binary(&blasted.model, &names));
    let counts = |file: &str| {
        let said = tool("yosys", &["-p", &format!("read_aiger {file}; stat")])?;
        assert!(!said.contains("ERROR"), "{said}");
        Some(said.lines().filter(|line| line.contains("$_AND_")).map(str::to_owned).collect::<Vec<_>>())
    };
    let (Some(left), Some(right)) = (counts(&text), counts(&bytes)) else { return };
    assert_eq!(left, right);
    assert_eq!(left.len(), 1);
}

/// A witness of BTOR2 for obligation `index`: nothing but the inputs.
fn witness(system: &System, inputs: &[Vec<u64>], index: usize) -> String {
    let mut out = format!("sat\nb{index}\n");
    for (cycle, values) in inputs.iter().enumerate() {
        out.push_str(&format!("@{cycle}\n"));
        for (input, value) in values.iter().enumerate() {
            let width = system.pool.width(system.inputs[input].variable) as usize;
            out.push_str(&format!("{input} {value:0width$b}\n"));
        }
    }
    out + ".\n"
}

#[test]
fn btorsim_sees_the_same_values() {
    let folder = tempfile::tempdir().expect("a folder");
    for seed in 1..=20 {
        let system = rich(seed * 131);
        let inputs = inputs(&system, &mut Numbers(seed * 1009), 7);
        let system = forced(&system, &inputs);
        let file = path(folder.path(), &format!("{seed}.btor2"), btor2(&system));
        for (index, fails) in [(0, false), (1, true)] {
            let run = path(folder.path(), &format!("{seed}{index}.wit"), witness(&system, &inputs, index));
            let Some(said) = tool("btorsim", &["-c", "-v", &file, &run]) else { return };
            assert_eq!(said.contains("claimed bad state property"), !fails, "seed {seed}: {said}");
        }
    }
}

/// Whether the Python module `bitwuzla` finds the constraints of a system without states satisfiable.
fn satisfiable(folder: &Path, system: &System) -> Option<bool> {
    const SCRIPT: &str = "import sys\ntry:\n import bitwuzla as b\nexcept ImportError:\n print('absent')\n sys.exit()\n\
                          p = b.Parser(b.TermManager(), b.Options(), 'btor2')\np.parse(sys.argv[1], True, True)\n\
                          print(p.bitwuzla().check_sat())";
    let file = path(folder, "c.btor2", btor2(system));
    let said = tool("python3", &["-c", SCRIPT, &file])?;
    match said.trim() {
        "sat" => Some(true),
        "unsat" => Some(false),
        "absent" => {
            let _ = writeln!(std::io::stderr(), "skipped: BTOR2 read by the Python module `bitwuzla` (it is absent)");
            None
        }
        other => panic!("{other}"),
    }
}

#[test]
fn bitwuzla_sees_the_same_values_of_terms() {
    let folder = tempfile::tempdir().expect("a folder");
    for seed in 1..=4 {
        let mut system = rich(seed * 1237);
        let states = std::mem::take(&mut system.states);
        system.inputs.extend(states.into_iter().map(|state| {
            let variable = state.variable;
            Input { variable, name: state.name, origin: None }
        }));
        let inputs = inputs(&system, &mut Numbers(seed * 31), 1);
        let system = forced(&system, &inputs);
        for (index, holds) in [(0, true), (1, false)] {
            let mut one = system.cone(&[index]).system;
            // The count of cycles is 0 in the only one.
            let zero = one.pool.constant(8, 0);
            let count = one.states[0].variable;
            let start = one.pool.eq(count, zero);
            one.constraints.extend([labelled(start, "start"), one.obligations[0].clone()]);
            one.obligations.clear();
            one.outputs.clear();
            let count = one.states.remove(0);
            one.inputs.push(Input { variable: count.variable, name: count.name, origin: None });
            let Some(found) = satisfiable(folder.path(), &one) else { return };
            assert_eq!(found, holds, "seed {seed}, obligation {index}");
        }
    }
}

#[test]
fn nusmv_sees_the_same_values() {
    let folder = tempfile::tempdir().expect("a folder");
    let script = path(folder.path(), "go.cmd", "go_bmc\ncheck_invar_bmc -a een-sorensson -k 5\nquit\n");
    for seed in [1, 5, 9] {
        let system = rich(seed * 33 + 66);
        let inputs = inputs(&system, &mut Numbers(seed * 3), 3);
        let text = smv(&forced(&system, &inputs));
        assert!(text.lines().filter(|line| line.starts_with("INVARSPEC")).count() == 2, "{text}");
        let file = path(folder.path(), &format!("{seed}.smv"), text);
        let Some(said) = ["nuXmv", "NuSMV"].into_iter().find_map(|name| tool(name, &["-source", &script, &file]))
        else {
            return;
        };
        // That the outputs are those of the run is not refuted; that they are not is.
        assert!(!said.contains("syntax error") && said.matches("is false").count() == 1, "{said}");
        assert!(said.contains("-> State: 1.3") && !said.contains("-> State: 1.4"), "in the last cycle: {said}");
    }
}
