//! Text to tree and findings, without loss; parsing never fails.
