//! The program from its arguments to its exit status: prints one sentence about an error, and returns the
//! status of [`fault`].

use crate::cli::Cli;
use crate::fault;
use std::error::Error as _;
use std::ffi::OsString;
use std::io::{ErrorKind, Write};
use taxel::text::words;

/// Beginning of errors about the standard output.
const OUTPUT: &str = "the standard output cannot be written";

/// Runs a command line, whose first word is the program's name. The process ends here where the command line
/// is wrong, or asks for help.
pub fn run(words: impl IntoIterator<Item = OsString>) -> u8 {
    leave_where_nobody_reads();
    match Cli::read(words).run() {
        Ok(()) => 0,
        Err(error) => match of_closed_output(&error) {
            Some(ErrorKind::BrokenPipe) => 0,
            Some(ErrorKind::StorageFull) => print_error(error.context(OUTPUT)),
            _ => print_error(error),
        },
    }
}

/// Prints an error. If that fails, the exit status still reports it.
fn print_error(error: anyhow::Error) -> u8 {
    _ = writeln!(std::io::stderr(), "error: {}", words::sentence(error.as_ref()));
    fault::status(&error)
}

/// Kind of a broken pipe or full disk without a context, which can only come from the standard output: errors
/// of links and files have contexts.
fn of_closed_output(error: &anyhow::Error) -> Option<ErrorKind> {
    let outermost = error.chain().next()?;
    let of_library = outermost.downcast_ref::<taxel::Error>().filter(|error| error.source().is_none());
    let error = outermost.downcast_ref::<std::io::Error>().or_else(|| of_library?.io())?;
    let is_bare = error.raw_os_error().is_some() || error.kind() == ErrorKind::BrokenPipe;
    is_bare.then(|| error.kind())
}

/// `println!` panics if the disk is full, or if the reader of a pipe has exited (`taxel ... | head`), which
/// is not an error.
fn leave_where_nobody_reads() {
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        let text = panic.payload_as_str().unwrap_or_default();
        match text.strip_prefix("failed printing to stdout: ") {
            Some(why) if why.contains("Broken pipe") => std::process::exit(0),
            Some(why) => {
                print_error(anyhow::anyhow!("{why}").context(OUTPUT));
                std::process::exit(1)
            }
            None => report(panic),
        }
    }));
}
