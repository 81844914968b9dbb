//! Families of systems as blocks and tables give them, each of any size.

use rungbook::logic::aig::Lit;

use super::words::Builder;

/// A counter that wraps at `limit`; bad when it gets to `target`.
pub(crate) fn counter(width: usize, limit: u64, target: u64) -> Builder {
    let mut b = Builder::default();
    let (enable, count) = (b.bit(), b.state(width));
    let up = b.increment(&count, 1);
    let wraps = b.equals(&count, limit);
    let stepped = b.choose(wraps, &Builder::constant(width, 0), &up);
    let next = b.choose(enable, &stepped, &count);
    b.latch(&count, &next, Some(0));
    let bad = b.equals(&count, target);
    b.model.bad = vec![bad];
    b
}

/// A timer with an elapsed time in steps of `step`, and a table that counts cycles itself: the output must come
/// exactly after `cycles` cycles of the input.
pub(crate) fn timer(width: usize, cycles: u64, step: u64) -> Builder {
    let mut b = Builder::default();
    let input = b.bit();
    let (elapsed, age) = (b.state(width), b.state(width));
    let preset = Builder::constant(width, cycles * step);
    let more = b.increment(&elapsed, step);
    let running = b.below(&elapsed, &preset);
    let grown = b.choose(running, &more, &elapsed);
    let next = b.choose(input, &grown, &Builder::constant(width, 0));
    let output = {
        let done = b.below(&next, &preset);
        b.model.aig.and(input, !done)
    };
    let older = b.increment(&age, 1);
    let full = b.equals(&age, cycles);
    let older = b.choose(full, &age, &older);
    let age_next = b.choose(input, &older, &Builder::constant(width, 0));
    let due = b.equals(&age_next, cycles);
    b.latch(&elapsed, &next, Some(0));
    b.latch(&age, &age_next, Some(0));
    let bad = b.model.aig.xor(output, due);
    b.model.bad = vec![bad];
    b
}

/// A queue by two pointers and a count; bad when they disagree.
pub(crate) fn queue(width: usize) -> Builder {
    let mut b = Builder::default();
    let (push, pop) = (b.bit(), b.bit());
    let (read, write, count) = (b.state(width), b.state(width), b.state(width + 1));
    let empty = b.equals(&count, 0);
    let full = b.equals(&count, 1 << width);
    let (push, pop) = (b.model.aig.and(push, !full), b.model.aig.and(pop, !empty));
    let (read_up, write_up) = (b.increment(&read, 1), b.increment(&write, 1));
    let (count_up, count_down) = (b.increment(&count, 1), b.increment(&count, (2 << width) - 1));
    let (read_next, write_next) = (b.choose(pop, &read_up, &read), b.choose(push, &write_up, &write));
    let both = b.model.aig.xor(push, pop);
    let moved = b.choose(push, &count_up, &count_down);
    let count_next = b.choose(both, &moved, &count);
    b.latch(&read, &read_next, Some(0));
    b.latch(&write, &write_next, Some(0));
    b.latch(&count, &count_next, Some(0));
    let (sum, _) = b.add(&read, &count[..width], Lit::FALSE);
    let agree = b.equal(&sum, &write);
    b.model.bad = vec![!agree];
    b
}

/// A token ring that grants to who asks and has the token; bad when two are granted.
pub(crate) fn arbiter(clients: usize) -> Builder {
    let mut b = Builder::default();
    let requests: Vec<Lit> = (0..clients).map(|_| b.bit()).collect();
    let token = b.state(clients);
    let granted: Vec<Lit> = (0..clients).map(|i| b.model.aig.and(requests[i], token[i])).collect();
    let mut busy = Lit::FALSE;
    for &grant in &granted {
        busy = b.model.aig.or(busy, grant);
    }
    let moved: Vec<Lit> = (0..clients).map(|i| token[(i + 1) % clients]).collect();
    let next = b.choose(busy, &token, &moved);
    b.latch(&token, &next, Some(1));
    b.words.clear();
    let mut bad = Lit::FALSE;
    for i in 0..clients {
        for j in 0..i {
            let both = b.model.aig.and(granted[i], granted[j]);
            bad = b.model.aig.or(bad, both);
        }
    }
    b.model.bad = vec![bad];
    b
}

/// Products of latched factors; bad when the order of the factors matters.
pub(crate) fn product(width: usize) -> Builder {
    let mut b = Builder::default();
    let (x, y) = (b.input(width), b.input(width));
    let (a, c) = (b.state(width), b.state(width));
    b.latch(&a, &x, Some(0));
    b.latch(&c, &y, Some(0));
    let (one, other) = (b.multiply(&a, &c), b.multiply(&c, &a));
    let same = b.equal(&one, &other);
    b.model.bad = vec![!same];
    b
}

/// Tracks the extremes of an input; bad when their mean leaves them, or the present input is outside.
pub(crate) fn extremes(width: usize) -> Builder {
    let mut b = Builder::default();
    let (clear, x) = (b.bit(), b.input(width));
    let (low, high, last, valid) = (b.state(width), b.state(width), b.state(width), b.state(1));
    let fresh = b.model.aig.or(clear, !valid[0]);
    let (lower, higher) = (b.below(&x, &low), b.below(&high, &x));
    let (lower, higher) = (b.model.aig.or(lower, fresh), b.model.aig.or(higher, fresh));
    let (low_next, high_next) = (b.choose(lower, &x, &low), b.choose(higher, &x, &high));
    b.latch(&low, &low_next, Some((1 << width) - 1));
    b.latch(&high, &high_next, Some(0));
    b.latch(&last, &x, Some(0));
    b.latch(&valid, &[Lit::TRUE], Some(0));
    let (sum, carry) = b.add(&low, &high, Lit::FALSE);
    let mut mean: Vec<Lit> = sum[1..].to_vec();
    mean.push(carry);
    let (under, over) = (b.below(&mean, &low), b.below(&high, &mean));
    let (before, after) = (b.below(&last, &low), b.below(&high, &last));
    let mut bad = Lit::FALSE;
    for one in [under, over, before, after] {
        bad = b.model.aig.or(bad, one);
    }
    bad = b.model.aig.and(bad, valid[0]);
    b.model.bad = vec![bad];
    b
}
