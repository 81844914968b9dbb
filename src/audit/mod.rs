//! Rules, one a file: what is undocumented, unverified, broken.
