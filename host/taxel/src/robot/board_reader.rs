//! Reads the files that a board's configuration names, and checks them.

use super::board::{BoardGarment, RobotBoard};
use super::config::BoardConfig;
use super::place::RobotText;
use crate::body::{self, robot::Robot};
use crate::error::{Context, Error, Result, UsageError};
use crate::files::bases::Base;
use crate::files::calibrate::{Calibration, Forces};
use crate::files::{folds, garments, scripts};
use crate::recording::is_board;
use crate::session::setting;
use crate::source::{SceneFile, SourceSpec};
use std::path::Path;
use std::sync::Arc;
use taxel_core::garment::{Circuit, Layout};
use taxel_core::gesture::GestureConfig;

/// Longest tare, frames.
const TARE: u16 = 4096;
/// Longest name of a board, bytes.
const NAME: usize = 32;

/// Place of a board's configuration: how errors name its keys.
#[derive(Debug, Clone, Copy)]
pub enum ConfigPlace<'a> {
    /// Robot's file of so many boards.
    File {
        /// The file.
        text: RobotText<'a>,
        /// Number of the board.
        index: usize,
        /// Number of boards.
        boards: usize,
    },
    /// By options of a command.
    Options,
    /// By keywords of Python.
    Keywords,
}

impl ConfigPlace<'_> {
    /// Error about a key.
    fn wrong(&self, board: &str, key: &str, why: String) -> Error {
        match self {
            ConfigPlace::File { text, index, .. } => text.of_board(*index, board, key, why).into(),
            ConfigPlace::Options => {
                UsageError::Argument(format!("--{}: {why}", key.replace('_', "-"))).into()
            }
            ConfigPlace::Keywords => UsageError::Argument(format!("{key}: {why}")).into(),
        }
    }

    /// Names a key in the error about the file that it names. Options and keywords are stated by that file alone.
    fn named<T>(&self, board: &str, key: &str, read: Result<T>) -> Result<T> {
        match self {
            ConfigPlace::File { text, index, .. } => read.with_context(|| text.place(*index, board, key)),
            ConfigPlace::Options | ConfigPlace::Keywords => read,
        }
    }

    /// Error if an earlier board has the board's name or its place.
    pub(super) fn check_alone(&self, board: &RobotBoard, earlier: &[RobotBoard]) -> Result<()> {
        let wrong = |key: &str, why: String| Err(self.wrong(&board.name, key, why));
        if earlier.iter().any(|other| other.name == board.name) {
            return wrong("name", "another board has this name".into());
        }
        let place = board.source.place();
        match earlier.iter().find(|other| place.is_some() && other.source.place() == place) {
            Some(other) => wrong("source", format!("board {} is there, too", other.name)),
            None => Ok(()),
        }
    }
}

/// Reads a board's configuration.
#[derive(Debug, Clone, Copy)]
pub(super) struct BoardReader<'a> {
    /// The configuration, with paths from the working folder.
    pub config: &'a BoardConfig,
    /// Place of the configuration.
    pub place: ConfigPlace<'a>,
    /// The robot that carries it, if it is described.
    pub robot: Option<&'a Arc<Robot>>,
}

