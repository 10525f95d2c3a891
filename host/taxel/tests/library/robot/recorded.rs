//! One recording of all boards holds of each what a recording of the board alone holds.

use super::boards::{BOARDS, alone, robot};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::time::Duration;
use taxel::json::message;
use taxel::record::{COUNTS, Plan, Play, Recorder, Tally};
use taxel::recording::{
    BoardRecording, Clips, LinkRecord, Messages, Overview, WIRE, WireReader, boards, chunk_indexes, scan,
    summary,
};
use taxel::robot::{BoardEvent, BoardState, RobotStream, WhenFull};
use taxel::session::{RunLimit, Session};
use taxel::source::SourceOptions;

/// Records the three boards to their ends.
fn record(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let read = robot();
    let recorder = Recorder::create(Plan { force: true, ..read.recording(path.clone()).unwrap() }).unwrap();
    let plans = read.plans(&SourceOptions::default(), &RunLimit::of(None, None));
    let mut session: RobotStream<()> =
        RobotStream::start(plans, WhenFull::Wait, |number, _| Box::new(recorder.board(number))).unwrap();
    while let Some(event) = session.wait(Duration::from_secs(30)) {
        assert!(!matches!(event.what, BoardEvent::State(BoardState::Failed(_))), "{event:?}");
    }
    drop(session);
    recorder.finish().unwrap();
    path
}

#[test]
fn each_board_is_read_back_as_it_is_alone() {
    let path = record("robot.mcap");
    assert!(scan(&path).unwrap().whole);
    let overview = Overview::of(&path).unwrap();
    assert_eq!(boards(overview.topics()), BOARDS.map(|(name, ..)| name));
    let words = overview.words("robot").unwrap();
    assert_eq!((words["name"].as_str(), words["boards"].as_str()), ("three", "chest,arm,back"));
    assert_eq!(overview.attached("robot.toml").unwrap().unwrap(), robot().text.as_bytes());
    for board in BOARDS {
        let (name, alone) = (board.0, alone(board));
        let mut play = Play::open(&format!("{}#{name}", path.display()).into()).unwrap();
        let mut played = Vec::new();
        while let Some((_, event)) = play.next_event().unwrap() {
            played.push(message(play.client(), &event).to_string());
        }
        assert!(played == alone, "{name}: {} events of {}", played.len(), alone.len());
        // As a source it is that board again.
        let mut session = Session::open(&format!("replay:{}#{name}@max", path.display())).unwrap();
        let mut replayed = Vec::new();
        while let Some(event) = session.wait().unwrap() {
            replayed.push(message(session.client(), &event).to_string());
        }
        assert!(replayed == alone, "{name}: {} messages of {}", replayed.len(), alone.len());
        let tally = Tally::of(play.client().counts());
        assert_eq!(overview.words(&format!("{name}/{COUNTS}")).and_then(Tally::read), Some(tally));
        assert_eq!(overview.words(&format!("{name}/taxel")).unwrap()["garment"], board.2);
        // The JSON of contacts is of those of the line, with the host's time.
        let mut contacts = Messages::of_topic(&path, &format!("/taxel/{name}/contacts")).unwrap();
        let mut lines = alone.iter().filter(|line| line.contains("\"type\":\"contacts\""));
        while let Some(message) = contacts.next_message().unwrap() {
            let reported: Value = serde_json::from_slice(message.data).unwrap();
            assert_eq!(reported["host_time_us"].as_u64().unwrap() * 1000, message.header.log_time);
            let line: Value = serde_json::from_str(lines.next().unwrap()).unwrap();
            let totals = |all: &Value| -> Vec<(Value, Value)> {
                all["contacts"]
                    .as_array()
                    .unwrap()
                    .iter()
                    .map(|it| (it["id"].clone(), it["total"].clone()))
                    .collect()
            };
            assert_eq!((&reported["frame"], totals(&reported)), (&line["frame"], totals(&line)));
        }
        assert_eq!(lines.next(), None, "{name}");
    }
}

