//! The loop of cycles: boards, mind and joints in, commands out.

use crate::watch::{RobotNews, RobotObserver};
use anyhow::Result;
use std::time::Duration;
use taxel::mind::RobotMind;
use taxel::motion::{MotionCommand, MotionControl, MotionFault, MotionFeed, MotionNews, MotionState};
use taxel::robot::ReadRobot;

/// Shortest time between two cycles, us: several boards scan at times of their own.
const PERIOD_US: u64 = 4000;

/// Request to a robot's motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asked {
    /// To arm it.
    #[cfg_attr(not(feature = "ros2"), allow(dead_code, reason = "only a node is asked"))]
    Arm,
    /// To disarm it.
    #[cfg_attr(not(feature = "ros2"), allow(dead_code, reason = "only a node is asked"))]
    Disarm,
}

/// Receiver of the commands.
pub trait Face {
    /// Takes positions of joints. Returns what is asked.
    fn turn(&mut self, _feed: &mut MotionFeed, _now_us: u64) -> Vec<Asked> {
        Vec::new()
    }

    /// Takes the answers to what the last turn asked, in its order: done, or why not.
    fn answer(&mut self, _answers: Vec<Result<(), MotionFault>>) {}

    /// Gives a command.
    fn command(&mut self, command: &MotionCommand, feed: &MotionFeed, now_us: u64) -> Result<()>;
}

/// A robot whose boards are followed.
pub struct MotionFollower {
    control: MotionControl,
    state: MotionState,
    feed: MotionFeed,
    mind: RobotMind,
    faces: Vec<Box<dyn Face>>,
    /// True if it is to be armed as soon as that can be.
    arms: bool,
    cycled_us: u64,
}

impl MotionFollower {
    /// Nothing is followed yet.
    pub fn new(
        robot: &ReadRobot,
        control: MotionControl,
        arms: bool,
        faces: Vec<Box<dyn Face>>,
    ) -> Result<MotionFollower> {
        let (state, feed) = (control.start(), MotionFeed::new(&control, robot.boards.len()));
        Ok(MotionFollower { mind: RobotMind::new(robot)?, control, state, feed, faces, arms, cycled_us: 0 })
    }

    fn cycle(&mut self, now_us: u64) -> Result<()> {
        let MotionFollower { control, state, feed, faces, arms, .. } = self;
        for face in faces.iter_mut() {
            let answers = face.turn(feed, now_us).into_iter().map(|asked| match asked {
                Asked::Arm => feed.cycle(now_us, |input| control.arm(state, input)),
                Asked::Disarm => {
                    state.disarm();
                    Ok(())
                }
            });
            let answers = answers.collect();
            face.answer(answers);
        }
        if *arms {
            *arms = feed.cycle(now_us, |input| control.arm(state, input)).is_err();
        }
        let command = feed.cycle(now_us, |input| control.step(state, input));
        faces.iter_mut().try_for_each(|face| face.command(&command, feed, now_us))
    }
}

impl RobotObserver<MotionNews> for MotionFollower {
    const LOOK: Duration = Duration::from_millis(5);

    fn mind(&mut self) -> Option<&mut RobotMind> {
        Some(&mut self.mind)
    }

    fn event(&mut self, news: RobotNews<'_, MotionNews>) -> Result<()> {
        let RobotNews { session, inputs, event } = news;
        for input in inputs {
            self.feed.take_joints(input.line.from_us(input.host_us), input.line.joints());
        }
        if let Some(event) = event {
            self.mind.event(event, |news| Some(&news.sense));
            self.feed.take(event, &self.mind);
        }
        let now_us = session.now_us();
        if now_us < self.cycled_us + PERIOD_US {
            return Ok(());
        }
        if event.is_none() {
            self.mind.pass(now_us);
            self.feed.sense(&self.mind);
        }
        self.cycled_us = now_us;
        self.cycle(now_us)
    }
}
