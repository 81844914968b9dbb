//! A block that learns the range of a signal and warns outside of it, with its table as an automaton: after an idea in the
//! papers on generalized test tables, written down bit by bit.

use rungbook::logic::aig::Lit;

use super::words::{Builder, Word};

/// Where the table can be after each of its twelve places.
const AFTER: [&[usize]; 12] =
    [&[0, 1], &[1, 2], &[2, 3], &[3, 4], &[4, 3, 5, 6], &[5, 6], &[7], &[8], &[9], &[10], &[11], &[11, 5, 6]];

/// What the block reads and has, and what it makes of it.
struct Cycle {
    active: Lit,
    learn: Lit,
    signal: Word,
    output: Word,
    warning: Lit,
}

fn block(b: &mut Builder, width: usize) -> Cycle {
    let (active, learn, signal) = (b.bit(), b.bit(), b.input(width));
    let (lower, upper, quench, heat) = (b.state(width), b.state(width), b.state(width), b.state(width));
    let warning = b.state(1);
    let top = 1 << (width - 1);
    let zero = Builder::constant(width, 0);
    let (small, large) = (b.less(&lower, &signal), b.less(&signal, &upper));
    let teach = b.model.aig.and(!active, learn);
    let (taught_low, taught_high) = (b.choose(small, &lower, &signal), b.choose(large, &upper, &signal));
    let (low, high) = (b.choose(teach, &taught_low, &lower), b.choose(teach, &taught_high, &upper));
    let empty = b.less(&upper, &lower);
    let raised = b.choose(small, &signal, &lower);
    let under = b.less(&raised, &upper);
    let cut = b.choose(under, &raised, &upper);
    let works = b.model.aig.and(active, !empty);
    let output = b.choose(works, &cut, &zero);
    let outside = !b.equal(&signal, &cut);
    let (hot, cool) = (b.model.aig.and(works, outside), b.model.aig.and(works, !outside));
    let (heat_down, quench_down) = (b.increment(&heat, (2 * top) - 1), b.increment(&quench, (2 * top) - 1));
    let three = Builder::constant(width, 3);
    let heat_kept = b.choose(cool, &three, &heat);
    let heat_next = b.choose(hot, &heat_down, &heat_kept);
    let quench_kept = b.choose(hot, &three, &quench);
    let quench_next = b.choose(cool, &quench_down, &quench_kept);
    let (heated, quenched) = (b.equals(&heat_down, 0), b.equals(&quench_down, 0));
    let heated = b.model.aig.or(heated, warning[0]);
    let quenched = b.model.aig.and(!quenched, warning[0]);
    let warns = b.model.aig.ite(outside, heated, quenched);
    let warns = b.model.aig.or(empty, warns);
    let warns = b.model.aig.and(active, warns);
    b.latch(&lower, &low, Some(top - 2));
    b.latch(&upper, &high, Some(top + 1));
    b.latch(&quench, &quench_next, Some(3));
    b.latch(&heat, &heat_next, Some(3));
    b.latch(&warning, &[warns], Some(0));
    Cycle { active, learn, signal, output, warning: warns }
}

/// The block and its table; the range fixed to 0 and 100, or any that holds 0.
pub(crate) fn minmax(width: usize, fixed: bool) -> Builder {
    let mut b = Builder::default();
    let Cycle { active, learn, signal, output, warning } = block(&mut b, width);
    let (min, max) = (b.state(width), b.state(width));
    b.latch(&min.clone(), &min, fixed.then_some(0));
    b.latch(&max.clone(), &max, fixed.then_some(100));
    let zero = Builder::constant(width, 0);
    if !fixed {
        let (over, under) = (b.less(&zero, &min), b.less(&max, &zero));
        b.model.constraints = vec![!over, !under];
    }
    let within = |b: &mut Builder, x: &[Lit]| {
        let (under, over) = (b.less(x, &min), b.less(&max, x));
        b.model.aig.and(!under, !over)
    };
    let (inside, kept) = (within(&mut b, &signal), within(&mut b, &output));
    let (above, most) = (b.less(&max, &signal), !b.less(&max, &output));
    let (is_min, is_max, none) = (b.equal(&signal, &min), b.equal(&signal, &max), b.equal(&output, &zero));
    let teach = b.model.aig.and(!active, learn);
    let all = |b: &mut Builder, lits: &[Lit]| lits.iter().fold(Lit::TRUE, |all, &l| b.model.aig.and(all, l));
    let quiet = all(&mut b, &[none, !warning]);
    let row = |b: &mut Builder, given: &[Lit], shown: &[Lit]| (all(b, given), all(b, shown));
    let mut rows = vec![
        row(&mut b, &[active], &[none, warning]),
        row(&mut b, &[teach, is_min], &[quiet]),
        row(&mut b, &[teach, is_max], &[quiet]),
        row(&mut b, &[!active, !learn], &[quiet]),
        row(&mut b, &[teach, inside], &[kept, !warning]),
        row(&mut b, &[active, inside], &[kept, !warning]),
    ];
    rows.extend((0..2).map(|_| row(&mut b, &[active, above], &[most, !warning])));
    rows.push(row(&mut b, &[active, above], &[most, warning]));
    rows.extend((0..2).map(|_| row(&mut b, &[active, inside], &[kept, warning])));
    rows.push(row(&mut b, &[active, inside], &[kept, !warning]));
    game(&mut b, &rows);
    b
}

/// The automaton over the rows' assumptions and assertions.
fn game(b: &mut Builder, rows: &[(Lit, Lit)]) {
    let places: Vec<Lit> = rows.iter().map(|_| b.state(1)[0]).collect();
    let (mut covered, mut held) = (Lit::FALSE, Lit::FALSE);
    let mut next = vec![Lit::FALSE; rows.len()];
    for (i, &(given, shown)) in rows.iter().enumerate() {
        let here = b.model.aig.and(places[i], given);
        let stays = b.model.aig.and(here, shown);
        covered = b.model.aig.or(covered, here);
        held = b.model.aig.or(held, stays);
        for &to in AFTER[i] {
            next[to] = b.model.aig.or(next[to], stays);
        }
    }
    for (i, &place) in places.iter().enumerate() {
        b.latch(&[place], &[next[i]], Some(u64::from(i == 0)));
    }
    let lost = b.model.aig.and(covered, !held);
    b.model.bad = vec![lost];
}
