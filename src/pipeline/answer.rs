//! A verdict of the prover as the answer that records keep.

use super::verify::Verified;
use super::{Project, tell};
use crate::evidence::record::{Answer, Artefact, ArtefactKind, Effort, Verdict as Word};
use crate::prove::verdict::{Reason, Verdict};

/// What is known before anything was tried.
#[must_use]
pub const fn nothing() -> Answer {
    Answer::without_engine(Word::Unverified)
}

/// Whether there is no use in trying: the claim has its verdict already. A bounded one may go further in more time.
#[must_use]
pub const fn is_settled(answer: &Answer) -> bool {
    matches!(answer.verdict, Word::Verified | Word::Violated | Word::Unusable { .. })
}

/// The answer that `verified` is.
#[must_use]
pub fn of(project: &Project, verified: &Verified) -> Answer {
    let (verdict, artefact) = match &verified.verdict {
        Verdict::Verified(_) => (Word::Verified, certificate(verified)),
        Verdict::Violated(_) => {
            let run = tell::run(project, verified).map(|value| Artefact { kind: ArtefactKind::Run, value });
            (Word::Violated, run)
        }
        Verdict::Bounded(cycles) => (Word::Bounded { cycles: *cycles }, None),
        Verdict::Unsupported(reasons) => (Word::Unsupported { reasons: told(project, reasons) }, None),
        Verdict::Unusable(reasons) => (Word::Unusable { reasons: told(project, reasons) }, None),
    };
    let milliseconds = u64::try_from(verified.time.as_millis()).unwrap_or(u64::MAX);
    Answer {
        verdict,
        coverage: verified.coverage.clone(),
        artefact,
        rests_on: verified.assumptions.clone(),
        engine: verified.engine.to_owned(),
        effort: Some(Effort { milliseconds }),
    }
}

fn certificate(verified: &Verified) -> Option<Artefact> {
    verified.certificate.clone().map(|value| Artefact { kind: ArtefactKind::Certificate, value })
}

fn told(project: &Project, reasons: &[Reason]) -> Vec<String> {
    let one = |reason: &Reason| {
        let place = reason.place.map_or(String::new(), |place| {
            format!("{}:{}: ", project.files.get(place.file).path, project.files.line_column(place).line)
        });
        let help = if reason.help.is_empty() { String::new() } else { format!(" ({})", reason.help) };
        format!("{place}{}{help}", reason.message)
    };
    reasons.iter().map(one).collect()
}
