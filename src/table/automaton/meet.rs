//! Which rows can hold two tokens at once. A row that cannot needs one counter, however long it lasts.
//!
//! Pairs of rows that two different tokens can be in after the same cycle are closed under the edges: a pair begins where
//! one token takes two edges, and each of its tokens may take each of its edges, as long as some values satisfy
//! both rows that they lead to. Counts are looked at where one token would need contradicting ones, and not else; the
//! answer errs to the side of two tokens, and says so of every row where the search would be too long.

use std::collections::BTreeSet;

use super::edges::Edge;
use super::{Automaton, Site, Target, Test};

/// So many pairs of edges are looked at.
const MAX_STEPS: usize = 20_000_000;

/// For each leaf, whether two tokens with different counts may live in it. `compatible` says of two sites whether some
/// values satisfy the constraints of both; it may say so too often.
pub(super) fn crowded(automaton: &Automaton, compatible: &mut dyn FnMut(Site, Site) -> bool) -> Vec<bool> {
    let mut search = Search { automaton, compatible, seen: BTreeSet::new(), work: Vec::new(), left: MAX_STEPS };
    search.split(&automaton.entries);
    for edges in &automaton.edges {
        search.split(edges);
    }
    while search.left > 0
        && let Some((a, b)) = search.work.pop()
    {
        for one in &automaton.edges[a] {
            for other in &automaton.edges[b] {
                search.pair(one, other);
            }
        }
    }
    if search.left == 0 {
        return vec![true; automaton.leaves.len()];
    }
    (0..automaton.leaves.len()).map(|leaf| search.seen.contains(&(leaf, leaf))).collect()
}

struct Search<'a, 'c> {
    automaton: &'a Automaton,
    compatible: &'c mut dyn FnMut(Site, Site) -> bool,
    seen: BTreeSet<(usize, usize)>,
    work: Vec<(usize, usize)>,
    left: usize,
}

impl Search<'_, '_> {
    /// The pairs that one token makes by taking two of its edges.
    fn split(&mut self, edges: &[Edge]) {
        for (index, one) in edges.iter().enumerate() {
            for other in &edges[..index] {
                self.left = self.left.saturating_sub(1);
                if self.left == 0 {
                    return;
                }
                if !contradict(one, other) && !gives_way(one, other) && !gives_way(other, one) {
                    self.pair(one, other);
                }
            }
        }
    }

    fn pair(&mut self, one: &Edge, other: &Edge) {
        self.left = self.left.saturating_sub(1);
        if self.left == 0 {
            return;
        }
        let (Some(a), Some(b)) = (one.site(), other.site()) else { return };
        let key = (a.leaf.min(b.leaf), a.leaf.max(b.leaf));
        if self.seen.contains(&key) || (a != b && !(self.compatible)(a, b)) {
            return;
        }
        debug_assert!(key.1 < self.automaton.leaves.len());
        self.seen.insert(key);
        self.work.push(key);
    }
}

/// Whether no counts satisfy the conditions of both.
pub(in crate::table) fn contradict(one: &Edge, other: &Edge) -> bool {
    one.conditions.iter().any(|a| {
        other.conditions.iter().filter(|b| a.counter == b.counter).any(|b| match (a.test, b.test) {
            (Test::AtLeast(low), Test::Below(high)) | (Test::Below(high), Test::AtLeast(low)) => high <= low,
            _ => false,
        })
    })
}

/// Whether `one` may not be taken where `other` may: a progress flag.
pub(in crate::table) fn gives_way(one: &Edge, other: &Edge) -> bool {
    one.rivals.iter().any(|rival| {
        other.target == Target::Enter(rival.leaf)
            && rival.conditions.iter().all(|condition| other.conditions.contains(condition))
    })
}
