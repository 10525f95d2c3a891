//! What a board says of two moving contacts, made beforehand by the simulation.

use anyhow::{Context, Result};
use std::path::Path;
use taxel::client::{Client, Event, ImageNews, time_of};
use taxel::session::Session;
use taxel::source::{self, SourceOptions};
use taxel_core::wire::{self, Report};

/// Two touches that move.
const TWO: &str = include_str!("two.toml");

/// Messages that answer requests: whoever plays the stream answers its own.
const ANSWERS: [u32; 3] = [Report::SYNC, Report::ANSWER, Report::START_OF_FRAME];

/// The messages of a board.
#[derive(Debug, Default)]
pub struct Stream {
    /// Its `Hello`.
    pub hello: Vec<u8>,
    /// All others without their numbers, each with the board's time, us.
    pub messages: Vec<(u64, Vec<u8>)>,
}

/// What a stream brings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Brought {
    /// Images.
    pub frames: u64,
    /// Lists of contacts.
    pub contacts: u64,
}

impl Stream {
    /// Makes one of so many seconds of the board's time; its scene is written into this folder.
    pub fn make(folder: &Path, seconds: f64) -> Result<Stream> {
        let scene = folder.join("two.toml");
        std::fs::write(&scene, TWO).with_context(|| scene.display().to_string())?;
        let options = SourceOptions { repeat: true, ..SourceOptions::default() };
        let spec = format!("sim:{}", scene.display()).parse().map_err(anyhow::Error::msg)?;
        let mut session = Session::over(source::open(&spec, &options)?)?;
        let (mut stream, mut begun, mut now) = (Stream::default(), None, 0);
        while let Some(event) = session.wait()? {
            now = time_of(session.client(), &event).unwrap_or(now);
            stream.keep(session.client(), now)?;
            let Event::Frame { time, image: ImageNews::Whole, .. } = event else { continue };
            if (time.0 - *begun.get_or_insert(time.0)) as f64 >= seconds * 1e6 {
                break;
            }
        }
        // What was said before the first image has no time of its own.
        let first = begun.context("the simulation has sent no image")?;
        stream.messages.iter_mut().for_each(|(at_us, _)| *at_us = first.max(*at_us));
        Ok(stream)
    }

    fn keep(&mut self, client: &Client, now: u64) -> Result<()> {
        for line in client.lines() {
            let mut line = line.to_vec();
            line.pop();
            let (_, report) = postcard::take_from_bytes::<u32>(wire::open(&mut line)?)?;
            let (number, _) = postcard::take_from_bytes::<u32>(report)?;
            match number {
                Report::HELLO => self.hello = report.to_vec(),
                number if ANSWERS.contains(&number) => {}
                _ => self.messages.push((now, report.to_vec())),
            }
        }
        Ok(())
    }

    /// Writes it to a file.
    pub fn write(&self, path: &Path) -> Result<()> {
        let bytes = postcard::to_allocvec(&(&self.hello, &self.messages))?;
        std::fs::write(path, bytes).with_context(|| path.display().to_string())
    }

    /// Reads a file that was written.
    pub fn read(path: &Path) -> Result<Stream> {
        let bytes = std::fs::read(path).with_context(|| path.display().to_string())?;
        let (hello, messages) = postcard::from_bytes(&bytes)?;
        Ok(Stream { hello, messages })
    }

    /// What it brings.
    pub fn brought(&self) -> Brought {
        let count = |wanted: u32| {
            let number = |report: &[u8]| postcard::take_from_bytes::<u32>(report).map(|(number, _)| number);
            let all = self.messages.iter().filter(|(_, report)| number(report) == Ok(wanted));
            all.count() as u64
        };
        Brought { frames: count(Report::FRAME), contacts: count(Report::CONTACTS) }
    }
}
