//! How many cycles a second the interpreter does.

mod cylinder;

use divan::Bencher;
use divan::counter::ItemsCount;
use rungbook::machine::interpret::Interpreter;

/// Cycles in one measurement.
const CYCLES: u64 = 100_000;

fn main() {
    divan::main();
}

/// A cylinder that goes out and back; an item is a cycle, its inputs set and an output read.
#[divan::bench]
fn cycles(bencher: Bencher<'_, '_>) {
    let run = Interpreter::new(&cylinder::program());
    bencher.counter(ItemsCount::new(CYCLES)).with_inputs(|| run.clone()).bench_local_values(|mut run| {
        let mut open = 0;
        for cycle in 0..CYCLES {
            let at = cycle % 100;
            run.set(cylinder::EXTEND, u64::from(at < 60));
            run.set(cylinder::EXTENDED, u64::from(at > 30 && at < 60));
            run.set(cylinder::RETRACTED, u64::from(at > 70));
            if run.cycle().is_err() {
                break;
            }
            open += run.get(cylinder::VALVE);
        }
        open
    });
}
