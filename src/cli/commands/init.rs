//! `rungbook init`: writes a commented `rungbook.toml`.

use crate::cli::args::InitArgs;
use crate::cli::{Exit, Failure, say, tree, write};
use crate::config::TEMPLATE;

pub(crate) fn run(args: &InitArgs) -> Result<Exit, Failure> {
    let path = tree::folder(&args.dir)?.join("rungbook.toml");
    if path.exists() {
        return Err(Failure(format!("`{}` exists; it is left as it is", path.display())));
    }
    write::file(&path, TEMPLATE.as_bytes())?;
    say(&format!("wrote {}", args.dir.join("rungbook.toml").display()));
    Ok(Exit::Ok)
}
