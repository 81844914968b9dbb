//! Instances as a test suite of TcUnit (github.com/tcunit/TcUnit): a method for each, which runs one cycle of the block in
//! each cycle of the task. The task must run as often as the table's cycle says.

use std::fmt::Write;

use super::Instance;
use super::solve::variable;
use crate::semantics::scalar::Scalar;
use crate::semantics::show;
use crate::table::bind::{BoundTable, BoundVariable};
use crate::table::decide::literal;
use crate::table::model::Table;

/// The suite in Structured Text. `program` says that the unit is a program, which is called by its name.
#[must_use]
pub fn suite(of: &Table, bound: &BoundTable, instances: &[Instance], unit: &str, program: bool) -> String {
    let name = format!("FB_{}_Test", identifier(unit.strip_prefix("FB_").unwrap_or(unit)));
    let mut out = String::new();
    if let Some(cycle) = of.options.cycle {
        let _ = writeln!(out, "// The task that calls this runs every {}.", crate::table::cell::time_text(cycle.nanos));
    }
    let _ = writeln!(out, "FUNCTION_BLOCK {name} EXTENDS TcUnit.FB_TestSuite");
    for number in 1..=instances.len() {
        let _ = writeln!(out, "Instance{number}();");
    }
    for (number, instance) in (1..).zip(instances) {
        method(of, bound, instance, (number, unit, program), &mut out);
    }
    let _ = writeln!(out, "END_FUNCTION_BLOCK");
    out
}

fn identifier(text: &str) -> String {
    text.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect()
}

fn method(of: &Table, bound: &BoundTable, instance: &Instance, named: (usize, &str, bool), out: &mut String) {
    let (number, unit, program) = named;
    let (object, declared) = if program { (unit, String::new()) } else { ("Unit", format!("    Unit : {unit};\n")) };
    let _ = writeln!(out, "\nMETHOD PRIVATE Instance{number}\nVAR_INST\n{declared}    Cycle : UDINT;\nEND_VAR");
    let _ = writeln!(out, "TEST('{}');", instance.name.replace('$', "$$").replace('\'', "$'"));
    let _ = writeln!(out, "Cycle := Cycle + 1;");
    cases(of, bound, instance, true, out, &|variable, value| format!("{object}.{} := {value};", variable.path));
    let _ = writeln!(out, "{object}();");
    cases(of, bound, instance, false, out, &|variable, value| check(object, variable, value));
    let last: u64 = instance.steps.iter().map(|step| step.cycles).sum();
    let _ = writeln!(out, "IF Cycle >= {last} THEN\n    TEST_FINISHED();\nEND_IF\nEND_METHOD");
}

/// What is done in which cycles, for the inputs or for the outputs.
fn cases(
    of: &Table,
    bound: &BoundTable,
    instance: &Instance,
    inputs: bool,
    out: &mut String,
    line: &dyn Fn(&BoundVariable, &str) -> String,
) {
    let _ = writeln!(out, "CASE Cycle OF");
    let mut first = 1;
    for step in &instance.steps {
        let last = first + step.cycles - 1;
        let label = if first == last { first.to_string() } else { format!("{first}..{last}") };
        let _ = writeln!(out, "{label}: // row {}", of.rows()[step.row].id);
        let mut any = false;
        for column in 0..of.columns.len() {
            let Some(index) = variable(of, bound, column).filter(|_| of.columns[column].kind.is_assumption() == inputs)
            else {
                continue;
            };
            let variable = &bound.variables[index];
            if let Some(bits) = step.values[index] {
                any = true;
                let _ = writeln!(out, "    {}", line(variable, &literal(variable.scalar, &variable.labels, bits)));
            }
        }
        if !any {
            let _ = writeln!(out, "    ;");
        }
        first = last + 1;
    }
    let _ = writeln!(out, "END_CASE");
}

/// The assertion that fits the type; what TcUnit has none for is compared.
fn check(object: &str, variable: &BoundVariable, value: &str) -> String {
    let (path, name) = (&variable.path, show::type_name(variable.scalar));
    let own = matches!(variable.scalar, Scalar::Bool | Scalar::Int { .. } | Scalar::Bits(_) | Scalar::Time(_));
    match variable.scalar {
        Scalar::Real(_) => format!(
            "AssertEquals_{name}(Expected := {value}, Actual := {object}.{path}, Delta := 0.0, Message := '{path}');"
        ),
        _ if own && variable.labels.is_empty() => {
            format!("AssertEquals_{name}(Expected := {value}, Actual := {object}.{path}, Message := '{path}');")
        }
        _ => format!("AssertTrue(Condition := {object}.{path} = {value}, Message := '{path}');"),
    }
}
