//! A robot's posture, sent to the board that the robot carries.

use super::joint_time::JointTime;
use super::moving::moving;
use super::setting;
use crate::body::posture::{JointHistory, Motion};
use crate::body::robot::{self, Robot};
use crate::body::{self, ReadBody, RobotSurface};
use crate::client::{Client, Event};
use crate::error::{Result, UsageError};
use crate::time::Instant;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use taxel_core::format::Micros;
use taxel_core::garment::Garment;
use taxel_core::wire::Request;

/// Poses per second, unless another rate is asked for.
pub const POSES_HZ: f64 = 50.0;
/// Rates of poses that there may be, per second.
pub const POSES: std::ops::RangeInclusive<f64> = 0.1..=1000.0;
/// Longest wait for the board's answer before poses are sent again.
const ANSWER: Duration = Duration::from_millis(500);
/// Time after a refusal before poses are sent again.
const REFUSED: Duration = Duration::from_secs(1);
/// Age of the joints' last positions from which no poses are sent: a board says how old its poses are.
const SILENT: Duration = Duration::from_millis(200);
/// Most by which positions may be stamped before or after now, us.
const APART_US: u128 = 10_000_000;
/// Number of `SetPoses`.
const SET_POSES: u8 = Request::SetPoses(&[]).number();

/// Positions of joints, at a time.
#[derive(Debug, Clone, PartialEq)]
pub struct JointPositions {
    /// The board's time.
    pub time: Micros,
    /// By the joint's name, rad or m.
    pub positions: Vec<(String, f64)>,
}

/// Turns positions of a robot's joints into poses of the links that carry the garment, and sends them to the
/// board, with how they move: the board carries them on, and bounds the error.
///
/// Positions come through [`Session::take_joints`](super::Session::take_joints) or [`Posing::take`]. Poses
/// are those of the [live](JointHistory::live) posture in the frame of the robot's root, the base. While
/// nobody sends positions, none are sent.
#[derive(Debug)]
pub struct Posing {
    body: ReadBody,
    robot: Arc<Robot>,
    period_us: u64,
    placed: Option<PlacedBody>,
    history: JointHistory,
    /// The board's time now, and the host's, us.
    now: (Option<Micros>, u64),
    /// Positions taken since the last turn.
    taken: Vec<JointPositions>,
    /// The board's time of the next poses, us.
    due_us: u64,
    /// Time at which the poses were sent that the board has not answered.
    asked: Option<Instant>,
    refused: Option<Instant>,
    /// Restarts of the board so far.
    restarts: u64,
}

/// The body on the garment of the board.
#[derive(Debug)]
struct PlacedBody {
    garment: Garment,
    surface: RobotSurface,
}

impl Posing {
    /// Reads a body and a robot: presets or files. Else as [`Posing::new`].
    pub fn open(body: &str, robot: &str, motion: Motion, hz: f64) -> Result<Posing> {
        Posing::new(body::read(body)?, Arc::new(robot::read(robot)?), motion, hz)
    }

