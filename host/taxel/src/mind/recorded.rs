//! The mind of a robot whose boards are recorded: what it means, and what it was told, are in the recording.

use super::felt::{BoardSense, MindReader};
use super::line::{ROBOT_INTENT, ROBOT_INTENT_SCHEMA, RobotMeaningLine};
use super::robot_mind::{RobotMeaning, RobotMind};
use super::told::{ROBOT_TOLD, ROBOT_TOLD_SCHEMA, RobotToldLine, ToldLine};
use crate::client::{Client, Event};
use crate::error::Result;
use crate::record::Stamp;
use crate::robot::{BoardRecord, ReadRobot, RecordTeller, RobotEvent, RobotRecorder, RobotTopic, Teller};
use crate::source::Source;

/// What a recording holds of an event of a board, and what that says of touches.
#[derive(Debug)]
pub struct MindRecord {
    /// What the recording holds.
    pub record: BoardRecord,
    /// What it says of touches.
    pub sense: Option<BoardSense>,
}

/// Encodes a board's events for a recording, and reads them for the mind of its robot.
#[derive(Debug)]
pub struct MindRecordTeller {
    records: RecordTeller,
    mind: MindReader,
}

impl MindRecordTeller {
    /// Of a board of a robot, recorded by `records`.
    pub fn new(robot: &ReadRobot, board: usize, records: RecordTeller) -> MindRecordTeller {
        MindRecordTeller { records, mind: MindReader::new(robot, board) }
    }
}

impl Teller<MindRecord> for MindRecordTeller {
    fn opened(&mut self, source: &Source) {
        self.records.opened(source);
    }

    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<Option<MindRecord>> {
        let record = self.records.event(client, event, stamp)?;
        let sense = self.mind.sense(client, event);
        let is_news = record.is_some() || sense.is_some();
        Ok(is_news.then(|| MindRecord { record: record.unwrap_or_default(), sense }))
    }

    fn asked(&mut self, client: &Client, bytes: &[u8], stamp: Stamp) -> Result<Option<MindRecord>> {
        let record = self.records.asked(client, bytes, stamp)?;
        Ok(record.map(|record| MindRecord { record, sense: None }))
    }
}

/// The mind of a robot that is recorded.
#[derive(Debug)]
pub struct RecordedMind {
    mind: RobotMind,
    intent: RobotTopic,
    told: RobotTopic,
}

impl RecordedMind {
    /// Adds the topics `/taxel/robot_intent` and `/taxel/robot_told` to a recording. Error as of
    /// [`RobotRecorder::topic`].
    pub fn begin(mind: RobotMind, recorder: &mut RobotRecorder) -> Result<RecordedMind> {
        let intent = recorder.topic(ROBOT_INTENT, ROBOT_INTENT_SCHEMA)?;
        let told = recorder.topic(ROBOT_TOLD, ROBOT_TOLD_SCHEMA)?;
        Ok(RecordedMind { mind, intent, told })
    }

    /// The mind, to be told what others know; what it says then is for [`RecordedMind::told`].
    pub fn mind(&mut self) -> &mut RobotMind {
        &mut self.mind
    }

    /// Hears an event of a board, and records what touches mean then if that is news. Error as of
    /// [`RobotRecorder::line`].
    pub fn hear(&mut self, recorder: &mut RobotRecorder, event: &RobotEvent<MindRecord>) -> Result<()> {
        let news = self.mind.event(event, |news| news.sense.as_ref()).cloned();
        self.write(recorder, news.as_ref())
    }

    /// It is this time of the host, us, and no board says anything. Error as of [`RobotRecorder::line`].
    pub fn pass(&mut self, recorder: &mut RobotRecorder, host_us: u64) -> Result<()> {
        let news = self.mind.pass(host_us).cloned();
        self.write(recorder, news.as_ref())
    }

    /// Records what was told at a time of the host, us, and what touches meant then if that was news. Error as
    /// of [`RobotRecorder::line`].
    pub fn told(
        &self,
        recorder: &mut RobotRecorder,
        line: &ToldLine,
        host_us: u64,
        news: Option<&RobotMeaning>,
    ) -> Result<()> {
        recorder.line(self.told, host_us, &RobotToldLine::of(line, host_us))?;
        self.write(recorder, news)
    }

    fn write(&self, recorder: &mut RobotRecorder, news: Option<&RobotMeaning>) -> Result<()> {
        let Some(meaning) = news else { return Ok(()) };
        recorder.line(self.intent, meaning.host_us, &RobotMeaningLine::of(&self.mind, meaning))
    }
}