#[test]
fn the_chunks_of_a_board_are_those_of_its_stream() {
    let path = record("robot-chunks.mcap");
    for (name, ..) in BOARDS {
        let recording = BoardRecording { path: path.clone(), board: Some(name.into()) };
        let mut clips = Clips::open(&recording, WIRE).unwrap();
        let starts: Vec<u64> = clips.places().iter().map(|place| place.start).collect();
        assert!(clips.has_topic() && starts.is_sorted() && !starts.is_empty(), "{name}: {starts:?}");
        let mut frames = WireReader::open(&recording).unwrap();
        for chunk in 0..clips.places().len() {
            let clip = clips.clip(chunk).unwrap();
            assert!(!clip.is_empty(), "{name}: another board's chunk");
            for message in clip.iter() {
                let frame = frames.next_record().unwrap();
                assert_eq!(frame, Some((message.header, LinkRecord::Frame(&message.data))), "{name}");
            }
        }
        assert_eq!(frames.next_record().unwrap(), None, "{name}");
        assert!(clips.words("taxel").is_some() && clips.attached("garment.toml").is_some());
    }
}

#[test]
fn what_is_damaged_of_one_board_is_passed_over_by_its_readers_alone() {
    let path = record("robot-damaged.mcap");
    let of = |name: &str| BoardRecording { path: path.clone(), board: Some(name.into()) };
    let read = |name: &str| {
        let mut play = Play::open(&of(name)).unwrap();
        let mut frames = 0;
        while play.next_event().unwrap().is_some() {
            frames += 1;
        }
        (frames, play.skipped().chunks)
    };
    let whole = BOARDS.map(|(name, ..)| read(name));
    // The last chunk of a wire is of the board that ends last.
    let bytes = std::fs::read(&path).unwrap();
    let channels = summary(&path).unwrap().unwrap().channels;
    let mut chunks = chunk_indexes(&path).unwrap();
    chunks.retain(|chunk| chunk.message_index_offsets.keys().any(|id| channels[id].topic.ends_with("/wire")));
    let last = chunks.pop().unwrap();
    let mut damaged = bytes;
    damaged[(last.chunk_start_offset + last.chunk_length) as usize - 40] ^= 1;
    std::fs::write(&path, damaged).unwrap();
    let after = BOARDS.map(|(name, ..)| read(name));
    assert!(whole.iter().all(|(frames, skipped)| *frames > 100 && *skipped == 0), "{whole:?}");
    let hit: Vec<_> = after.iter().zip(&whole).filter(|(after, whole)| after != whole).collect();
    assert!(matches!(hit[..], [((frames, 1), (before, 0))] if frames < before), "{whole:?}, {after:?}");
}

#[test]
fn a_recording_of_a_robot_is_opened_by_the_name_of_a_board() {
    let path = record("robot-named.mcap");
    let why = |board: &str| {
        let error = Session::open(&format!("replay:{}{board}", path.display())).err().unwrap();
        error.to_string().replace(&path.display().to_string(), "FILE")
    };
    assert_eq!(why(""), "FILE is of a robot's boards, chest, arm, back: name one, FILE#chest");
    let unknown = "FILE: there is no board \"bakc\": did you mean \"back\"? Known are chest, arm, back";
    assert_eq!(why("#bakc"), unknown);
}

#[test]
fn a_recording_is_not_replaced_unless_asked() {
    let path = record("robot-kept.mcap");
    let before = std::fs::read(&path).unwrap();
    let error = Recorder::create(robot().recording(path.clone()).unwrap()).unwrap_err();
    assert!(error.to_string().contains("robot-kept.mcap already exists"), "{error}");
    assert_eq!(std::fs::read(&path).unwrap(), before);
    let mut read = robot();
    read.inputs.push(path.display().to_string());
    let plan = read.recording(path.clone()).unwrap();
    let error = Recorder::create(Plan { force: true, ..plan }).unwrap_err();
    assert_eq!(std::fs::read(&path).unwrap(), before, "{error}");
}
