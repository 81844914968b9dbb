//! What was typed on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

/// Exit codes, at the end of `--help`.
const EXIT_CODES: &str = "\
Exit codes:
  0  done; for `check`: nothing at or above the denied severity, and the gate is reached
  1  `check` found something at or above the denied severity, or the gate is not reached;
     `verify` or `run` found a violated table; `diff` found what the gate denies; `evidence verify` found a change
  2  unusable input, configuration, arguments or tables
  3  `verify` left a table undecided, or `run` could not play it: bounded, or not supported

Start with:
  rungbook build                  the manual of this folder, in target/rungbook
  rungbook check --deny error     what is wrong, for a pipeline
  rungbook explain undocumented   what a finding means and how to mend it

Colours are used on a terminal only, and never where NO_COLOR is set.
SOURCE_DATE_EPOCH sets the date that the manual shows.";

/// A reference manual from a PLC source tree (IEC 61131-3), with its test tables and what is not documented.
#[derive(Debug, Parser)]
#[command(name = "rungbook", version, after_help = EXIT_CODES, max_term_width = 100)]
pub(crate) struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Write the manual of a source tree: a static site, a PDF, a model as JSON
    Build(BuildArgs),
    /// Print what is undocumented, unverified or unreadable, and fail if it is bad enough
    Check(CheckArgs),
    /// Read, convert and align test tables; make concrete ones from them
    Table(super::commands::table::TableArgs),
    /// Decide whether blocks conform to their test tables, in runs of every length
    Verify(VerifyArgs),
    /// Play tables on their blocks, cycle by cycle, or hold a recorded trace against them
    Run(super::commands::run::RunArgs),
    /// Pack a release with its evidence, sign it, check it again
    #[command(subcommand)]
    Evidence(EvidenceCommand),
    /// Check the certificates and runs of a release bundle again, on this machine: as `evidence verify`
    Recheck(BundleVerifyArgs),
    /// Compare two releases: interfaces, documentation, tables cell by cell, evidence
    Diff(DiffArgs),
    /// Explain a finding's code, or which comment documents an entity and why
    Explain(ExplainArgs),
    /// Write a block as a transition system for other tools: BTOR2, AIGER, SMV
    Export(super::commands::export::ExportArgs),
    /// Write a commented rungbook.toml
    Init(InitArgs),
    /// Print the JSON Schema of `build --json`
    Schema,
    /// Print the completions of a shell
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Print the manual page, for `man -l -`
    Man,
}

/// The tree and its configuration.
#[derive(Debug, Args)]
pub(crate) struct TreeArgs {
    /// Folder to read
    #[arg(default_value = ".", value_name = "DIR")]
    pub(crate) dir: PathBuf,
    /// Configuration file [default: DIR/rungbook.toml, if there is one]
    #[arg(long, value_name = "FILE")]
    pub(crate) config: Option<PathBuf>,
    /// No progress and no summary on stderr
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// `rungbook build`.
#[derive(Debug, Args)]
pub(crate) struct BuildArgs {
    #[command(flatten)]
    pub(crate) tree: TreeArgs,
    /// Folder to write to [default: DIR/target/rungbook]
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Write the site, OUT/html
    #[arg(long)]
    pub(crate) html: bool,
    /// Write the PDF, OUT/manual.pdf
    #[arg(long)]
    pub(crate) pdf: bool,
    /// Write the model, OUT/model.json (its schema: `rungbook schema`)
    #[arg(long)]
    pub(crate) json: bool,
    /// Decide first what the store of verdicts does not know, as `rungbook verify` does
    #[arg(long)]
    pub(crate) verify: bool,
    /// Add the evidence report as a page
    #[arg(long)]
    pub(crate) evidence: bool,
    /// Add a page of the changes since this release: a bundle, a folder, or a git revision
    #[arg(long, value_name = "OLD")]
    pub(crate) previous: Option<String>,
}

/// `rungbook check`.
#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) tree: TreeArgs,
    /// Fail from this severity on [default: warning, or as configured]
    #[arg(long, value_enum, value_name = "SEVERITY")]
    pub(crate) deny: Option<Level>,
    /// How to print
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
    /// Write a report to a file besides, as in `--report sarif=out.sarif`; may be repeated
    #[arg(long, value_name = "FORMAT=FILE", value_parser = report_file)]
    pub(crate) report: Vec<(Format, PathBuf)>,
    /// Allow the findings of this file [default: as configured]
    #[arg(long, value_name = "FILE")]
    pub(crate) baseline: Option<PathBuf>,
    /// Decide first what the store of verdicts does not know, as `rungbook verify` does
    #[arg(long)]
    pub(crate) verify: bool,
    /// Write the baseline: what is found now is allowed from now on
    #[arg(long)]
    pub(crate) write_baseline: bool,
}

