//! Where bytes come from and requests go: a simulated board, a board on USB, a serial port, TCP, the
//! emulator, a file, a recording.

mod auto;
mod emulator;
mod file;
mod pipe;
mod replay;
mod scene;
mod serial;
mod sim;
mod spec;
mod tcp;

pub use auto::{PortKind, listed as ports};
pub use replay::Speed;
pub use scene::{SceneFile, read_scene, scene_of};
pub use spec::SourceSpec;

use crate::sim::Script;
use crate::verbose;
use anyhow::Result;
use std::io;
use std::time::Duration;

/// Bytes both ways. What is written before the first read waits for it, so that a simulated board finds it. An
/// error means that the link is broken.
pub trait Port: Send {
    /// Bytes that have come, after a short wait if there are none (then 0); none: no more will come.
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>>;
    /// Sends as many of the bytes as the other end takes within a short while: how many; it may read slowly, or
    /// not at all.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize>;
    /// What is to be said of it at the end.
    fn remark(&self) -> Option<String> {
        None
    }
}

/// What a source is to do beyond giving bytes.
#[derive(Debug, Default, Clone, PartialEq)]
pub struct SourceOptions {
    /// Seed of a simulation in place of its script's.
    pub seed: Option<u64>,
    /// Pace simulations to real time.
    pub realtime: bool,
    /// A simulation begins again when its script is over.
    pub repeat: bool,
    /// Images that somebody waits for: a simulation lasts that long.
    pub frames: Option<u64>,
    /// Seconds of the board that somebody waits for.
    pub seconds: Option<f64>,
    /// A simulation sends raw codes with every frame.
    pub raw: bool,
    /// A simulated board wears this garment, a preset or a TOML file, in place of that of its script.
    pub garment: Option<String>,
}

/// Opens a source again that was lost.
pub type Return = dyn FnMut() -> Result<Source> + Send;

/// An open source.
pub struct Source {
    /// What it is, in a few words.
    pub label: String,
    /// Its bytes.
    pub port: Box<dyn Port>,
    /// Frames over which it should be tared at the start; 0: as it is.
    pub tare: u16,
    /// Its board lives in real time: its clock can be compared with the host's.
    pub real_time: bool,
    /// Counts per newton on a taxel, where that is known.
    pub counts_per_newton: Option<f32>,
    /// Its board wears the garment that was asked for already.
    pub wears_asked: bool,
    /// There is a board that hears what is asked of it: nothing was recorded before.
    pub listens: bool,
    /// How it is opened again when it is lost; none: it ends for good.
    pub returns: Option<Box<Return>>,
}

impl Source {
    /// Of something that ends by itself.
    pub fn new(label: impl Into<String>, port: impl Port + 'static) -> Source {
        Source {
            label: label.into(),
            port: Box::new(port),
            tare: 0,
            real_time: false,
            counts_per_newton: None,
            wears_asked: false,
            listens: true,
            returns: None,
        }
    }

    /// Of a real board, and how its link is opened again.
    pub fn real(
        label: impl Into<String>,
        port: impl Port + 'static,
        returns: impl FnMut() -> Result<Source> + Send + 'static,
    ) -> Source {
        Source { real_time: true, returns: Some(Box::new(returns)), ..Source::new(label, port) }
    }
}

/// Connects to a board within a time.
fn tcp(address: &str, longest: Duration) -> Result<Source> {
    let known = address.to_string();
    // A try to come back is short: who waits may want to do something else.
    let returns = move || tcp(&known, tcp::RETURN);
    Ok(Source::real(format!("tcp:{address}"), tcp::Tcp::open(address, longest)?, returns))
}

/// Opens a simulated board that plays a script of this name.
pub fn simulated(script: Script, options: &SourceOptions) -> Result<Source> {
    let label = format!("sim:{}", script.name);
    sim::play(script, label, options)
}

/// Opens a source. Errors are one sentence.
pub fn open(spec: &SourceSpec, options: &SourceOptions) -> Result<Source> {
    let source = opened(spec, options)?;
    verbose::tell(format_args!("source {} is open", source.label));
    Ok(source)
}

fn opened(spec: &SourceSpec, options: &SourceOptions) -> Result<Source> {
    match spec {
        SourceSpec::Auto => auto::open(options),
        SourceSpec::Usb => auto::usb(),
        SourceSpec::Sim(scene) => sim::open(scene, options),
        SourceSpec::Serial { path, baud } => auto::port(path, *baud),
        SourceSpec::Tcp(address) => tcp(address, tcp::CONNECT),
        SourceSpec::Emulator(scene) => emulator::open(scene, options),
        SourceSpec::File(path) => {
            let saved = Source::new(format!("file:{}", path.display()), file::Saved::open(path)?);
            Ok(Source { listens: false, ..saved })
        }
        SourceSpec::Replay { path, speed } => replay::open(path, *speed, options),
    }
}
