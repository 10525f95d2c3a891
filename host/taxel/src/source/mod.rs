//! Sources of a stream: a simulated board, a board on USB, a serial port, TCP, Zenoh, a recording, an
//! array of others.

pub mod array;
mod auto;
mod beside;
mod hand;
mod heard;
mod overhear;
mod paced;
mod pipe;
#[cfg(feature = "port-table")]
mod port_table;
mod ports;
mod replay;
mod scene;
mod script_posture;
mod serial;
mod serial_ports;
pub mod shared;
mod sim;
mod spec;
mod stepped_board;
mod stranger;
mod tcp;
mod touching;
mod usb;
#[cfg(feature = "zenoh")]
mod zenoh;

pub use hand::{FingerPress, HAND_ORDERS, Hand};
pub(crate) use heard::Heard;
pub use overhear::overheard;
pub use ports::Ports;
pub use replay::Speed;
pub use scene::{SceneFile, read_scene, scene_of};
pub use serial_ports::SerialPorts;
pub use spec::SourceSpec;
pub use stepped_board::{SteppedBoard, WireSink};
pub(crate) use stranger::Stranger;
pub use usb::{PortKind, listed as ports};

use crate::error::{Result, UsageError};
use crate::files::calibrate::ForceScale;
use crate::recording::GapMark;
use crate::sim::Script;
use std::io;
use std::path::PathBuf;
use std::time::Duration;

/// A byte stream in both directions. Bytes written before the first read are delivered before it, so that a
/// simulated board finds them. An error means that the link is broken.
pub trait Port: Send {
    /// Reads available bytes, after a short wait if there are none (then 0); none at the end of the stream.
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>>;
    /// Writes as many bytes as the other end accepts within a short while, which may be 0. Returns their
    /// number.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize>;
    /// Requests that the board was sent by the source itself, before what was read last: a simulation sends the
    /// joints of its script.
    fn own_requests(&mut self) -> Vec<u8> {
        Vec::new()
    }
    /// Returns how long bytes may wait to be read without holding back the board: not at all, unless the link has
    /// room for them.
    fn keeps(&self) -> Duration {
        Duration::ZERO
    }
    /// Begin or end of a gap that a recording holds, once: it precedes the bytes that are read next.
    fn gap(&mut self) -> Option<GapMark> {
        None
    }
    /// Returns what has become known of the link, to be reported at once.
    fn news(&mut self) -> Option<String> {
        None
    }
    /// Returns the bytes of an array in which the stream was perceived, since the last call.
    fn original(&mut self) -> Vec<array::OriginalBytes> {
        Vec::new()
    }
    /// A remark to print at the end.
    fn remark(&self) -> Option<String> {
        None
    }
}

/// Options of a source.
#[derive(Debug, Default, Clone)]
pub struct SourceOptions {
    /// Seed of a simulation, instead of its script's.
    pub seed: Option<u64>,
    /// Pace simulations to real time.
    pub realtime: bool,
    /// Repeat a simulation's script.
    pub repeat: bool,
    /// With `repeat`: begin it only once nobody has touched the garment for ten seconds.
    pub waits: bool,
    /// Images that are awaited; a simulation lasts that long.
    pub frames: Option<u64>,
    /// Seconds of board time that are awaited.
    pub seconds: Option<f64>,
    /// Garment of a simulated board, a preset or a TOML file, instead of its script's.
    pub garment: Option<String>,
    /// Body that a simulated board has in its flash from the start, a preset or a TOML file.
    pub body: Option<String>,
    /// Table of folds that a simulated board has in its flash from the start.
    pub folds: Option<PathBuf>,
    /// True to open the first that speaks of several boards that are plugged in, instead of refusing.
    pub first: bool,
    /// Serial ports; those of this machine by default.
    pub ports: SerialPorts,
}

/// Opens a lost source again.
pub type Return = dyn FnMut() -> Result<Source> + Send;

