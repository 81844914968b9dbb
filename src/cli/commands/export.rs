//! `rungbook export`: writes a block as a transition system that other tools read.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use crate::cli::args::TreeArgs;
use crate::cli::report::progress::Progress;
use crate::cli::{Exit, Failure, say, tree, write};
use crate::pipeline::export::{self, Form};

/// `rungbook export`.
#[derive(Debug, Args)]
pub(crate) struct ExportArgs {
    /// Function block, program or function
    block: String,
    #[command(flatten)]
    tree: TreeArgs,
    /// Form to write [default: by the name of OUT]
    #[arg(long, value_enum, value_name = "FORM")]
    format: Option<Format>,
    /// File to write; `.aag` is AIGER as text
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
}

/// The forms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// BTOR2, by words
    Btor2,
    /// AIGER 1.9, by bits
    Aiger,
    /// SMV as nuXmv reads it, by words
    Smv,
}

pub(crate) fn run(args: &ExportArgs) -> Result<Exit, Failure> {
    let form = form(args)?;
    let (project, _) = tree::read(&args.tree, None, &Progress::new(args.tree.quiet))?;
    let unit = match export::units(&project, &args.block).as_slice() {
        [] => return Err(Failure(format!("`{}` is not in this tree", args.block))),
        [unit] => *unit,
        several => return Err(Failure(format!("`{}` is declared {} times in this tree", args.block, several.len()))),
    };
    let translated = match export::system(&project, unit) {
        Ok(translated) => translated,
        Err(reasons) => {
            for reason in &reasons {
                say(&format!("unsupported: {reason}"));
            }
            return Ok(Exit::Findings);
        }
    };
    write::file(&args.output, &export::bytes(&translated, form))?;
    if !args.tree.quiet {
        let system = &translated.system;
        let (inputs, states, obligations) = (system.inputs.len(), system.states.len(), system.obligations.len());
        say(&format!("{inputs} inputs, {states} states, {obligations} obligations"));
    }
    Ok(Exit::Ok)
}

/// The form that is asked for, or that the file's name says.
fn form(args: &ExportArgs) -> Result<Form, Failure> {
    let extension = args.output.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    let as_text = extension.as_deref() == Some("aag");
    match (args.format, extension.as_deref()) {
        (Some(Format::Btor2), _) | (None, Some("btor2" | "btor")) => Ok(Form::Btor2),
        (Some(Format::Smv), _) | (None, Some("smv")) => Ok(Form::Smv),
        (Some(Format::Aiger), _) | (None, Some("aag" | "aig")) => {
            Ok(if as_text { Form::AigerText } else { Form::Aiger })
        }
        _ => {
            let file = args.output.display();
            Err(Failure(format!("the name `{file}` does not say the form; add `--format btor2`, `aiger` or `smv`")))
        }
    }
}
