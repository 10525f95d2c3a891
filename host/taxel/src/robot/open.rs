//! How the boards of a robot's file are opened, and what is asked of them first.

use super::event::Teller;
use super::file::{ReadRobot, RobotBoard};
use super::follow::BoardPlan;
use super::identity::Identity;
use super::queue::WhenFull;
use super::recognise::recognised;
use super::session::RobotSession;
use crate::client::Client;
use crate::error::Result;
use crate::session::setting;
use crate::source::{self, Source, SourceOptions, SourceSpec};
use std::time::Duration;
use taxel_core::wire::Request;

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
            let (options, begins) = (board.options(options), board.clone());
            let spec = board.source.clone();
            BoardPlan {
                name: board.name.clone(),
                open: Box::new(move || source::open(&spec, &options)),
                waits: board.is_real(),
                identity: board.identity(),
                begin: Box::new(move |client, source| begins.begin(client, source)),
                teller: teller(number),
                limit,
            }
        };
        self.boards.iter().enumerate().map(plan).collect()
    }
}

impl RobotBoard {
    /// True if its source is a board that may be plugged in later.
    pub fn is_real(&self) -> bool {
        use SourceSpec::{Auto, Serial, Tcp, Usb};
        matches!(self.source, Auto | Usb | Serial { .. } | Tcp(_))
    }

    /// Opens its source, and recognises the board if it is a real one.
    pub fn open(&self, options: &SourceOptions) -> Result<Source> {
        recognised(source::open(&self.source, &self.options(options))?, &self.identity())
    }

    /// What it is recognised by.
    pub fn identity(&self) -> Identity {
        Identity::new(self.usb_serial.clone(), self.garment.as_ref().map(|worn| worn.garment.clone()))
    }

    /// Options with which its source is opened.
    pub fn options(&self, options: &SourceOptions) -> SourceOptions {
        SourceOptions {
            garment: self.garment.as_ref().map(|worn| worn.name.clone()),
            body: self.body.clone(),
            usb_serial: self.usb_serial.clone(),
            ..options.clone()
        }
    }

    /// Queues what is asked of it first: scene, body, stream, tare, and what presses on each link if it has a
    /// body.
    pub fn begin(&self, client: &mut Client, source: &Source) -> Result<()> {
        if let Some(scene) = &self.scene {
            setting::set_scene(client, scene)?;
        }
        // Before the tare, during which the board stores nothing.
        if let Some((body, worn)) = self.body.as_ref().zip(self.garment.as_ref())
            && !source.has_body
        {
            setting::set_body(client, body, &worn.name)?;
        }
        client.start(self.tare.unwrap_or(source.tare))?;
        if self.body.is_some() {
            client.request(&Request::SetPressing(u16::MAX))?;
        }
        Ok(())
    }
}
