//! `taxel live`: what a board tells, as a picture in the terminal, as lines, or as JSON.

mod lines;
mod map;
mod messages;
pub(crate) mod narrate;
mod outfit;
mod panes;
pub(crate) mod ramp;
pub(crate) mod rate;
mod screen;
mod svg;
mod taxel;
mod view;

pub use lines::Lines;
pub use messages::{Messages, message};
pub use outfit::GestureModel;
pub use svg::picture;
pub use taxel::{TaxelLines, TaxelPlace};
pub use view::View;

use crate::calibrate::Calibration;
use crate::client::{Client, Event, ImageNews};
use crate::clock::SteadyTime;
use crate::source::{self, Source, SourceOptions, SourceSpec};
use anyhow::{Context, Result, bail};
use clap::Args;
use std::fs::File;
use std::io::{IsTerminal, Write, stdout};
use std::path::PathBuf;
use std::time::{Duration, Instant};
use taxel_core::format::Micros;
use taxel_core::wire::Request;

/// What `taxel live` takes.
#[derive(Debug, Clone, Args)]
pub struct LiveArgs {
    /// `auto`, `usb`, `sim[:SCENE]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`, `emulator[:SCENE]`, `file:FILE` or `replay:FILE[@SPEED]`
    #[arg(long, value_name = "SOURCE", default_value = "auto")]
    pub source: SourceSpec,
    /// End after N images
    #[arg(long, value_name = "N")]
    pub frames: Option<u64>,
    /// End after S seconds of the board
    #[arg(long, value_name = "S")]
    pub seconds: Option<f64>,
    /// Print messages as JSON, one a line
    #[arg(long)]
    pub json: bool,
    /// With --json: also the pressure of every taxel
    #[arg(long, requires = "json")]
    pub pixels: bool,
    /// Keep the bytes that come, for --source file:FILE
    #[arg(long, value_name = "FILE")]
    pub save: Option<PathBuf>,
    /// Print one taxel's time, code and pressure, frame by frame
    #[arg(long, value_name = "PANEL,ROW,COL")]
    pub taxel: Option<TaxelPlace>,
    /// Garment that a real or emulated board is to wear: a preset or a TOML file
    #[arg(long, value_name = "G")]
    pub garment: Option<String>,
    /// Scene that the board is used for: a TOML file; what it does not say is as shipped
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    /// Calibration that the board is to have, for forces in newtons: a file of `taxel calibrate`
    #[arg(long, value_name = "FILE")]
    pub calibration: Option<PathBuf>,
    /// Take the mean of the first N frames as the baseline [default: as a simulated scene asks, else 0]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=4096))]
    pub tare: Option<u16>,
    /// How many times a second the board reports where its time goes; 65535: for each frame [default: 1]
    #[arg(long, value_name = "HZ")]
    pub budget: Option<u16>,
    /// The board recognises what goes on by a model that it holds
    #[arg(long, value_name = "MODEL", value_enum)]
    pub gestures: Option<GestureModel>,
    /// With --gestures: counts of the model's sheet per count of the garment [default: 1]
    #[arg(long, value_name = "G", requires = "gestures")]
    pub gesture_gain: Option<f64>,
    /// A simulation is not faster than time
    #[arg(long)]
    pub realtime: bool,
    /// Seed of a simulation
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
    /// Write the terminal's last picture as SVG
    #[arg(long, value_name = "FILE", hide = true)]
    pub svg: Option<PathBuf>,
}

impl LiveArgs {
    /// Everything that comes from a source, as it is.
    pub fn of(source: SourceSpec) -> LiveArgs {
        LiveArgs {
            source,
            frames: None,
            seconds: None,
            json: false,
            budget: None,
            gestures: None,
            gesture_gain: None,
            pixels: false,
            save: None,
            taxel: None,
            garment: None,
            scene: None,
            calibration: None,
            tare: None,
            realtime: false,
            seed: None,
            svg: None,
        }
    }
}

/// Something that shows what comes.
pub trait Show {
    /// Bytes have come; the events that they make are told next.
    fn bytes(&mut self, _bytes: &[u8]) {}

    /// Takes an event; the client is in the state after it.
    fn event(&mut self, client: &Client, event: &Event) -> Result<()>;

    /// These bytes are about to be sent to the board.
    fn asked(&mut self, _client: &Client, _bytes: &[u8]) -> Result<()> {
        Ok(())
    }

    /// Bytes have been taken, or none came for a while: whether to go on.
    fn idle(&mut self, _client: &mut Client) -> Result<bool> {
        Ok(true)
    }

