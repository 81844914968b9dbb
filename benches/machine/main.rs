//! How many cycles a second the interpreter does: on a cylinder of `samples/pick-and-place`, read from its source and elaborated.

use std::collections::BTreeMap;

use divan::Bencher;
use divan::counter::ItemsCount;
use rungbook::config::{ConfigFile, Settings};
use rungbook::machine::elaborate::{Options, elaborate};
use rungbook::machine::interpret::Interpreter;
use rungbook::machine::program::{Program, SlotId};
use rungbook::source::Disk;

/// Cycles in one measurement.
const CYCLES: u64 = 100_000;

fn main() {
    divan::main();
}

fn sample(name: &str) -> Program {
    let samples = concat!(env!("CARGO_MANIFEST_DIR"), "/samples/pick-and-place");
    let settings = Settings::new(ConfigFile::default()).expect("the defaults");
    let project = rungbook::pipeline::read(&Disk::new(samples).expect("the samples"), "samples", &settings, &|_| {});
    let (unit, _) = project.catalogue.iter().find(|(_, item)| item.name == name).expect("a block of the samples");
    elaborate(&project.catalogue, &project.names, unit, &Options::default()).expect("nothing unsupported")
}

/// A cylinder that goes out and back, watched by timers; an item is a cycle, its inputs set and an output read.
#[divan::bench]
fn single_acting_cylinder(bencher: Bencher<'_, '_>) {
    let program = sample("FB_SingleActingCylinder");
    let slots: BTreeMap<&str, SlotId> = program.variables.iter().map(|v| (v.path.as_str(), v.slot)).collect();
    let [extend, extended, retracted, valve] =
        ["bExtend", "bExtended", "bRetracted", "bValve"].map(|name| *slots.get(name).expect("a variable"));
    let run = Interpreter::new(&program);
    bencher.counter(ItemsCount::new(CYCLES)).with_inputs(|| run.clone()).bench_local_values(|mut run| {
        let mut open = 0;
        for cycle in 0..CYCLES {
            let at = cycle % 100;
            run.set(extend, u64::from(at < 60));
            run.set(extended, u64::from(at > 30 && at < 60));
            run.set(retracted, u64::from(at > 70));
            run.cycle().expect("no fault");
            open += run.get(valve);
        }
        open
    });
}
