//! Opens an array as a source: the very board on this host perceives its frames.

use super::super::pipe::pipe;
use super::super::shared::Shared;
use super::super::stepped_board::SteppedBoard;
use super::super::tcp;
use super::super::usb;
use super::super::{Source, SourceOptions};
use super::datagrams::Datagrams;
use super::description::ArrayDescription;
use super::input::ArrayInput;
use super::link::ArrayLink;
use super::listener::Listener;
use super::noise::NoiseMeter;
use super::original::RecordedBytes;
use super::perceiver::Perceiver;
use super::piped::Piped;
use super::report::ArrayPort;
use super::sensor;
use super::spec::ArraySpec;
use crate::error::{Result, UsageError};
use crate::files::{garments, input};
use crate::recording::BoardRecording;
use serialport::SerialPortInfo;
use std::path::Path;
use std::sync::Arc;
use std::thread;
use std::time::Duration;
use taxel_core::capacity::TAXELS;
use taxel_core::format::Micros;
use taxel_core::garment::{ASSUMED_PITCH_UM, Garment, Layout};
use taxel_core::scene::Scene;

/// Frames of the first tare.
const TARE: u16 = 32;
/// Frames per second of a file whose format has no time.
const RATE: f64 = 50.0;
/// Largest code of a board.
const FULL_SCALE: u16 = 4095;

/// Opens an array.
pub fn open(spec: &ArraySpec, options: &SourceOptions) -> Result<Source> {
    opened(spec, options, tcp::CONNECT, None)
}

fn opened(
    spec: &ArraySpec,
    options: &SourceOptions,
    longest: Duration,
    lost: Option<&SerialPortInfo>,
) -> Result<Source> {
    let description = sensor::described(spec)?;
    let garment = garment(spec, &description, options)?;
    let rate = rate(spec)?;
    let mut serial = None;
    let has_datagrams = matches!(spec.link, ArrayLink::Udp(_));
    let link = |port| ArrayInput::Link { port, has_datagrams };
    let input = match &spec.link {
        ArrayLink::Serial { path, baud } => {
            let baud = baud.unwrap_or(description.link.baud);
            let info = match lost {
                Some(lost) => usb::found_again(lost, &options.ports)?,
                None => usb::named_port(path, &options.ports),
            };
            let port = options.ports.open(&info.port_name, baud)?;
            serial = Some(info);
            link(port)
        }
        ArrayLink::Tcp(address) => link(Box::new(tcp::Tcp::open(address, longest)?)),
        ArrayLink::Listen(port) => link(Box::new(Listener::open(*port)?)),
        ArrayLink::Udp(port) => link(Box::new(Datagrams::open(*port)?)),
        ArrayLink::File(path) => match recording(path) {
            Some(recording) => ArrayInput::Recorded(Box::new(RecordedBytes::open(&recording)?)),
            None => link(Box::new(Piped::new(input::open(path)?)?)),
        },
        ArrayLink::Stdin => link(Box::new(Piped::new(std::io::stdin())?)),
    };
    // A board has this name for as long as it may be asked for it.
    let name = short(spec);
    let firmware: &'static str =
        Box::leak(format!("taxel-host {} {name}", env!("CARGO_PKG_VERSION")).into_boxed_str());
    let mut board = SteppedBoard::new(garment, Scene::shipped(), firmware)?;
    board.tare(TARE, Micros(0))?;
    let (host, end) = pipe();
    let report = Arc::new(Shared::default());
    let perceiver = Perceiver {
        board,
        input,
        link: end,
        report: Arc::clone(&report),
        // A recording has the times of arrival, unless a rate is given.
        rate: matches!(&spec.link, ArrayLink::File(path) if recording(path).is_none() || spec.key("rate").is_some())
            .then_some(rate),
        is_paced: matches!(spec.link, ArrayLink::File(_)) && options.realtime,
        description: description.clone(),
        limits: Vec::new(),
        noise: NoiseMeter::default(),
    };
    let label = spec.to_string();
    thread::Builder::new().name(label.clone()).spawn(move || perceiver.run())?;
    let port = ArrayPort::new(host, report, about(&name, &description));
    let ends = matches!(spec.link, ArrayLink::File(_) | ArrayLink::Stdin);
    let source = match ends {
        true => Source::new(label, port),
        false => {
            let (spec, options) = (spec.clone(), options.clone());
            Source::real(label, port, move || opened(&spec, &options, tcp::RETURN, serial.as_ref()))
        }
    };
    Ok(Source { tare: TARE, has_asked_garment: options.garment.is_some(), ..source })
}

/// The recording that a file is, by its name; none if it holds an array's bytes alone.
fn recording(path: &Path) -> Option<BoardRecording> {
    let recording = BoardRecording::from(path);
    let is_mcap = recording.path.extension().is_some_and(|end| end.eq_ignore_ascii_case("mcap"));
    is_mcap.then_some(recording)
}

/// The garment: one panel of the description's size, unless the user names another one of as many taxels.
fn garment(spec: &ArraySpec, description: &ArrayDescription, options: &SourceOptions) -> Result<Garment> {
    let [rows, columns] = description.shape();
    let Some(asked) = &options.garment else {
        return Ok(Garment::grid(&short(spec), rows, columns, description.pitch_um.unwrap_or([0, 0])));
    };
    let read = garments::read(asked)?;
    let layout = Layout::build(&read.garment, TAXELS, FULL_SCALE).map_err(|error| read.error(&error))?;
    let (taxels, values) = (layout.taxels(), usize::from(rows) * usize::from(columns));
    require!(
        taxels == values,
        UsageError::Argument,
        "garment {asked} has {taxels} taxels, a frame of {spec} {values}"
    );
    Ok(read.garment)
}

/// Name of a format, or of the file that describes it.
fn short(spec: &ArraySpec) -> String {
    let stem = Path::new(&spec.format).file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

fn rate(spec: &ArraySpec) -> Result<f64> {
    let Some(rate) = spec.key("rate") else { return Ok(RATE) };
    match rate.parse::<f64>() {
        Ok(rate) if (0.1..=10_000.0).contains(&rate) => Ok(rate),
        _ => fail!(UsageError::Argument, "{spec}: `rate`: \"{rate}\" must be 0.1 to 10000 frames per second"),
    }
}

/// Words about a sensor.
fn about(name: &str, description: &ArrayDescription) -> String {
    let ([rows, columns], [low, high]) = (description.shape(), description.range.unwrap_or_default());
    let what = match description.change_of.is_empty() {
        true => "",
        false => ", the change of a magnetic field and no force",
    };
    let unit = description.unit.as_ref().map_or(String::new(), |unit| format!(" {unit}"));
    let falls = if description.falling { ", falling" } else { "" };
    let pitch = match description.pitch_um {
        None => format!("taxels assumed {} mm apart (pitch_mm=N)", ASSUMED_PITCH_UM / 1000),
        Some([x, y]) => format!("taxels {} x {} mm apart", f64::from(x) / 1e3, f64::from(y) / 1e3),
    };
    format!("{name}, {rows} x {columns}, perceived by this host: {low} to {high}{unit}{falls}{what}, {pitch}")
}
