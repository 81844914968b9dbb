//! Which comments document an item or a variable.
//!
//! For an item the order of [`Options::order`] decides: what the container keeps, above the header,
//! behind it, below it, after the last section, the first comment of the body, between sections. A
//! comment with a documentation mark (`///`, `//!`, `(**`) goes before one without, wherever it
//! stands; the scattered blocks of TE1030 are one. Several comments in one place are one text, as far
//! as no empty line parts them.
//!
//! For a variable a marked comment above goes first, then the one on its line (with the lines that
//! go on with it), then the one above. Two plain comments, above and behind, are both
//! documentation, unless the variables beside it only carry one behind: then the one above heads
//! their group.

use super::comment::{Chunk, Marker};
use super::conventions::oscat;
use super::judge::is_heading;
use super::mapped::Mapped;
use super::model::Reason;
use super::options::Options;
use crate::library::{ItemKind, Placement};

/// A chunk, judged: the prose in it, or why there is none.
pub(super) struct Candidate {
    pub(super) chunk: Chunk,
    pub(super) prose: Result<Mapped, Reason>,
    pub(super) history: Option<Mapped>,
}

impl Candidate {
    const fn is_open(&self) -> bool {
        self.prose.is_ok()
    }

    fn reject(&mut self, reason: Reason) {
        if self.is_open() {
            self.prose = Err(reason);
        }
    }

    fn text(&self) -> &str {
        self.prose.as_ref().map_or("", Mapped::as_str)
    }
}

/// Leaves open what documents an item of `kind`, and says why the others do not.
pub(super) fn choose_for_item(candidates: &mut [Candidate], kind: ItemKind, options: &Options) {
    let by_body = is_by_body(kind);
    for candidate in candidates.iter_mut() {
        if let Some(reason) = misplaced(candidate, kind, options) {
            candidate.reject(reason);
        }
    }
    if !by_body || has_mark(candidates) {
        prefer_marked(candidates);
    }
    if candidates.iter().any(|candidate| candidate.is_open() && candidate.chunk.marker == Marker::Bang) {
        return;
    }
    head_group(candidates);
    let rank = |placement: Placement| options.order.iter().position(|other| *other == placement);
    let best = candidates.iter().filter(|c| c.is_open()).filter_map(|c| rank(c.chunk.placement)).min();
    let Some(chosen) = best.map(|best| options.order[best]) else { return };
    for candidate in candidates.iter_mut().filter(|candidate| candidate.chunk.placement != chosen) {
        candidate.reject(Reason::OtherPlacement(chosen));
    }
    cut_at_gap(candidates, chosen);
}

/// Whether items of `kind` have no declaration to put a comment at.
const fn is_by_body(kind: ItemKind) -> bool {
    matches!(kind, ItemKind::Action | ItemKind::Transition)
}

fn misplaced(candidate: &Candidate, kind: ItemKind, options: &Options) -> Option<Reason> {
    let chunk = &candidate.chunk;
    let by_body = is_by_body(kind);
    let is_code_block = !kind.is_type() || matches!(kind, ItemKind::FunctionBlock | ItemKind::Class);
    let asked = options.order.contains(&chunk.placement) && (!options.marked_only || chunk.marker.is_marked());
    if !asked {
        return Some(Reason::NotAsked);
    }
    if chunk.marker.is_marked() {
        return None;
    }
    if chunk.placement == Placement::Trailing {
        return None;
    }
    if is_heading(candidate.text()) || chunk.decorated && chunk.placement != Placement::Above {
        return Some(Reason::Heading);
    }
    let text = candidate.text();
    let told = text.contains('\n') || text.trim_end().ends_with('.');
    let stated = chunk.placement == Placement::FirstInBody
        || chunk.before_statement && matches!(chunk.placement, Placement::BelowHeader | Placement::AfterSections);
    // A block that names a version and a programmer speaks of no statement, however near one stands.
    let apart = chunk.set_apart && told || oscat::is_used(text);
    match chunk.placement {
        _ if stated && is_code_block && !(by_body || apart) => Some(Reason::Statement),
        // One line right above a section speaks of the section.
        Placement::BetweenSections if !told || !(chunk.set_apart || text.contains('\n')) => Some(Reason::Heading),
        _ => None,
    }
}

