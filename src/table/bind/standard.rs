//! The variables of the standard function blocks (IEC 61131-3:2013, 6.6.3.5), for trees that do not declare them.

/// A standard function block.
#[derive(Debug)]
pub(super) struct Standard {
    /// Its name.
    pub(super) name: &'static str,
    /// Its inputs and outputs with their types.
    pub(super) variables: &'static [(&'static str, &'static str)],
}

const TIMER: &[(&str, &str)] = &[("IN", "BOOL"), ("PT", "TIME"), ("Q", "BOOL"), ("ET", "TIME")];
const LONG_TIMER: &[(&str, &str)] = &[("IN", "BOOL"), ("PT", "LTIME"), ("Q", "BOOL"), ("ET", "LTIME")];
const EDGE: &[(&str, &str)] = &[("CLK", "BOOL"), ("Q", "BOOL")];

const BLOCKS: &[Standard] = &[
    Standard { name: "TON", variables: TIMER },
    Standard { name: "TOF", variables: TIMER },
    Standard { name: "TP", variables: TIMER },
    Standard { name: "LTON", variables: LONG_TIMER },
    Standard { name: "LTOF", variables: LONG_TIMER },
    Standard { name: "LTP", variables: LONG_TIMER },
    Standard { name: "R_TRIG", variables: EDGE },
    Standard { name: "F_TRIG", variables: EDGE },
    Standard {
        name: "CTU",
        variables: &[("CU", "BOOL"), ("RESET", "BOOL"), ("R", "BOOL"), ("PV", "WORD"), ("Q", "BOOL"), ("CV", "WORD")],
    },
    Standard {
        name: "CTD",
        variables: &[("CD", "BOOL"), ("LOAD", "BOOL"), ("LD", "BOOL"), ("PV", "WORD"), ("Q", "BOOL"), ("CV", "WORD")],
    },
    Standard {
        name: "CTUD",
        variables: &[
            ("CU", "BOOL"),
            ("CD", "BOOL"),
            ("RESET", "BOOL"),
            ("LOAD", "BOOL"),
            ("R", "BOOL"),
            ("LD", "BOOL"),
            ("PV", "WORD"),
            ("QU", "BOOL"),
            ("QD", "BOOL"),
            ("CV", "WORD"),
        ],
    },
    Standard {
        name: "SR",
        variables: &[("SET1", "BOOL"), ("RESET", "BOOL"), ("S1", "BOOL"), ("R", "BOOL"), ("Q1", "BOOL")],
    },
    Standard {
        name: "RS",
        variables: &[("SET", "BOOL"), ("RESET1", "BOOL"), ("S", "BOOL"), ("R1", "BOOL"), ("Q1", "BOOL")],
    },
];

/// The standard function block of that name.
pub(super) fn block(name: &str) -> Option<&'static Standard> {
    BLOCKS.iter().find(|block| block.name.eq_ignore_ascii_case(name))
}

impl Standard {
    /// The variable of that name, with its type.
    pub(super) fn variable(&self, name: &str) -> Option<(&'static str, &'static str)> {
        self.variables.iter().find(|(other, _)| other.eq_ignore_ascii_case(name)).copied()
    }
}
