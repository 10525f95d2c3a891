//! A source by its name: `sim:pat`, the path of a port, of a recording or of a robot's file.

use super::array::{ArrayLink, ArraySpec};
use super::replay::Speed;
use crate::network::BoardPlace;
use crate::recording::BoardRecording;
use crate::text::words;
use std::fmt;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// Default speed of a serial port, Bd.
const BAUD: u32 = 921_600;
/// Default script of touches.
const SCENE: &str = "pat";

/// A source of a stream.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum SourceSpec {
    /// The board that is plugged in: on USB, else behind a probe.
    Auto,
    /// The board on USB; with a serial number the board, or the probe before it, of this number.
    Usb(Option<String>),
    /// A simulated board that plays this script of touches.
    Sim(String),
    /// A serial port.
    Serial {
        /// The device.
        path: String,
        /// Bits per second.
        baud: u32,
    },
    /// `HOST:PORT`
    Tcp(String),
    /// A board that another machine offers over Zenoh.
    Zenoh {
        /// Name of the board.
        place: BoardPlace,
        /// Zenoh's configuration; none for that of the environment, else for this machine.
        config: Option<PathBuf>,
    },
    /// The boards of a robot's file, or the one of this name.
    Robot {
        /// The file.
        file: PathBuf,
        /// Name of the board; none for all.
        board: Option<String>,
    },
    /// An array of others, perceived by this host.
    Array(ArraySpec),
    /// A recording.
    Replay {
        /// The file, and the board to play of a robot's.
        recording: BoardRecording,
        /// Speed of the replay.
        speed: Speed,
    },
}

impl SourceSpec {
    /// The default simulation.
    pub fn simulation() -> SourceSpec {
        SourceSpec::Sim(SCENE.into())
    }

    /// Returns where its board is, the same for all names of a place: a port's number or path, an address; none if
    /// any board may be there, or a simulated one.
    pub fn place(&self) -> Option<String> {
        match self {
            SourceSpec::Usb(number) => number.clone(),
            SourceSpec::Array(ArraySpec { link, .. }) => match link {
                ArrayLink::Serial { path, .. } => {
                    SourceSpec::Serial { path: path.clone(), baud: BAUD }.place()
                }
                ArrayLink::Tcp(address) => Some(address.clone()),
                ArrayLink::File(_) => None,
                link => Some(link.to_string()),
            },
            SourceSpec::Serial { path, .. } => {
                let resolved = std::fs::canonicalize(path);
                // A port that is not there has at least no doubled slashes.
                let path = resolved.unwrap_or_else(|_| Path::new(path).components().collect());
                Some(path.display().to_string())
            }
            SourceSpec::Tcp(address) => Some(address.clone()),
            SourceSpec::Zenoh { place, .. } => Some(place.to_string()),
            _ => None,
        }
    }

    /// The source with its file's path as `beside` makes it.
    pub fn beside(&self, beside: &mut dyn FnMut(&str) -> String) -> SourceSpec {
        let mut path = |path: &Path| PathBuf::from(beside(&path.display().to_string()));
        match self.clone() {
            SourceSpec::Sim(script) => SourceSpec::Sim(beside(&script)),
            SourceSpec::Robot { file, board } => SourceSpec::Robot { file: path(&file), board },
            SourceSpec::Replay { recording: BoardRecording { path: file, board }, speed } => {
                SourceSpec::Replay { recording: BoardRecording { path: path(&file), board }, speed }
            }
            SourceSpec::Zenoh { place, config } => {
                SourceSpec::Zenoh { place, config: config.map(|file| path(&file)) }
            }
            SourceSpec::Array(mut spec) => {
                if spec.is_described_by_file() {
                    spec.format = beside(&spec.format);
                }
                if let ArrayLink::File(file) = &spec.link {
                    spec.link = ArrayLink::File(beside(&file.display().to_string()).into());
                }
                SourceSpec::Array(spec)
            }
            other => other,
        }
    }

    /// Path of its file, if it has one, which no output may replace.
    pub fn file(&self) -> Option<PathBuf> {
        match self {
            SourceSpec::Replay { recording: BoardRecording { path, .. }, .. } => Some(path.clone()),
            SourceSpec::Sim(scene) => Some(scene.into()),
            SourceSpec::Robot { file, .. } => Some(file.clone()),
            SourceSpec::Zenoh { config, .. } => config.clone(),
            SourceSpec::Array(ArraySpec { link: ArrayLink::File(file), .. }) => Some(file.clone()),
            SourceSpec::Array(spec) if spec.is_described_by_file() => Some(spec.format.clone().into()),
            _ => None,
        }
    }
}

