//! Replays a run that never ends: its cycles, and then those that it repeats, until block and game are where they were before,
//! so that nothing new can come.
//!
//! What is compared at the end of each round: the slots that matter for the game, the words that are possible, and the values
//! that cells look back to. Between the two equal ones the environment must have stayed in no open end: see
//! [`OpenEnd`](crate::table::automaton::OpenEnd).

use super::replay::{End, Environment, Missing, Player, Subject};
use crate::machine::program::SlotId;
use crate::table::automaton::game::Game;

/// Why a run is not believed to go on for ever.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Rejection {
    /// The table names a variable that the block does not have.
    Missing(Missing),
    /// Nothing is repeated.
    Empty,
    /// A cycle of the run, or of its repetition, ends the game.
    Ends(End),
    /// The environment stays in an open end of the table.
    Unfair,
    /// Block and game do not come back to where they were.
    NotRepeated,
}

/// More cycles than this are not played to see something again.
const MOST: usize = 20_000;

/// What a round leaves.
struct Mark<'a> {
    memory: Vec<u64>,
    game: Game<'a>,
    past: Vec<u64>,
    /// How often each open end had been left by then.
    fair: Vec<u64>,
}

/// Checks that the cycles of `environment` from `from` on can be repeated for ever, within the table, by a fair environment.
/// `slots` are those that what happens in the game depends on.
///
/// # Errors
/// Why it is not so.
pub fn check(subject: &Subject<'_>, environment: &Environment, from: usize, slots: &[SlotId]) -> Result<(), Rejection> {
    let Some((stem, round)) = environment.inputs.split_at_checked(from).filter(|(_, round)| !round.is_empty()) else {
        return Err(Rejection::Empty);
    };
    let mut player = Player::new(subject, environment).map_err(Rejection::Missing)?;
    let mut fair = vec![0; player.game.fair().len()];
    play(&mut player, stem, &mut fair)?;
    let mut marks = vec![mark(&player, slots, &fair)];
    while player.run.cycles.len() + round.len() <= MOST.max(environment.inputs.len()) {
        play(&mut player, round, &mut fair)?;
        let now = mark(&player, slots, &fair);
        if let Some(before) = marks.iter().find(|before| same(before, &now)) {
            let left = before.fair.iter().zip(&now.fair).all(|(before, now)| before < now);
            return if left { Ok(()) } else { Err(Rejection::Unfair) };
        }
        marks.push(now);
    }
    Err(Rejection::NotRepeated)
}

fn play(player: &mut Player<'_>, cycles: &[Vec<u64>], fair: &mut [u64]) -> Result<(), Rejection> {
    for inputs in cycles {
        player.cycle(inputs);
        if player.run.end != End::Open {
            return Err(Rejection::Ends(player.run.end.clone()));
        }
        // Nobody asks for what was assigned, and the run may be long.
        if let Some(cycle) = player.run.cycles.last_mut() {
            cycle.assigned = Vec::new();
        }
        for (count, fair) in fair.iter_mut().zip(player.game.fair()) {
            *count += u64::from(*fair);
        }
    }
    Ok(())
}

fn mark<'a>(player: &Player<'a>, slots: &[SlotId], fair: &[u64]) -> Mark<'a> {
    let cycles = &player.run.cycles;
    let depths = player.subject.table.depths();
    let past = depths.iter().enumerate().flat_map(|(variable, depth)| {
        let seen = cycles.iter().rev().take(*depth as usize);
        // Before the first cycle is what no cycle comes back to.
        let missing = (*depth as usize).saturating_sub(cycles.len());
        let seen = seen.flat_map(move |cycle| cycle.values[variable].map(Some));
        seen.chain(std::iter::repeat_n(None, missing)).map(|value| value.map_or(u64::MAX, |value| value))
    });
    Mark {
        memory: slots.iter().map(|slot| player.machine.get(*slot)).collect(),
        game: player.game.clone(),
        past: past.collect(),
        fair: fair.to_vec(),
    }
}

fn same(one: &Mark<'_>, other: &Mark<'_>) -> bool {
    one.memory == other.memory && one.past == other.past && one.game.same_words(&other.game)
}
