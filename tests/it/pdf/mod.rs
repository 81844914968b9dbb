//! Tests of the PDF.

mod fixture;
mod scratch;
