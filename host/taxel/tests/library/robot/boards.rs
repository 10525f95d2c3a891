//! The streams of a robot's boards are those of the boards alone.

use std::fs::File;
use std::path::Path;
use std::time::Duration;
use taxel::client::{Client, Event, Stamp};
use taxel::json::message;
use taxel::recording::{Format, WIRE, Writer};
use taxel::robot::{BoardEvent, BoardState, ReadRobot, RobotStream, WAITING, WhenFull};
use taxel::session::{RunLimit, Session};
use taxel::source::{self, SourceOptions};

/// Name, script and garment of a board.
type SimulatedBoard = (&'static str, &'static str, &'static str);

/// The boards of the robot.
pub const BOARDS: [SimulatedBoard; 3] = [
    ("chest", "sim:pat", "reference"),
    ("arm", "sim:press", "block-4x16"),
    ("back", "sim:lash", "mat-64x32"),
];

pub fn robot() -> ReadRobot {
    let boards = BOARDS.map(|(name, source, garment)| {
        format!("[[boards]]\nname = \"{name}\"\nsource = \"{source}\"\ngarment = \"{garment}\"\n")
    });
    ReadRobot::parse("three.toml".into(), format!("name = \"three\"\n{}", boards.concat()), Path::new("."))
        .unwrap()
}

/// All messages of a board that is followed alone.
pub fn alone((_, spec, garment): SimulatedBoard) -> Vec<String> {
    let options = SourceOptions { garment: Some(garment.into()), ..SourceOptions::default() };
    let mut session = Session::over(source::open(&spec.parse().unwrap(), &options).unwrap()).unwrap();
    let mut lines = Vec::new();
    while let Some(event) = session.wait().unwrap() {
        lines.push(message(session.client(), &event).to_string());
    }
    lines
}

/// Each message of the boards; of the host's clock it holds nothing.
fn lines(robot: &ReadRobot, when_full: WhenFull) -> RobotStream<String> {
    let plans = robot.plans(&SourceOptions::default(), &RunLimit::of(None, None));
    let line = |client: &Client, event: &Event, _: Stamp| Some(message(client, event).to_string());
    RobotStream::start(plans, when_full, |_, queue| queue.make(line)).unwrap()
}

#[test]
fn each_board_of_a_robot_says_what_it_says_alone() {
    let mut robot = lines(&robot(), WhenFull::Wait);
    let mut together = [const { Vec::new() }; 3];
    let mut states = [const { Vec::new() }; 3];
    while let Some(event) = robot.wait(Duration::from_secs(30)) {
        match event.what {
            BoardEvent::News(line) => together[event.board].push(line),
            BoardEvent::State(BoardState::Met) => states[event.board].push("met"),
            BoardEvent::State(BoardState::Over { .. }) => states[event.board].push("over"),
            other => panic!("{other:?}"),
        }
    }
    assert!(robot.is_over());
    assert_eq!(states, [["met", "over"]; 3]);
    for (board, together) in BOARDS.into_iter().zip(together) {
        let (name, alone) = (board.0, alone(board));
        let contacts = alone.iter().filter(|line| line.contains("\"type\":\"contacts\"")).count();
        assert!(contacts >= 10, "{name}: {contacts}");
        assert!(together == alone, "{name}: {} messages of {}", together.len(), alone.len());
    }
}

#[test]
fn a_simulation_waits_for_a_slow_reader_and_nothing_is_dropped() {
    let mut robot = lines(&robot(), WhenFull::DropImages);
    std::thread::sleep(Duration::from_millis(300));
    let mut count = [0; 3];
    while let Some(event) = robot.wait(Duration::from_secs(30)) {
        assert!(!matches!(event.what, BoardEvent::State(BoardState::Dropped { .. })));
        count[event.board] += 1;
    }
    assert!(count[1] > 2 * WAITING, "{count:?}");
    assert_eq!([0, 1, 2].map(|board| robot.dropped(board)), [0; 3]);
}

#[test]
fn a_board_that_refuses_its_scene_fails_and_the_others_go_on() {
    let mut read = robot();
    let scene = "[stream]\ncontacts_hz = 20000\n";
    read.boards[1].scene = Some(taxel::source::SceneFile::named(scene).unwrap());
    let mut robot = lines(&read, WhenFull::Wait);
    let (mut failed, mut over) = (Vec::new(), 0);
    while let Some(event) = robot.wait(Duration::from_secs(30)) {
        match event.what {
            BoardEvent::State(BoardState::Failed(error)) => failed.push((event.board, error.to_string())),
            BoardEvent::State(BoardState::Over { .. }) => over += 1,
            _ => {}
        }
    }
    let [(1, why)] = &failed[..] else { panic!("{failed:?}") };
    assert!(
        why.starts_with("sim:press: the board refuses set-scene: scene: stream.contacts_hz must be lower"),
        "{why}"
    );
    assert_eq!(over, 2);
    let gone = robot.ask(1, |_| Ok(())).unwrap_err();
    assert_eq!(gone.to_string(), "board arm is over");
}

#[test]
fn what_is_not_the_stream_of_the_board_fails_and_says_why() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let keep = |name: &str, bytes: &[u8]| {
        let mut writer = Writer::create(File::create(folder.join(name)).unwrap(), "").unwrap();
        let format = Format { encoding: "taxel-wire", schema: "", schema_encoding: "", text: b"" };
        let channel = writer.channel(WIRE, &format).unwrap();
        writer.message(channel, 0, 0, bytes).unwrap();
        writer.finish().unwrap();
    };
    keep("noise.mcap", &[7; 1000]);
    let options = SourceOptions { garment: Some("block-4x16".into()), ..SourceOptions::default() };
    let mut session = Session::over(source::open(&"sim:press".parse().unwrap(), &options).unwrap()).unwrap();
    let mut bytes = Vec::new();
    while session.wait().unwrap().is_some() {
        session.client().lines().for_each(|line| bytes.extend_from_slice(line));
    }
    keep("block.mcap", &bytes);
    let text = "name = \"two\"\n[[boards]]\nname = \"noise\"\nsource = \"replay:noise.mcap\"\n\
                [[boards]]\nname = \"other\"\nsource = \"replay:block.mcap\"\ngarment = \"reference\"\n";
    let read = ReadRobot::parse("two.toml".into(), text.into(), folder).unwrap();
    let mut robot = lines(&read, WhenFull::Wait);
    let (mut failed, mut others) = ([const { String::new() }; 2], 0);
    while let Some(event) = robot.wait(Duration::from_secs(30)) {
        match event.what {
            BoardEvent::State(BoardState::Failed(error)) => failed[event.board] = format!("{error:#}"),
            BoardEvent::State(BoardState::Other { .. }) => others += 1,
            other => panic!("{other:?}"),
        }
    }
    assert!(failed[0].ends_with("noise.mcap: no Hello of a taxel board in 1000 bytes"), "{}", failed[0]);
    let why = "answers with another board: it has the garment block-4x16, not reference";
    assert!(others == 1 && failed[1].ends_with(why), "{}", failed[1]);
}
