//! Arguments, one file a command, reporters, exit codes; the only writer.

mod args;
mod commands;
mod release;
mod report;
mod stamp;
mod store;
mod tree;
mod write;

use std::ffi::OsString;
use std::io::Write;
use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};

/// How a command ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
    /// Done, and nothing is wrong.
    Ok,
    /// Something is at or above the denied severity.
    Findings,
    /// Input, configuration or arguments cannot be used.
    Unusable,
    /// A table has no verdict.
    Undecided,
}

impl Exit {
    /// The process's exit code.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::Ok => 0,
            Self::Findings => 1,
            Self::Unusable => 2,
            Self::Undecided => 3,
        }
    }
}

/// Why a command could not do its work; printed on stderr.
#[derive(Debug)]
pub(crate) struct Failure(pub(crate) String);

/// Runs the command line `args`, program name first.
pub fn run(args: impl IntoIterator<Item = OsString>) -> ExitCode {
    let cli = match Cli::try_parse_from(args) {
        Ok(cli) => cli,
        Err(error) => {
            let code = if error.use_stderr() { Exit::Unusable } else { Exit::Ok };
            // Nobody is left to tell if the terminal is gone.
            let _ = error.print();
            return ExitCode::from(code.code());
        }
    };
    let done = match cli.command {
        Command::Build(args) => commands::build::run(&args),
        Command::Check(args) => commands::check::run(&args),
        Command::Table(args) => commands::table::run(&args),
        Command::Verify(args) => commands::verify::run(&args),
        Command::Run(args) => commands::run::run(&args),
        Command::Evidence(command) => commands::evidence::run(&command),
        Command::Recheck(args) => commands::evidence::check(&args),
        Command::Diff(args) => commands::diff::run(&args),
        Command::Explain(args) => commands::explain::run(&args),
        Command::Export(args) => commands::export::run(&args),
        Command::Init(args) => commands::init::run(&args),
        Command::Schema => commands::print::schema(),
        Command::Completions { shell } => commands::print::completions(shell),
        Command::Man => commands::print::man(),
    };
    let exit = done.unwrap_or_else(|Failure(message)| {
        say(&format!("error: {message}"));
        Exit::Unusable
    });
    ExitCode::from(exit.code())
}

/// Prints a result on stdout. A closed pipe is no error: the reader has seen enough.
pub(crate) fn print(text: &str) {
    let mut out = std::io::stdout().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}

/// Prints a message on stderr.
pub(crate) fn say(text: &str) {
    let mut err = std::io::stderr().lock();
    let _ = writeln!(err, "{}", text.trim_end());
}
