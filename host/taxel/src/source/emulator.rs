//! The firmware image in the RP2040 emulator, with a scene on its pins.

use super::tcp::{CONNECT, Tcp};
use super::{Port, Source, SourceOptions};
use crate::error::{Result, SourceError};
use crate::files::scripts;
use crate::sim::{self, COUNTS_PER_NEWTON, FRAME_PERIOD_US, FULL_SCALE, frame_codes, wiring_json};
use serde_json::Value;
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::SystemTime;
use taxel_core::garment::{Circuit, Garment, Layout, Pins};

/// File name of the harness.
const PROGRAM: &str = "emulator.mjs";
/// Path of the image in cargo's target folder.
const IMAGE: &str = "thumbv6m-none-eabi/release/taxel-firmware";
/// Code of an unwired pin.
const IDLE: &str = "90";

/// Starts the emulator and connects to its UART.
pub fn open(scene: &str, options: &SourceOptions) -> Result<Source> {
    let harness = harness()?;
    let image = image(&harness)?;
    let script = scripts::load(scene)?;
    let garment = scripts::garment(&script)?;
    if garment != Garment::reference() {
        fail!(
            SourceError::Unstarted,
            "emulator:{scene}: the image starts with the garment reference, the scene wants {}",
            garment.name
        );
    }
    let asked = options.seconds.map_or(0, |s| (s * 1e6) as u64 / FRAME_PERIOD_US);
    let length = (script.duration_s * 1e6) as u64 / FRAME_PERIOD_US;
    let frames = length.max(options.frames.unwrap_or(0)).max(asked) + 1;
    let seeded = sim::Script { seed: options.seed.unwrap_or(script.seed), ..script.clone() };
    let folder = TempFolder::new()?;
    let codes = frame_codes(
        &seeded,
        &garment,
        FRAME_PERIOD_US,
        if options.repeat { length } else { frames } as usize,
    )?;
    std::fs::write(
        folder.0.join("codes.bin"),
        codes.iter().flat_map(|c| c.to_le_bytes()).collect::<Vec<_>>(),
    )?;
    std::fs::write(folder.0.join("wiring.json"), wiring(&garment)?.to_string())?;
    let mut node = Command::new("node");
    node.arg(harness.join(PROGRAM)).arg("--image").arg(image).args(["--port", "0", "--idle", IDLE]);
    node.arg("--wiring").arg(folder.0.join("wiring.json")).arg("--codes").arg(folder.0.join("codes.bin"));
    if options.repeat {
        node.arg("--loop");
    } else if options.frames.is_none() {
        node.arg("--until-frames").arg(frames.to_string());
    }
    if options.realtime {
        node.arg("--realtime");
    }
    let port = Emulator::start(node, folder)?;
    let tare = script.tare_frames.min(4096) as u16;
    let label = format!("emulator:{scene}");
    Ok(Source { tare, counts_per_newton: Some(COUNTS_PER_NEWTON), ..Source::new(label, port) })
}

fn wiring(garment: &Garment) -> Result<Value> {
    let layout = Layout::build(garment, usize::from(u16::MAX), FULL_SCALE)?;
    let circuit = Circuit::build(garment, &layout, Pins::ANY)?;
    Ok(wiring_json(garment, &layout, &circuit)?)
}

/// Folder of the harness: `TAXEL_EMULATOR`, or found upwards from the working folder.
fn harness() -> Result<PathBuf> {
    let folder = match std::env::var_os("TAXEL_EMULATOR").map(PathBuf::from) {
        Some(told) => {
            let folder =
                if told.is_file() { told.parent().map(Path::to_path_buf) } else { Some(told.clone()) };
            folder.filter(|folder| folder.join(PROGRAM).is_file()).ok_or_else(|| {
                error!(SourceError::Unstarted, "TAXEL_EMULATOR={} has no {PROGRAM}", told.display())
            })?
        }
        None => std::env::current_dir()?
            .ancestors()
            .map(|above| above.join("tests/emulator"))
            .find(|folder| folder.join(PROGRAM).is_file())
            .ok_or_else(|| {
                error!(
                    SourceError::Unstarted,
                    "there is no tests/emulator/{PROGRAM} here or above; set TAXEL_EMULATOR to its folder"
                )
            })?,
    };
    if !folder.join("node_modules").is_dir() {
        fail!(SourceError::Unstarted, "the emulator is not installed: run `npm ci` in {}", folder.display());
    }
    Ok(folder)
}

