//! The mind of a robot whose boards are recorded: what it means, and what it was sent, are in the recording.

use super::felt::BoardSense;
use super::host_input::{HOST_INPUT, HOST_INPUT_SCHEMA, HostInputLine, HostInputMessage};
use super::line::{ROBOT_INTENT, ROBOT_INTENT_SCHEMA, RobotMeaningLine};
use super::robot_mind::{RobotMeaning, RobotMind};
use crate::error::Result;
use crate::record::{Recorder, RobotTopic};
use crate::robot::RobotEvent;

/// The mind of a robot that is recorded.
#[derive(Debug)]
pub struct RecordedMind {
    mind: RobotMind,
    intent: RobotTopic,
    input: RobotTopic,
}

impl RecordedMind {
    /// Adds the topics `/taxel/robot_intent` and `/taxel/host_input` to a recording. Error as of
    /// [`Recorder::topic`].
    pub fn begin(mind: RobotMind, recorder: &Recorder) -> Result<RecordedMind> {
        let intent = recorder.topic(ROBOT_INTENT, ROBOT_INTENT_SCHEMA)?;
        let input = recorder.topic(HOST_INPUT, HOST_INPUT_SCHEMA)?;
        Ok(RecordedMind { mind, intent, input })
    }

    /// The mind, to be given what others know; what it says then is for [`RecordedMind::take_input`].
    pub fn mind(&mut self) -> &mut RobotMind {
        &mut self.mind
    }

    /// Hears an event of a board, and records what touches mean then if that is news. Error as of
    /// [`Recorder::line`].
    pub fn hear(&mut self, recorder: &Recorder, event: &RobotEvent<BoardSense>) -> Result<()> {
        let news = self.mind.event(event, |sense| Some(sense)).cloned();
        self.write(recorder, news.as_ref())
    }

    /// Advances to this time of the host, us, at which no board says anything. Error as of [`Recorder::line`].
    pub fn pass(&mut self, recorder: &Recorder, host_us: u64) -> Result<()> {
        let news = self.mind.pass(host_us).cloned();
        self.write(recorder, news.as_ref())
    }

    /// Records what was reported at a time of the host, us, and what touches meant then if that was news. Error as
    /// of [`Recorder::line`].
    pub fn take_input(
        &self,
        recorder: &Recorder,
        line: &HostInputLine,
        host_us: u64,
        news: Option<&RobotMeaning>,
    ) -> Result<()> {
        recorder.line(self.input, host_us, &HostInputMessage::of(line, host_us))?;
        self.write(recorder, news)
    }

    fn write(&self, recorder: &Recorder, news: Option<&RobotMeaning>) -> Result<()> {
        let Some(meaning) = news else { return Ok(()) };
        recorder.line(self.intent, meaning.host_us, &RobotMeaningLine::of(&self.mind, meaning))
    }
}