impl FromStr for SourceSpec {
    type Err = String;

    fn from_str(text: &str) -> Result<SourceSpec, String> {
        if let Some(array) = ArraySpec::read(text) {
            return array.map(SourceSpec::Array);
        }
        let (kind, rest) = text.split_once(':').map_or((text, None), |(kind, rest)| (kind, Some(rest)));
        match (kind, rest) {
            ("auto", None) => Ok(SourceSpec::Auto),
            ("usb", None) => Ok(SourceSpec::Usb(None)),
            ("usb", Some(number)) if !number.is_empty() => Ok(SourceSpec::Usb(Some(number.into()))),
            ("sim", None) => Ok(SourceSpec::simulation()),
            ("sim", Some(scene)) if !scene.is_empty() => Ok(SourceSpec::Sim(scene.into())),
            ("serial", Some(port)) if !port.is_empty() => serial(port),
            ("tcp", Some(address)) => tcp(address),
            ("zenoh", Some(place)) => zenoh(place),
            ("replay", Some(path)) if !path.is_empty() => Ok(replay(path)),
            _ => by_path(text).unwrap_or_else(|| Err(unknown(kind, rest))),
        }
    }
}

/// A port, a recording or a robot's file by its path; none if it is none.
fn by_path(text: &str) -> Option<Result<SourceSpec, String>> {
    let is_com =
        text.strip_prefix("COM").is_some_and(|number| number.starts_with(|c: char| c.is_ascii_digit()));
    let (path, board) = text.rsplit_once('#').map_or((text, None), |(path, board)| (path, Some(board)));
    if text.starts_with("/dev/") || is_com {
        Some(serial(text))
    } else if text.contains(".mcap") {
        Some(Ok(replay(text)))
    } else if path.ends_with(".toml") {
        Some(Ok(SourceSpec::Robot { file: path.into(), board: board.map(String::from) }))
    } else {
        None
    }
}

/// Returns what sources there are, and which one may be meant.
fn unknown(kind: &str, rest: Option<&str>) -> String {
    let kinds = ["auto", "usb", "sim", "serial", "tcp", "zenoh", "replay"];
    let meant = words::meant(kind, kinds).filter(|meant| *meant != kind);
    let meant = meant.map(|meant| rest.map_or(meant.into(), |rest| format!("{meant}:{rest}")));
    let meant = meant.map_or(String::new(), |meant| format!("did you mean {meant}? "));
    meant
        + "known are auto, usb[:SERIAL], sim[:TOUCHES], serial:PATH[@BAUD], tcp:HOST:PORT, \
           zenoh:ROBOT/BOARD[@FILE], replay:FILE[#BOARD][@SPEED], the path of a port, of a recording (.mcap) or of a \
           robot's file (.toml[#BOARD]), and FORMAT:LINK[,KEY=VALUE...] for another tactile array, of FORMAT "
        + &ArraySpec::formats()
        + " or a description (.toml)"
}

fn serial(port: &str) -> Result<SourceSpec, String> {
    let Some((path, baud)) = port.rsplit_once('@') else {
        return Ok(SourceSpec::Serial { path: port.into(), baud: BAUD });
    };
    match baud.parse() {
        Ok(baud) if baud > 0 && !path.is_empty() => Ok(SourceSpec::Serial { path: path.into(), baud }),
        _ => Err(format!("serial:PATH@BAUD needs a whole number of bits per second, not \"{baud}\"")),
    }
}

/// Text behind the last `@` that is not a speed belongs to the file name.
fn replay(text: &str) -> SourceSpec {
    let (path, speed) = match text.rsplit_once('@').map(|(path, speed)| (path, speed.parse())) {
        Some((path, Ok(speed))) if !path.is_empty() => (path, speed),
        _ => (text, Speed::AsAsked),
    };
    SourceSpec::Replay { recording: path.into(), speed }
}

fn tcp(address: &str) -> Result<SourceSpec, String> {
    match address.rsplit_once(':') {
        Some((host, port)) if !host.is_empty() && port.parse::<u16>().is_ok() => {
            Ok(SourceSpec::Tcp(address.into()))
        }
        _ => Err("tcp:HOST:PORT needs a host and a port number of 0 to 65535".into()),
    }
}

fn zenoh(text: &str) -> Result<SourceSpec, String> {
    let (place, config) = text.split_once('@').map_or((text, None), |(place, file)| (place, Some(file)));
    if config.is_some_and(str::is_empty) {
        return Err("zenoh:ROBOT/BOARD@FILE needs a file".into());
    }
    Ok(SourceSpec::Zenoh { place: place.parse()?, config: config.map(PathBuf::from) })
}

