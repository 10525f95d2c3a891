//! What is told on the standard error. Where nobody takes it (a log on a full disk) the command goes on: the
//! standard library's macros of these names end the program then, and a recording with it.

/// Tells a line.
macro_rules! eprintln {
    ($($words:tt)*) => {{
        use std::io::Write as _;
        _ = writeln!(std::io::stderr(), $($words)*);
    }};
}

/// Tells words without an end of the line.
macro_rules! eprint {
    ($($words:tt)*) => {{
        use std::io::Write as _;
        _ = write!(std::io::stderr(), $($words)*);
    }};
}
