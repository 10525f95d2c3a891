//! The boards of a robot's file, followed.

use super::board::RobotBoard;
use super::event::Teller;
use super::file::ReadRobot;
use super::follow::BoardPlan;
use super::queue::WhenFull;
use super::session::RobotSession;
use crate::error::Result;
use crate::source::SourceOptions;
use std::time::Duration;

impl<T: Send + 'static> RobotSession<T> {
    /// Follows the boards of a robot's file; `teller` is asked for that of each board, by its number.
    pub fn open(
        robot: &ReadRobot,
        when_full: WhenFull,
        teller: impl FnMut(usize) -> Box<dyn Teller<T>>,
    ) -> Result<RobotSession<T>> {
        RobotSession::start(robot.plans(&SourceOptions::default(), None, teller), when_full)
    }
}

impl ReadRobot {
    /// Plans of the boards, in the order of the file, each for this much of its time; simulations have these
    /// options, too.
    pub fn plans<T>(
        &self,
        options: &SourceOptions,
        limit: Option<Duration>,
        mut teller: impl FnMut(usize) -> Box<dyn Teller<T>>,
    ) -> Vec<BoardPlan<T>> {
        let plan = |(number, board): (usize, &RobotBoard)| {
            let (options, opens, begins) = (options.clone(), board.clone(), board.clone());
            let (robot, motion, poses) = (self.robot.clone(), self.motion, self.poses);
            BoardPlan {
                name: board.name.clone(),
                open: Box::new(move || opens.open_any(&options)),
                waits: board.is_real(),
                listens: board.listens(),
                identity: board.identity(),
                begin: Box::new(move |session| {
                    let (client, source) = session.parts();
                    begins.begin(client, source)?;
                    let posing =
                        robot.map(|robot| begins.posing(robot, motion, poses)).transpose()?.flatten();
                    posing.into_iter().for_each(|posing| session.pose_by(posing));
                    Ok(())
                }),
                teller: teller(number),
                gather: Duration::ZERO,
                limit,
            }
        };
        self.boards.iter().enumerate().map(plan).collect()
    }
}
