//! The program `taxel`: one sentence and exit status 2 where the input is bad.
#![forbid(unsafe_code)]

use clap::Parser;
use std::process::ExitCode;
use taxel::cli::Cli;

fn main() -> ExitCode {
    leave_quietly_on_broken_pipe();
    match Cli::parse().run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if is_closed_output(&error) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", one_line(&error));
            ExitCode::from(2)
        }
    }
}

/// The chain of causes as one sentence on one line.
fn one_line(error: &anyhow::Error) -> String {
    format!("{error:#}").lines().map(str::trim).collect::<Vec<_>>().join(" ")
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
