//! Macros for standard error that ignore write errors. The standard library's macros of these names panic if
//! it cannot be written (a log on a full disk), and would end a recording.

/// Prints a line.
macro_rules! eprintln {
    ($($words:tt)*) => {{
        use std::io::Write as _;
        _ = writeln!(std::io::stderr(), $($words)*);
    }};
}

/// Prints text without a line end.
macro_rules! eprint {
    ($($words:tt)*) => {{
        use std::io::Write as _;
        _ = write!(std::io::stderr(), $($words)*);
    }};
}
