//! The command line: a row for each command, whose arguments, examples and help are in its own file.

mod completions;
mod groups;

use crate::commands::{board::*, body, garment::*, maps, motion, process, recordings::*, shapes, views::*};
use crate::stderr_log;
use anyhow::Result;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use completions::CompletionsArgs;
use std::ffi::OsString;
use taxel::text::words;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel
  taxel live --source sim:lash
  taxel config touches

Exit status:
  0  done
  1  failed: a file, the disk, a result that is not good enough
  2  wrong use: another command line is needed
  3  the board is at fault: no answer, a refusal, faulty lines or taxels";

/// See, record and understand touch on a robot's tactile garment
#[derive(Debug, Parser)]
#[command(name = "taxel", version, after_help = EXAMPLES)]
pub struct Cli {
    /// Command to run [default: live]
    #[command(subcommand)]
    command: Option<Command>,
    /// Report on standard error what the program does
    #[arg(short, long, global = true)]
    verbose: bool,
}

#[derive(Debug, Subcommand)]
enum Command {
    #[command(flatten)]
    Look(Look),
    #[command(flatten)]
    Recordings(Recordings),
    #[command(flatten)]
    SetUp(SetUp),
    #[command(flatten)]
    Teach(Teach),
    Completions(CompletionsArgs),
}

/// A group of commands: the module of each, and its arguments, which the module's `run` takes.
macro_rules! group {
    ($group:ident { $($command:ident($module:ident, $args:ident),)+ }) => {
        #[derive(Debug, Subcommand)]
        enum $group {
            $($command(Box<$module::$args>),)+
        }

        impl $group {
            fn run(self) -> Result<()> {
                match self {
                    $($group::$command(args) => $module::run(*args),)+
                }
            }
        }
    };
}

group!(Look {
    Live(live, LiveArgs),
    View(view, ViewArgs),
    Motion(motion, MotionArgs),
    Ros2(ros2, Ros2Args),
    Foxglove(foxglove, FoxgloveArgs),
    Serve(serve, ServeArgs),
});

group!(Recordings {
    Record(record, RecordArgs),
    Info(info, InfoArgs),
    Export(export, ExportArgs),
    Report(report, ReportArgs),
});

group!(SetUp {
    Ports(ports, PortsArgs),
    Flash(flash, FlashArgs),
    Doctor(doctor, DoctorArgs),
    Health(health, HealthArgs),
    Setup(setup, SetupArgs),
    Calibrate(calibrate, CalibrateArgs),
    Config(config, ConfigArgs),
    Body(body, BodyArgs),
    Save(save, SaveArgs),
    ResetSettings(reset_settings, ResetSettingsArgs),
});

group!(Teach {
    Fcm(maps, FcmArgs),
    Shapes(shapes, ShapesArgs),
    Process(process, ProcessArgs),
});

impl Cli {
    /// Reads a command line; the program ends here where it is wrong, or asks for help.
    pub fn read(words: impl IntoIterator<Item = OsString>) -> Cli {
        let mut command = groups::grouped(Cli::command());
        let read = command.try_get_matches_from_mut(words);
        let read =
            read.and_then(|read| Cli::from_arg_matches(&read).map_err(|error| error.format(&mut command)));
        read.unwrap_or_else(|error| in_words(error).exit())
    }

    /// Runs what was asked for.
    pub fn run(self) -> Result<()> {
        stderr_log::begin(self.verbose);
        match self.command {
            None => live::run_bare(),
            Some(Command::Look(command)) => command.run(),
            Some(Command::Recordings(command)) => command.run(),
            Some(Command::SetUp(command)) => command.run(),
            Some(Command::Teach(command)) => command.run(),
            Some(Command::Completions(args)) => completions::run(&args, Cli::command()),
        }
    }
}

/// Rewrites number-parsing errors in plain words.
fn in_words(error: clap::Error) -> clap::Error {
    let Some(theirs) = std::error::Error::source(&error).map(ToString::to_string) else { return error };
    let ours = words::plain(&theirs);
    if ours == theirs {
        return error;
    }
    let text = error.to_string();
    let message = text.trim_start_matches("error: ").replacen(&theirs, &ours, 1);
    clap::Error::raw(error.kind(), message)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_help_has_an_example() {
        let command = Cli::command();
        command.clone().debug_assert();
        for command in command.get_subcommands().chain([&command]) {
            let after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            assert!(
                after.starts_with("Example") && after.contains("taxel"),
                "{}: {after}",
                command.get_name()
            );
        }
    }
}
