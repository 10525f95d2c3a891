//! A board of a robot: how it is opened and recognised, and what it is asked first.

use super::recognise::recognised;
use crate::body::{self, posture::Motion, robot::Robot};
use crate::client::{Client, Identity, SceneChange};
use crate::error::{Result, UsageError};
use crate::files::bases::Base;
use crate::files::calibrate::Calibration;
use crate::session::{POSES_HZ, Posing, setting};
use crate::source::{self, SceneFile, Source, SourceOptions, SourceSpec};
use std::path::PathBuf;
use std::sync::Arc;
use taxel_core::garment::{Garment, Layout};
use taxel_core::gesture::GestureConfig;
use taxel_core::intent::Feed;
use taxel_core::wire::Request;

/// A board, and what it is asked first: a [`BoardConfig`](super::BoardConfig) whose files are read and checked.
#[derive(Debug, Clone)]
pub struct RobotBoard {
    /// Name in a robot.
    pub name: String,
    /// Place at which it is found.
    pub source: SourceSpec,
    /// Garment of the board; none if any will do.
    pub garment: Option<BoardGarment>,
    /// The garment is sent to the board, in place of being what it is recognised by.
    pub is_dressed: bool,
    /// Scene to send to it.
    pub scene: Option<SceneFile>,
    /// Calibration, for forces in newtons.
    pub calibration: Option<Calibration>,
    /// Frames of the tare; none for that of the source.
    pub tare: Option<u16>,
    /// Timing reports per second.
    pub budget: Option<u16>,
    /// Raw codes of every scan.
    pub raw: bool,
    /// Recognition of gestures.
    pub gestures: Option<GestureConfig>,
    /// Contacts per frame whose form is computed, 0 for all.
    pub forms: Option<u8>,
    /// Values of concepts.
    pub feeds: Vec<Feed>,
    /// Shapes that it recognises.
    pub shapes: Option<Base>,
    /// Body on which its panels lie: path of a file, or name of a preset.
    pub body: Option<String>,
    /// Table of its folds.
    pub folds: Option<PathBuf>,
    /// Reports per second of what presses on each link; none for each frame of a board with a body.
    pub pressing: Option<u16>,
    /// Link of the robot that carries the whole garment.
    pub link: Option<String>,
}

/// A garment of a board.
#[derive(Debug, Clone)]
pub struct BoardGarment {
    /// Path of its file, or name of the preset.
    pub name: String,
    /// Content of the file or preset.
    pub garment: Garment,
    /// Geometry of the garment.
    pub layout: Layout,
}

impl RobotBoard {
    /// True if its source is a board that may be plugged in later.
    pub fn is_real(&self) -> bool {
        use SourceSpec::{Replay, Robot, Sim};
        !matches!(self.source, Sim(_) | Replay { .. } | Robot { .. })
    }

    /// True unless its source is a recording, whose board takes no requests.
    pub fn listens(&self) -> bool {
        !matches!(self.source, SourceSpec::Replay { .. })
    }

    /// Opens its source, and recognises the board if it is a real one.
    pub fn open(&self, options: &SourceOptions) -> Result<Source> {
        recognised(self.open_any(options)?, &self.identity())
    }

    /// Opens its source, whatever board is there; with a calibration, it scales the forces.
    pub fn open_any(&self, options: &SourceOptions) -> Result<Source> {
        let mut source = source::open(&self.source, &self.options(options))?;
        source.scale = source.scale.with(self.calibration.as_ref());
        Ok(source)
    }

    /// Returns what it is recognised by.
    pub fn identity(&self) -> Identity {
        let usb_serial = match &self.source {
            SourceSpec::Usb(number) => number.clone(),
            _ => None,
        };
        Identity::new(usb_serial, self.garment.as_ref().map(|board_garment| board_garment.garment.clone()))
    }

    /// Options with which its source is opened.
    pub fn options(&self, options: &SourceOptions) -> SourceOptions {
        SourceOptions {
            garment: self.garment.as_ref().map(|board_garment| board_garment.name.clone()),
            body: self.body.clone(),
            folds: self.folds.clone(),
            ..options.clone()
        }
    }

    /// Queues what it is asked first, and its stream. Error if it cannot be asked that.
    pub fn begin(&self, client: &mut Client, source: &Source) -> Result<()> {
        if source.listens {
            self.configure(client, source)?;
        }
        client.start(self.tare.unwrap_or(source.tare))?;
        // What changes the board's scene waits for its `Hello`, which follows the start.
        let pressing_hz = self.pressing.or(self.body.as_ref().map(|_| u16::MAX));
        let forms = self.forms.map(|in_frame| (in_frame, true));
        let change = SceneChange { forms, pressing_hz, gestures: self.gestures.map(Some) };
        if source.listens && change != SceneChange::default() {
            client.change_scene(change);
        }
        if let Some(base) = &self.shapes {
            setting::set_shapes(client, base)?;
        }
        if let Some(hz) = self.budget {
            client.stream_budget(hz)?;
        }
        if self.raw {
            client.request_codes()?;
        }
        Ok(())
    }

    /// Queues what comes before the stream.
    fn configure(&self, client: &mut Client, source: &Source) -> Result<()> {
        if let Some(board_garment) =
            self.garment.as_ref().filter(|_| self.is_dressed && !source.has_asked_garment)
        {
            require!(
                !source.label.starts_with("sim:"),
                UsageError::Argument,
                "garment {}: a simulated board keeps the garment that it started with",
                board_garment.name
            );
            setting::set_garment(client, &board_garment.name)?;
        }
        if let Some(scene) = &self.scene {
            setting::set_scene(client, scene)?;
        }
        for feed in &self.feeds {
            client.request(&Request::Feed(feed.clone()))?;
        }
        if let Some(calibration) = &self.calibration {
            calibration.requests().try_for_each(|request| client.request(&request))?;
        }
        // Before the tare, during which the board stores nothing.
        if let Some(body) = self.body.as_ref().filter(|_| !source.has_body) {
            let garment = self.garment.as_ref().map_or("reference", |board_garment| &board_garment.name);
            setting::set_body(client, body, garment)?;
        }
        if let Some(folds) = self.folds.as_ref().filter(|_| !source.has_folds) {
            setting::set_folds(client, folds)?;
        }
        Ok(())
    }

    /// Sender of its robot's posture; none without a body, or if it does not listen.
    pub fn posing(
        &self,
        robot: Arc<Robot>,
        motion: Option<Motion>,
        hz: Option<f64>,
    ) -> Result<Option<Posing>> {
        let body = self.body.as_deref().filter(|_| self.listens());
        let (motion, hz) = (motion.unwrap_or_default(), hz.unwrap_or(POSES_HZ));
        body.map(|body| Posing::new(body::read(body)?, robot, motion, hz)).transpose()
    }
}
