//! Runs a command with one fault at one call.

use crate::cases::Case;
use crate::faults::Fault;
use crate::stage::{Files, Place, Stage, read};
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, ExitStatus, Stdio};

/// A run.
pub struct Run<'a> {
    pub case: &'a Case,
    pub replaces: bool,
    /// Number of the failing call; 0 for none.
    pub call: usize,
    pub fault: Fault,
}

/// Result of a run.
pub struct Done {
    pub place: Place,
    pub status: ExitStatus,
    pub said: String,
    /// The calls that changed files, as logged.
    pub calls: Vec<String>,
    pub after: Files,
}

impl Run<'_> {
    /// Runs the command in a folder of its own.
    pub fn go(&self, stage: &Stage, before: &Files) -> Done {
        let place = stage.folder(before);
        let target = self.case.outputs[0].name;
        let precious = if self.case.outputs[0].is_folder { "precious-folder" } else { "precious" };
        let notes = place.around.join("notes");
        let mut command = Command::new(env!("CARGO_BIN_EXE_taxel"));
        command.args(self.case.args(self.replaces)).current_dir(&place.folder);
        command.env("LD_PRELOAD", std::env::var_os("TAXEL_DISK").expect("TAXEL_DISK names no library"));
        command.env("TAXEL_DISK_FOLDER", &place.folder).env("TAXEL_DISK_NOTES", &notes);
        command.env("TAXEL_DISK_CALL", self.call.to_string()).env("TAXEL_DISK_FAULT", self.fault.name());
        command.env("TAXEL_DISK_TARGET", place.folder.join(target));
        command.env("TAXEL_DISK_PRECIOUS", place.around.join(precious)).env("TAXEL_DISK_HELD", place.held());
        let output = command.stdin(Stdio::null()).output().unwrap();
        let notes = fs::read_to_string(notes).unwrap_or_default();
        Done {
            status: output.status,
            said: String::from_utf8_lossy(&output.stderr).into_owned(),
            calls: notes.lines().map(|line| called(line, &place)).collect(),
            after: read(&place.folder),
            place,
        }
    }
}

/// A call without its number and without the folder.
fn called(line: &str, place: &Place) -> String {
    let line = line.split_once(' ').map_or(line, |(_, call)| call);
    line.replace(&format!("{}/", place.folder.display()), "")
}

impl Done {
    pub fn succeeded(&self) -> bool {
        self.status.success()
    }

    pub fn was_killed(&self) -> bool {
        self.status.signal() == Some(9)
    }
}
