//! A board of a robot: how it is opened and recognised, and what is asked of it first.

use super::recognise::recognised;
use crate::body::posture::Motion;
use crate::body::{self, robot::Robot};
use crate::client::{Client, Identity, SceneChange};
use crate::error::Result;
use crate::files::calibrate::Calibration;
use crate::session::{POSES_HZ, Posing, setting};
use crate::source::{self, SceneFile, Source, SourceOptions, SourceSpec};
use std::sync::Arc;
use taxel_core::garment::{Garment, Layout};

/// A board of a robot.
#[derive(Debug, Clone)]
pub struct RobotBoard {
    /// Its name.
    pub name: String,
    /// Where it is found.
    pub source: SourceSpec,
    /// The garment that it wears; none if any will do.
    pub garment: Option<BoardGarment>,
    /// Scene to send to it.
    pub scene: Option<SceneFile>,
    /// Its calibration, for forces in newtons.
    pub calibration: Option<Calibration>,
    /// Frames of the tare; none for that of the source.
    pub tare: Option<u16>,
    /// Where its panels lie: path of a file, or name of a preset.
    pub body: Option<String>,
    /// Link of the robot that wears the whole garment.
    pub link: Option<String>,
}

/// A garment of a board.
#[derive(Debug, Clone)]
pub struct BoardGarment {
    /// Path of its file, or name of the preset.
    pub name: String,
    /// What it is.
    pub garment: Garment,
    /// Its geometry.
    pub layout: Layout,
}

impl RobotBoard {
    /// True if its source is a board that may be plugged in later.
    pub fn is_real(&self) -> bool {
        use SourceSpec::{Auto, Serial, Tcp, Usb, Zenoh};
        matches!(self.source, Auto | Usb(_) | Serial { .. } | Tcp(_) | Zenoh { .. })
    }

    /// True unless its source is a recording, whose board takes no requests.
    pub fn listens(&self) -> bool {
        !matches!(self.source, SourceSpec::File(_) | SourceSpec::Replay { .. })
    }

    /// Opens its source, and recognises the board if it is a real one.
    pub fn open(&self, options: &SourceOptions) -> Result<Source> {
        recognised(self.open_any(options)?, &self.identity())
    }

    /// Opens its source, whatever board is there; with a calibration, the source uses its counts per newton.
    pub(super) fn open_any(&self, options: &SourceOptions) -> Result<Source> {
        let mut source = source::open(&self.source, &self.options(options))?;
        let known = self.calibration.as_ref().and_then(Calibration::counts_per_newton);
        source.counts_per_newton = known.or(source.counts_per_newton);
        Ok(source)
    }

    /// What it is recognised by.
    pub fn identity(&self) -> Identity {
        let usb_serial = match &self.source {
            SourceSpec::Usb(number) => number.clone(),
            _ => None,
        };
        Identity::new(usb_serial, self.garment.as_ref().map(|worn| worn.garment.clone()))
    }

    /// Options with which its source is opened.
    pub fn options(&self, options: &SourceOptions) -> SourceOptions {
        SourceOptions {
            garment: self.garment.as_ref().map(|worn| worn.name.clone()),
            body: self.body.clone(),
            ..options.clone()
        }
    }

    /// Queues what is asked of it first: scene, calibration, body, stream, tare, and what presses on each link if it has a
    /// body.
    pub fn begin(&self, client: &mut Client, source: &Source) -> Result<()> {
        if let Some(scene) = &self.scene {
            setting::set_scene(client, scene)?;
        }
        if let Some(calibration) = self.calibration.as_ref().filter(|_| source.listens) {
            calibration.requests().try_for_each(|request| client.request(&request))?;
        }
        // Before the tare, during which the board stores nothing.
        if let Some((body, worn)) = self.body.as_ref().zip(self.garment.as_ref())
            && !source.has_body
        {
            setting::set_body(client, body, &worn.name)?;
        }
        client.start(self.tare.unwrap_or(source.tare))?;
        if self.body.is_some() {
            client.change_scene(SceneChange::pressing(u16::MAX));
        }
        Ok(())
    }

    /// Who tells it the posture of its robot; none without a body, or if it does not listen.
    pub fn posing(&self, robot: Arc<Robot>) -> Result<Option<Posing>> {
        let body = self.body.as_deref().filter(|_| self.listens());
        body.map(|body| Posing::new(body::read(body)?, robot, Motion::default(), POSES_HZ)).transpose()
    }
}
