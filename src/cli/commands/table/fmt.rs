//! `rungbook table fmt`: aligns pipe tables where they stand.

use super::FmtArgs;
use crate::cli::{Exit, Failure, say, write};
use crate::table::write::format_in_place;

pub(super) fn run(args: &FmtArgs) -> Result<Exit, Failure> {
    let mut changed = 0;
    for path in &args.files {
        // Bytes of another encoding would not come back as they were.
        let text = String::from_utf8(super::bytes(path)?)
            .map_err(|_| Failure(format!("`{}` is not in UTF-8; it is left as it is", path.display())))?;
        let aligned = format_in_place(&text);
        if aligned == text {
            continue;
        }
        changed += 1;
        if args.check {
            say(&format!("`{}` is not aligned", path.display()));
        } else {
            write::file(path, aligned.as_bytes())?;
            say(&format!("aligned `{}`", path.display()));
        }
    }
    Ok(if args.check && changed > 0 { Exit::Findings } else { Exit::Ok })
}
