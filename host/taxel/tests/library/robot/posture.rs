//! The posture of a robot, sent to all of its boards.

use std::path::Path;
use std::time::{Duration, Instant};
use taxel::body::robot;
use taxel::body::{self, DVec3};
use taxel::client::{Client, Event, Stamp};
use taxel::robot::{BoardEvent, BoardState, ReadRobot, RobotStream, WhenFull};
use taxel::session::RunLimit;
use taxel::source::SourceOptions;
use taxel_core::wire::PressingReport;

/// Two boards with a body, and one without.
const ROBOT: &str = r#"
name = "three"
urdf = "reference"
[[boards]]
name = "one"
source = "sim:five"
garment = "reference"
body = "reference"
[[boards]]
name = "two"
source = "sim:five"
garment = "reference"
body = "reference"
[[boards]]
name = "bare"
source = "sim:five"
"#;

/// Joints that move the reference garment in the base: all must be sent.
const JOINTS: [&str; 7] = [
    "waist",
    "left_shoulder_pitch",
    "left_shoulder_roll",
    "left_shoulder_yaw",
    "right_shoulder_pitch",
    "right_shoulder_roll",
    "right_shoulder_yaw",
];

fn pressing(_: &Client, event: &Event, _: Stamp) -> Option<PressingReport> {
    match event {
        Event::Pressing(report) => Some((**report).clone()),
        _ => None,
    }
}

#[test]
fn every_board_with_a_body_says_where_its_contacts_are_on_a_robot_that_moves() {
    let read = ReadRobot::parse("three.toml".into(), ROBOT.into(), Path::new(".")).unwrap();
    let options = SourceOptions { realtime: true, repeat: true, ..SourceOptions::default() };
    let plans = read.plans(&options, &RunLimit::of(None, None));
    let mut session = RobotStream::start(plans, WhenFull::Wait, |_, queue| queue.make(pressing)).unwrap();
    let posture = JOINTS.map(|joint| (joint, 0.4));
    let robot = robot::read("reference").unwrap();
    let board_garment = read.boards[0].garment.as_ref().unwrap();
    let surface = body::read("reference").unwrap();
    let surface = surface.on_robot(&board_garment.garment, &board_garment.layout, robot.into()).unwrap();
    let stands = surface.robot().poses(&surface.robot().posture(posture).unwrap());
    let stands = surface.poses(&stands, 0).unwrap();
    let metres = |um: [i32; 3]| DVec3::from(um.map(|um| f64::from(um) * 1e-6));
    let (begun, mut judged) = (Instant::now(), [0; 3]);
    while judged[..2].iter().any(|count| *count < 20) {
        assert!(begun.elapsed() < Duration::from_secs(30), "contacts in the base: {judged:?}");
        session.take_joints(session.now_us(), posture);
        let Some(event) = session.wait(Duration::from_millis(10)) else { continue };
        let BoardEvent::News(report) = event.what else { continue };
        for landed in &report.contacts {
            let Some(base) = landed.base else { continue };
            let wanted = stands[usize::from(landed.spot.link)].point(metres(landed.spot.at));
            let off = metres(base.at).distance(wanted);
            // The board rounds poses and places.
            assert!(off < 60e-6, "board {}: {off} m", event.board);
            judged[event.board] += 1;
        }
    }
    assert_eq!(judged[2], 0);
}

#[test]
fn joints_that_the_robot_does_not_have_do_no_harm() {
    let read = ReadRobot::parse("three.toml".into(), ROBOT.into(), Path::new(".")).unwrap();
    let limit = RunLimit::of(None, Some(Duration::from_millis(300)));
    let plans = read.plans(&SourceOptions::default(), &limit);
    let mut session = RobotStream::start(plans, WhenFull::Wait, |_, queue| queue.make(pressing)).unwrap();
    let mut over = 0;
    while !session.is_over() {
        session.take_joints(session.now_us(), [("tail", 0.6), ("waist", f64::NAN)]);
        session.take_joints(0, [("waist", 0.6)]);
        match session.wait(Duration::from_millis(10)).map(|event| event.what) {
            Some(BoardEvent::State(BoardState::Over { .. })) => over += 1,
            Some(BoardEvent::State(BoardState::Failed(error))) => panic!("{error}"),
            Some(BoardEvent::News(report)) => assert_eq!(report.posed, None),
            _ => {}
        }
    }
    assert_eq!(over, 3);
}