    /// Nothing more comes.
    fn end(&mut self, _client: &Client) -> Result<()> {
        Ok(())
    }
}

/// Runs the command.
pub fn run(args: LiveArgs) -> Result<()> {
    if args.seconds.is_some_and(|s| !s.is_finite() || s < 0.0) {
        bail!("--seconds must be a time of 0 or more");
    }
    let terminal = stdout().is_terminal() && !args.json && args.taxel.is_none() && args.svg.is_none();
    let bounded = args.frames.is_some() || args.seconds.is_some();
    let options = SourceOptions {
        seed: args.seed,
        realtime: args.realtime || terminal,
        repeat: terminal && !bounded,
        frames: args.frames,
        seconds: args.seconds,
        raw: args.taxel.is_some(),
    };
    let mut source = source::open(&args.source, &options)?;
    let calibration = args.calibration.as_deref().map(Calibration::read).transpose()?;
    source.counts_per_newton =
        calibration.as_ref().and_then(Calibration::counts_per_newton).or(source.counts_per_newton);
    let out = std::io::BufWriter::new(stdout());
    let mut show: Box<dyn Show> = if let Some(file) = &args.svg {
        Box::new(svg::Painter::new(View::new(&source), file.clone()))
    } else if let Some(place) = &args.taxel {
        Box::new(TaxelLines::new(place.clone(), args.json, out))
    } else if args.json {
        Box::new(Messages::new(args.pixels, out).calibrated(calibration))
    } else if terminal {
        Box::new(screen::Screen::open(View::new(&source))?)
    } else {
        Box::new(Lines::new(&source, out))
    };
    watch(&args, source, show.as_mut())
}

/// Shows what comes from a source until it ends, or until enough has come.
pub fn watch(args: &LiveArgs, mut source: Source, show: &mut dyn Show) -> Result<()> {
    let mut client = Client::new();
    prepare(&mut client, args, &source)?;
    let mut limits = Limits {
        frames: args.frames,
        seconds: args.seconds,
        began: None,
        codes: args.taxel.is_some(),
        ended: false,
    };
    let mut save = args.save.as_ref().map(Saver::open).transpose()?;
    let mut patience = Patience { asked: Instant::now(), times: 0 };
    let time = SteadyTime::start();
    let tell_time = |client: &mut Client, real: bool| {
        if real {
            client.tell_time(time.now_us());
        }
    };
    let mut buffer = [0; 4096];
    while !limits.ended {
        tell_time(&mut client, source.real_time);
        let lost = || format!("{} is gone", source.label);
        let requests = client.take_requests();
        show.asked(&client, &requests)?;
        source.port.write(&requests).with_context(lost)?;
        let Some(count) = source.port.read(&mut buffer).with_context(lost)? else { break };
        tell_time(&mut client, source.real_time);
        show.bytes(&buffer[..count]);
        let mut taken = 0;
        for byte in &buffer[..count] {
            taken += 1;
            let Some(event) = client.push(*byte) else { continue };
            show.event(&client, &event)?;
            if limits.reached(&event) {
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
    match client.worn() {
        Some(_) => Ok(()),
        None => bail!("{}: no Hello of a taxel board in {} bytes", source.label, client.counts().bytes),
    }
}

/// Queues what is asked of the board before anything is shown.
fn prepare(client: &mut Client, args: &LiveArgs, source: &Source) -> Result<()> {
    if let Some(garment) = &args.garment {
        if source.label.starts_with("sim:") {
            bail!("--garment {garment}: a simulated board wears the garment that its scene file names");
        }
        outfit::wear(client, garment)?;
    }
    if let Some(scene) = &args.scene {
        outfit::play(client, scene)?;
    }
    if let Some(file) = &args.calibration {
        Calibration::read(file)?.requests().try_for_each(|request| client.request(&request))?;
    }
    client.start(args.tare.unwrap_or(source.tare))?;
    if let Some(model) = args.gestures {
        outfit::recognise(client, model, args.gesture_gain)?;
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
    fn open(path: &PathBuf) -> Result<Saver> {
        let file = File::create(path).with_context(|| format!("{} cannot be written", path.display()))?;
        Ok(Saver { file, path: path.clone() })
    }

    fn write(&mut self, bytes: &[u8]) -> Result<()> {
        self.file.write_all(bytes).with_context(|| format!("{} cannot be written", self.path.display()))
    }
}

/// A request that came to nothing (the board was starting, the line was noisy) is made again.
struct Patience {
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
        Ok(client.start(0)?)
    }
}
