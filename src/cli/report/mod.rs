//! How findings and totals are printed.

mod annotations;
pub(crate) mod diff;
pub(crate) mod json;
mod junit;
mod markdown;
mod metrics;
pub(crate) mod outcome;
pub(crate) mod progress;
pub(crate) mod run;
mod sarif;
pub(crate) mod summary;
pub(crate) mod text;
pub(crate) mod verdict;

use super::Failure;
use super::args::Format;
use outcome::Outcome;

/// `outcome` in a format for programs; text for people is [`text`]'s.
pub(crate) fn render(outcome: &Outcome<'_>, format: Format) -> Result<String, Failure> {
    Ok(match format {
        Format::Text => {
            let reporter = text::Reporter::new(false);
            outcome.new_ones().map(|found| reporter.render(found.finding, outcome.files) + "\n\n").collect()
        }
        Format::Json => json::render(outcome),
        Format::Sarif => sarif::render(outcome),
        Format::Junit => junit::render(outcome).map_err(Failure)?,
        Format::Github => annotations::github(outcome),
        Format::Gitlab => annotations::gitlab(outcome),
        Format::Markdown => markdown::render(outcome),
        Format::Badge => metrics::badge(outcome),
        Format::Prometheus => metrics::prometheus(outcome),
    })
}
