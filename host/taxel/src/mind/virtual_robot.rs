//! The very boards of a robot and its mind, stepped by hand: for simulators that make codes of their own, and
//! for tests. Nothing here waits, and nothing reads a clock: all boards go by the time of the steps.

use super::felt::MindReader;
use super::robot_mind::{RobotMeaning, RobotMind};
use crate::error::{Context, Result, UsageError};
use crate::robot::ReadRobot;
use crate::virtual_board::VirtualBoard;
use taxel_core::format::Micros;
use taxel_core::scene::Scene;
use taxel_core::wire::Request;

/// The boards of a robot, and its mind.
pub struct VirtualRobot {
    boards: Vec<VirtualRobotBoard>,
    mind: RobotMind,
}

struct VirtualRobotBoard {
    name: String,
    stepped: VirtualBoard,
    reader: MindReader,
}

impl VirtualRobot {
    /// The boards of a robot's file as after power-up, each with its garment, its scene and its tare. Their
    /// sources are not opened. Error if a board of the file has no garment.
    pub fn new(robot: &ReadRobot) -> Result<VirtualRobot> {
        let mut boards = Vec::new();
        for (number, board) in robot.boards.iter().enumerate() {
            let name = &board.name;
            let Some(board_garment) = &board.garment else {
                fail!(UsageError::Argument, "{}: board {name} has no `garment`", robot.file);
            };
            let scene = board.scene.as_ref().map_or_else(Scene::shipped, |file| file.scene.clone());
            let mut stepped = VirtualBoard::new(board_garment.garment.clone(), scene)
                .with_context(|| format!("board {name}"))?;
            if let Some(frames) = board.tare.filter(|frames| *frames > 0) {
                stepped.client().request(&Request::Tare { frames })?;
            }
            let reader = MindReader::new(robot, number);
            boards.push(VirtualRobotBoard { name: name.clone(), stepped, reader });
        }
        Ok(VirtualRobot { boards, mind: RobotMind::new(robot)? })
    }

    /// Number of a board's taxels: the length of a scan. Error if there is no such board.
    pub fn taxels(&self, board: usize) -> Result<usize> {
        match self.boards.get(board) {
            Some(board) => Ok(board.stepped.taxels()),
            None => fail!(UsageError::Argument, "the robot has no board number {board}"),
        }
    }

    /// The mind, to be given what others know.
    pub fn mind(&mut self) -> &mut RobotMind {
        &mut self.mind
    }

    /// One scan of a board at this time, us, with the codes of all its taxels by their numbers. Returns what
    /// touches mean then, if that is news. Error if there is no such board, the codes are not those of its
    /// taxels, or the time is before that of its last step.
    pub fn step(&mut self, board: usize, codes: &[u16], time_us: u64) -> Result<Option<RobotMeaning>> {
        self.taxels(board)?;
        let VirtualRobotBoard { name, stepped, reader } = &mut self.boards[board];
        let mind = &mut self.mind;
        let mut news = None;
        stepped
            .step(codes, Micros(time_us), &mut |client, event| {
                if let Some(sense) = reader.sense(client, event)
                    && let Some(meaning) = mind.board(board, &sense, time_us)
                {
                    news = Some(meaning.clone());
                }
                Ok(())
            })
            .with_context(|| format!("board {name}"))?;
        Ok(news)
    }
}
