//! What is never documentation, whatever its place.
//!
//! Each judge looks at the clean text of one chunk. A licence or a history may be a part of a
//! comment whose rest is documentation; then only that part is set aside.

mod allowance;
mod code;
mod directive;
mod heading;
mod history;
mod licence;
mod placeholder;

use super::Reason;
use super::comment::Chunk;
use super::conventions::file_header;
use super::mapped::Mapped;
use crate::library::Placement;

pub(super) use code::is_code_line;
pub(super) use directive::is_directive;
pub(super) use heading::is_heading;
pub(super) use placeholder::is_placeholder;

/// What a chunk turned out to be.
pub(super) struct Judgement {
    /// What may be documentation; `Err` says why there is none.
    pub(super) prose: Result<Mapped, Reason>,
    /// The revision history in it.
    pub(super) history: Option<Mapped>,
}

/// Judges `chunk`, which may document something called `name`.
pub(super) fn judge(chunk: &Chunk, name: &str) -> Judgement {
    let (prose, history) = history::split(&allowance::without(&chunk.text));
    let prose = match prose {
        None => Err(if history.is_some() { Reason::History } else { Reason::Separator }),
        Some(prose) => judge_prose(chunk, prose, name),
    };
    Judgement { prose, history }
}

/// Whether there is a word in it, or a sign behind a declaration, such as `CHAR_MUL := 42; // *`.
fn says_something(chunk: &Chunk, text: &str) -> bool {
    let sign = chunk.placement == Placement::Trailing && (1..=2).contains(&text.trim().chars().count());
    sign || text.contains(char::is_alphanumeric)
}

fn judge_prose(chunk: &Chunk, prose: Mapped, name: &str) -> Result<Mapped, Reason> {
    let text = prose.as_str();
    if !says_something(chunk, text) {
        return Err(Reason::Separator);
    }
    if is_directive(text) {
        return Err(Reason::Directive);
    }
    if chunk.code || !chunk.marker.is_marked() && code::is_code(text) {
        return Err(Reason::Code);
    }
    let prose = licence::without(&prose).ok_or(Reason::Licence)?;
    if file_header::is_bare(prose.as_str()) {
        return Err(Reason::FileHeader);
    }
    if is_placeholder(prose.as_str(), name) {
        return Err(Reason::Placeholder);
    }
    Ok(prose)
}
