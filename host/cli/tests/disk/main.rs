//! Every command that writes a file, on a failing disk: full, read-only, broken, a link changed meanwhile, or
//! a kill, at each of its writing calls. `cargo xtask test` provides the library that makes them fail
//! (`TAXEL_DISK`).

mod cases;
mod faults;
mod judge;
mod run;
mod stage;

use cases::{CASES, Case};
use faults::Fault;
use judge::Judge;
use run::Run;
use stage::{Files, Stage};
use std::collections::BTreeSet;
use std::sync::Mutex;
use std::thread;

/// True if every call is tried, not only some of each command.
fn is_campaign() -> bool {
    std::env::var_os("TAXEL_CAMPAIGN").is_some()
}

/// Numbers of the calls to try, of `calls`.
fn tried(calls: usize) -> BTreeSet<usize> {
    let all = 1..=calls;
    if is_campaign() {
        return all.collect();
    }
    let chosen = |n: &usize| *n <= 4 || calls - n < 5 || n.is_multiple_of(calls.div_ceil(3));
    all.filter(chosen).collect()
}

/// Results of the runs of one command.
#[derive(Default)]
struct Tally {
    runs: usize,
    calls: usize,
    wrong: Vec<String>,
}

/// Tries a command with each fault, in a folder where its output exists already or not.
fn try_out(case: &Case, stage: &Stage, replaces: bool) -> Tally {
    let before = stage.before(case, replaces);
    let whole = Run { case, replaces, call: 0, fault: Fault::None }.go(stage, &before);
    assert!(whole.succeeded(), "{}: {}", case.name, whole.said);
    let judge = Judge { case, stage, before: &before, whole: &whole.after };
    let mut tally = Tally { calls: whole.calls.len(), ..Tally::default() };
    for fault in Fault::ALL {
        for call in tried(whole.calls.len()) {
            if !fault.concerns(&whole.calls[call - 1]) || fault.is_left_out(call, case) {
                continue;
            }
            let run = Run { case, replaces, call, fault };
            let done = run.go(stage, &before);
            if done.calls.len() < call {
                // A live stream is written in a varying number of calls.
                continue;
            }
            tally.runs += 1;
            let place =
                format!("{} ({}), {fault:?} at {}", case.name, case.shown(replaces), whole.calls[call - 1]);
            let wrong = judge.judge(fault, &done);
            tally.wrong.extend(
                wrong.into_iter().map(|why| format!("{place}: {why}\n    said: {}", done.said.trim())),
            );
        }
    }
    tally
}

#[test]
fn a_disk_that_fails_costs_no_file() {
    let stage = Stage::new("all");
    let waiting =
        Mutex::new(CASES.iter().flat_map(|case| case.variants().map(move |replaces| (case, replaces))));
    let all = Mutex::new(Tally::default());
    let work = || {
        loop {
            let next = waiting.lock().unwrap().next();
            let Some((case, replaces)) = next else { return };
            let tally = try_out(case, &stage, replaces);
            let mut all = all.lock().unwrap();
            (all.runs, all.calls) = (all.runs + tally.runs, all.calls + tally.calls);
            all.wrong.extend(tally.wrong);
        }
    };
    let cores = thread::available_parallelism().map_or(2, usize::from);
    thread::scope(|scope| (0..cores).for_each(|_| _ = scope.spawn(work)));
    let Tally { runs, calls, wrong } = all.into_inner().unwrap();
    assert!(wrong.is_empty(), "{} of {runs} runs:\n{}", wrong.len(), wrong.join("\n"));
    let faults = Fault::ALL.len();
    println!(
        "{} commands that write, {faults} faults, {runs} runs over {calls} calls: no file lost",
        CASES.len()
    );
}

#[test]
fn a_recording_that_grows_is_not_repaired_in_place() {
    let stage = Stage::new("grown");
    let case = CASES.iter().find(|case| case.args.contains("--in-place")).unwrap();
    let before = stage.before(case, true);
    let done = Run { case, replaces: true, call: 1, fault: Fault::Grown }.go(&stage, &before);
    assert!(!done.succeeded() && done.said.contains("is still being recorded"), "{}", done.said);
    assert_eq!(done.after["cut.mcap"], [&before["cut.mcap"][..], b"more"].concat());
    assert_eq!(names(&done.after), names(&before));
}

/// All files below a folder.
fn names(files: &Files) -> Vec<&str> {
    files.keys().map(String::as_str).collect()
}
