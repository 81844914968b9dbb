//! Walks trees and unwraps vendor files; the only reader of the disk beside `cli/`.
