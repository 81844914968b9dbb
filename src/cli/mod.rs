//! Arguments, one file a command, reporters, exit codes; the only writer.
