//! AIGER files are read as they were written, and what is none is said.

use rungbook::logic::aig::{Model, Random, Trace};
use rungbook::logic::blast::blast;
use rungbook::logic::read::aiger;
use rungbook::logic::write::{Names, binary};

use super::written::rich;

/// 20 cycles with random inputs.
fn trace(model: &Model) -> Trace {
    let mut random = Random::default();
    let mut bits = |count: usize| (0..count).map(|_| random.word() & 1 == 1).collect::<Vec<bool>>();
    let latches = bits(model.latches.len());
    Trace { latches, inputs: (0..20).map(|_| bits(model.inputs.len())).collect() }
}

#[test]
fn what_was_written_is_read() {
    for seed in 1..=20 {
        let system = rich(seed * 77);
        let blasted = blast(&system);
        let names = Names::of(&system, &blasted);
        let written = binary(&blasted.model, &names);
        let (model, read) = aiger(&written).expect("a file");
        assert_eq!(binary(&model, &read), written, "seed {seed}");
        let trace = trace(&model);
        let (own, other) = (model.simulate(&trace), blasted.model.simulate(&trace));
        assert!(own == other, "seed {seed}");
        assert!(own.iter().any(|cycle| cycle.latches.iter().any(|value| *value)), "seed {seed}");
    }
}

#[test]
fn outputs_are_bad_where_nothing_else_is() {
    let (model, names) = aiger(b"aig 3 2 0 1 1\n7\n\x02\x02o0 both_not\nc\nprose\n").expect("a file");
    let said = |one: bool, two: bool| {
        model.simulate(&Trace { latches: Vec::new(), inputs: vec![vec![one, two]] })[0].bad.clone()
    };
    assert_eq!([said(false, false), said(true, false), said(true, true)], [vec![true], vec![true], vec![false]]);
    assert_eq!(names.bad, ["both_not"]);
}

#[test]
fn what_is_no_aiger_file_is_said_at_its_byte() {
    let cases: [(&[u8], &str); 10] = [
        (b"", "byte 0: the file ends in a line"),
        (b"aag 0 0 0 0 0\n", "byte 0: `aig` is expected, the binary form"),
        (b"aig 1 1 0\n", "byte 4: 5 to 9 numbers are expected"),
        (b"aig 1 1 0 0 0 0 0 1\n", "byte 4: justice and fairness are not read"),
        (b"aig 5 1 0 0 1\n", "byte 4: inputs, latches and conjunctions are not as many as variables"),
        (b"aig 99999999 99999999 0 0 0\n", "byte 4: more than 67108864 variables"),
        (b"aig 1 0 1 0 0\n0 3\n", "byte 14: a latch has a next value and a first one: 0, 1 or itself"),
        (b"aig 1 1 0 1 0\n9\n", "byte 14: literal 9 is beyond the last variable"),
        (b"aig 2 1 0 0 1\n\x05\x00", "byte 14: a conjunction comes before its operands"),
        (b"aig 1 1 0 1 0\n2\ni7 name\n", "byte 16: `i7 name` names nothing"),
    ];
    for (bytes, expected) in cases {
        assert_eq!(aiger(bytes).err().map(|error| error.to_string()).as_deref(), Some(expected));
    }
}

#[test]
fn a_damaged_file_is_no_panic() {
    let system = rich(5);
    let blasted = blast(&system);
    let written = binary(&blasted.model, &Names::of(&system, &blasted));
    for at in 0..written.len() {
        let mut damaged = written.clone();
        damaged[at] ^= 1 << (at % 8);
        drop(aiger(&damaged));
    }
    for end in 0..60 {
        assert!(aiger(&written[..end]).is_err(), "{end}");
    }
}
