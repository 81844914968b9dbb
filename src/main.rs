//! Parses arguments and hands over to `cli`.

use std::process::ExitCode;

/// Models and terms are many small allocations, on several threads.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    rungbook::cli::run(std::env::args_os())
}
