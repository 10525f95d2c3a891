//! Plans with the boards of a robot's file: to follow them, to record them.

use super::board::RobotBoard;
use super::file::ReadRobot;
use super::follow::BoardPlan;
use super::refused::Required;
use crate::body;
use crate::error::Result;
use crate::files::calibrate::ForceScale;
use crate::record::{Origin, Plan, PlannedBoard, PlannedRobot};
use crate::session::{PATIENCE, Returns, RunLimit};
use crate::source::SourceOptions;
use std::path::PathBuf;
use std::time::Duration;

impl ReadRobot {
    /// Plans of the boards, in the order of the file, each for so many images or this much of its time; simulations
    /// have these options, too.
    pub fn plans(&self, options: &SourceOptions, limit: &RunLimit) -> Vec<BoardPlan> {
        let plan = |board: &RobotBoard| {
            let (options, opens, begins) = (options.clone(), board.clone(), board.clone());
            let (robot, motion, poses) = (self.robot.clone(), self.motion, self.poses);
            BoardPlan {
                name: board.name.clone(),
                open: Box::new(move || opens.open_any(&options)),
                waits: board.is_real(),
                listens: board.listens(),
                identity: Some(board.identity()),
                is_among: true,
                returns: if limit.is_any() { Returns::Within(PATIENCE) } else { Returns::Always },
                begin: Box::new(move |session| {
                    let (client, source) = session.parts();
                    begins.begin(client, source)?;
                    let required = if source.listens { Required::of(client) } else { Required::default() };
                    let posing =
                        robot.map(|robot| begins.posing(robot, motion, poses)).transpose()?.flatten();
                    posing.into_iter().for_each(|posing| session.pose_by(posing));
                    Ok(required)
                }),
                gather: Duration::ZERO,
                limit: limit.clone(),
            }
        };
        self.boards.iter().map(plan).collect()
    }

    /// Plan of a recording of all boards, into this file. Error if a body cannot be read.
    pub fn recording(&self, path: PathBuf) -> Result<Plan> {
        let board = |board: &RobotBoard| {
            let origin =
                Origin { scale: ForceScale::new(board.calibration.clone(), None), ..Origin::default() };
            let body = board.body.as_deref().map(body::read).transpose()?;
            Ok(PlannedBoard { name: Some(board.name.clone()), origin, body, is_there: !board.is_real() })
        };
        Ok(Plan {
            path,
            inputs: self.inputs.iter().map(PathBuf::from).collect(),
            robot: Some(PlannedRobot { name: self.name.clone(), text: self.text.clone() }),
            boards: self.boards.iter().map(board).collect::<Result<_>>()?,
            ..Plan::default()
        })
    }
}
