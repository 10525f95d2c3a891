//! Captures a board's report of an intention to be explained: from any source, when an intention is announced
//! or at a given time.

use crate::fault::own;
use crate::watch::{self, BoardArgs, WatchOptions};
use anyhow::{Context, Result, bail};
use std::path::PathBuf;
use taxel::client::{Client, Event, Stamp};
use taxel::fcm::map::MapFile;
use taxel::fcm::reported::ReportedIntent;
use taxel::robot::{BoardConfig, ReadRobot, feed};
use taxel::session::Observer;
use taxel::source::{SourceOptions, SourceSpec};
use taxel_core::format::Micros;
use taxel_core::intent::{Feed, Leading};
use taxel_core::wire::IntentReport;

/// Arguments of commands that show a map in the state of a board.
#[derive(Debug, Clone, clap::Args)]
pub struct ReportedArgs {
    /// Instead of a map: a board or a recording, whose first announced intention is shown: `sim[:TOUCHES]`,
    /// `usb`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `zenoh:ROBOT/BOARD` or
    /// `replay:FILE[@SPEED]`
    #[arg(long, value_name = "SOURCE", conflicts_with_all = ["map", "input"])]
    pub source: Option<SourceSpec>,
    /// With --source: show the last state within this time, such as 2s, announced or not
    #[arg(long, value_name = "TIME", value_parser = watch::time, requires = "source")]
    pub at: Option<f64>,
    /// With --source: scene to send to the board, a TOML file
    #[arg(long, value_name = "FILE", requires = "source")]
    pub scene: Option<PathBuf>,
    /// With --source: set a concept, as in `taxel live`
    #[arg(long, value_name = "NAME=VALUE[,AGE_MS[,TIMEOUT_MS[,DEFAULT]]]", value_parser = feed, requires = "source")]
    pub feed: Vec<Feed>,
    /// With --source of a robot's file: send requests to its boards and host input to its map, as in `taxel live`
    #[arg(long, value_name = "FILE", requires = "source")]
    pub requests: Option<PathBuf>,
}

impl ReportedArgs {
    /// Paths of the input files.
    pub fn files(&self) -> Vec<PathBuf> {
        self.source.iter().filter_map(SourceSpec::file).chain(self.scene.clone()).collect()
    }

    /// The robot whose boards are all meant; none for a board.
    pub fn robot(&self) -> Result<Option<ReadRobot>> {
        let Some(SourceSpec::Robot { file, board: None }) = &self.source else { return Ok(None) };
        let more =
            BoardConfig { scene: self.scene.clone(), feed: self.feed.clone(), ..BoardConfig::default() };
        Ok(Some(ReadRobot::read_with(file, &more)?))
    }

    /// Report of the source, if one is given.
    pub fn listen(self) -> Result<Option<ReportedIntent>> {
        let Some(source) = self.source else { return Ok(None) };
        let config = BoardConfig { scene: self.scene, feed: self.feed, ..BoardConfig::of(source) };
        listen(BoardArgs { config, ..BoardArgs::default() }, self.at).map(Some)
    }
}

/// Listens until an intention is announced; with `at` for this many seconds, and returns the last report.
pub fn listen(board: BoardArgs, at: Option<f64>) -> Result<ReportedIntent> {
    let (source, _) = board.open(SourceOptions { seconds: at, ..SourceOptions::default() })?;
    let label = source.label.clone();
    if source.real_time {
        eprintln!("{label}: waiting for {}.", if at.is_some() { "the time" } else { "an intention" });
    }
    let mut ear = Ear { at, began: None, now: Micros(0), leading: Leading::None, found: None, done: false };
    // The report of a moment comes after its image; without images the limit ends the wait.
    let seconds = at.map(|at| at + 1.0);
    watch::watch(&WatchOptions { seconds, ..WatchOptions::on(board) }, source, &mut ear)?;
    match (ear.found, at) {
        (Some(reported), _) => Ok(reported),
        (None, None) => {
            bail!("{label}: no intention was announced; --at TIME explains the state at that time")
        }
        (None, Some(at)) => bail!("{label}: no intention was reported in the first {at} s"),
    }
}

/// State while listening.
struct Ear {
    at: Option<f64>,
    /// Time of the first frame.
    began: Option<Micros>,
    now: Micros,
    leading: Leading,
    found: Option<ReportedIntent>,
    done: bool,
}

impl Ear {
    /// Handles the board's time.
    fn clock(&mut self, time: Micros) {
        self.began.get_or_insert(time);
        self.now = time;
        self.done |= self.at.is_some_and(|at| self.seconds() > at);
    }

    fn seconds(&self) -> f64 {
        self.began.map_or(0.0, |began| self.now.since(began) as f64 / 1e6)
    }

    fn take(&mut self, client: &Client, report: &IntentReport) -> Result<()> {
        let announced = report.leading != self.leading && report.leading != Leading::None;
        self.leading = report.leading;
        if self.at.is_none() && !announced {
            return Ok(());
        }
        let intent = client.description().and_then(|description| description.scene.intent.as_ref());
        let map = MapFile::from_config(&intent.context("the board's scene has no map")?.map);
        self.found = Some(ReportedIntent { map, report: report.clone(), seconds: self.seconds() });
        self.done = self.at.is_none();
        Ok(())
    }
}

impl Observer for Ear {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        if self.done {
            return Ok(());
        }
        match event {
            Event::Frame { time, .. } => self.clock(*time),
            Event::Intent(report) => {
                self.clock(report.time);
                if !self.done {
                    self.take(client, report).map_err(own)?;
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn is_done(&self) -> bool {
        self.done
    }
}
