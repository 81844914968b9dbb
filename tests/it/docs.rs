//! Tests of `docs` that need other rooms.

mod attachment;
