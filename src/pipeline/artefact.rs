//! Certificates and runs as JSON, and back: what records keep, bundles carry, pages show and `recheck` reads.
//!
//! A certificate: `{"format": "rungbook-certificate-1", "states": [["name", width], …], "k": 1, "simple_path": false,
//! "gates": [["s3.0", "!g0"], …], "clauses": [["!s0.1", "g2"], …]}`. `s3.0` says that bit 0 of state 3 is one, `!s3.0` that it is
//! zero, `g2` that gate 2 holds. The states are those of the system that this version of the tool makes of block and
//! table; their names and widths are there so that a difference is told.

use serde_json::{Value, json};

use crate::logic::certificate::{Certificate, Fact, StateBit};
use crate::logic::system::System;

/// The format of certificates.
pub const CERTIFICATE: &str = "rungbook-certificate-1";

/// `certificate` of `system` as JSON.
#[must_use]
pub fn certificate(system: &System, certificate: &Certificate) -> Value {
    let states: Vec<Value> =
        system.states.iter().map(|state| json!([state.name, system.pool.width(state.variable)])).collect();
    let clause = |clause: &Vec<Fact>| clause.iter().map(written).collect::<Vec<String>>();
    json!({
        "format": CERTIFICATE,
        "states": states,
        "k": certificate.k,
        "simple_path": certificate.simple_path,
        "gates": certificate.gates.iter().map(|gate| gate.iter().map(written).collect()).collect::<Vec<Vec<String>>>(),
        "clauses": certificate.clauses.iter().map(clause).collect::<Vec<_>>(),
    })
}

fn written(fact: &Fact) -> String {
    let (text, value) = match fact {
        Fact::Bit(bit) => (format!("s{}.{}", bit.state, bit.bit), bit.value),
        Fact::Gate(gate, value) => (format!("g{gate}"), *value),
    };
    if value { text } else { format!("!{text}") }
}

/// Reads a certificate for `system`.
///
/// # Errors
/// What is wrong with it, or that it is for another system.
pub fn read_certificate(system: &System, value: &Value) -> Result<Certificate, String> {
    if value["format"] != CERTIFICATE {
        return Err(format!("the format is {}, and not \"{CERTIFICATE}\"", value["format"]));
    }
    let own = certificate(system, &Certificate::default());
    if value["states"] != own["states"] {
        return Err("its states are not those that block and table have".to_owned());
    }
    let list = |key: &str| value[key].as_array().ok_or_else(|| format!("`{key}` is no list"));
    let facts = |value: &Value| {
        let facts = value.as_array().ok_or("a clause is no list")?;
        facts.iter().map(|fact| read_fact(fact).ok_or_else(|| format!("{fact} is no fact"))).collect()
    };
    let gates = list("gates")?.iter().map(|gate| {
        let facts: Vec<Fact> = facts(gate)?;
        <[Fact; 2]>::try_from(facts).map_err(|_| "a gate has two operands".to_owned())
    });
    let gates = gates.collect::<Result<_, String>>()?;
    let clauses = list("clauses")?.iter().map(facts).collect::<Result<_, String>>()?;
    let k = value["k"].as_u64().and_then(|k| u32::try_from(k).ok()).ok_or("`k` is no number")?;
    let simple_path = value["simple_path"].as_bool().ok_or("`simple_path` is no truth value")?;
    Ok(Certificate { gates, clauses, k, simple_path })
}

fn read_fact(value: &Value) -> Option<Fact> {
    let text = value.as_str()?;
    let (text, value) = text.strip_prefix('!').map_or((text, true), |text| (text, false));
    if let Some(gate) = text.strip_prefix('g') {
        return Some(Fact::Gate(gate.parse().ok()?, value));
    }
    let (state, bit) = text.strip_prefix('s')?.split_once('.')?;
    Some(Fact::Bit(StateBit { state: state.parse().ok()?, bit: bit.parse().ok()?, value }))
}
