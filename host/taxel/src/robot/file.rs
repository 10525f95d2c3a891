//! Robots' files, checked.

use super::board::{BoardGarment, RobotBoard};
use super::config::{BoardConfig, RobotConfig};
use super::place::RobotText;
use crate::body::{
    self,
    robot::{self, Robot},
};
use crate::error::{Context, MapFileError, Result};
use crate::fcm::load;
use crate::fcm::map::MapFile;
use crate::fcm::unite::{EdgeConflict, United, unite};
use crate::files::calibrate::{Calibration, Forces};
use crate::files::input;
use crate::files::{garments, scripts};
use crate::recording::{BoardRecording, is_board};
use crate::source::{SceneFile, SourceSpec};
use std::path::Path;
use std::sync::Arc;
use taxel_core::garment::{Circuit, Layout, Pins};

/// Maps of a robot that names none.
const MAPS: [&str; 2] = ["robot", "probe"];
/// Longest tare, frames.
const TARE: u16 = 4096;
/// Longest name of a board, bytes.
const NAME: usize = 32;

/// A robot's file, checked.
#[derive(Debug, Clone)]
pub struct ReadRobot {
    /// Path of the file.
    pub file: String,
    /// Text of the file, with its comments.
    pub text: String,
    /// Name of the robot.
    pub name: String,
    /// Its description, if it names one.
    pub robot: Option<Arc<Robot>>,
    /// What touches mean to it.
    pub map: MapFile,
    /// Its boards, in the order of the file; at least one.
    pub boards: Vec<RobotBoard>,
    /// Every file that was read, which no output may replace.
    pub inputs: Vec<String>,
}

impl ReadRobot {
    /// True if its boards are at one time: real ones always are, simulations and recordings at real time.
    pub fn is_at_one_time(&self, realtime: bool) -> bool {
        realtime || self.boards.iter().all(RobotBoard::is_real)
    }

    /// Reads a robot's file and the files that it names. Errors name file, line, board and key.
    pub fn read(path: &Path) -> Result<ReadRobot> {
        let file = path.display().to_string();
        let text = input::text(path).with_context(|| format!("{file} cannot be read"))?;
        ReadRobot::parse(file, text, path.parent().unwrap_or(Path::new("")))
    }

    /// Reads the text of a robot's file, whose paths are relative to `folder`. `file` names it in errors.
    pub fn parse(file: String, text: String, folder: &Path) -> Result<ReadRobot> {
        let place = RobotText { file: &file, text: &text };
        let config = place.parse()?;
        if config.name.is_empty() {
            return Err(place.error("name", "the robot has no name").into());
        }
        if config.boards.is_empty() {
            return Err(place.error("boards", "the robot has no boards").into());
        }
        let mut inputs = vec![file.clone()];
        let mut beside = |named: &str| {
            let path = input::beside(folder, named);
            inputs.push(path.clone());
            path
        };
        let described = config.urdf.as_deref().map(|urdf| robot::read(&beside(urdf)));
        let described =
            described.transpose().with_context(|| place.error("urdf", "the robot"))?.map(Arc::new);
        let maps: Result<Vec<MapFile>> = match &config.maps {
            Some(maps) => maps.iter().map(|map| load::map(&beside(map))).collect(),
            None => MAPS.into_iter().map(load::map).collect(),
        };
        let map = maps.and_then(united).with_context(|| place.error("maps", "the map of the robot"))?;
        let mut boards: Vec<RobotBoard> = Vec::new();
        for (index, board) in config.boards.iter().enumerate() {
            let reader = BoardReader { place, index, config: &config, robot: described.as_ref() };
            let read = reader.read(board, &mut beside)?;
            reader.is_alone(&read, &boards)?;
            boards.push(read);
        }
        Ok(ReadRobot { name: config.name, robot: described, map, boards, inputs, text, file })
    }

    /// Number of the board of this name.
    pub fn board(&self, name: &str) -> Option<usize> {
        self.boards.iter().position(|board| board.name == name)
    }
}

/// Maps as one, by the concepts that they have in common. Error if they contradict each other.
fn united(maps: Vec<MapFile>) -> Result<MapFile> {
    let United { map, conflicts, .. } = unite(&maps, "robot", EdgeConflict::Agree)?;
    require!(conflicts.is_empty(), MapFileError::Unanswerable, "{}", conflicts.join("; "));
    Ok(map)
}

/// Reads one board.
struct BoardReader<'a> {
    place: RobotText<'a>,
    index: usize,
    config: &'a RobotConfig,
    robot: Option<&'a Arc<Robot>>,
}

