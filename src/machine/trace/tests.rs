//! Traces: drawn, written and read back.

use super::{Kind, Known, Signal, Trace, csv, diagram, vcd};
use crate::machine::program::Role;
use crate::semantics::scalar::Scalar;
use crate::semantics::show::type_named;

fn signal(name: &str, ty: &str, values: &[u64]) -> Signal {
    let kind = Kind::from(type_named(ty).expect("a type"));
    Signal { name: name.to_owned(), kind, role: Role::Output, values: values.to_vec() }
}

fn sample() -> Trace {
    Trace {
        name: "Pump".to_owned(),
        cycle_time: 10_000_000,
        signals: vec![
            signal("Start", "BOOL", &[0, 0, 1, 1, 0]),
            signal("Level", "INT", &[5, 5, 0xFFFF, 0, 0]),
            signal("Points[3].X", "REAL", &[0, 0, 0, 1.5_f32.to_bits().into(), 0x7FC0_0000]),
            signal("Passed", "TIME", &[0, 10, 20, 30, 40]),
        ],
    }
}

fn nothing(_: &str) -> Option<Kind> {
    None
}

fn known() -> Known<'static> {
    Known { name: "Pump", cycle_time: 10_000_000, kind: &nothing }
}

#[test]
fn csv_is_read_as_it_was_written() {
    let text = csv::write(&sample());
    assert!(text.starts_with("cycle,time [ms],Start : BOOL,Level : INT,"), "{text}");
    assert!(text.contains("\n3,20,TRUE,-1,0.0,T#20ms\n"), "{text}");
    assert_eq!(csv::read(&text, &known()), Ok(sample()));
}

#[test]
fn vcd_is_read_as_it_was_written() {
    let bytes = vcd::write(&sample());
    assert_eq!(vcd::read(&bytes, &known()), Ok(sample()));
    let text = String::from_utf8(bytes).expect("text");
    assert!(text.contains("$timescale 1 ns $end"), "{text}");
    assert!(text.contains("Points(3).X"), "{text}");
}

#[test]
fn a_dump_of_another_tool_is_sampled() {
    let text = "$timescale 1 us $end $scope module top $end $scope module fb $end $var wire 1 ! Q $end \
                $var integer 16 # N $end $upscope $end $upscope $end $enddefinitions $end\n\
                #0 0! b101 #\n#9000 1!\n#25000 0!\n#30000 b1111111111111111 #\n";
    let trace = vcd::read(text.as_bytes(), &known()).expect("readable");
    assert_eq!(trace.signal("fb.q").map(|s| s.values.clone()), Some(vec![0, 1, 1, 0]));
    assert_eq!(trace.signal("N").map(|s| s.values.clone()), Some(vec![5, 5, 5, 0xFFFF]));
    let cut = text.replace("#0 0!", "#0 x!");
    let error = vcd::read(cut.as_bytes(), &known()).expect_err("no value at first");
    assert_eq!(error.0, "`fb.Q` has no value in cycle 1");
    assert!(vcd::read(b"nonsense", &known()).is_err());
}

#[test]
fn samples_over_time_are_held() {
    let text = "time [s];A;B\n0,1;TRUE;Red\n0,115;FALSE;Green\n0,131;FALSE;Red\n";
    let trace = csv::read(text, &known()).expect("readable");
    assert_eq!(trace.signals[0].values, [1, 1, 0, 0]);
    assert_eq!(trace.signals[0].kind.scalar, Scalar::Bool);
    assert_eq!(trace.signals[1].values, [0, 0, 1, 1]);
    assert_eq!(trace.signals[1].kind.labels[1].1, "Green");
}

#[test]
fn unreadable_values_are_told_with_their_line() {
    let error = csv::read("cycle,N : INT\n1,5\n2,70000\n", &known()).expect_err("too large");
    assert_eq!(error.0, "line 3: `70000` is no value of `N`, which is of type INT");
    let error = csv::read("time,N\n5,1\n4,1\n", &known()).expect_err("back in time");
    assert_eq!(error.0, "line 3: the time goes back");
}

#[test]
fn the_diagram_shows_levels_and_values() {
    let trace = Trace {
        signals: vec![
            signal("Start", "BOOL", &[vec![0; 3], vec![1; 40], vec![0; 2]].concat()),
            signal("Level", "INT", &[vec![5; 3], vec![0xFFFF; 40], vec![12345; 2]].concat()),
        ],
        ..sample()
    };
    let drawn = diagram::draw(&trace, &diagram::Options { width: 60, mark: Some(43) });
    let expected = "\
cycle  1  4       44
Start     ┌───────┐
       ───┘       └─
Level  │5 │-1     │…
                  ▲
";
    assert_eq!(drawn, expected);
}

#[test]
fn a_wide_diagram_goes_on_below() {
    let values: Vec<u64> = (0..50).map(|cycle| cycle % 2).collect();
    let trace = Trace { signals: vec![signal("Q", "BOOL", &values)], ..sample() };
    let drawn = diagram::draw(&trace, &diagram::Options { width: 40, mark: None });
    assert_eq!(drawn.lines().filter(|line| line.starts_with("Q ")).count(), 2);
    assert!(drawn.lines().all(|line| line.chars().count() <= 40), "{drawn}");
    assert_eq!(diagram::draw(&Trace::new("Empty", 1), &diagram::Options::default()), "");
}
