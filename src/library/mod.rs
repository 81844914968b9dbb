//! What the tree declares, resolved.
