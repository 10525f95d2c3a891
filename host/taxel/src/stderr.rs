//! A macro for standard error that ignores write errors. The standard library's macro of this name panics if
//! it cannot be written (a log on a full disk), and would end a recording.

/// Prints a line.
macro_rules! eprintln {
    ($($words:tt)*) => {{
        use std::io::Write as _;
        _ = writeln!(std::io::stderr(), $($words)*);
    }};
}