/// The newest firmware image: `TAXEL_FIRMWARE`, or where `cargo xtask firmware` writes it.
fn image(harness: &Path) -> Result<PathBuf> {
    if let Some(told) = std::env::var_os("TAXEL_FIRMWARE").map(PathBuf::from) {
        return if told.is_file() {
            Ok(told)
        } else {
            fail!(SourceError::Unstarted, "TAXEL_FIRMWARE={} is not a file", told.display())
        };
    }
    let told = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    let repository = harness.ancestors().nth(2).map(|root| root.join("target"));
    let built = |path: &PathBuf| path.metadata().and_then(|m| m.modified()).unwrap_or(SystemTime::UNIX_EPOCH);
    // Each toolchain has a folder of its own.
    let ways =
        told.into_iter().chain(repository).filter_map(|target| target.join("firmware").read_dir().ok());
    ways.flatten()
        .filter_map(|way| Some(way.ok()?.path().join(IMAGE)))
        .filter(|path| path.is_file())
        .max_by_key(built)
        .ok_or_else(|| {
            error!(SourceError::Unstarted, "there is no firmware image: build it with `cargo xtask firmware`")
        })
}

/// A folder that is deleted with its owner.
struct TempFolder(PathBuf);

impl TempFolder {
    fn new() -> io::Result<TempFolder> {
        let stamp = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).map_or(0, |d| d.as_nanos());
        let path = std::env::temp_dir().join(format!("taxel-emulator-{}-{stamp}", std::process::id()));
        std::fs::create_dir_all(&path)?;
        Ok(TempFolder(path))
    }
}

impl Drop for TempFolder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// A running emulator and the connection to its UART.
struct Emulator {
    child: Child,
    tcp: Tcp,
    _folder: TempFolder,
}

impl Emulator {
    fn start(mut node: Command, folder: TempFolder) -> Result<Emulator> {
        let spawned = node.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = spawned.map_err(|error| {
            error!(SourceError::Unstarted, "node, which runs the emulator, cannot be started: {error}")
        })?;
        match connect(&mut child) {
            Ok(tcp) => Ok(Emulator { child, tcp, _folder: folder }),
            Err(error) => {
                stop(&mut child);
                Err(error)
            }
        }
    }
}

/// Connects to the port that the harness prints in its first line.
fn connect(child: &mut Child) -> Result<Tcp> {
    let mut out = BufReader::new(
        child.stdout.take().ok_or_else(|| error!(SourceError::Unstarted, "the emulator has no output"))?,
    );
    let mut line = String::new();
    out.read_line(&mut line)?;
    let told: Value = serde_json::from_str(&line)
        .map_err(|_| error!(SourceError::Unstarted, "the emulator ended before it began"))?;
    let port = told["port"]
        .as_u64()
        .ok_or_else(|| error!(SourceError::Unstarted, "the emulator printed no port, but {}", line.trim()))?;
    // Further output is drained, so that the emulator never blocks on it.
    std::thread::spawn(move || io::copy(&mut out, &mut io::sink()));
    Tcp::open(&format!("127.0.0.1:{port}"), CONNECT)
}

fn stop(child: &mut Child) {
    let asked = child.stdin.take().map(|mut input| input.write_all(b"quit\n"));
    if asked.is_none() || child.try_wait().is_ok_and(|status| status.is_none()) {
        let _ = child.kill();
    }
    let _ = child.wait();
}

impl Port for Emulator {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<Option<usize>> {
        self.tcp.read(buffer)
    }

    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.tcp.write(bytes)
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        stop(&mut self.child);
    }
}
