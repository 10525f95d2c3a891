//! What a recording says of its boards, in a few numbers.

use super::play::Play;
use super::tally::Tally;
use crate::client::{Client, Event};
use crate::error::{RecordingError, Result};
use crate::recording::{BoardRecording, Overview, Skipped, WIRE};
use std::path::Path;
use taxel_core::contact::Phase;
use taxel_core::intent::Leading;

/// A board of a recording.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct BoardSummary {
    /// Name of the robot; none of a recording of one board.
    pub robot: Option<String>,
    /// Name of the board among those of the robot.
    pub board: Option<String>,
    /// Name of its garment.
    pub garment: Option<String>,
    /// Name of its scene.
    pub scene: Option<String>,
    /// Version of its firmware.
    pub firmware: Option<String>,
    /// Short name of its source.
    pub source: Option<String>,
    /// Id of the calibration that the board has.
    pub calibration: Option<String>,
    /// Host times of its first and last message, us since 1970.
    pub time_us: Option<[u64; 2]>,
    /// Counters of its messages.
    pub tally: Tally,
    /// Contacts that began.
    pub contacts: u64,
    /// How often its intention became kindness, threat, attack.
    pub intentions: [u64; 3],
    /// Reactions that began.
    pub reactions: u64,
    /// Faulty taxels at the end.
    pub faulty_taxels: u64,
    /// Damage that was passed over.
    pub skipped: Skipped,
    /// The file has its end.
    pub is_whole: bool,
}

impl BoardSummary {
    /// Reads all of a recording: one summary for each board, in the order of the file. Error if it is not a
    /// recording of taxel, or cannot be read.
    pub fn read(path: &Path) -> Result<Vec<BoardSummary>> {
        let overview = Overview::of(path)?;
        let recordings = BoardRecording::all(path, &overview);
        if recordings.is_empty() {
            let path = path.display();
            fail!(RecordingError::Record, "{path} has no topic {WIRE}: it is not a recording of taxel");
        }
        recordings.iter().map(|recording| BoardSummary::of(recording, &overview)).collect()
    }

    fn of(recording: &BoardRecording, overview: &Overview) -> Result<BoardSummary> {
        let word =
            |of: &str, name: &str| overview.words(of)?.get(name).filter(|word| !word.is_empty()).cloned();
        let about = recording.attachment("taxel");
        let mut summary = BoardSummary {
            robot: recording.board.as_ref().and_then(|_| word("robot", "name")),
            board: recording.board.clone(),
            garment: word(&about, "garment"),
            scene: word(&about, "scene"),
            firmware: word(&about, "firmware"),
            source: word(&about, "source"),
            calibration: word(&about, "calibration"),
            is_whole: overview.torn.is_none(),
            ..BoardSummary::default()
        };
        let mut play = Play::open(recording)?;
        let (mut leading, mut has_image) = (Leading::None, false);
        while let Some((header, event)) = play.next_event()? {
            let us = header.log_time / crate::client::NS;
            let [first, last] = summary.time_us.unwrap_or([us; 2]);
            summary.time_us = Some([first.min(us), last.max(us)]);
            // What precedes the first image of a file that continues another had begun before.
            has_image |= matches!(event, Event::Frame { .. });
            if has_image {
                summary.take(play.client(), &event, &mut leading);
            }
        }
        summary.tally = Tally::of(play.client().counts());
        summary.faulty_taxels = play.client().ill().len() as u64;
        summary.skipped = play.skipped();
        Ok(summary)
    }

    /// Counts an event.
    fn take(&mut self, client: &Client, event: &Event, leading: &mut Leading) {
        match event {
            Event::Contacts { .. } => {
                let begun = client.contacts().iter().filter(|placed| placed.contact.phase == Phase::Onset);
                self.contacts += begun.count() as u64;
            }
            Event::Intent(report) => {
                if std::mem::replace(leading, report.leading) != report.leading
                    && let Some(at) = Leading::INTENTIONS.iter().position(|one| *one == report.leading)
                {
                    self.intentions[at] += 1;
                }
            }
            Event::Reaction(report) => self.reactions += u64::from(report.reaction.active),
            _ => {}
        }
    }
}
