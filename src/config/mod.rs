//! `rungbook.toml` to each room's own options.