/// `FORMAT=FILE`
fn report_file(text: &str) -> Result<(Format, PathBuf), String> {
    let (format, file) = text.split_once('=').ok_or("write FORMAT=FILE, as in `sarif=out.sarif`")?;
    Ok((Format::from_str(format, true)?, PathBuf::from(file)))
}

/// `rungbook verify`.
#[derive(Debug, Args)]
pub(crate) struct VerifyArgs {
    /// A folder, or the files of blocks and tables: PROGRAM.st LIBRARY.st TABLE.gtt [default: .]
    #[arg(value_name = "DIR|FILE")]
    pub(crate) paths: Vec<PathBuf>,
    /// Configuration file [default: DIR/rungbook.toml, if there is one]
    #[arg(long, value_name = "FILE")]
    pub(crate) config: Option<PathBuf>,
    /// Only the table of this name
    #[arg(long, value_name = "NAME")]
    pub(crate) table: Option<String>,
    /// The block that all tables specify, whatever they say themselves
    #[arg(long, value_name = "NAME")]
    pub(crate) unit: Option<String>,
    /// Seconds for one table [default: 60, or as configured]
    #[arg(long, value_name = "SECONDS")]
    pub(crate) timeout: Option<f64>,
    /// MiB of memory for one table [default: 4096, or as configured]
    #[arg(long, value_name = "MIB")]
    pub(crate) memory: Option<u64>,
    /// How many threads: a table each, and two for a table where there are fewer of them [default: one for each core]
    #[arg(short, long, value_name = "N")]
    pub(crate) jobs: Option<usize>,
    /// Strict conformance for every table: the end is reached, unless the environment stays for ever where it may
    #[arg(long)]
    pub(crate) strict: bool,
    /// Read REAL and LREAL in fixed point, so many decimal digits in so many bits, such as 3,32: an assumption of the verdict
    #[arg(long, value_name = "DIGITS,WIDTH")]
    pub(crate) fixed: Option<String>,
    /// Change verified blocks in small ways, and say which changes their tables notice
    #[arg(long)]
    pub(crate) mutants: bool,
    /// Cycle time of tables that state none, such as 4ms
    #[arg(long, value_name = "TIME")]
    pub(crate) cycle: Option<String>,
    /// A time constant of the tables, such as TOUT=10 or TOUT=200ms
    #[arg(long = "const", value_name = "NAME=VALUE")]
    pub(crate) constants: Vec<String>,
    /// Decide anew, whatever the store of verdicts knows
    #[arg(long)]
    pub(crate) fresh: bool,
    /// Decide nothing; write what is to be decided of each table to DIR/UNIT-TABLE.aig, for other checkers
    #[arg(long, value_name = "DIR")]
    pub(crate) aiger: Option<PathBuf>,
    /// How to print
    #[arg(long, value_enum, default_value_t = Output::Text)]
    pub(crate) format: Output,
    /// No progress and no summary on stderr
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// `rungbook evidence`.
#[derive(Debug, Subcommand)]
pub(crate) enum EvidenceCommand {
    /// Write a bundle: manual, report, records, certificates, runs, tables, sources, signed
    Bundle(BundleArgs),
    /// Check a bundle, without a network: signature, manifest, digests, records, certificates
    Verify(BundleVerifyArgs),
    /// Write a new Ed25519 key, FILE, and its public half, FILE.pub
    Keygen {
        /// File to write to; it must not exist
        #[arg(value_name = "FILE")]
        file: PathBuf,
    },
    /// Print the JSON Schema of a record
    Schema,
}

/// `rungbook evidence bundle`.
#[derive(Debug, Args)]
pub(crate) struct BundleArgs {
    #[command(flatten)]
    pub(crate) tree: TreeArgs,
    /// File to write
    #[arg(short, long, value_name = "FILE", default_value = "release.zip")]
    pub(crate) output: PathBuf,
    /// Private key: Ed25519 as PKCS #8 (PEM), or OpenSSH's; without it nobody signs
    #[arg(long, value_name = "FILE")]
    pub(crate) key: Option<PathBuf>,
    /// The previous release, for the page of changes: a bundle, a folder, or a git revision
    #[arg(long, value_name = "OLD")]
    pub(crate) previous: Option<String>,
    /// Decide first what the store of verdicts does not know, as `rungbook verify` does
    #[arg(long)]
    pub(crate) verify: bool,
    /// Leave the PDFs out
    #[arg(long)]
    pub(crate) no_pdf: bool,
}

/// `rungbook evidence verify`.
#[derive(Debug, Args)]
pub(crate) struct BundleVerifyArgs {
    /// The bundle
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,
    /// Public key that must have signed it (PEM, OpenSSH, or allowed_signers); may be repeated
    #[arg(long, value_name = "FILE")]
    pub(crate) key: Vec<PathBuf>,
    /// Print nothing if all is well
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// `rungbook diff`.
#[derive(Debug, Args)]
pub(crate) struct DiffArgs {
    /// The older release: a bundle, a folder, or a git revision
    pub(crate) old: String,
    /// The newer release
    #[arg(default_value = ".")]
    pub(crate) new: String,
    /// The folder that git revisions are taken of
    #[arg(short = 'C', long = "in", value_name = "DIR", default_value = ".")]
    pub(crate) dir: PathBuf,
    /// How to print
    #[arg(long, value_enum, default_value_t = DiffFormat::Text)]
    pub(crate) format: DiffFormat,
    /// Fail on incompatible changes [default: as configured]
    #[arg(long)]
    pub(crate) deny_breaking: bool,
    /// Fail where a table was verified and is not any more [default: as configured]
    #[arg(long)]
    pub(crate) deny_lost_evidence: bool,
    /// No summary on stderr
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

/// How a comparison is printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum DiffFormat {
    /// For people
    Text,
    /// One JSON object
    Json,
    /// A page in Markdown
    Markdown,
    /// A page in HTML
    Html,
}

/// `rungbook explain`.
#[derive(Debug, Args)]
pub(crate) struct ExplainArgs {
    /// A finding's code, or an entity's name; without it, the list of codes
    pub(crate) what: Option<String>,
    /// Folder to look for an entity in
    #[arg(default_value = ".", value_name = "DIR")]
    pub(crate) dir: PathBuf,
}

/// `rungbook init`.
#[derive(Debug, Args)]
pub(crate) struct InitArgs {
    /// Folder to write to
    #[arg(default_value = ".", value_name = "DIR")]
    pub(crate) dir: PathBuf,
}

/// A severity.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum Level {
    /// Everything
    Info,
    /// Warnings and errors
    Warning,
    /// Errors only
    Error,
}

/// How the results of other commands are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Output {
    /// For people
    Text,
    /// One JSON object
    Json,
}

/// How findings are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// For people
    Text,
    /// One JSON object
    Json,
    /// SARIF 2.1.0
    Sarif,
    /// JUnit XML
    Junit,
    /// Annotations of GitHub's workflows
    Github,
    /// Code quality report of GitLab
    Gitlab,
    /// A summary in Markdown
    Markdown,
    /// A badge as SVG
    Badge,
    /// Prometheus text
    Prometheus,
}
