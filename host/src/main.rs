//! The program `taxel`: where it fails one sentence, and the exit status of [`taxel::fault`].
#![forbid(unsafe_code)]

use std::process::ExitCode;
use taxel::cli::Cli;
use taxel::{fault, words};

fn main() -> ExitCode {
    leave_quietly_on_broken_pipe();
    match Cli::read().run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if is_closed_output(&error) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", words::sentence(&error));
            ExitCode::from(fault::status(&error))
        }
    }
}

/// A broken pipe that nobody has put into words is that of the standard output; those of links say which link.
fn is_closed_output(error: &anyhow::Error) -> bool {
    let error = error.chain().next().and_then(|outermost| outermost.downcast_ref::<std::io::Error>());
    error.is_some_and(|error| error.kind() == std::io::ErrorKind::BrokenPipe)
}

/// `println!` panics when the reader of a pipe is gone (`taxel ... | head`), which is no fault.
fn leave_quietly_on_broken_pipe() {
    let report = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        let text = panic.payload_as_str().unwrap_or_default();
        if text.starts_with("failed printing to stdout") && text.contains("Broken pipe") {
            std::process::exit(0);
        }
        report(panic);
    }));
}
