//! Observations of a board over some seconds.

use taxel::client::{BoardDescription, Buses, Client, Event, Stamp};
use taxel::session::Observer;
use taxel_core::boot::Boot;
use taxel_core::garment::Garment;
use taxel_core::selftest::Findings;
use taxel_core::wire::{Health, Request};

/// Facts that were observed.
#[derive(Debug, Default, Clone)]
pub struct Facts {
    /// The board is simulated.
    pub simulated: bool,
    /// Name and version of the firmware; none if no `Hello` came.
    pub firmware: Option<String>,
    /// Cause of the board's start; none if it does not report one.
    pub boot: Option<Boot>,
    /// Reason why a `Hello` could not be used.
    pub unusable: Option<String>,
    /// Number of taxels of the garment.
    pub taxels: usize,
    /// Id, date and fit error of the calibration; empty if there is none.
    pub calibration: String,
    /// First and last image: number of the scan, and its time, us.
    pub frames: Option<[(u32, u64); 2]>,
    /// Images received, thinned out, and received but not decodable.
    pub images: [u64; 3],
    /// Messages lost on the link, and frames refused.
    pub lost: [u64; 2],
    /// The board's counters, first and last report.
    pub health: Option<[Health; 2]>,
    /// Number of faulty taxels.
    pub faulty: usize,
    /// Uncertainty of the host's time of a frame, us; none if the board is not real-time, or has not
    /// answered.
    pub clock_us: Option<u64>,
    /// Answer to a self-test: none yet, passed, or the reason for refusal.
    pub self_test: Option<Result<(), String>>,
    /// Lines and inputs of a garment, and what the last self-test found of them.
    pub pins: Option<(Garment, Findings)>,
    /// Errors that the board has logged, and losses of its link.
    pub logged: Vec<String>,
    /// A self-test was requested.
    pub asked: bool,
    /// USB host controllers that the board may share with others.
    pub buses: Buses,
    /// Number of the one that it is on; none if it has reported no start of a frame.
    pub bus: Option<usize>,
}

impl Facts {
    /// No observations yet, of a board that may share one of these controllers.
    pub fn new(buses: Buses) -> Facts {
        Facts { buses, ..Facts::default() }
    }
}

impl Observer for Facts {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        match event {
            Event::Hello => {
                self.firmware = client.description().map(|description| description.firmware.clone());
                self.simulated = client.description().is_some_and(BoardDescription::is_simulated);
                self.boot = client.boot();
            }
            Event::Unusable(why) => self.unusable = Some(why.clone()),
            Event::Frame { frame, time, .. } => {
                let first = self.frames.map_or((*frame, time.0), |[first, _]| first);
                self.frames = Some([first, (*frame, time.0)]);
            }
            Event::Health(health) => {
                self.health = Some([self.health.map_or(*health, |[first, _]| first), *health]);
            }
            Event::SelfTest(report) => {
                let description = client.description().map(|description| description.garment.clone());
                self.pins = description.map(|garment| (garment, report.findings.clone()));
            }
            Event::Answer { request, refusal } if *request == Request::SelfTest.number() => {
                self.self_test = Some(refusal.clone().map_or(Ok(()), Err));
            }
            Event::Log { level: taxel_core::wire::Level::Error, text, .. }
            | Event::Lost { why: text, .. } => {
                self.logged.push(text.clone());
            }
            _ => {}
        }
        Ok(())
    }

    fn idle(&mut self, client: &mut Client) -> taxel::Result<()> {
        if client.description().is_some() && !std::mem::replace(&mut self.asked, true) {
            client.share(self.buses.clone());
            client.request(&Request::SelfTest)?;
        }
        Ok(())
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> taxel::Result<()> {
        let counts = client.counts();
        self.images = [counts.frames, counts.thinned, counts.undecoded];
        self.lost = [counts.lost, counts.refused()];
        self.faulty = client.faulty().len();
        self.bus = client.bus();
        if let Some(description) = client.description() {
            (self.taxels, self.calibration) = (description.layout.taxels(), description.calibration.clone());
        }
        let last = self.frames.map(|[_, (_, time)]| taxel_core::format::Micros(time));
        self.clock_us = last.and_then(|time| client.host_time(time)).map(|time| time.uncertainty_us);
        Ok(())
    }
}