impl BoardReader<'_> {
    fn read(&self, board: &BoardConfig, beside: &mut impl FnMut(&str) -> String) -> Result<RobotBoard> {
        let BoardReader { place, index, .. } = *self;
        let name = board.name.as_str();
        if name.len() > NAME || !is_board(name) {
            let why = format!("a board's name is 1 to {NAME} letters, digits, _ and -, not \"{name}\"");
            return Err(place.error(&format!("boards[{index}].name"), why).into());
        }
        let source = self.source(board, beside)?;
        let at = |key: &'static str| place.place(index, name, key);
        let garment = board.garment.as_deref().map(|named| garment(&beside(named)));
        let garment = garment.transpose().with_context(|| at("garment"))?;
        let scene = board.scene.as_deref().map(|named| SceneFile::read(Path::new(&beside(named))));
        let scene = scene.transpose().with_context(|| at("scene"))?;
        let calibration =
            board.calibration.as_deref().map(|named| calibration(&beside(named), garment.as_ref()));
        let calibration = calibration.transpose().with_context(|| at("calibration"))?;
        if let Some(tare) = board.tare.filter(|tare| *tare > TARE) {
            let why = format!("it is {tare}, and must be 0 to {TARE}");
            return Err(place.of_board(index, name, "tare", why).into());
        }
        let body = board.body.as_deref().map(&mut *beside);
        body.as_ref().map_or(Ok(()), |named| self.check_body(named, garment.as_ref(), name))?;
        self.check_link(board)?;
        Ok(RobotBoard {
            name: name.into(),
            source,
            garment,
            scene,
            calibration,
            tare: board.tare,
            body,
            link: board.link.clone(),
        })
    }

    fn source(&self, board: &BoardConfig, beside: &mut impl FnMut(&str) -> String) -> Result<SourceSpec> {
        let wrong = |key: &str, why: String| self.place.of_board(self.index, &board.name, key, why);
        let source: SourceSpec = board
            .source
            .parse()
            .map_err(|why| wrong("source", format!("there is no source \"{}\": {why}", board.source)))?;
        let finds_any = matches!(source, SourceSpec::Auto | SourceSpec::Usb(None));
        if finds_any && self.config.boards.len() > 1 {
            let why = format!("{} finds any board: name its serial number, usb:SERIAL", board.source);
            return Err(wrong("source", why).into());
        }
        let is_recorded = matches!(source, SourceSpec::File(_) | SourceSpec::Replay { .. });
        let asks = [
            ("scene", board.scene.is_some()),
            ("tare", board.tare.is_some()),
            ("body", board.body.is_some()),
        ];
        if let Some((key, _)) = asks.into_iter().find(|(_, asked)| *asked && is_recorded) {
            return Err(
                wrong(key, format!("{} is a recording, whose board does not listen", board.source)).into()
            );
        }
        Ok(match source {
            SourceSpec::Sim(scene) => {
                let scene = beside(&scene);
                let place = || self.place.place(self.index, &board.name, "source");
                scripts::load(&scene).with_context(place)?;
                SourceSpec::Sim(scene)
            }
            SourceSpec::Emulator(scene) => SourceSpec::Emulator(beside(&scene)),
            SourceSpec::File(path) => SourceSpec::File(beside(&path.display().to_string()).into()),
            SourceSpec::Replay { recording: BoardRecording { path, board }, speed } => {
                let path = beside(&path.display().to_string()).into();
                SourceSpec::Replay { recording: BoardRecording { path, board }, speed }
            }
            SourceSpec::Zenoh { place, config } => {
                let config = config.map(|file| beside(&file.display().to_string()).into());
                SourceSpec::Zenoh { place, config }
            }
            found => found,
        })
    }

    fn check_body(&self, named: &str, worn: Option<&BoardGarment>, name: &str) -> Result<()> {
        let at = || self.place.place(self.index, name, "body");
        let Some(BoardGarment { garment, layout, .. }) = worn else {
            let why = "a body is that of a garment: name the board's `garment`, too";
            return Err(self.place.of_board(self.index, name, "body", why).into());
        };
        let read = body::read(named).with_context(at)?;
        match self.robot {
            Some(robot) => drop(read.on_robot(garment, layout, robot.clone()).with_context(at)?),
            None => drop(read.surface(garment, layout).with_context(at)?),
        }
        Ok(())
    }

    fn check_link(&self, board: &BoardConfig) -> Result<()> {
        let Some(link) = &board.link else { return Ok(()) };
        let wrong = |why: &str| self.place.of_board(self.index, &board.name, "link", why);
        if board.body.is_some() {
            return Err(wrong("its `body` says on which links its panels lie").into());
        }
        let Some(robot) = self.robot else {
            return Err(wrong("the robot has no `urdf` that has links").into());
        };
        robot.link(link).with_context(|| self.place.place(self.index, &board.name, "link"))?;
        Ok(())
    }

    /// Error if an earlier board has its name or its place.
    fn is_alone(&self, board: &RobotBoard, earlier: &[RobotBoard]) -> Result<()> {
        let wrong = |key: &str, why: String| self.place.of_board(self.index, &board.name, key, why);
        if earlier.iter().any(|other| other.name == board.name) {
            return Err(wrong("name", "another board has this name".into()).into());
        }
        let place = board.source.place();
        match earlier.iter().find(|other| place.is_some() && other.source.place() == place) {
            Some(other) => Err(wrong("source", format!("board {} is there, too", other.name)).into()),
            None => Ok(()),
        }
    }
}

/// Reads a garment, and checks what does not depend on a board.
fn garment(named: &str) -> Result<BoardGarment> {
    let read = garments::read(named)?;
    let layout =
        Layout::build(&read.garment, usize::from(u16::MAX), 4095).map_err(|error| read.error(&error))?;
    Circuit::build(&read.garment, &layout, Pins::ANY).map_err(|error| read.error(&error))?;
    Ok(BoardGarment { name: read.name, garment: read.garment, layout })
}

/// Reads a calibration, and checks that it is of this garment.
fn calibration(path: &str, worn: Option<&BoardGarment>) -> Result<Calibration> {
    let calibration = Calibration::read(Path::new(path))?;
    worn.map_or(Ok(()), |worn| Forces::new(&calibration, &worn.layout).map(drop))?;
    Ok(calibration)
}
