//! Two boards as one stream: `cargo run --example robot -- robot.toml`, or without a file two simulated ones.

use std::path::Path;
use std::time::Duration;
use taxel::client::Event;
use taxel::robot::{BoardEvent, ReadRobot, RobotStream, WhenFull};
use taxel::session::RunLimit;
use taxel::source::SourceOptions;

/// A robot without any board that must be plugged in.
const TWO: &str = "name = \"two\"\n[[boards]]\nname = \"left\"\nsource = \"sim:pat\"\n\
                   [[boards]]\nname = \"right\"\nsource = \"sim:lash\"\n";

fn main() -> taxel::Result<()> {
    let robot = match std::env::args().nth(1) {
        Some(path) => ReadRobot::read(Path::new(&path))?,
        None => ReadRobot::parse("two.toml".into(), TWO.into(), Path::new("."))?,
    };
    let limit = RunLimit::of(None, Some(Duration::from_secs(2)));
    let plans = robot.plans(&SourceOptions::default(), &limit);
    // In the thread of each board: what it means with its touches, if that is news.
    let mut boards = RobotStream::start(plans, WhenFull::Wait, |_, queue| {
        let mut last = taxel::taxel_core::intent::Leading::None;
        queue.make(move |_, event, _| match event {
            Event::Intent(report) if report.leading != last => {
                last = report.leading;
                Some(last)
            }
            _ => None,
        })
    })?;
    while !boards.is_over() {
        let Some(event) = boards.wait(Duration::from_secs(1)) else { continue };
        let name = &robot.boards[event.board].name;
        match event.what {
            BoardEvent::News(leading) => println!("{name}: {leading:?}"),
            BoardEvent::State(state) => println!("{name}: {state:?}"),
        }
    }
    Ok(())
}
