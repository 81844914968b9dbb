//! Tests of the PDF.

mod fixture;
