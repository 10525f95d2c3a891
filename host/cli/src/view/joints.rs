//! Joints that another program tells while a board is shown: lines of positions on the standard input.

use super::hub::PageHub;
use super::said::Said;
use std::io::BufRead;
use std::time::{Duration, Instant};
use taxel::body::robot::Robot;

/// Time between two lines that are said to be wrong: a robot tells its joints a hundred times a second.
const PAUSE: Duration = Duration::from_secs(1);

/// Reads lines such as `waist=10deg,left_elbow=0.4rad` to the end, and moves the robot of the pages; joints that
/// a line leaves out rest. A line that is wrong is passed over, and said in the pages' log and on the standard
/// error; of several in a second, the first.
pub fn follow(robot: &Robot, lines: impl BufRead, hub: &PageHub) {
    let mut said: Option<Instant> = None;
    for (number, line) in (1..).zip(lines.lines()) {
        let moved = line.map_err(anyhow::Error::from).and_then(|line| {
            if line.trim().is_empty() { Ok(()) } else { hub.posture(robot.posture_of(&line)?) }
        });
        let is_due = said.is_none_or(|said| said.elapsed() >= PAUSE);
        if let (Err(error), true) = (moved, is_due) {
            said = Some(Instant::now());
            let text = format!("joints, line {number} of the standard input: {error:#}");
            eprintln!("{text}");
            hub.say(&Said::note(text));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::on_robot::Wearer;
    use crate::view::mailbox::Parcel;
    use serde_json::Value;

    #[test]
    fn each_line_moves_the_robot_and_a_wrong_one_is_named() {
        let hub = PageHub::default();
        let wearer = Wearer::read("reference", Some("reference"), "waist=30deg").unwrap();
        let robot = wearer.robot().unwrap().clone();
        hub.wear(wearer);
        let page = hub.join().unwrap();
        let told = |lines: &str| -> Vec<Value> {
            follow(&robot, lines.as_bytes(), &hub);
            let parcels = std::iter::from_fn(|| page.line_now());
            let lines = parcels.map(|parcel| match parcel {
                Parcel::Line(line) => serde_json::from_str(&line).unwrap(),
                other => panic!("{other:?}"),
            });
            lines.collect()
        };
        let [poses] = &told("waist=60deg\n\n")[..] else { panic!("one message") };
        // About the vertical: half of the angle's sine and cosine.
        let turn = &poses["links"]["torso"]["turn"];
        let half = 0.5;
        assert_eq!(poses["type"], "poses");
        assert!((turn[2].as_f64().unwrap() - half).abs() < 1e-9, "{turn}");
        let [wrong] = &told("waits=90deg\n")[..] else { panic!("one message") };
        let text = wrong["text"].as_str().unwrap();
        assert!(
            text.starts_with("joints, line 1 of the standard input: reference: ") && text.contains("waist"),
            "{text}"
        );
        let [beyond] = &told("\nwaist=7rad\n")[..] else { panic!("one message") };
        assert!(beyond["text"].as_str().unwrap().starts_with("joints, line 2 of"), "{beyond}");
    }
}
