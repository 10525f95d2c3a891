//! Commands as lines of JSON.

use super::follow::Face;
use anyhow::Result;
use std::io::{BufWriter, Stdout, Write, stdout};
use std::sync::Arc;
use taxel::body::robot::Robot;
use taxel::motion::{MotionCommand, MotionControl, MotionFeed};

/// Time between two lines while nothing changes, us.
const QUIET_US: u64 = 1_000_000;

/// Prints what is commanded: each command that moves the robot or slows it down, what has changed, and a line each
/// second.
pub struct MotionLines {
    robot: Arc<Robot>,
    last: Option<(MotionCommand, u64)>,
    out: BufWriter<Stdout>,
}

impl MotionLines {
    /// Nothing is printed yet.
    pub fn new(control: &MotionControl) -> MotionLines {
        MotionLines { robot: control.robot().clone(), last: None, out: BufWriter::new(stdout()) }
    }
}

impl Face for MotionLines {
    fn command(&mut self, command: &MotionCommand, _feed: &MotionFeed, now_us: u64) -> Result<()> {
        let is_same = |last: &(MotionCommand, u64)| {
            let (before, at_us) = last;
            let known = |it: &MotionCommand| (it.phase, it.deed, it.fault, it.speed);
            known(before) == known(command) && !command.moves() && now_us < at_us + QUIET_US
        };
        if self.last.as_ref().is_some_and(is_same) {
            return Ok(());
        }
        writeln!(self.out, "{}", command.line(&self.robot, now_us))?;
        self.out.flush()?;
        self.last = Some((command.clone(), now_us));
        Ok(())
    }
}
