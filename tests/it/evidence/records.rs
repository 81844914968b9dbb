//! Records and their store: keys, bytes, what makes a verdict stale, what a broken store does.

use std::collections::BTreeMap;

use proptest::prelude::*;
use rungbook::evidence::cache::{self, Found};
use rungbook::evidence::digest::{Digest, canonical};
use rungbook::evidence::record::{self, Answer, Artefact, ArtefactKind, Claim, Effort, Origin, Part, Record, Verdict};
use serde_json::json;

use super::validate;

pub(crate) fn part(kind: &str, name: &str, text: &str) -> Part {
    Part {
        kind: kind.to_owned(),
        name: name.to_owned(),
        file: format!("{name}.st"),
        raw: Digest::of(format!("raw {text}")),
        model: Digest::of(text),
    }
}

pub(crate) fn claim() -> Claim {
    Claim {
        table: part("table", "Extends in time", "| 1 |"),
        block: Some(part("function-block", "FB_Cyl", "body")),
        cone: vec![part("function-block", "FB_Base", "base"), part("gvl", "Globals", "g")],
        externals: vec!["TON".to_owned()],
        cycle_ns: Some(10_000_000),
        conformance: "weak".to_owned(),
        options: BTreeMap::from([("unit".to_owned(), "FB_Cyl".to_owned())]),
        assumptions: vec!["`TON` is declared in no file of the tree".to_owned()],
        semantics: "1".to_owned(),
    }
}

pub(crate) fn origin() -> Origin {
    Origin {
        tool: "rungbook test".to_owned(),
        commit: "0123abc".to_owned(),
        date: "2026-01-31".to_owned(),
        author: "A. Tester".to_owned(),
    }
}

pub(crate) fn verified() -> Answer {
    Answer {
        verdict: Verdict::Verified,
        coverage: Some(record::Coverage::default()),
        artefact: Some(Artefact { kind: ArtefactKind::Certificate, value: json!({"invariant": [1, -2, 3]}) }),
        rests_on: Vec::new(),
        engine: "pdr".to_owned(),
        effort: Some(Effort { milliseconds: 12 }),
    }
}

fn store(record: &Record, answer: &Answer) -> BTreeMap<String, Vec<u8>> {
    cache::entries(record, answer.artefact.as_ref()).into_iter().collect()
}

#[test]
fn a_record_of_every_verdict_meets_the_schema_and_reads_back() {
    let reasons = vec!["a drawn body".to_owned()];
    let verdicts = [
        Verdict::Verified,
        Verdict::Violated,
        Verdict::Bounded { cycles: 40 },
        Verdict::Unsupported { reasons: reasons.clone() },
        Verdict::Unusable { reasons },
        Verdict::Stale { was: "verified".to_owned(), changed: vec!["the block".to_owned()] },
        Verdict::Unverified,
    ];
    for (verdict, word) in verdicts.into_iter().zip(Verdict::WORDS) {
        assert_eq!(verdict.word(), word);
        let record = Record::new(claim(), &Answer { verdict, ..verified() }, origin());
        let value = serde_json::from_slice(&record.bytes()).expect("JSON");
        validate(record::SCHEMA, &value);
        assert_eq!(Record::parse(&record.bytes()), Ok(record));
    }
}

#[test]
fn only_what_bears_on_the_verdict_changes_the_key() {
    let key = claim().key();
    let mut moved = claim();
    moved.table.file = "elsewhere.gtt".to_owned();
    moved.table.raw = Digest::of("other layout");
    assert_eq!(moved.key(), key, "layout and place do not");
    let changes: [fn(&mut Claim); 8] = [
        |claim| claim.table.model = Digest::of("x"),
        |claim| claim.block = None,
        |claim| claim.cone[1].model = Digest::of("x"),
        |claim| claim.cycle_ns = Some(1),
        |claim| claim.conformance = "strict".to_owned(),
        |claim| _ = claim.options.insert("k".to_owned(), "v".to_owned()),
        |claim| claim.assumptions.clear(),
        |claim| claim.semantics = "2".to_owned(),
    ];
    for (i, change) in changes.iter().enumerate() {
        let mut other = claim();
        change(&mut other);
        assert_ne!(other.key(), key, "change {i}");
        assert_eq!(other.changed_since(&claim()).len(), 1, "change {i}");
    }
}

#[test]
fn the_store_gives_back_what_it_was_given_and_tells_what_is_stale() {
    let (claim, answer) = (claim(), verified());
    let record = Record::new(claim.clone(), &answer, origin());
    let files = store(&record, &answer);
    let read = |path: &str| files.get(path).cloned();
    let Found::Fresh(found, artefact) = cache::lookup(&claim, &read) else { panic!("it is there") };
    assert_eq!(*found, record);
    assert_eq!(artefact, answer.artefact);
    let mut edited = claim.clone();
    edited.cone[0].model = Digest::of("edited");
    let stale = cache::answer(&edited, cache::lookup(&edited, &read));
    let changed = vec!["`FB_Base`".to_owned()];
    assert_eq!(stale.verdict, Verdict::Stale { was: "verified".to_owned(), changed });
    let mut other = claim;
    other.table.name = "Another".to_owned();
    other.table.model = Digest::of("another");
    assert_eq!(cache::answer(&other, cache::lookup(&other, &read)).verdict, Verdict::Unverified);
}

#[test]
fn numbers_in_artefacts_keep_their_digits() {
    let value = json!({"wide": u64::MAX, "low": i64::MIN});
    let bytes = canonical(&value);
    assert_eq!(serde_json::from_slice::<serde_json::Value>(&bytes).expect("JSON"), value);
}

proptest! {
    /// A store in which any byte was changed never gives another verdict; at worst it knows nothing.
    #[test]
    fn a_damaged_store_lies_about_nothing(file in 0_usize..3, at in any::<prop::sample::Index>(), bit in 0_u8..8) {
        let (claim, answer) = (claim(), verified());
        let record = Record::new(claim.clone(), &answer, origin());
        let mut files = store(&record, &answer);
        let path = files.keys().nth(file).expect("three files").clone();
        let bytes = files.get_mut(&path).expect("there");
        let at = at.index(bytes.len());
        bytes[at] ^= 1 << bit;
        match cache::lookup(&claim, &|path| files.get(path).cloned()) {
            Found::Fresh(found, artefact) => {
                prop_assert_eq!(&found.claim.table.model, &claim.table.model);
                prop_assert_eq!(artefact, answer.artefact);
            }
            Found::Old(_) => prop_assert!(false, "an older claim out of nothing"),
            Found::Nothing => {}
        }
    }
}
