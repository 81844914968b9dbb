//! Decides AIGER files as the prover decides the obligations of tables, for `benches/compare.py`:
//!
//!     cargo run --release --no-default-features --example aiger -- [--timeout SECONDS] [--jobs N] [--engine NAME] FILE…
//!
//! A line a file: verdict, engine, file. Without a name it is the portfolio that decides.
//!
//! Words are taken from names: `x[0]`, `x[1]` … are the bits of one.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    clippy::disallowed_methods,
    reason = "it is a program of its own, which prints, and reads the files that it is given"
)]

use std::collections::BTreeMap;
use std::process::ExitCode;

use rungbook::logic::aig::{Lit, Model};
use rungbook::logic::read::aiger;
use rungbook::logic::write::Names;
use rungbook::prove::bmc::Bmc;
use rungbook::prove::engine::{Answer, Budget, Engine, Hints};
use rungbook::prove::ic3::Ic3;
use rungbook::prove::induction::Induction;
use rungbook::prove::interpolation::Interpolation;
use rungbook::prove::mine::Mine;
use rungbook::prove::portfolio::{Options, decide};

/// The latches of each word, the least significant bit first.
fn words(model: &Model, names: &Names) -> Vec<Vec<Lit>> {
    let mut words: BTreeMap<&str, BTreeMap<usize, Lit>> = BTreeMap::new();
    for (latch, name) in model.latches.iter().zip(&names.latches) {
        let (word, bit) = name.strip_suffix(']').and_then(|name| name.rsplit_once('[')).unwrap_or((name, "0"));
        if let Ok(bit) = bit.parse() {
            words.entry(word).or_default().insert(bit, latch.lit);
        }
    }
    words.into_values().map(|bits| bits.into_values().collect()).collect()
}

/// What the command line says.
struct Request {
    seconds: f64,
    jobs: usize,
    engine: Option<Box<dyn Engine>>,
    files: Vec<String>,
}

fn engine(name: &str) -> Option<Box<dyn Engine>> {
    let all: [Box<dyn Engine>; 5] =
        [Box::new(Bmc), Box::new(Induction), Box::new(Ic3), Box::new(Interpolation), Box::new(Mine::default())];
    all.into_iter().find(|engine| engine.name() == name)
}

fn request(mut arguments: impl Iterator<Item = String>) -> Result<Request, String> {
    let mut request = Request { seconds: 60.0, jobs: 1, engine: None, files: Vec::new() };
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--timeout" => {
                let given = arguments.next().and_then(|text| text.parse().ok()).filter(|given| *given >= 0.0);
                request.seconds = given.ok_or("--timeout takes seconds")?;
            }
            "--jobs" => {
                let given = arguments.next().and_then(|text| text.parse().ok()).filter(|given| *given > 0);
                request.jobs = given.ok_or("--jobs takes a number from 1 on")?;
            }
            "--engine" => {
                let given = arguments.next().and_then(|name| engine(&name));
                request.engine = Some(given.ok_or("--engine takes bmc, induction, ic3, interpolation or mine")?);
            }
            _ => request.files.push(argument),
        }
    }
    Ok(request)
}

fn answer(file: &str, request: &Request) -> Result<String, String> {
    let bytes = std::fs::read(file).map_err(|error| error.to_string())?;
    let (model, mut names) = aiger(&bytes).map_err(|error| error.to_string())?;
    let begun = model.latches.iter().position(|latch| latch.next == Lit::TRUE && latch.initial == Some(false));
    let before = model.latches.len();
    let model = model.without_first_cycle();
    if let Some(begun) = begun.filter(|_| model.latches.len() < before) {
        names.latches.remove(begun);
    }
    if model.bad.len() != 1 {
        return Err(format!("{} properties, and one is decided", model.bad.len()));
    }
    let budget = Budget::seconds(request.seconds);
    let (answer, engine) = if let Some(engine) = &request.engine {
        (engine.run(&model, 0, &budget, &|_| ()), engine.name())
    } else {
        let options = Options { threads: request.jobs, hints: Hints { words: words(&model, &names) } };
        let outcome = decide(&model, 0, &options, &budget, &|_| ());
        (outcome.answer, outcome.engine)
    };
    let verdict = match answer {
        Answer::Proved(_) => "verified".to_owned(),
        Answer::Violated(_) => "violated".to_owned(),
        Answer::Bounded { depth, .. } => format!("bounded {depth}"),
        Answer::GaveUp(_) => "bounded 0".to_owned(),
    };
    Ok(format!("{verdict}\t{engine}\t{file}"))
}

/// As of the command.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    let request = match request(std::env::args().skip(1)) {
        Ok(request) => request,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::from(2);
        }
    };
    let mut code = ExitCode::SUCCESS;
    for file in &request.files {
        match answer(file, &request) {
            Ok(line) => println!("{line}"),
            Err(error) => {
                eprintln!("{file}: {error}");
                code = ExitCode::from(2);
            }
        }
    }
    code
}
