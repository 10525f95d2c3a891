//! Cost of the mind of a robot, by the number of its boards.

use anyhow::{Context, Result};
use clap::Args;
use serde_json::{Value, json};
use std::path::Path;
use std::time::{Duration, Instant};
use taxel::body::DVec3;
use taxel::body::robot::RobotJoint;
use taxel::mind::{BoardSense, HostInputLine, MindReader, RobotMind};
use taxel::robot::ReadRobot;
use taxel::virtual_board::VirtualBoard;
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::scene::Scene;
use taxel_core::wire::Request;

/// Numbers of boards.
const BOARDS: [usize; 5] = [1, 4, 16, 64, 100];
/// Time between two scans of a board, us.
const PERIOD_US: u64 = 5_000;
/// Scans: a tare, and a second and a half with three touches that last for a second.
const SCANS: u64 = 320;
const TARE: u16 = 20;
const TOUCHED: std::ops::Range<u64> = 60..260;
/// Time between two postures, us.
const JOINTS_US: u64 = 10_000;
/// Distance of a garment from the next one, m.
const BESIDE_M: f64 = 0.1;
/// Repetitions; the fastest counts, because the others were disturbed.
const TIMES: usize = 3;

/// Arguments of `cargo xtask bench mind`.
#[derive(Debug, Clone, Args)]
pub struct MindBench {
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
}

/// What the mind costs.
#[derive(Debug, Clone)]
pub struct MindCost {
    /// Reading a board's events for the mind, in the board's thread, us a scan.
    pub read: f64,
    /// Number of boards, and what the mind takes, us a scan of a board.
    pub rows: Vec<(usize, f64)>,
}

/// Runs the command.
pub fn run(args: &MindBench) -> Result<()> {
    let cost = measure(&BOARDS)?;
    match args.json {
        true => println!("{}", cost.json()),
        false => print!("{}", cost.table()),
    }
    Ok(())
}

impl MindCost {
    /// Readable form.
    pub fn table(&self) -> String {
        let mut text = format!(
            "Boards of 2,048 taxels with a body, side by side, three moving contacts each, {} scans/s; on this machine:\n\n\
             reading in the board's thread: {:.1} us a scan\n\nboards  mind, us a scan  % of one core\n",
            1_000_000 / PERIOD_US,
            self.read
        );
        for (boards, us) in &self.rows {
            text += &format!("{boards:>6}{us:>17.2}{:>15.1}\n", share(*boards, *us));
        }
        text
    }

    /// JSON form.
    pub fn json(&self) -> Value {
        let rows = self.rows.iter().map(|(boards, us)| json!([boards, us, share(*boards, *us)]));
        let rows: Value = rows.collect();
        json!({ "columns": ["boards", "us_a_scan", "percent_of_a_core"], "rows": rows, "read_us": self.read })
    }
}

/// Share of a core that so many boards take, percent.
fn share(boards: usize, us: f64) -> f64 {
    100.0 * us * boards as f64 / PERIOD_US as f64
}

/// Measures with so many boards.
pub fn measure(boards: &[usize]) -> Result<MindCost> {
    let (senses, read) = senses()?;
    let rows = boards.iter().map(|boards| Ok((*boards, fastest(*boards, &senses)?)));
    Ok(MindCost { read, rows: rows.collect::<Result<_>>()? })
}

/// A robot of so many boards, each with the reference garment on the reference robot.
fn robot(boards: usize) -> Result<ReadRobot> {
    let board = |number: usize| {
        format!(
            "[[boards]]\nname = \"b{number}\"\nsource = \"sim:idle\"\ngarment = \"reference\"\nbody = \"reference\"\n"
        )
    };
    let boards: String = (0..boards).map(board).collect();
    let text = format!("name = \"bench\"\nurdf = \"reference\"\n{boards}");
    Ok(ReadRobot::parse("bench.toml".into(), text, Path::new("."))?)
}

