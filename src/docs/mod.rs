//! Comments to structured prose and links.