    /// Makes the poses of a body on a robot. `hz` poses a second, 0.1 to 1000, are sent at most; `motion` bounds the
    /// errors.
    pub fn new(body: ReadBody, robot: Arc<Robot>, motion: Motion, hz: f64) -> Result<Posing> {
        require!(
            POSES.contains(&hz),
            UsageError::Argument,
            "poses per second must be {} to {}, not {hz}",
            POSES.start(),
            POSES.end()
        );
        Ok(Posing {
            body,
            history: JointHistory::new(robot.clone(), motion)?,
            robot,
            period_us: (1e6 / hz) as u64,
            placed: None,
            now: (None, 0),
            taken: Vec::new(),
            due_us: 0,
            asked: None,
            refused: None,
            restarts: 0,
        })
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Files that the body was read from, beside its own.
    pub fn lists(&self) -> Vec<PathBuf> {
        self.body.lists().map(PathBuf::from).collect()
    }

    /// Name of the frame of the poses: the root of the robot.
    pub fn base(&self) -> &str {
        self.robot.links().first().map_or("", |link| link.name.as_str())
    }

    /// The board's time now; none before it is known.
    pub fn now(&self) -> Option<Micros> {
        self.now.0
    }

    /// Hands over what was taken since the poses were last looked after.
    pub fn taken(&mut self) -> Vec<JointPositions> {
        std::mem::take(&mut self.taken)
    }

    /// Takes positions of joints, rad or m. Error, and nothing is taken, if the robot has no such joint, a
    /// position is not a number or is out of the joint's range, or the time is more than 10 s from now.
    pub fn take<'a>(
        &mut self,
        client: &Client,
        at: JointTime,
        positions: impl IntoIterator<Item = (&'a str, f64)>,
    ) -> Result<()> {
        // Before the board has sent its time, none of its frames needs a posture.
        let (Some(now), host_us) = self.now else { return Ok(()) };
        let time_us = at.on_board(client, now, host_us);
        let ahead_us = time_us - i128::from(now.0);
        if ahead_us.unsigned_abs() > APART_US {
            let seconds = ahead_us as f64 / 1e6;
            fail!(UsageError::Argument, "the positions of joints are stamped {seconds:+.1} s from now");
        }
        // Before its start there was no frame.
        let time = Micros(u64::try_from(time_us).unwrap_or(0));
        let positions: Vec<(&str, f64)> = positions.into_iter().collect();
        self.history.take(time, positions.iter().copied())?;
        let positions = positions.into_iter().map(|(name, at)| (name.to_string(), at)).collect();
        self.taken.push(JointPositions { time, positions });
        Ok(())
    }

    /// Notes what time it is.
    pub(super) fn set_time(&mut self, board: Option<Micros>, host_us: u64) {
        self.now = (board, host_us);
    }

    /// Sends poses that are due. Error if the body does not fit the garment of the board.
    pub(super) fn turn(&mut self, client: &mut Client) -> Result<()> {
        self.taken.clear();
        self.place(client)?;
        let restarts = client.counts().restarts;
        if std::mem::replace(&mut self.restarts, restarts) != restarts {
            // Its clock begins anew, and it has no poses.
            self.history.forget();
            (self.asked, self.due_us) = (None, 0);
        }
        let (Some(placed), Some(now)) = (&self.placed, self.now.0) else { return Ok(()) };
        let waits = self.asked.is_some_and(|since| since.elapsed() < ANSWER)
            || self.refused.is_some_and(|since| since.elapsed() < REFUSED)
            || client.is_storing_table();
        // A replayed clock may go back.
        self.due_us = self.due_us.min(now.0.saturating_add(self.period_us));
        if waits || now.0 < self.due_us {
            return Ok(());
        }
        let Ok(estimate) = self.history.live(now) else { return Ok(()) };
        if estimate.age > SILENT {
            return Ok(());
        }
        let Some(moving) = moving(&placed.surface, &self.history, &estimate, now) else { return Ok(()) };
        let links = placed.surface.surface().links().iter().map(String::as_str);
        setting::move_poses(client, now, links.zip(moving))?;
        // Later than due by less than a period: the next one is not late, too.
        let next_us = self.due_us + self.period_us;
        self.due_us = if next_us > now.0 { next_us } else { now.0 + self.period_us };
        (self.asked, self.refused) = (Some(Instant::now()), None);
        Ok(())
    }

    /// Places the body on the garment of the board, if it is another one than before.
    fn place(&mut self, client: &Client) -> Result<()> {
        let Some(board) = client.description() else { return Ok(()) };
        if self.placed.as_ref().is_some_and(|placed| placed.garment == board.garment) {
            return Ok(());
        }
        let surface = self.body.on_robot(&board.garment, &board.layout, self.robot.clone())?;
        self.history.need(&surface.moving(0));
        self.placed = Some(PlacedBody { garment: board.garment.clone(), surface });
        self.asked = None;
        Ok(())
    }

    /// Handles an event.
    pub(super) fn event(&mut self, event: &Event) {
        if let Event::Answer { request: SET_POSES, refusal } = event {
            self.asked = None;
            self.refused = refusal.is_some().then(Instant::now);
        }
    }
}