/// An open source.
pub struct Source {
    /// Short name.
    pub label: String,
    /// Byte stream.
    pub port: Box<dyn Port>,
    /// Frames over which it should be tared at the start; 0 for no tare.
    pub tare: u16,
    /// True if its board runs in real time, so that its clock can be compared with the host's.
    pub real_time: bool,
    /// Scale from counts to newtons, as far as it is known.
    pub scale: ForceScale,
    /// True if its board already has the requested garment.
    pub has_asked_garment: bool,
    /// True if its board already has the requested body.
    pub has_body: bool,
    /// Scene that the board begins with, if it is known: that of a simulated one.
    pub scene: Option<taxel_core::scene::Scene>,
    /// True if its board already has the requested table of folds.
    pub has_folds: bool,
    /// Serial number on USB of its board, or of the probe before it; none if its link has none.
    pub usb_serial: Option<String>,
    /// Names of other boards that are plugged in, and were not chosen.
    pub others: Vec<String>,
    /// True if it has a board that receives requests; false for recordings.
    pub listens: bool,
    /// Touches the garment of its board; none unless that is simulated.
    pub hand: Option<Hand>,
    /// Opens it again when it is lost; none if it ends for good.
    pub returns: Option<Box<Return>>,
}

impl Source {
    /// A source that ends by itself.
    pub fn new(label: impl Into<String>, port: impl Port + 'static) -> Source {
        Source {
            label: label.into(),
            port: Box::new(port),
            tare: 0,
            real_time: false,
            scale: ForceScale::default(),
            has_asked_garment: false,
            has_body: false,
            scene: None,
            has_folds: false,
            usb_serial: None,
            others: Vec::new(),
            listens: true,
            hand: None,
            returns: None,
        }
    }

    /// A real board, and how to open its link again.
    pub fn real(
        label: impl Into<String>,
        port: impl Port + 'static,
        returns: impl FnMut() -> Result<Source> + Send + 'static,
    ) -> Source {
        Source { real_time: true, returns: Some(Box::new(returns)), ..Source::new(label, port) }
    }
}

/// Connects to a board within a time limit.
fn tcp(address: &str, longest: Duration) -> Result<Source> {
    let known = address.to_string();
    // Attempts to reconnect are short, so that the caller can do other things.
    let returns = move || tcp(&known, tcp::RETURN);
    Ok(Source::real(format!("tcp:{address}"), tcp::Tcp::open(address, longest)?, returns))
}

/// Opens a simulated board that plays this script.
pub fn simulated(script: Script, options: &SourceOptions) -> Result<Source> {
    let label = format!("sim:{}", script.name);
    sim::play(script, label, options)
}

/// Opens a source. Errors are one sentence.
pub fn open(spec: &SourceSpec, options: &SourceOptions) -> Result<Source> {
    let source = opened(spec, options)?;
    log::info!("source {} is open", source.label);
    Ok(source)
}

fn opened(spec: &SourceSpec, options: &SourceOptions) -> Result<Source> {
    match spec {
        SourceSpec::Auto => auto::plugged(true, options),
        SourceSpec::Usb(None) => auto::plugged(false, options),
        SourceSpec::Usb(Some(number)) => auto::numbered(number, options),
        SourceSpec::Sim(scene) => sim::open(scene, options),
        SourceSpec::Serial { path, baud } => auto::port(path, *baud, options),
        SourceSpec::Tcp(address) => tcp(address, tcp::CONNECT),
        #[cfg(feature = "zenoh")]
        SourceSpec::Zenoh { place, config } => zenoh::open(place, config.as_deref()),
        #[cfg(not(feature = "zenoh"))]
        SourceSpec::Zenoh { .. } => {
            fail!(
                UsageError::Unknown,
                "source {spec}: this program was built without Zenoh (feature `zenoh`); docs/guides/zenoh.md says how it is built in"
            )
        }
        SourceSpec::Robot { file, .. } => {
            let file = file.display();
            fail!(UsageError::Argument, "{file} is a robot's file, and this takes one board: name its source")
        }
        SourceSpec::Array(spec) => array::open(spec, options),
        SourceSpec::Replay { recording, speed } => replay::open(recording, *speed, options),
    }
}
