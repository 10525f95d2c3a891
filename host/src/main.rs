//! The program `taxel`: where it fails one sentence, and the exit status of [`taxel::fault`].
#![forbid(unsafe_code)]

use std::io::{ErrorKind, Write};
use std::process::ExitCode;
use taxel::cli::Cli;
use taxel::{fault, words};

fn main() -> ExitCode {
    leave_where_nobody_reads();
    match Cli::read().run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => match of_closed_output(&error) {
            Some(ErrorKind::BrokenPipe) => ExitCode::SUCCESS,
            Some(ErrorKind::StorageFull) => tell(error.context(OUTPUT)),
            _ => tell(error),
        },
    }
}

/// How errors of the standard output begin.
const OUTPUT: &str = "the standard output cannot be written";

/// Tells an error. Where nobody takes it, its status still says something.
fn tell(error: anyhow::Error) -> ExitCode {
    _ = writeln!(std::io::stderr(), "error: {}", words::sentence(&error));
    ExitCode::from(fault::status(&error))
}

/// A broken pipe, or a full disk, that nobody has put into words is that of the standard output; those of links
/// and files say which.
fn of_closed_output(error: &anyhow::Error) -> Option<ErrorKind> {
    let outermost = error.chain().next()?;
    let error = outermost.downcast_ref::<std::io::Error>()?;
    let is_bare = error.raw_os_error().is_some() || error.kind() == ErrorKind::BrokenPipe;
    is_bare.then(|| error.kind())
}

/// `println!` panics when the reader of a pipe is gone (`taxel ... | head`), which is no fault, or where the
/// disk is full.
fn leave_where_nobody_reads() {
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        let text = panic.payload_as_str().unwrap_or_default();
        match text.strip_prefix("failed printing to stdout: ") {
            Some(why) if why.contains("Broken pipe") => std::process::exit(0),
            Some(why) => {
                tell(anyhow::anyhow!("{why}").context(OUTPUT));
                std::process::exit(1)
            }
            None => report(panic),
        }
    }));
}
