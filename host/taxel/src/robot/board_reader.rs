//! Reads the files that a board's configuration names, and checks them.

use super::board::{BoardGarment, RobotBoard};
use super::config::BoardConfig;
use super::place::RobotText;
use crate::body::{self, robot::Robot};
use crate::error::{Context, Error, Result, UsageError};
use crate::files::bases::Base;
use crate::files::calibrate::{Calibration, Forces};
use crate::files::{folds, garments, scripts};
use crate::recording::{BoardRecording, is_board};
use crate::session::setting;
use crate::source::{SceneFile, SourceSpec};
use std::path::Path;
use std::sync::Arc;
use taxel_core::garment::{Circuit, Layout, Pins};
use taxel_core::gesture::GestureConfig;

/// Longest tare, frames.
const TARE: u16 = 4096;
/// Longest name of a board, bytes.
const NAME: usize = 32;

/// Where a board is configured: how errors name its keys.
#[derive(Debug, Clone, Copy)]
pub enum ConfigPlace<'a> {
    /// In a robot's file of so many boards.
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

    /// Names a key in the error about the file that it names. Options and keywords are told by that file alone.
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

impl BoardConfig {
    /// Reads a board that is configured by options of a command or keywords of Python.
    pub fn read_alone(&self, place: ConfigPlace<'_>) -> Result<RobotBoard> {
        self.read(place, None, &mut |named| named.into())
    }

    /// Reads what it names by paths that `beside` makes absolute or relative to the working folder, of a robot with
    /// this description.
    pub(super) fn read(
        &self,
        place: ConfigPlace<'_>,
        robot: Option<&Arc<Robot>>,
        beside: &mut impl FnMut(&str) -> String,
    ) -> Result<RobotBoard> {
        let name = self.name.as_str();
        let wrong = |key: &str, why: String| Err(place.wrong(name, key, why));
        if let ConfigPlace::File { text, index, .. } = place
            && (name.len() > NAME || !is_board(name))
        {
            let why = format!("a board's name is 1 to {NAME} letters, digits, _ and -, not \"{name}\"");
            return Err(text.error(&format!("boards[{index}].name"), why).into());
        }
        let is_file = matches!(place, ConfigPlace::File { .. });
        let source = self.found(place, beside)?;
        if let (ConfigPlace::File { .. }, SourceSpec::Replay { .. }) = (place, &source)
            && let Some(key) = self.configures().find(|key| *key != "garment")
        {
            return wrong(key, format!("{source} is a recording, whose board does not listen"));
        }
        let mut file = |path: &Path| beside(&path.display().to_string());
        let worn = self.garment.as_deref().map(|named| garment(&file(Path::new(named)))).transpose();
        let worn = place.named(name, "garment", worn)?;
        let scene = self.scene.as_deref().map(|path| SceneFile::read(Path::new(&file(path)))).transpose();
        let calibration = self.calibration.as_deref().map(|path| calibration(&file(path), worn.as_ref()));
        let shapes = self.shapes.as_deref().map(|path| Base::open(Path::new(&file(path)))).transpose();
        let folds = self.folds.as_deref().map(|path| file(path).into());
        let table = folds.as_deref().map_or(Ok(()), |path| folds::read(path).map(drop));
        place.named(name, "folds", table)?;
        if let Some(tare) = self.tare.filter(|tare| *tare > TARE) {
            return wrong("tare", format!("it is {tare}, and must be 0 to {TARE}"));
        }
        let body = self.body.as_deref().map(|named| file(Path::new(named)));
        if is_file && let Some(body) = &body {
            let Some(worn) = &worn else {
                return wrong("body", "a body is that of a garment: name the board's `garment`, too".into());
            };
            place.named(name, "body", check_body(body, worn, robot))?;
        }
        self.check_link(place, robot)?;
        Ok(RobotBoard {
            name: name.into(),
            source,
            garment: worn,
            is_dressed: !is_file,
            scene: place.named(name, "scene", scene)?,
            calibration: place.named(name, "calibration", calibration.transpose())?,
            tare: self.tare,
            budget: self.budget,
            raw: self.raw,
            gestures: self.gestures(place)?,
            forms: self.forms.map(|forms| forms.0),
            feeds: self.feed.clone(),
            shapes: place.named(name, "shapes", shapes)?,
            body,
            folds,
            pressing: self.pressing,
            link: self.link.clone(),
        })
    }

    /// Its source, with paths from the working folder.
    fn found(&self, place: ConfigPlace<'_>, beside: &mut impl FnMut(&str) -> String) -> Result<SourceSpec> {
        let wrong = |why: String| Err(place.wrong(&self.name, "source", why));
        let source = self.source.clone().unwrap_or(SourceSpec::Auto);
        if let (ConfigPlace::File { boards: 2.., .. }, SourceSpec::Auto | SourceSpec::Usb(None)) =
            (place, &source)
        {
            return wrong(format!("{source} finds any board: name its serial number, usb:SERIAL"));
        }
        let mut beside = |path: &Path| beside(&path.display().to_string());
        Ok(match source {
            SourceSpec::Sim(scene) => {
                let scene = beside(Path::new(&scene));
                place.named(&self.name, "source", scripts::load(&scene))?;
                SourceSpec::Sim(scene)
            }
            SourceSpec::Replay { recording: BoardRecording { path, board }, speed } => {
                let path = beside(&path).into();
                SourceSpec::Replay { recording: BoardRecording { path, board }, speed }
            }
            SourceSpec::Zenoh { place, config } => {
                let config = config.map(|file| beside(&file).into());
                SourceSpec::Zenoh { place, config }
            }
            found => found,
        })
    }

    /// The recognition of gestures, if a model is named.
    fn gestures(&self, place: ConfigPlace<'_>) -> Result<Option<GestureConfig>> {
        let of = [("gesture_gain", self.gesture_gain), ("gesture_certainty", self.gesture_certainty)];
        if let (None, Some((key, _))) = (self.gestures, of.into_iter().find(|(_, value)| value.is_some())) {
            return Err(place.wrong(
                &self.name,
                key,
                "it is a setting of `gestures`, which is missing".into(),
            ));
        }
        let Some(model) = self.gestures else { return Ok(None) };
        let config = setting::gestures(model.into(), self.gesture_gain, self.gesture_certainty);
        config.map(Some).map_err(|error| place.wrong(&self.name, "gestures", error.to_string()))
    }

    fn check_link(&self, place: ConfigPlace<'_>, robot: Option<&Arc<Robot>>) -> Result<()> {
        let Some(link) = &self.link else { return Ok(()) };
        let wrong = |why: &str| Err(place.wrong(&self.name, "link", why.into()));
        if self.body.is_some() {
            return wrong("its `body` says on which links its panels lie");
        }
        let Some(robot) = robot else { return wrong("the robot has no `urdf` that has links") };
        place.named(&self.name, "link", robot.link(link).map(drop).map_err(Error::from))
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

/// Error if a body does not fit its garment or its robot.
fn check_body(named: &str, worn: &BoardGarment, robot: Option<&Arc<Robot>>) -> Result<()> {
    let read = body::read(named)?;
    match robot {
        Some(robot) => drop(read.on_robot(&worn.garment, &worn.layout, robot.clone())?),
        None => drop(read.surface(&worn.garment, &worn.layout)?),
    }
    Ok(())
}