impl BoardReader<'_> {
    /// Reads what it names.
    pub fn read(&self) -> Result<RobotBoard> {
        let BoardReader { config, place, robot } = *self;
        let name = config.name.as_str();
        let wrong = |key: &str, why: String| Err(place.wrong(name, key, why));
        if let ConfigPlace::File { text, index, .. } = place
            && (name.len() > NAME || !is_board(name))
        {
            let why = format!("a board's name is 1 to {NAME} letters, digits, _ and -, not \"{name}\"");
            return Err(text.error(&format!("boards[{index}].name"), why).into());
        }
        let is_file = matches!(place, ConfigPlace::File { .. });
        let source = self.found()?;
        if let (ConfigPlace::File { .. }, SourceSpec::Replay { .. }) = (place, &source)
            && let Some(key) = config.configures().find(|key| *key != "garment")
        {
            return wrong(key, format!("{source} is a recording, whose board does not listen"));
        }
        let board_garment =
            place.named(name, "garment", config.garment.as_deref().map(garment).transpose())?;
        let scene = config.scene.as_deref().map(scene).transpose();
        let calibration = config.calibration.as_deref().map(|path| calibration(path, board_garment.as_ref()));
        let shapes = config.shapes.as_deref().map(Base::open).transpose();
        let table = config.folds.as_deref().map_or(Ok(()), |path| folds::read(path).map(drop));
        place.named(name, "folds", table)?;
        if let Some(tare) = config.tare.filter(|tare| *tare > TARE) {
            return wrong("tare", format!("it is {tare}, and must be 0 to {TARE}"));
        }
        if is_file && let Some(body) = &config.body {
            let Some(board_garment) = &board_garment else {
                return wrong("body", "a body is that of a garment: name the board's `garment`, too".into());
            };
            place.named(name, "body", check_body(body, board_garment, robot))?;
        }
        self.check_link()?;
        Ok(RobotBoard {
            name: name.into(),
            source,
            garment: board_garment,
            is_dressed: !is_file,
            scene: place.named(name, "scene", scene)?,
            calibration: place.named(name, "calibration", calibration.transpose())?,
            tare: config.tare,
            budget: config.budget,
            raw: config.raw,
            gestures: self.gestures()?,
            forms: config.forms.map(|forms| forms.0),
            feeds: config.feed.clone(),
            shapes: place.named(name, "shapes", shapes)?,
            body: config.body.clone(),
            folds: config.folds.clone(),
            pressing: config.pressing,
            link: config.link.clone(),
        })
    }

    /// Returns its source.
    fn found(&self) -> Result<SourceSpec> {
        let BoardReader { config, place, .. } = *self;
        let wrong = |why: String| Err(place.wrong(&config.name, "source", why));
        let source = config.source.clone().unwrap_or(SourceSpec::Auto);
        match (place, &source) {
            (ConfigPlace::File { boards: 2.., .. }, SourceSpec::Auto | SourceSpec::Usb(None)) => {
                wrong(format!("{source} finds any board: name its serial number, usb:SERIAL"))
            }
            (ConfigPlace::File { .. }, SourceSpec::Robot { .. }) => {
                wrong(format!("{source} is a robot's file, and a board is found at one place"))
            }
            (ConfigPlace::File { .. }, SourceSpec::Sim(script)) => {
                place.named(&config.name, "source", scripts::load(script))?;
                Ok(source)
            }
            _ => Ok(source),
        }
    }

    /// The recognition of gestures, if a model is named.
    fn gestures(&self) -> Result<Option<GestureConfig>> {
        let BoardReader { config, place, .. } = *self;
        let of = [("gesture_gain", config.gesture_gain), ("gesture_certainty", config.gesture_certainty)];
        if let (None, Some((key, _))) = (config.gestures, of.into_iter().find(|(_, value)| value.is_some())) {
            return Err(place.wrong(
                &config.name,
                key,
                "it is a setting of `gestures`, which is missing".into(),
            ));
        }
        let Some(model) = config.gestures else { return Ok(None) };
        let known = setting::gestures(model.into(), config.gesture_gain, config.gesture_certainty);
        known.map(Some).map_err(|error| place.wrong(&config.name, "gestures", error.to_string()))
    }

    fn check_link(&self) -> Result<()> {
        let BoardReader { config, place, robot } = *self;
        let Some(link) = &config.link else { return Ok(()) };
        let wrong = |why: &str| Err(place.wrong(&config.name, "link", why.into()));
        if config.body.is_some() {
            return wrong("its `body` says on which links its panels lie");
        }
        let Some(robot) = robot else { return wrong("the robot has no `urdf` that has links") };
        place.named(&config.name, "link", robot.link(link).map(drop).map_err(Error::from))
    }
}

/// Reads a scene, and checks what does not depend on a board.
fn scene(path: &Path) -> Result<SceneFile> {
    let file = SceneFile::read(path)?;
    setting::check_scene(&file)?;
    Ok(file)
}

/// Reads a garment, and checks what does not depend on a board.
fn garment(named: &str) -> Result<BoardGarment> {
    let read = garments::read(named)?;
    let layout =
        Layout::build(&read.garment, usize::from(u16::MAX), 4095).map_err(|error| read.error(&error))?;
    Circuit::build(&read.garment, &layout, read.pins()).map_err(|error| read.error(&error))?;
    Ok(BoardGarment { name: read.name, garment: read.garment, layout })
}

/// Reads a calibration, and checks that it is of this garment.
fn calibration(path: &Path, board_garment: Option<&BoardGarment>) -> Result<Calibration> {
    let calibration = Calibration::read(path)?;
    board_garment
        .map_or(Ok(()), |board_garment| Forces::new(&calibration, &board_garment.layout).map(drop))?;
    Ok(calibration)
}

/// Error if a body does not fit its garment or its robot.
fn check_body(named: &str, board_garment: &BoardGarment, robot: Option<&Arc<Robot>>) -> Result<()> {
    let read = body::read(named)?;
    match robot {
        Some(robot) => drop(read.on_robot(&board_garment.garment, &board_garment.layout, robot.clone())?),
        None => drop(read.surface(&board_garment.garment, &board_garment.layout)?),
    }
    Ok(())
}
