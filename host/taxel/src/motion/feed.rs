//! Input of a cycle, from what boards, joints and mind say.

use super::control::MotionControl;
use super::input::{MotionBoard, MotionInput, MotionPosture, MotionTouch};
use crate::body::DVec3;
use crate::body::robot::Robot;
use crate::client::{Client, Event};
use crate::mind::{BoardSense, MindReader, RobotMind};
use crate::robot::{BoardEvent, BoardState, RobotEvent};
use std::sync::Arc;
use taxel_core::intent::Leading;

/// Longest time between two scans that counts for a board's period, us.
const LONGEST_US: u64 = 100_000;
/// Share of a new time in the period.
const NEW: f64 = 1.0 / 16.0;

/// Content of an event of a board, in the board's thread.
#[derive(Debug, Clone)]
pub struct MotionNews {
    /// Its touches.
    pub sense: BoardSense,
    /// True if it is of a scan.
    pub is_scan: bool,
    /// Newtons of the board's pressure are known.
    pub is_calibrated: bool,
}

impl MotionNews {
    /// Content of an event; none if it says nothing of touches.
    pub fn of(reader: &mut MindReader, client: &Client, event: &Event) -> Option<MotionNews> {
        let sense = reader.sense(client, event)?;
        let is_scan = matches!(sense, BoardSense::Contacts(_) | BoardSense::Alive);
        let is_calibrated = client.newtons().is_some_and(|newtons| newtons.counts_per_newton().is_some());
        Some(MotionNews { sense, is_scan, is_calibrated })
    }
}

/// The newest of all that a robot is told.
#[derive(Debug, Clone)]
pub struct MotionFeed {
    robot: Arc<Robot>,
    /// Joints whose positions must be told: those that may be moved.
    is_needed: Vec<bool>,
    /// Time, us, and position of each joint, once it was told.
    joints: Vec<Option<(u64, f64)>>,
    positions: Vec<f64>,
    boards: Vec<MotionBoard>,
    touches: Vec<MotionTouch>,
    leading: Leading,
}

impl MotionFeed {
    /// Nothing is told yet, of so many boards.
    pub fn new(control: &MotionControl, boards: usize) -> MotionFeed {
        let robot = control.robot().clone();
        let is_needed = control.behaviour().joints.iter().map(|limit| limit.velocity > 0.0).collect();
        MotionFeed {
            joints: vec![None; robot.free().len()],
            positions: robot.rest(),
            is_needed,
            boards: vec![MotionBoard::default(); boards],
            touches: Vec::new(),
            leading: Leading::None,
            robot,
        }
    }

    /// Takes positions of joints, rad or m, at a time of the host, us. Names that the robot does not have, and joints
    /// that mimic others, are passed over; an older position than the last is, too.
    pub fn take_joints<'a>(&mut self, at_us: u64, positions: impl IntoIterator<Item = (&'a str, f64)>) {
        for (name, position) in positions {
            let joint = self.robot.joint(name).ok();
            let free = self.robot.free().iter().position(|free| Some(*free) == joint);
            let Some(told) = free.and_then(|free| self.joints.get_mut(free)) else { continue };
            if told.is_none_or(|(before_us, _)| before_us <= at_us) {
                *told = Some((at_us, position));
            }
        }
    }

    /// Takes an event of a board, which the robot's mind has taken, too.
    pub fn take(&mut self, event: &RobotEvent<MotionNews>, mind: &RobotMind) {
        let Some(board) = self.boards.get_mut(event.board) else { return };
        let at_us = event.stamp.host_us;
        match &event.what {
            BoardEvent::News(news) => {
                board.is_calibrated = news.is_calibrated;
                if let BoardSense::Begins(_) = news.sense {
                    (board.begun, board.scanned_us) = (board.begun + 1, None);
                }
                if news.is_scan {
                    let passed = at_us.saturating_sub(board.scanned_us.unwrap_or(at_us)).min(LONGEST_US);
                    // Of a scan there are a frame and contacts.
                    if passed > 0 {
                        let period = f64::from(board.period_us);
                        let period = if period > 0.0 {
                            period + NEW * (passed as f64 - period)
                        } else {
                            passed as f64
                        };
                        board.period_us = period as u32;
                    }
                    board.scanned_us = Some(board.scanned_us.map_or(at_us, |before| before.max(at_us)));
                }
            }
            BoardEvent::State(BoardState::Dropped { .. }) => {}
            BoardEvent::State(_) => board.scanned_us = None,
        }
        self.sense(mind);
    }

    /// Takes what the mind knows now.
    pub fn sense(&mut self, mind: &RobotMind) {
        self.leading = mind.meaning().map_or(Leading::None, |meaning| meaning.leading);
        self.touches.clear();
        for board in 0..self.boards.len() {
            for touch in mind.senses().touches(board).iter().filter(|touch| touch.ended_us.is_none()) {
                let Some(spot) = &touch.felt.spot else { continue };
                let Ok(link) = self.robot.link(&spot.link) else { continue };
                self.touches.push(MotionTouch {
                    touch: (board as u64) << 32 | u64::from(touch.felt.contact),
                    place: touch.felt.place.clone(),
                    link,
                    at: spot.at,
                    normal: spot.normal,
                    newtons: f64::from(touch.felt.load) * 1e-3,
                    mover: touch.mover,
                });
            }
        }
    }

    /// Does something with the input of a cycle at a time of the host, us. The posture is as old as the oldest of the
    /// positions that must be told; without one of them there is none.
    pub fn cycle<T>(&mut self, now_us: u64, act: impl FnOnce(&MotionInput<'_>) -> T) -> T {
        let told =
            self.joints.iter().zip(&self.is_needed).filter(|(told, needed)| **needed || told.is_some());
        let times: Option<Vec<u64>> = told.map(|(told, _)| told.map(|(us, _)| us)).collect();
        for (position, told) in self.positions.iter_mut().zip(&self.joints) {
            *position = told.map_or(*position, |(_, at)| at);
        }
        let oldest_us = times.and_then(|times| times.into_iter().min());
        act(&MotionInput {
            now_us,
            posture: oldest_us.map(|at_us| MotionPosture { at_us, positions: &self.positions }),
            boards: &self.boards,
            touches: &self.touches,
            leading: self.leading,
        })
    }

    /// Force, N, and moment about the origin of the base, N m, of all touches on the robot, in the base.
    pub fn wrench(&self) -> [DVec3; 2] {
        let poses = self.robot.poses(&self.positions);
        let mut sums = [DVec3::ZERO; 2];
        for touch in &self.touches {
            let Some(pose) = poses.of(touch.link, 0) else { continue };
            let force = -touch.newtons * pose.direction(touch.normal);
            sums[0] += force;
            sums[1] += pose.point(touch.at).cross(force);
        }
        sums
    }

    /// Linear velocity of the origin of a link, m/s, and its angular velocity, rad/s, in the base, with velocities of
    /// the joints.
    pub fn twist(&self, link: usize, velocities: &[f64]) -> [DVec3; 2] {
        let poses = self.robot.poses(&self.positions);
        let Some(pose) = poses.of(link, 0) else { return [DVec3::ZERO; 2] };
        let columns = [self.robot.jacobian(&poses, link, pose.at), self.robot.turning(&poses, link)];
        columns
            .map(|columns| columns.iter().zip(velocities).map(|(column, velocity)| *column * *velocity).sum())
    }
}
