//! Drawings as primitives, then SVG.
