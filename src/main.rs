//! Parses arguments and hands over to `cli`.

use std::process::ExitCode;

fn main() -> ExitCode {
    rungbook::cli::run(std::env::args_os())
}
