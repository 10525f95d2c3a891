//! An observer of one's own, beside a recorder: `cargo run --example observer -- sim:lash touch.mcap`.

use taxel::client::{Client, Event, Stamp};
use taxel::record::{Plan, PlannedBoard, Recorder};
use taxel::robot::{BoardPlan, Required, Supervisor, follow_alone};
use taxel::session::{Observer, Session};
use taxel::source::{self, SourceOptions, SourceSpec};

/// Counts contacts that begin.
#[derive(Default)]
struct Counter {
    last: u32,
    count: u32,
}

impl Observer for Counter {
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> taxel::Result<()> {
        if let Event::Contacts { .. } = event {
            for placed in client.contacts().iter().filter(|placed| placed.contact.id > self.last) {
                println!("contact {} at {} us of the board", placed.contact.id, stamp.board_us);
                self.count += 1;
            }
            self.last = client.contacts().iter().map(|placed| placed.contact.id).fold(self.last, u32::max);
        }
        Ok(())
    }
}

/// Goes on until the source ends.
struct ToTheEnd;

impl Supervisor for ToTheEnd {
    fn goes_on(&mut self) -> bool {
        true
    }
}

fn main() -> taxel::Result<()> {
    let [spec, file] = [(1, "sim:pat"), (2, "touch.mcap")]
        .map(|(at, default)| std::env::args().nth(at).unwrap_or_else(|| default.into()));
    let spec: SourceSpec = spec.parse().map_err(taxel::Error::other)?;
    let recorder = Recorder::create(Plan { force: true, ..Plan::of(&file, PlannedBoard::default()) })?;
    let open = move || source::open(&spec, &SourceOptions::default());
    let begin = |session: &mut Session| {
        let (client, source) = session.parts();
        client.start(source.tare)?;
        Ok(Required::of(client))
    };
    let (mut counter, mut record) = (Counter::default(), recorder.board(0));
    let mut observers: Vec<&mut dyn Observer> = vec![&mut counter, &mut record];
    follow_alone(BoardPlan::of("it", open, begin), &mut observers, &mut ToTheEnd)?;
    recorder.finish()?;
    println!("{} contacts; {}", counter.count, recorder.summary());
    Ok(())
}
