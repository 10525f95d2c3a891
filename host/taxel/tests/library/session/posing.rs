//! A robot's posture, sent to a board while it streams, against motions that are known exactly.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use taxel::body::posture::Motion;
use taxel::body::robot::{self, Robot};
use taxel::body::{self, DVec3, RobotSurface};
use taxel::client::Event;
use taxel::json::message;
use taxel::session::{JointStates, JointTime, Poll, Posing, Session};
use taxel::source::{self, SourceOptions};
use taxel_core::format::Micros;

/// Joints that move the reference garment in the base.
const JOINTS: [&str; 7] = [
    "waist",
    "left_shoulder_pitch",
    "left_shoulder_roll",
    "left_shoulder_yaw",
    "right_shoulder_pitch",
    "right_shoulder_roll",
    "right_shoulder_yaw",
];
/// Amplitude and angular frequency of their motion: rad, rad/s.
const WAVE: (f64, f64) = (0.4, 4.0);

/// Position of each joint at a time of the board, us.
fn positions(us: u64) -> [(&'static str, f64); 7] {
    let mut number = 0.0;
    JOINTS.map(|joint| {
        number += 1.0;
        (joint, 0.5 + WAVE.0 * (WAVE.1 * us as f64 * 1e-6 + number).sin())
    })
}

fn motion() -> Motion {
    Motion { angular: WAVE.0 * WAVE.1 * WAVE.1, ..Motion::default() }
}

/// A simulated board with the reference body, with a report of what presses in each frame.
fn open(scene: &str, realtime: bool, seconds: f64) -> Session {
    let options = SourceOptions {
        body: Some("reference".into()),
        realtime,
        seconds: Some(seconds),
        ..SourceOptions::default()
    };
    let mut session = Session::over(source::open(&scene.parse().unwrap(), &options).unwrap()).unwrap();
    session.parts().0.change_scene(taxel::client::SceneChange::pressing(u16::MAX));
    session
}

fn posing(hz: f64) -> Posing {
    Posing::open("reference", "reference", motion(), hz).unwrap()
}

/// Robot and surface, to compare with.
fn judge(session: &Session) -> (Arc<Robot>, RobotSurface) {
    let robot = Arc::new(robot::read("reference").unwrap());
    let description = session.client().description().unwrap();
    let body = body::read("reference").unwrap();
    let surface = body.on_robot(&description.garment, &description.layout, robot.clone()).unwrap();
    (robot, surface)
}

fn metres(um: [i32; 3]) -> DVec3 {
    DVec3::from(um.map(|um| f64::from(um) * 1e-6))
}

/// Joints at 100 Hz, 10 ms late; poses at 50 Hz. No contact is farther from where it is in the base than the
/// message says, and the bound is of use.
#[test]
fn contacts_in_the_base_are_as_near_as_their_message_says() {
    let mut session = open("sim:five", true, 4.0);
    session.pose_by(posing(50.0));
    let (mut sent_us, mut judged, mut worst, mut widest) = (0, 0, 0.0f64, 0.0f64);
    let mut ages = Vec::new();
    let mut ends = None;
    loop {
        let now = session.posing().unwrap().1.now().map_or(0, |now| now.0);
        while sent_us + 20_000 <= now {
            sent_us += 10_000;
            session.take_joints(JointTime::Board(Micros(sent_us)), positions(sent_us)).unwrap();
        }
        match session.poll().unwrap() {
            Poll::Event(event @ Event::Pressing(_)) => {
                let line = message(session.client(), &event);
                let Event::Pressing(report) = event else { continue };
                let Some(posed) = report.posed else { continue };
                let age = report.time.0 as i64 - posed.0 as i64;
                assert_eq!((&line["pose_age_us"], &line["posed_us"]), (&age.into(), &posed.0.into()));
                let bound = line["pose_error_m"].as_f64().unwrap();
                ages.push(age);
                let (robot, surface) = ends.get_or_insert_with(|| judge(&session));
                let posture = robot.posture(positions(report.time.0)).unwrap();
                let poses = surface.poses(&robot.poses(&posture), 0).unwrap();
                for landed in &report.contacts {
                    let want = poses[usize::from(landed.spot.link)].point(metres(landed.spot.at));
                    let off = metres(landed.base.unwrap().at).distance(want);
                    // The board rounds poses and places.
                    assert!(off <= bound + 60e-6, "{off} m, and the message says {bound} m");
                    (worst, widest, judged) = (worst.max(off), widest.max(bound), judged + 1);
                }
            }
            Poll::End => break,
            _ => {}
        }
    }
    ages.sort_unstable();
    let median = ages[ages.len() / 2];
    println!(
        "{judged} contacts in the base: off by {:.2} mm at most, said {:.2} mm at most; poses {:.1} ms old (median)",
        worst * 1e3,
        widest * 1e3,
        median as f64 / 1e3
    );
    assert!(judged > 500 && worst > 1e-4, "{judged} contacts, {worst} m");
    assert!((-5_000..60_000).contains(&median), "{median} us");
}

#[test]
fn without_positions_no_poses_are_sent() {
    let mut session = open("sim:pat", false, 1.0);
    session.pose_by(posing(50.0));
    let (mut reports, mut asked) = (0, 0);
    while let Some(event) = session.wait().unwrap() {
        asked += u32::from(matches!(event, Event::Answer { request: 23, .. }));
        let Event::Pressing(report) = event else { continue };
        assert_eq!(report.posed, None);
        reports += 1;
    }
    assert!(reports > 0 && asked == 0);
}

#[test]
fn wrong_positions_are_refused_by_name_and_time() {
    let mut session = open("sim:pat", true, 3.0);
    let none = session.take_joints(JointTime::Now, [("waist", 0.1)]).unwrap_err();
    assert_eq!(none.to_string(), "no robot was named whose joints these are");
    session.pose_by(posing(50.0));
    while session.posing().unwrap().1.now().is_none() {
        session.poll().unwrap();
    }
    let refused = |session: &mut Session, at, joint, position| {
        session.take_joints(at, [("waist", 0.1), (joint, position)]).unwrap_err().to_string()
    };
    let now = JointTime::Now;
    let why = refused(&mut session, now, "wast", 0.0);
    assert!(why.starts_with("reference: there is no joint \"wast\"") && why.contains("waist"), "{why}");
    let why = refused(&mut session, now, "left_elbow", 9.0);
    assert!(why.contains("joint \"left_elbow\": ") && why.contains("is out of its range"), "{why}");
    let why = refused(&mut session, now, "left_elbow", f64::NAN);
    assert!(why.contains("its position must be a number, not NaN"), "{why}");
    let why = refused(&mut session, JointTime::Host(1_000_000), "left_elbow", 0.0);
    assert!(
        why.starts_with("the positions of joints are stamped -") && why.ends_with(" s from now"),
        "{why}"
    );
    let why = refused(&mut session, JointTime::Board(Micros(99_000_000)), "left_elbow", 0.0);
    assert!(why.starts_with("the positions of joints are stamped +9"), "{why}");
    assert!(session.posing().unwrap().1.taken().is_empty());
    session.take_joints(now, [("waist", 0.1), ("left_wrist", 0.0)]).unwrap();
    assert_eq!(session.posing().unwrap().1.taken().len(), 1);
    for hz in [0.0, -1.0, f64::NAN, 1001.0] {
        let why = Posing::open("reference", "reference", motion(), hz).unwrap_err().to_string();
        assert!(why.starts_with("poses per second must be 0.1 to 1000, not "), "{why}");
    }
}

/// A file of positions.
fn file(name: &str, text: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::File::create(&path).unwrap().write_all(text.as_bytes()).unwrap();
    path
}

/// Plays lines beside a simulation; what was taken, and what failed.
fn played(path: &Path, mut each: impl FnMut(u64, u64)) -> Result<usize, taxel::Error> {
    let mut session = open("sim:pat", true, 1.5);
    session.pose_by(posing(20.0));
    let mut lines = JointStates::open(path)?;
    let mut taken = 0;
    loop {
        let (client, posing) = session.posing().unwrap();
        lines.hand_over(client, posing)?;
        for positions in posing.taken() {
            each(positions.time.0, posing.now().unwrap().0);
            taken += 1;
        }
        if session.poll()? == Poll::End {
            return Ok(taken);
        }
    }
}

#[test]
fn lines_are_taken_when_their_time_has_come() {
    let line =
        |us: u64| format!("{{\"time_us\": {us}, \"positions\": {{\"waist\": {}}}}}\n", us as f64 * 3e-7);
    let text: String = (0..200).map(|number| line(number * 10_000)).collect();
    // One line ahead of the board's time.
    let seen =
        played(&file("joints.jsonl", &text), |time, now| assert!(time <= now + 20_000, "{time} {now}"));
    let seen = seen.unwrap();
    assert!((100..200).contains(&seen), "{seen}");
    // A recording's line, a line without a time, and an empty one.
    let text = "{\"type\":\"joints\",\"time_us\":5,\"positions\":{\"waist\":0},\"host_time_us\":9}\n\n\
                {\"positions\": {\"waist\": 0.5}}";
    assert_eq!(played(&file("three.jsonl", text), |_, _| ()).unwrap(), 2);
}

#[test]
fn wrong_lines_are_named_by_file_and_number() {
    let good = "{\"positions\": {\"waist\": 0.5}}\n";
    for (bad, why) in [
        ("{", "line 2: no positions of joints: EOF while parsing"),
        ("{\"position\": {\"waist\": 0.5}}", "line 2: no positions of joints: unknown field `position`"),
        ("{\"positions\": {\"waist\": null}}", "line 2: no positions of joints: invalid type: null"),
        ("{\"positions\": {\"wast\": 1}}", "line 2: reference: there is no joint \"wast\""),
        (
            "{\"type\": \"poses\", \"positions\": {}}",
            "line 2: a message of type \"poses\": must be \"joints\"",
        ),
    ] {
        let path = file("wrong.jsonl", &format!("{good}{bad}"));
        let error = played(&path, |_, _| ()).unwrap_err();
        let error = taxel::text::words::sentence(&error);
        assert!(error.starts_with(&format!("{}, {why}", path.display())), "{error}");
    }
    let long = file("long.jsonl", &" ".repeat(1 << 20));
    let error = taxel::text::words::sentence(&played(&long, |_, _| ()).unwrap_err());
    assert!(error.ends_with("line 1: the line is longer than 1048576 bytes"), "{error}");
    let error = JointStates::open(&file("none.jsonl", "").with_file_name("nowhere.jsonl")).err().unwrap();
    assert!(error.to_string().starts_with("cannot read "), "{error}");
}
