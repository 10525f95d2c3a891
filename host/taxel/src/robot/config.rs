//! A robot's file as its author writes it.

use serde::Deserialize;

/// A robot of several boards: `robot.toml`. Paths are relative to the folder of the file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RobotConfig {
    /// Name of the robot.
    pub name: String,
    /// Its description: a URDF file, or `reference`.
    pub urdf: Option<String>,
    /// What touches mean to it: maps of a robot, TOML files or shipped ones, which are united; `robot` and
    /// `probe` if left out.
    pub maps: Option<Vec<String>>,
    /// Its boards.
    pub boards: Vec<BoardConfig>,
}

/// A board of a robot.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoardConfig {
    /// Its name: 1 to 32 letters, digits, `_` and `-`.
    pub name: String,
    /// Where it is found, as for `--source`.
    pub source: String,
    /// The garment that it wears: a preset or a TOML file. A board that wears another one is not this board.
    /// A simulated board is given this one.
    pub garment: Option<String>,
    /// Scene to send to it: a TOML file.
    pub scene: Option<String>,
    /// Calibration to send to it, for forces in newtons: a file written by `taxel calibrate`.
    pub calibration: Option<String>,
    /// Number of frames whose mean is the baseline, 0 to 4096; that of a simulated script, else 0, if left
    /// out.
    pub tare: Option<u16>,
    /// Where its panels lie on the robot's links: a TOML file, or `reference`.
    pub body: Option<String>,
    /// Link of the robot that wears the whole garment, if there is no body.
    pub link: Option<String>,
}
