//! `rungbook schema`, `completions` and `man`: texts that are made from the tool itself.

use clap::CommandFactory;

use crate::book::model;
use crate::cli::args::Cli;
use crate::cli::{Exit, Failure, print};

/// The JSON Schema of the model.
pub(crate) fn schema() -> Result<Exit, Failure> {
    print(model::SCHEMA);
    Ok(Exit::Ok)
}

/// The completions of a shell.
pub(crate) fn completions(shell: clap_complete::Shell) -> Result<Exit, Failure> {
    let mut out = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "rungbook", &mut out);
    print(&String::from_utf8_lossy(&out));
    Ok(Exit::Ok)
}

/// The manual page.
pub(crate) fn man() -> Result<Exit, Failure> {
    let mut out = Vec::new();
    let page = clap_mangen::Man::new(Cli::command());
    page.render(&mut out).map_err(|error| Failure(error.to_string()))?;
    print(&String::from_utf8_lossy(&out));
    Ok(Exit::Ok)
}