/// What a board says of touches in each of its scans, and what reading that takes, us a scan.
fn senses() -> Result<(Vec<Vec<BoardSense>>, f64)> {
    let robot = robot(1)?;
    let mut board = VirtualBoard::new(Garment::reference(), Scene::shipped())?;
    board.client().request(&Request::Tare { frames: TARE })?;
    let mut reader = MindReader::new(&robot, 0);
    let (mut all, mut took) = (Vec::new(), Duration::ZERO);
    for scan in 0..SCANS {
        let mut senses = Vec::new();
        board.step(&codes(board.taxels(), scan), Micros(scan * PERIOD_US), &mut |client, event| {
            let begun = Instant::now();
            senses.extend(reader.sense(client, event));
            took += begun.elapsed();
            Ok(())
        })?;
        all.push(senses);
    }
    let most = |senses: &BoardSense| if let BoardSense::Contacts(list) = senses { list.len() } else { 0 };
    let touched = all.iter().flatten().map(most).max();
    anyhow::ensure!(touched == Some(3), "the scans have {touched:?} contacts and not 3");
    Ok((all, took.as_secs_f64() * 1e6 / SCANS as f64))
}

/// Codes of a scan: a palm that moves on the chest, one on each arm.
fn codes(taxels: usize, scan: u64) -> Vec<u16> {
    let mut codes = vec![100; taxels];
    if TOUCHED.contains(&scan) {
        let row = 4 + (scan - TOUCHED.start) as usize / 20;
        for (panel, columns) in [(0, 4..10), (2, 6..9), (3, 6..9)] {
            for place in (row..row + 6).flat_map(|row| columns.clone().map(move |column| 16 * row + column)) {
                codes[512 * panel + place] += 300;
            }
        }
    }
    codes
}

/// What the mind takes, us a scan of a board.
fn fastest(boards: usize, senses: &[Vec<BoardSense>]) -> Result<f64> {
    let robot = robot(boards)?;
    let senses: Vec<_> = (0..boards).map(|board| placed(senses, board)).collect();
    let mut fastest = f64::INFINITY;
    for _ in 0..TIMES {
        let begun = Instant::now();
        hear(&robot, &senses)?;
        fastest = fastest.min(begun.elapsed().as_secs_f64() * 1e6);
    }
    Ok(fastest / (boards as u64 * SCANS) as f64)
}

/// What the board of this number says: its garment lies beside those of the others.
fn placed(senses: &[Vec<BoardSense>], board: usize) -> Vec<Vec<BoardSense>> {
    let beside = DVec3::new((board % 10) as f64, (board / 10) as f64, 0.0) * BESIDE_M;
    let place = |sense: &BoardSense| {
        let mut sense = sense.clone();
        if let BoardSense::Contacts(contacts) = &mut sense {
            contacts.iter_mut().filter_map(|felt| felt.spot.as_mut()).for_each(|spot| spot.at += beside);
        }
        sense
    };
    senses.iter().map(|scan| scan.iter().map(place).collect()).collect()
}

/// All boards say the same, one after the other, while the robot moves its arms.
fn hear(robot: &ReadRobot, senses: &[Vec<Vec<BoardSense>>]) -> Result<()> {
    let mut mind = RobotMind::new(robot)?;
    let described = robot.robot.as_ref().context("the robot has a description")?;
    let free = described.free().iter().filter_map(|joint| described.joints().get(*joint));
    let middle = |joint: &RobotJoint| {
        joint.limits.as_ref().map_or(0.0, |limits| (limits.start() + limits.end()) / 2.0)
    };
    let joints: Vec<(&str, f64)> = free.map(|joint| (joint.name.as_str(), middle(joint))).collect();
    let count = robot.boards.len() as u64;
    for scan in 0..SCANS {
        let begun_us = 1_000_000 + scan * PERIOD_US;
        if begun_us.is_multiple_of(JOINTS_US) {
            let moved = 0.1 * (begun_us as f64 * 2e-6).sin();
            let positions = joints.iter().map(|(joint, at)| (joint.to_string(), at + moved)).collect();
            mind.take_input(&HostInputLine { positions, ..HostInputLine::default() }, begun_us)?;
        }
        for (board, senses) in senses.iter().enumerate() {
            let now_us = begun_us + board as u64 * PERIOD_US / count;
            for sense in &senses[scan as usize] {
                let _ = mind.board(board, sense, now_us);
            }
        }
    }
    Ok(())
}