/// A line above a declaration that has a comment behind it heads the group that begins there.
fn head_group(candidates: &mut [Candidate]) {
    let behind = |c: &Candidate| c.is_open() && c.chunk.placement == Placement::Trailing;
    if candidates.iter().any(behind) {
        let above = candidates.iter_mut().filter(|c| c.chunk.placement == Placement::Above);
        above.filter(|c| !c.text().contains('\n')).for_each(|c| c.reject(Reason::Heading));
    }
}

fn has_mark(candidates: &[Candidate]) -> bool {
    candidates.iter().any(|candidate| candidate.is_open() && candidate.chunk.marker.is_marked())
}

/// Rejects what carries no mark if something does.
fn prefer_marked(candidates: &mut [Candidate]) {
    if has_mark(candidates) {
        for candidate in candidates.iter_mut().filter(|candidate| !candidate.chunk.marker.is_marked()) {
            candidate.reject(Reason::Unmarked);
        }
    }
}

/// Of several chunks in one place keeps those next to the declaration: the last ones above it, the
/// first ones elsewhere. Line comments of one kind belong together across an empty line, but not in
/// a body.
fn cut_at_gap(candidates: &mut [Candidate], chosen: Placement) {
    let mut order: Vec<usize> = (0..candidates.len()).filter(|i| candidates[*i].is_open()).collect();
    if chosen == Placement::Above {
        order.reverse();
    }
    let mut cut = false;
    for pair in 1..order.len() {
        let (near, far) = (order[pair - 1], order[pair]);
        let lower = &candidates[near.max(far)].chunk;
        let line = |i: usize| matches!(candidates[i].chunk.marker, Marker::Line | Marker::Slashes);
        let lines = line(near) && line(far) && chosen != Placement::FirstInBody;
        cut |= lower.gap_before && !lines;
        if cut {
            candidates[far].reject(Reason::SetApart);
        }
    }
}

/// How the variables beside one are documented, by comments without a mark.
#[derive(Clone, Copy, Default)]
pub(super) struct Habit {
    /// Variables with a comment above and none behind.
    pub(super) above: usize,
    /// Variables with a comment behind and none above.
    pub(super) behind: usize,
}

/// Leaves open what documents a variable, and says why the others do not.
pub(super) fn choose_for_variable(candidates: &mut [Candidate], habit: Habit, options: &Options) {
    let last_above = candidates.iter().rposition(|candidate| candidate.chunk.placement == Placement::Above);
    for candidate in candidates.iter_mut() {
        let chunk = &candidate.chunk;
        let above = chunk.placement == Placement::Above;
        let reason = if options.marked_only && !chunk.marker.is_marked() {
            Some(Reason::NotAsked)
        } else if above && chunk.decorated {
            Some(Reason::Heading)
        } else {
            None
        };
        if let Some(reason) = reason {
            candidate.reject(reason);
        }
    }
    if let Some(last) = last_above {
        keep_adjoining(&mut candidates[..=last]);
    }
    prefer_marked(candidates);
    let open = |candidates: &[Candidate], above: bool| {
        candidates.iter().any(|c| c.is_open() && (c.chunk.placement == Placement::Above) == above)
    };
    if !open(candidates, true) || !open(candidates, false) || has_mark(candidates) {
        return;
    }
    for candidate in candidates.iter_mut().filter(|candidate| candidate.chunk.placement == Placement::Above) {
        if habit.behind > habit.above || is_heading(candidate.text()) {
            candidate.reject(Reason::Heading);
        }
    }
}

/// Rejects what an empty line parts from the variable below.
fn keep_adjoining(candidates: &mut [Candidate]) {
    let mut apart = false;
    for candidate in candidates.iter_mut().rev().filter(|candidate| candidate.chunk.placement == Placement::Above) {
        apart |= candidate.chunk.set_apart && !candidate.chunk.marker.is_marked();
        if apart {
            candidate.reject(Reason::SetApart);
        }
    }
}
