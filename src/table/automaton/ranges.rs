//! Sets of counts as ranges: tokens that entered a row in successive cycles have successive counts.

/// A set of counts: disjoint ranges that do not touch, ascending, both ends included.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Ranges(Vec<(u64, u64)>);

impl Ranges {
    pub(super) fn one(count: u64) -> Self {
        Self(vec![(count, count)])
    }

    pub(super) const fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Whether it holds a count between the two.
    pub(super) fn meets(&self, low: u64, high: u64) -> bool {
        self.0.iter().any(|(from, to)| *from <= high && *to >= low)
    }

    /// The counts between the two.
    pub(super) fn between(&self, low: u64, high: u64) -> Self {
        let cut = self.0.iter().map(|(from, to)| ((*from).max(low), (*to).min(high)));
        Self(cut.filter(|(from, to)| from <= to).collect())
    }

    /// Every count one higher, but none above `most`.
    pub(super) fn next(&self, most: u64) -> Self {
        let mut out = Self::default();
        for (from, to) in &self.0 {
            out.add((from + 1).min(most), (to + 1).min(most));
        }
        out
    }

    pub(super) fn union(&mut self, other: &Self) {
        for (from, to) in &other.0 {
            self.add(*from, *to);
        }
    }

    fn add(&mut self, from: u64, to: u64) {
        let begin = self.0.partition_point(|(_, end)| end.saturating_add(1) < from);
        let end = self.0.partition_point(|(start, _)| *start <= to.saturating_add(1));
        let merged = self.0[begin..end].iter().fold((from, to), |(low, high), (a, b)| (low.min(*a), high.max(*b)));
        self.0.splice(begin..end, [merged]);
    }

    /// The ranges themselves.
    pub(super) fn iter(&self) -> impl Iterator<Item = (u64, u64)> + '_ {
        self.0.iter().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::Ranges;

    #[test]
    fn ranges_that_touch_become_one() {
        let mut set = Ranges::one(5);
        set.union(&Ranges::one(3));
        assert_eq!(set.iter().collect::<Vec<_>>(), [(3, 3), (5, 5)]);
        set.union(&Ranges::one(4));
        assert_eq!(set.iter().collect::<Vec<_>>(), [(3, 5)]);
        assert_eq!(set.next(5).iter().collect::<Vec<_>>(), [(4, 5)]);
        assert!(set.meets(5, 9) && !set.meets(6, 9));
        assert_eq!(set.between(4, 9).iter().collect::<Vec<_>>(), [(4, 5)]);
    }
}
