//! `taxel config check` of a robot's file: its boards.

use anyhow::{Context, Result};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;
use taxel::mind::RobotMind;
use taxel::robot::{ReadRobot, RobotBoard};

/// Runs the command.
pub fn run(file: &Path, is_json: bool) -> Result<()> {
    let robot = ReadRobot::read(file)?;
    RobotMind::new(&robot).with_context(|| robot.file.clone())?;
    match is_json {
        true => println!("{}", report(&robot)),
        false => print!("{}", table(&robot)),
    }
    Ok(())
}

/// A line for the robot, and one for each board.
fn table(robot: &ReadRobot) -> String {
    let boards = robot.boards.len();
    let mut text = format!("robot {}: {boards} board{}", robot.name, if boards == 1 { "" } else { "s" });
    if let Some(described) = &robot.robot {
        let base = described.links().first().map_or("", |base| base.name.as_str());
        let _ = write!(text, "; {}: {} links, base {base}", described.file(), described.links().len());
    }
    text += "\n";
    let head = ["board", "source", "garment", "taxels", "lies on", "scene", "calibration", "tare", "also"]
        .map(String::from);
    let rows: Vec<[String; 9]> = [head].into_iter().chain(robot.boards.iter().map(row)).collect();
    let wide = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let wide: Vec<usize> = (0..9).map(wide).collect();
    for row in &rows {
        let cells: String = row.iter().zip(&wide).map(|(cell, wide)| format!("{cell:wide$}  ")).collect();
        let _ = writeln!(text, "{}", cells.trim_end());
    }
    text
}

fn row(board: &RobotBoard) -> [String; 9] {
    let RobotBoard { name, source, garment, scene, calibration, tare, body, link, .. } = board;
    [
        name.clone(),
        source.to_string(),
        garment.as_ref().map_or("any".into(), |board_garment| board_garment.garment.name.to_string()),
        garment.as_ref().map_or("-".into(), |board_garment| board_garment.layout.taxels().to_string()),
        match (body, link) {
            (Some(body), _) => format!("body {body}"),
            (None, Some(link)) => link.clone(),
            (None, None) => "-".into(),
        },
        scene.as_ref().map_or("-".into(), |scene| scene.scene.name.to_string()),
        calibration.as_ref().map_or("-".into(), |calibration| calibration.id.clone()),
        tare.map_or("-".into(), |frames| frames.to_string()),
        also(board).join(", "),
    ]
}

/// Keys of what else the board is asked.
fn also(board: &RobotBoard) -> Vec<&'static str> {
    let keys = [
        ("budget", board.budget.is_some()),
        ("raw", board.raw),
        ("gestures", board.gestures.is_some()),
        ("forms", board.forms.is_some()),
        ("feed", !board.feeds.is_empty()),
        ("shapes", board.shapes.is_some()),
        ("folds", board.folds.is_some()),
        ("pressing", board.pressing.is_some()),
    ];
    keys.into_iter().filter(|(_, is_there)| *is_there).map(|(key, _)| key).collect()
}

fn report(robot: &ReadRobot) -> Value {
    let board = |board: &RobotBoard| {
        let board_garment = board.garment.as_ref();
        let areas = board_garment.map(|board_garment| board_garment.layout.areas());
        let panels = areas.map(|areas| areas.iter().map(|area| area.name.as_str()).collect::<Vec<_>>());
        json!({
            "name": board.name,
            "source": board.source.to_string(),
            "garment": board_garment.map(|board_garment| board_garment.garment.name.as_str()),
            "taxels": board_garment.map(|board_garment| board_garment.layout.taxels()),
            "panels": panels,
            "scene": board.scene.as_ref().map(|scene| scene.scene.name.as_str()),
            "calibration": board.calibration.as_ref().map(|calibration| calibration.id.as_str()),
            "tare": board.tare,
            "body": board.body,
            "link": board.link,
            "also": also(board),
        })
    };
    json!({
        "robot": robot.name,
        "urdf": robot.robot.as_ref().map(|described| described.file()),
        "boards": robot.boards.iter().map(board).collect::<Vec<_>>(),
    })
}
