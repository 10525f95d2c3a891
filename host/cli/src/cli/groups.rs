//! The help of the program: its commands under headings, by what they are for.

use super::{Look, Recordings, SetUp, Teach};
use clap::{Command, Subcommand};
use std::fmt::Write;

/// Adds a group's commands to a command line.
type AddCommands = fn(Command) -> Command;

/// Headings, and what adds the commands below each to a command line.
const GROUPS: [(&str, AddCommands); 4] = [
    ("Look", Look::augment_subcommands),
    ("Record", Recordings::augment_subcommands),
    ("Set up", SetUp::augment_subcommands),
    ("Teach", Teach::augment_subcommands),
];
/// Heading of the rest.
const OTHER: &str = "Other";

/// The command line with a help that lists its commands in groups: clap has one heading for all of them.
pub(super) fn grouped(command: Command) -> Command {
    let template = template(&command);
    command.help_template(template)
}

/// Template that clap fills in, around the lists of the commands, which say what the commands themselves say.
fn template(command: &Command) -> String {
    let mut built = command.clone();
    // Only then it has the command `help`.
    built.build();
    let (header, literal) = (built.get_styles().get_header(), built.get_styles().get_literal());
    let width = built.get_subcommands().map(|command| command.get_name().len()).max().unwrap_or(0);
    let mut text = String::from("{about-with-newline}\n{usage-heading} {usage}\n");
    let mut rest: Vec<&Command> = built.get_subcommands().collect();
    let mut list = |heading: &str, commands: &[&Command]| {
        _ = writeln!(text, "\n{header}{heading}:{header:#}");
        for command in commands {
            let (name, about) = (command.get_name(), command.get_about().cloned().unwrap_or_default());
            _ = writeln!(text, "  {literal}{name:width$}{literal:#}  {about}");
        }
    };
    for (heading, group) in GROUPS {
        let group = group(Command::new(heading));
        let (listed, others): (Vec<_>, _) =
            rest.into_iter().partition(|command| group.find_subcommand(command.get_name()).is_some());
        list(heading, &listed);
        rest = others;
    }
    list(OTHER, &rest);
    text + &format!("\n{header}Options:{header:#}\n{{options}}{{after-help}}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::Cli;
    use clap::CommandFactory;

    #[test]
    fn the_help_has_what_clap_would_list() {
        let (plain, grouped) = (Cli::command().render_help(), grouped(Cli::command()).render_help());
        let lines = |text: String| {
            let mut lines: Vec<String> = text.lines().map(String::from).collect();
            lines.retain(|line| line.starts_with(' '));
            lines.sort_unstable();
            lines
        };
        assert_eq!(lines(grouped.to_string()), lines(plain.to_string()));
    }

    #[test]
    fn options_of_a_board_have_headings_of_their_own() {
        let command = Cli::command();
        let of_boards = command.get_subcommands().filter(|command| {
            let mut ids = command.get_arguments().map(|arg| arg.get_id().as_str());
            ids.any(|id| id == "joint_states")
        });
        for command in of_boards {
            let under = |heading| {
                let args = command.get_arguments().filter(move |arg| arg.get_help_heading() == heading);
                args.map(|arg| arg.get_id().as_str()).collect::<Vec<_>>()
            };
            let name = command.get_name();
            assert_eq!(under(Some("Connect")), ["source", "wait", "once", "seed"], "{name}");
            let set = under(Some("Set"));
            let of_set = ["garment", "scene", "calibration", "body", "robot", "poses", "requests"];
            assert!(of_set.iter().all(|id| set.contains(id)), "{name}: {set:?}");
            let rest = under(None);
            let of_rest = ["place", "frames", "seconds", "json", "output", "port", "pixels"];
            let has = |id: &&str| command.get_arguments().any(|arg| arg.get_id() == *id);
            assert!(of_rest.iter().filter(|id| has(id)).all(|id| rest.contains(id)), "{name}: {rest:?}");
        }
    }
}
