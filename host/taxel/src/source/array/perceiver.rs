//! The thread that reads an array and steps the very board with its frames.

use super::super::pipe::BoardEnd;
use super::super::shared::Shared;
use super::super::stepped_board::SteppedBoard;
use super::codes::CodeMap;
use super::decoder::ArrayDecoder;
use super::description::ArrayDescription;
use super::frame::ArrayFrame;
use super::input::ArrayInput;
use super::noise::{ArrayNoise, NoiseMeter};
use super::pace::Pace;
use super::polling::Polling;
use super::report::ArrayReport;
use crate::client::scene_bytes;
use crate::error::Result;
use crate::text::words;
use crate::time::Instant;
use std::io;
use std::sync::Arc;
use std::time::Duration;
use taxel_core::run::{Link, block_on};
use taxel_core::scene::Scene;
use taxel_core::wire::{LONGEST_REQUEST, Request, encode, frame_bound};

/// Longest time to send a request to the array.
const SEND: Duration = Duration::from_secs(1);
/// Time between two looks at requests while frames come.
const ATTEND_US: u64 = 100_000;

/// An array, its decoder and its board.
pub struct Perceiver {
    pub description: ArrayDescription,
    pub input: ArrayInput,
    pub board: SteppedBoard,
    pub link: BoardEnd,
    pub report: Arc<Shared<ArrayReport>>,
    /// Frames per second of a file.
    pub rate: Option<f64>,
    /// Frames of a file are paced to real time.
    pub is_paced: bool,
    /// A request with limits of contacts that is not passed yet.
    pub limits: Vec<u8>,
    /// Noise of the first frames.
    pub noise: NoiseMeter,
}

impl Perceiver {
    /// Runs until one of both ends is gone.
    pub fn run(mut self) {
        if block_on(self.link.begin())
            && let Err(why) = self.follow()
        {
            self.report.lock().fault = Some(words::sentence(&why));
        }
    }

    fn follow(&mut self) -> Result<()> {
        let (mut decoder, mut map) = (ArrayDecoder::new(&self.description), CodeMap::new(&self.description));
        let (mut pace, mut polling) = (Pace::start(self.rate), Polling::new(&self.description));
        let mut frames = Vec::new();
        if let Some(text) = self.description.link.send.clone() {
            self.write(text.as_bytes())?;
        }
        let mut attended = 0;
        while !self.link.is_alone() {
            if let Some(text) = polling.due() {
                self.write(text.as_bytes())?;
            }
            let read = self.input.read(&mut pace)?;
            let now = read.as_ref().map_or_else(|| pace.now_us(), |read| read.arrival_us);
            let count = read.as_ref().map(|read| read.bytes.len());
            let take = &mut |frame: ArrayFrame| frames.push(frame);
            match read {
                None => {
                    decoder.quiet(take);
                }
                Some(original) if original.bytes.is_empty() => {
                    if polling.is_quiet() {
                        decoder.quiet(take);
                    }
                }
                Some(original) => {
                    polling.heard();
                    match original.is_datagram {
                        true => decoder.datagram(&original.bytes, now, take),
                        false => decoder.push(&original.bytes, now, take),
                    }
                    let mut report = self.report.lock();
                    report.bytes += original.bytes.len() as u64;
                    report.original.push(original);
                }
            }
            let lost = decoder.loss();
            let before = std::mem::replace(&mut self.report.lock().loss, lost);
            let mut missed = (lost.missed - before.missed).try_into().unwrap_or(u32::MAX);
            for frame in frames.drain(..) {
                self.perceive(&frame, &mut map, &mut pace, std::mem::take(&mut missed))?;
                attended = now;
            }
            let link = &self.link;
            for _ in before.dropped..lost.dropped {
                self.board.fail(pace.between(), &mut |bytes| pass(link, bytes))?;
            }
            if count.is_none() {
                return Ok(());
            }
            if count == Some(0) || now > attended + ATTEND_US {
                attended = now;
                let (requests, time) = (self.requests(), pace.between());
                let link = &self.link;
                self.board.attend(&requests, time, &mut |bytes| pass(link, bytes))?;
            }
        }
        Ok(())
    }

    fn perceive(
        &mut self,
        frame: &ArrayFrame,
        map: &mut CodeMap,
        pace: &mut Pace,
        missed: u32,
    ) -> Result<()> {
        let mut codes = Vec::new();
        let time = pace.of(frame);
        if !map.codes(frame, &mut codes) {
            return Ok(());
        }
        if self.is_paced {
            self.link.sleep(pace.until(time));
        }
        let mut requests = self.requests();
        // With the frame after those that were measured.
        requests.extend(std::mem::take(&mut self.limits));
        if let Some(noise) = self.noise.add(&codes) {
            self.limits = self.adapt(noise)?;
        }
        let link = &self.link;
        let stepped = self.board.step(&requests, &codes, missed, time, &mut |bytes| pass(link, bytes));
        let mut report = self.report.lock();
        report.frames += 1;
        if let Err(why) = stepped {
            // The garment was changed to one of another size.
            report.fault = Some(words::sentence(&why));
        }
        Ok(())
    }

    /// Returns the request that fits the limits of contacts to a noise, and reports them; none if a scene was set.
    fn adapt(&self, noise: ArrayNoise) -> Result<Vec<u8>> {
        if self.board.board().setup().scene != Scene::shipped() {
            return Ok(Vec::new());
        }
        let scene = noise.scene(self.board.board().setup().layout.areas());
        self.report.lock().limits = Some(format!(
            "{:.1} counts of noise at rest: contacts from {} counts on (--scene sets limits of your own)",
            noise.deviation, scene.contact.high
        ));
        let mut room = vec![0; frame_bound(LONGEST_REQUEST)];
        Ok(encode(&Request::SetScene(&scene_bytes(&scene)?), &mut room)?.to_vec())
    }

    fn requests(&self) -> Vec<u8> {
        let (mut requests, mut buffer) = (Vec::new(), [0; 4096]);
        loop {
            match (&self.link).try_read(&mut buffer) {
                0 => return requests,
                count => requests.extend_from_slice(&buffer[..count]),
            }
        }
    }

    fn write(&mut self, mut bytes: &[u8]) -> io::Result<()> {
        let began = Instant::now();
        while !bytes.is_empty() && began.elapsed() < SEND {
            bytes = &bytes[self.input.write(bytes)?..];
        }
        Ok(())
    }
}

fn pass(mut link: &BoardEnd, bytes: &[u8]) -> Result<()> {
    link.try_write(bytes);
    Ok(())
}
