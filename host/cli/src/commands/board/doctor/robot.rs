//! `taxel doctor` of a robot: the diagnosis of each board, and which of them share a USB host controller.

use super::command::{DoctorArgs, Examined, examine, first_cure, line, worst};
use super::controllers::controller;
use super::finding::{Finding, Grade};
use crate::fault::Fault;
use anyhow::{Result, bail};
use serde_json::{Value, json};
use std::thread;
use taxel::client::Buses;
use taxel::robot::{ReadRobot, RobotBoard};
use taxel::source::SourceOptions;
use taxel::text::words;

/// Runs the command: all boards at once. Error if one does not work.
pub fn run(args: &DoctorArgs, robot: &ReadRobot) -> Result<()> {
    let all = diagnosed_together(&robot.boards, args.seconds);
    let worst_of_all = all.iter().map(|found| worst(found)).max().unwrap_or(Grade::Good);
    let boards = || robot.boards.iter().zip(&all);
    if args.json {
        let reported = boards().map(|(board, found)| {
            json!({
                "board": board.name, "source": board.source.to_string(), "verdict": worst(found), "findings": found,
            })
        });
        let reported: Value = reported.collect();
        println!(
            "{}",
            json!({ "type": "doctor", "robot": robot.name, "verdict": worst_of_all, "boards": reported })
        );
    } else {
        for (board, found) in boards() {
            println!("{}: {}", board.name, board.source);
            found.iter().for_each(|finding| println!("{}", line(finding)));
        }
    }
    if let Some((board, found)) = boards().find(|(_, found)| worst(found) == Grade::Bad) {
        let name = &board.name;
        bail!(Fault::board(format!("board {name} does not work as it should: {}", first_cure(found))));
    }
    match worst_of_all {
        _ if args.json => {}
        Grade::Good => println!("All is well."),
        Grade::Weak | Grade::Bad => println!("They work. What could be better is marked with !"),
    }
    Ok(())
}

/// Returns what is found of each board.
fn diagnosed_together(boards: &[RobotBoard], seconds: f64) -> Vec<Vec<Finding>> {
    let buses = Buses::default();
    let (mut all, on): (Vec<_>, Vec<_>) = thread::scope(|scope| {
        let begin = |board| {
            let buses = buses.clone();
            scope.spawn(move || diagnosed(board, seconds, buses))
        };
        let begun: Vec<_> = boards.iter().map(begin).collect();
        begun.into_iter().map(|thread| thread.join().unwrap_or_default()).unzip()
    });
    let named: Vec<_> = boards.iter().map(|board| board.name.as_str()).zip(on).collect();
    for (at, found) in all.iter_mut().enumerate() {
        found.extend(controller(&named, at));
    }
    all
}

/// Returns what is found of a board, and the number of its controller.
fn diagnosed(board: &RobotBoard, seconds: f64, buses: Buses) -> (Vec<Finding>, Option<usize>) {
    let options = SourceOptions { seconds: Some(seconds), ..SourceOptions::default() };
    let source = match board.open(&options) {
        Ok(source) => source,
        Err(error) => {
            let cure = "`taxel ports` lists what is plugged in; docs/guides/troubleshooting.md says more";
            return (vec![Finding::bad("link", words::sentence(&error), cure)], None);
        }
    };
    let Examined { mut found, heard, bus } = examine(&board.source, source, seconds, buses);
    if let Err(error) = heard {
        let cure = "`taxel doctor` with this source says more";
        found.push(Finding::bad("link", words::sentence(error.as_ref()), cure));
    }
    (found, bus)
}
