//! Records a board of a robot, and shows it to pages: one client, and both get the same events.

use super::view::viewer;
use crate::view::{PageHub, Said, Viewer};
use std::sync::Arc;
use taxel::Result;
use taxel::client::{Client, Event};
use taxel::files::calibrate::Calibration;
use taxel::mind::{MindRecord, MindRecordTeller};
use taxel::record::Stamp;
use taxel::robot::{ReadRobot, Teller};
use taxel::session::Show;
use taxel::source::Source;

/// What is recorded is what would be without pages: these never wait, and what they cannot show is told on them
/// alone.
pub struct ViewedTeller {
    records: MindRecordTeller,
    hub: Arc<PageHub>,
    calibration: Option<Calibration>,
    /// None before the source is open.
    viewer: Option<Viewer>,
}

impl ViewedTeller {
    /// Of a board of a robot, recorded by `records` and shown by the pages of `hub`.
    pub fn new(
        robot: &ReadRobot,
        number: usize,
        records: MindRecordTeller,
        hub: Arc<PageHub>,
    ) -> ViewedTeller {
        ViewedTeller { records, hub, calibration: robot.boards[number].calibration.clone(), viewer: None }
    }

    fn show(&mut self, show: impl FnOnce(&mut Viewer) -> anyhow::Result<()>) {
        let shown = self.viewer.as_mut().map_or(Ok(()), show);
        if let Err(error) = shown {
            self.hub.say(&Said::note(format!("{error:#}")));
        }
    }
}

impl Teller<MindRecord> for ViewedTeller {
    fn opened(&mut self, source: &Source) {
        self.viewer = Some(viewer(source, &self.hub, self.calibration.clone()).beside_recording());
        self.records.opened(source);
    }

    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<Option<MindRecord>> {
        self.show(|viewer| viewer.event(client, event));
        self.records.event(client, event, stamp)
    }

    fn asked(&mut self, client: &Client, bytes: &[u8], stamp: Stamp) -> Result<Option<MindRecord>> {
        self.show(|viewer| viewer.asked(client, bytes));
        self.records.asked(client, bytes, stamp)
    }

    fn idle(&mut self, client: &mut Client) -> Result<()> {
        self.show(|viewer| viewer.idle(client).map(drop));
        Ok(())
    }

    fn ended(&mut self, client: &Client, stamp: Stamp) -> Result<Option<MindRecord>> {
        self.show(|viewer| viewer.end(client));
        self.records.ended(client, stamp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::{Parcel, message};
    use std::path::Path;
    use taxel::files::output::Force;
    use taxel::recording::Messages;
    use taxel::robot::RobotRecorder;
    use taxel::session::Session;
    use taxel::source::{self, SourceOptions};

    /// What is recorded of a simulated board, and the messages that were sent to a page.
    fn recorded(name: &str, hub: Option<&Arc<PageHub>>) -> (Vec<String>, Vec<Parcel>) {
        let text = "name = \"one\"\n[[boards]]\nname = \"hand\"\nsource = \"sim:five\"\n";
        let robot = ReadRobot::parse("one.toml".into(), text.into(), Path::new(".")).unwrap();
        let path = std::env::temp_dir().join(format!("taxel-{name}-{}.mcap", std::process::id()));
        let mut recorder = RobotRecorder::create(&robot, &path, Force { force: true }).unwrap();
        let records = MindRecordTeller::new(&robot, 0, recorder.teller(0));
        let mut teller: Box<dyn Teller<MindRecord>> = match hub {
            Some(hub) => Box::new(ViewedTeller::new(&robot, 0, records, hub.clone())),
            None => Box::new(records),
        };
        let page = hub.map(|hub| hub.join().unwrap());
        if let (Some(hub), Some(page)) = (hub, &page) {
            hub.wish(page, message::wish("{\"hover\": 7}").unwrap());
        }
        let source = source::open(&"sim:five".parse().unwrap(), &SourceOptions::default()).unwrap();
        teller.opened(&source);
        let mut session = Session::over(source).unwrap();
        let (mut told, mut sent) = (Vec::new(), Vec::new());
        while let Some(event) = session.wait().unwrap() {
            let number = told.len() as u64;
            let stamp = Stamp { board_us: number, host_us: number, uncertainty_us: None };
            let news = teller.event(session.client(), &event, stamp).unwrap();
            if let Some(news) = news {
                recorder.take(0, &news.record).unwrap();
                told.push(format!("{news:?}"));
            }
            teller.idle(session.parts().0).unwrap();
            sent.extend(page.as_ref().and_then(|page| page.take()));
        }
        recorder.finish().unwrap();
        let mut messages = Messages::open(&path).unwrap();
        while let Some(message) = messages.next_message().unwrap() {
            told.push(format!("{message:?}"));
        }
        std::fs::remove_file(path).unwrap();
        (told, sent)
    }

    #[test]
    fn what_is_recorded_is_what_would_be_if_nobody_watched() {
        let hub = Arc::new(PageHub::default());
        let ((alone, _), (watched, sent)) = (recorded("alone", None), recorded("watched", Some(&hub)));
        assert!(alone == watched && alone.len() > 1500, "{} {}", alone.len(), watched.len());
        assert!(sent.len() > 100, "{}", sent.len());
        assert!(hub.has_tape() && hub.is_looked_at());
    }
}