impl fmt::Display for SourceSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SourceSpec::Auto => f.write_str("auto"),
            SourceSpec::Usb(None) => f.write_str("usb"),
            SourceSpec::Usb(Some(number)) => write!(f, "usb:{number}"),
            SourceSpec::Sim(scene) => write!(f, "sim:{scene}"),
            SourceSpec::Serial { path, baud } => write!(f, "serial:{path}@{baud}"),
            SourceSpec::Tcp(address) => write!(f, "tcp:{address}"),
            SourceSpec::Zenoh { place, config } => {
                let config = config.as_ref().map_or(String::new(), |file| format!("@{}", file.display()));
                write!(f, "zenoh:{place}{config}")
            }
            SourceSpec::Robot { file, board } => {
                let board = board.as_ref().map_or(String::new(), |board| format!("#{board}"));
                write!(f, "{}{board}", file.display())
            }
            SourceSpec::Array(spec) => spec.fmt(f),
            SourceSpec::Replay { recording, speed } => write!(f, "replay:{recording}{speed}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn a_port_is_one_place_whatever_it_is_called() {
        let link = std::env::temp_dir().join(format!("taxel-null-{}", std::process::id()));
        std::os::unix::fs::symlink("/dev/null", &link).unwrap();
        let place = |text: &str| text.parse::<SourceSpec>().unwrap().place();
        let known = place("serial:/dev/null");
        assert_eq!(known.as_deref(), Some("/dev/null"));
        let others = ["serial:/dev/null@115200", "serial:/dev//null@115200", "serial:/dev/./null"].map(place);
        assert!(
            others
                .into_iter()
                .chain([place(&format!("serial:{}", link.display()))])
                .all(|other| other == known)
        );
        std::fs::remove_file(&link).unwrap();
        assert_eq!(place("serial:/dev//none@9600"), place("serial:/dev/none"));
        assert_ne!(place("serial:/dev/none"), known);
        assert_eq!([place("usb:A1"), place("usb"), place("sim:pat")], [Some("A1".into()), None, None]);
    }

    #[test]
    fn words_are_read_and_written() {
        for text in [
            "auto",
            "usb",
            "usb:E6616407E3:1",
            "sim:pat",
            "serial:/dev/ttyACM0@115200",
            "tcp:[::1]:80",
            "zenoh:arm/left",
            "zenoh:arm/left@a/b@c.json5",
            "sim:x/y.toml",
            "replay:a@b.mcap",
            "replay:a.mcap@2.5",
            "replay:a.mcap@max",
            "replay:a.mcap#left-arm@2",
            "replay:a#b.mcap",
            "a/robot.toml",
            "robot.toml#left-arm",
            "flexitac:/dev/ttyUSB0,rows=12",
            "mat.toml:COM5@9600",
        ] {
            assert_eq!(text.parse::<SourceSpec>().unwrap().to_string(), text);
        }
        let read = |text: &str| text.parse::<SourceSpec>();
        let robot = SourceSpec::Replay { recording: "a#b".into(), speed: Speed::Max };
        assert_eq!(read("replay:a#b@max").unwrap(), robot);
        assert_eq!(robot.file(), Some("a".into()));
        assert_eq!(read("sim").unwrap(), SourceSpec::simulation());
        assert_eq!(read("serial:COM3").unwrap().to_string(), "serial:COM3@921600");
        let by_path = ["/dev/ttyACM0", "COM3@9600", "pat.mcap", "a/robot.mcap#hand@max"]
            .map(|text| read(text).unwrap());
        let named = [
            "serial:/dev/ttyACM0@921600",
            "serial:COM3@9600",
            "replay:pat.mcap",
            "replay:a/robot.mcap#hand@max",
        ];
        assert_eq!(by_path.map(|spec| spec.to_string()), named);
        assert!(read("sm:pat").unwrap_err().starts_with("did you mean sim:pat? known are auto, "));
        assert!(read("Usb").unwrap_err().starts_with("did you mean usb? "));
        for wrong in [
            "",
            "auto:",
            "sim:",
            "serial:",
            "serial:a@b",
            "tcp:a",
            "tcp:a:99999",
            "tcp::1",
            "zenoh",
            "zenoh:arm",
            "zenoh:arm/left/2",
            "zenoh:arm/left@",
            "file:a",
            "usb:",
            "replay:",
        ] {
            assert!(read(wrong).is_err(), "{wrong}");
        }
    }
}
