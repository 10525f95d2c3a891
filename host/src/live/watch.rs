//! A source is read until it ends, or until enough has come.

use super::asked::Asked;
use super::narrate::request_name;
use super::{BoardArgs, LiveArgs, Show, outfit};
use crate::calibrate::Calibration;
use crate::client::{Client, Event, ImageNews};
use crate::clock::SteadyTime;
use crate::fault::{Blame, Fault};
use crate::output::Output;
use crate::shapes::base::Base;
use crate::shapes::teach::teach;
use crate::source::Source;
use crate::verbose;
use anyhow::{Context, Error, Result, bail};
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use taxel_core::format::Micros;
use taxel_core::wire::Request;

/// Requests, one a second, that a board may leave without an answer where somebody watches for some time only.
const SILENCE: u32 = 10;

/// Shows what comes from a source until it ends, or until enough has come.
pub fn watch(args: &LiveArgs, mut source: Source, show: &mut dyn Show) -> Result<()> {
    let mut client = Client::new();
    prepare(&mut client, &args.board, &source)?;
    let mut limits = Limits {
        frames: args.frames,
        seconds: args.seconds,
        began: None,
        codes: args.taxel.is_some(),
        ended: false,
    };
    let mut save = args.save.as_ref().map(|path| Saver::open(path, args)).transpose()?;
    let limited = args.frames.is_some() || args.seconds.is_some();
    let mut patience = Patience { limited, asked: Instant::now(), times: 0 };
    let mut asked = if source.listens { Asked::of(client.queued(), &args.board) } else { Asked::default() };
    let time = SteadyTime::start();
    let tell_time = |client: &mut Client, real: bool| {
        if real {
            client.tell_time(time.now_us());
        }
    };
    let mut buffer = [0; 4096];
    while !limits.ended && asked.refusal.is_none() {
        tell_time(&mut client, source.real_time);
        let lost = || format!("{} is gone", source.label);
        let requests = client.take_requests();
        show.asked(&client, &requests)?;
        source.port.write(&requests).with_context(lost).board()?;
        let Some(count) = source.port.read(&mut buffer).with_context(lost).board()? else { break };
        tell_time(&mut client, source.real_time);
        show.bytes(&buffer[..count]);
        let mut taken = 0;
        for byte in &buffer[..count] {
            taken += 1;
            let Some(event) = client.push(*byte) else { continue };
            tell(&client, &event);
            show.event(&client, &event)?;
            asked.answered(&event);
            if limits.reached(&event) || asked.refusal.is_some() {
                break;
            }
        }
        if let Some(save) = &mut save {
            save.write(&buffer[..taken])?;
        }
        if !show.idle(&mut client)? {
            break;
        }
        patience.ask_again(&mut client, &source)?;
    }
    show.end(&client)?;
    if let Some(remark) = source.port.remark() {
        eprintln!("{}: {remark}", source.label);
    }
    match (asked.refusal, client.worn()) {
        (Some(refusal), _) => Err(Fault::board(format!("{}: {refusal}", source.label)).into()),
        (None, Some(_)) => Ok(()),
        (None, None) => Err(silent(&source, client.counts().bytes)),
    }
}

/// What `-v` tells of a board.
fn tell(client: &Client, event: &Event) {
    match event {
        Event::Hello => {
            if let Some(worn) = client.worn() {
                let (firmware, garment, scene) = (&worn.firmware, &worn.garment.name, &worn.scene.name);
                verbose::tell(format_args!(
                    "board {firmware} wears garment {garment} and plays scene {scene}"
                ));
            }
        }
        Event::Answer { request, refusal: None } => {
            verbose::tell(format_args!("the board has done {}", request_name(*request)));
        }
        Event::Answer { request, refusal: Some(why) } => {
            verbose::tell(format_args!("the board refuses {}: {why}", request_name(*request)));
        }
        _ => {}
    }
}

/// A board is at fault where none is heard, a file is not.
fn silent(source: &Source, bytes: u64) -> Error {
    let why = format!("{}: no Hello of a taxel board in {bytes} bytes", source.label);
    if source.real_time { Fault::board(why).into() } else { Error::msg(why) }
}

/// Queues what is asked of the board before anything is shown.
fn prepare(client: &mut Client, args: &BoardArgs, source: &Source) -> Result<()> {
    if !source.listens {
        args.check_recorded(&source.label)?;
    }
    if let Some(garment) = args.garment.as_ref().filter(|_| !source.wears_asked) {
        if source.label.starts_with("sim:") {
            bail!(Fault::usage(format!(
                "--garment {garment}: a simulated board wears the garment that it began with"
            )));
        }
        outfit::wear(client, garment)?;
    }
    if let Some(scene) = &args.scene {
        outfit::play(client, scene)?;
    }
    if let Some(in_frame) = args.forms {
        client.request(&Request::SetForms { in_frame, ages: true })?;
    }
    for feed in &args.feed {
        client.request(&Request::Feed(feed.clone()))?;
    }
    if let Some(file) = &args.calibration {
        Calibration::read(file)?.requests().try_for_each(|request| client.request(&request))?;
    }
    client.start(args.tare.unwrap_or(source.tare))?;
    if let Some(model) = args.gestures {
        outfit::recognise(client, model, args.gesture_gain, args.gesture_certainty)?;
    }
    if let Some(base) = &args.shapes {
        teach(client, &Base::open(base)?)?;
    }
    if let Some(hz) = args.budget {
        client.request(&Request::Budget { hz })?;
    }
    Ok(())
}

/// When enough has come.
struct Limits {
    frames: Option<u64>,
    seconds: Option<f64>,
    began: Option<Micros>,
    /// The codes of the last image, which come after it, are waited for.
    codes: bool,
    ended: bool,
}

impl Limits {
    fn reached(&mut self, event: &Event) -> bool {
        if self.frames == Some(0) {
            self.ended |= matches!(event, Event::Raw { .. } | Event::Frame { .. });
        } else if let Event::Frame { time, image: ImageNews::Whole, .. } = event {
            let began = *self.began.get_or_insert(*time);
            if let Some(frames) = &mut self.frames {
                *frames = frames.saturating_sub(1);
                self.ended |= *frames == 0 && !self.codes;
            }
            self.ended |= self.seconds.is_some_and(|seconds| time.since(began) as f64 >= seconds * 1e6);
        }
        self.ended
    }
}

/// Keeps the bytes that were shown.
struct Saver {
    file: File,
    path: PathBuf,
}

impl Saver {
    fn open(path: &Path, args: &LiveArgs) -> Result<Saver> {
        let file = Output::file(path, args.force, args.board.files())?.begin()?;
        Ok(Saver { file, path: path.into() })
    }

    fn write(&mut self, bytes: &[u8]) -> Result<()> {
        self.file.write_all(bytes).with_context(|| format!("{} cannot be written", self.path.display()))
    }
}

/// A request that came to nothing (the board was starting, the line was noisy) is made again.
struct Patience {
    /// Whoever watches for some time only does not wait for ever for a board that says nothing.
    limited: bool,
    asked: Instant,
    times: u32,
}

impl Patience {
    fn ask_again(&mut self, client: &mut Client, source: &Source) -> Result<()> {
        if client.worn().is_some() || self.asked.elapsed() < Duration::from_secs(1) {
            return Ok(());
        }
        self.asked = Instant::now();
        self.times += 1;
        if self.times == 3 {
            eprintln!("No Hello yet from {}.", source.label);
        }
        if self.limited && self.times >= SILENCE {
            return Err(silent(source, client.counts().bytes));
        }
        Ok(client.start(0)?)
    }
}
