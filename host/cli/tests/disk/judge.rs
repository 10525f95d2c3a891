//! Requirements on a run with a fault.

use crate::cases::{Case, Content, Output, Replaces};
use crate::faults::Fault;
use crate::names;
use crate::run::{Done, Run};
use crate::stage::{Files, Stage};
use std::fs;
use std::path::Path;
use taxel::recording::{repair, scan};

/// Words of the programming language that must not reach the user.
const FOREIGN: [&str; 7] = ["panicked", "os error", "Err(", "Os {", "unwrap", "kind:", "RUST_"];

/// Files of a command before a run, and after one without a fault.
pub struct Judge<'a> {
    pub case: &'a Case,
    pub stage: &'a Stage,
    pub before: &'a Files,
    pub whole: &'a Files,
}

impl Judge<'_> {
    /// Violations of the requirements.
    pub fn judge(&self, fault: Fault, done: &Done) -> Vec<String> {
        let mut wrong = Vec::new();
        let mut require = |holds: bool, why: &dyn Fn() -> String| {
            if !holds {
                wrong.push(why());
            }
        };
        require(done.place.is_precious_safe(), &|| "what is precious was changed".into());
        for (name, bytes) in self.before.iter().filter(|(name, _)| !self.is_output(name)) {
            require(done.after.get(name) == Some(bytes), &|| format!("{name} was changed"));
        }
        let left = self.left(done);
        // As many as are written at a time: a recording has one beside it, an archive its arrays.
        let may_stay = if fault.kills() { 2 } else { 0 };
        require(left.len() <= may_stay || fault == Fault::ReadOnly, &|| format!("left: {left:?}"));
        for output in self.case.outputs {
            if let Err(why) = self.output(output, fault, done) {
                require(false, &|| format!("{}: {why}", output.name));
            }
        }
        if let Err(why) = self.reported(fault, done) {
            require(false, &|| why.clone());
        }
        if fault.kills()
            && let Err(why) = self.again(done)
        {
            require(false, &|| format!("the next run: {why}"));
        }
        wrong
    }

    fn is_output(&self, name: &str) -> bool {
        self.case.outputs.iter().any(|output| output.holds(name))
    }

    /// Files and folders that are neither input nor output.
    fn left(&self, done: &Done) -> Vec<String> {
        let is_known = |name: &&String| self.before.contains_key(*name) || self.is_output(name);
        let top = |name: &String| {
            let output = self.case.outputs.iter().find(|output| name.starts_with(output.name));
            let inside = output.map_or(0, |output| output.name.len() + 1);
            let end = name[inside..].find('/').map_or(name.len(), |end| inside + end);
            name[..end].to_string()
        };
        let mut left: Vec<String> =
            done.after.keys().filter(|name| !is_known(name) && !name.contains(".aside")).map(top).collect();
        left.dedup();
        left
    }

    /// Checks that an output has all of the old or all of the new content.
    fn output(&self, output: &Output, fault: Fault, done: &Done) -> Result<(), String> {
        let of = |files: &Files| -> Files {
            let own = files.iter().filter(|(name, _)| output.holds(name));
            own.map(|(name, bytes)| (name.clone(), bytes.clone())).collect()
        };
        let (old, new, now) = (of(self.before), of(self.whole), of(&done.after));
        if fault == Fault::Link && (now.is_empty() || now.values().all(|bytes| bytes == b"a link")) {
            return Ok(());
        }
        let is_new = match output.content {
            Content::Same => now == new,
            Content::Ends(end) => {
                now.values().all(|bytes| bytes.ends_with(end.as_bytes())) && !now.is_empty()
            }
            Content::Toml => {
                !now.is_empty() && now.iter().all(|(name, bytes)| keys(bytes) == keys(&new[name]))
            }
            Content::Recording => {
                let [path, held] =
                    [&done.place.folder, &done.place.held()].map(|folder| folder.join(output.name));
                let was_begun = fs::read(&held).is_ok_and(|held| old.get(output.name) != Some(&held));
                if now.is_empty() || now == old {
                    if was_begun {
                        return Err("it was begun, and is gone".into());
                    }
                    false
                } else {
                    let kept = messages(&path, done.succeeded())?;
                    if kept == 0 && !old.is_empty() {
                        return Err("the old one is gone, and nothing is in the new one".into());
                    }
                    let held = if was_begun { messages(&held, false)? } else { 0 };
                    if kept < held {
                        return Err(format!("{kept} messages, {held} before the fault"));
                    }
                    true
                }
            }
        };
        match (is_new, now == old, done.succeeded()) {
            (true, ..) | (_, true, false) => Ok(()),
            (_, true, true) => Err("the program says that all is well, and nothing is written".into()),
            _ => {
                let sizes: Vec<_> =
                    now.iter().map(|(name, bytes)| format!("{name}: {} bytes", bytes.len())).collect();
                Err(format!("neither the old nor the new: {sizes:?} of {:?}", names(&new)))
            }
        }
    }

    /// Checks for one sentence that names a file, in plain words.
    fn reported(&self, fault: Fault, done: &Done) -> Result<(), String> {
        if let Some(word) = FOREIGN.iter().find(|word| done.said.contains(*word)) {
            return Err(format!("says {word:?}"));
        }
        if fault.kills() {
            return if done.was_killed() { Ok(()) } else { Err("it was not killed".into()) };
        }
        if done.succeeded() {
            return Ok(());
        }
        if fault == Fault::Interrupted {
            return Err("an interrupted call ends the program".into());
        }
        let errors: Vec<&str> = done.said.lines().filter(|line| line.starts_with("error: ")).collect();
        let [error] = errors[..] else { return Err(format!("{} errors are reported", errors.len())) };
        let names_one = self.case.outputs.iter().any(|output| error.contains(output.name));
        if done.status.code() != Some(1) && fault != Fault::Link {
            return Err(format!("{}", done.status));
        }
        if names_one { Ok(()) } else { Err("the error names no output".into()) }
    }

    /// Runs the command again after a kill; nothing may be in its way.
    fn again(&self, done: &Done) -> Result<(), String> {
        let replaces =
            self.case.outputs.iter().any(|output| done.after.keys().any(|name| output.holds(name)));
        let run = Run { case: self.case, replaces, call: 0, fault: Fault::None };
        let again = run.go(self.stage, &done.after);
        if !again.succeeded() {
            return Err(again.said);
        }
        if self.case.replaces == Replaces::Always {
            // Its input was changed by the first run.
            return Ok(());
        }
        self.case.outputs.iter().try_for_each(|output| self.output(output, Fault::None, &again))
    }
}

/// Keys of a TOML table; none for other text.
fn keys(bytes: &[u8]) -> Option<Vec<String>> {
    let table: toml::Table = std::str::from_utf8(bytes).ok()?.parse().ok()?;
    Some(table.keys().cloned().collect())
}

/// Number of readable messages of a recording after a repair; error if some of it is damaged.
fn messages(path: &Path, must_be_whole: bool) -> Result<u64, String> {
    let reported = |error: taxel::Error| format!("{error:#}");
    let found = scan(path).map_err(reported)?;
    let (chunks, bytes) = found.damaged();
    if chunks > 0 || bytes > 0 || must_be_whole && !found.whole {
        return Err(format!("{chunks} chunks, {bytes} bytes damaged, whole: {}", found.whole));
    }
    let mut repaired = Vec::new();
    repair(path, &found, &mut repaired).map_err(reported)?;
    let beside = path.with_extension("whole");
    fs::write(&beside, repaired).unwrap();
    let found = scan(&beside).map_err(reported);
    fs::remove_file(beside).unwrap();
    Ok(found?.contents.counts().values().sum())
}
