//! Who works when, and how much: a list of turns without end.

/// Those who take turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Name {
    /// On the problem as it stands; the first searches for violations on the side.
    Induction,
    Ic3,
    Interpolation,
    /// One turn, as long as it takes.
    Mine,
    /// With what was mined.
    InductionWithFacts,
    Ic3WithFacts,
}

/// How many there are.
pub(super) const NAMES: usize = 6;

/// A turn: who has it, and for how many ticks of about 25 ns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Turn {
    pub(super) name: Name,
    pub(super) work: u64,
}

/// Work for the first turns, for the one of interpolation before mining, and for the first ones behind it, which grow by a
/// half.
const FIRST: u64 = 1_000_000;
const BEFORE: u64 = 48_000_000;
const BEHIND: u64 = 32_000_000;

/// From how many nodes of the graph on mining takes so long that interpolation goes first.
const LARGE: usize = 2_500;

const fn of(name: Name, work: u64) -> Turn {
    Turn { name, work }
}

/// The first turns: what is easy for one of them is settled there. Bounded checking, which is half of induction, is what
/// most violations are found by.
const OPENING: [Turn; 9] = [
    of(Name::Induction, FIRST),
    of(Name::Ic3, FIRST),
    of(Name::Interpolation, FIRST),
    of(Name::Induction, 4 * FIRST),
    of(Name::Ic3, 2 * FIRST),
    of(Name::Interpolation, 2 * FIRST),
    of(Name::Induction, 8 * FIRST),
    of(Name::Ic3, 4 * FIRST),
    of(Name::Interpolation, 4 * FIRST),
];

/// Mining, and behind it a short look whether what was mined does it.
const MINING: [Turn; 3] =
    [of(Name::Mine, 0), of(Name::Ic3WithFacts, 4 * FIRST), of(Name::InductionWithFacts, 4 * FIRST)];

/// The turns that come round again and again.
const ROUND: [Name; 4] = [Name::InductionWithFacts, Name::Interpolation, Name::Ic3WithFacts, Name::Ic3];

/// The plan for a model.
pub(super) struct Plan {
    opening: Vec<Turn>,
}

impl Plan {
    /// For a graph of so many nodes.
    pub(super) fn new(nodes: usize) -> Self {
        let mut opening = OPENING.to_vec();
        if nodes >= LARGE {
            opening.push(of(Name::Interpolation, BEFORE));
        }
        opening.extend(MINING);
        Self { opening }
    }

    /// The turn with this index.
    pub(super) fn turn(&self, index: usize) -> Turn {
        let Some(late) = index.checked_sub(self.opening.len()) else { return self.opening[index] };
        let work = (0..late / ROUND.len()).fold(BEHIND, |work, _| work.saturating_add(work / 2));
        of(ROUND[late % ROUND.len()], work)
    }

    /// Whether the one whose turn this is has another one later.
    pub(super) fn comes_again(&self, index: usize) -> bool {
        let name = self.turn(index).name;
        let later = self.opening.get(index + 1..).unwrap_or(&[]);
        ROUND.contains(&name) || later.iter().any(|turn| turn.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_behind_the_opening_grow_and_nobody_waits_for_ever() {
        for nodes in [0, LARGE] {
            let plan = Plan::new(nodes);
            let turns: Vec<Turn> = (0..60).map(|index| plan.turn(index)).collect();
            let mining = turns.iter().position(|turn| turn.name == Name::Mine).expect("mining has a turn");
            assert_eq!(turns.iter().filter(|turn| turn.name == Name::Mine).count(), 1);
            let facts = [Name::InductionWithFacts, Name::Ic3WithFacts];
            assert!(turns[..mining].iter().all(|turn| !facts.contains(&turn.name)), "there are no facts yet");
            for name in ROUND {
                let own: Vec<u64> =
                    turns[plan.opening.len()..].iter().filter(|turn| turn.name == name).map(|turn| turn.work).collect();
                assert!(own.len() > 5 && own.windows(2).all(|pair| pair[0] < pair[1]), "{name:?} {own:?}");
            }
        }
        assert_eq!(Plan::new(LARGE).opening.len(), Plan::new(LARGE - 1).opening.len() + 1);
    }

    #[test]
    fn who_has_no_later_turn_is_told() {
        let plan = Plan::new(0);
        let last = (0..60).rev().find(|&index| plan.turn(index).name == Name::Induction).expect("it has turns");
        assert!(!plan.comes_again(last) && plan.comes_again(0));
        assert!((0..60).filter(|&index| ROUND.contains(&plan.turn(index).name)).all(|index| plan.comes_again(index)));
    }

    #[test]
    fn work_of_late_turns_does_not_overflow() {
        assert_eq!(Plan::new(0).turn(1_000).work, u64::MAX);
    }
}
