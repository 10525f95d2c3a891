//! Arguments of `taxel live`, and those shared by every command that configures a board before it watches it.

use crate::fault::Fault;
use anyhow::{Result, bail};
use clap::Args;
use std::path::PathBuf;
use taxel::body::posture::Motion;
use taxel::robot::{BoardConfig, ConfigPlace, ReadRobot, RobotBoard, read_board};
use taxel::session::{POSES, POSES_HZ, Posing};
use taxel::source::{SourceOptions, SourceSpec};

/// Heading of the options about the way to a board, in the help.
const CONNECT: &str = "Connect";
/// Heading of the options about what is asked of a board.
const SET: &str = "Set";

/// A board, and what is requested of it before it is watched.
#[derive(Debug, Clone, Default, Args)]
pub struct BoardArgs {
    /// A source, as --source takes it: a board, the path of a port, a recording (.mcap), a robot's file (.toml: all
    /// its boards; .toml#BOARD: one), or another tactile array (FORMAT:LINK, such as flexitac:/dev/ttyUSB0)
    #[arg(value_name = "SOURCE", conflicts_with = "source")]
    pub place: Option<SourceSpec>,
    /// The board.
    #[command(flatten)]
    pub config: BoardConfig,
    /// Wait for the board if it cannot be opened yet, instead of ending with an error
    #[arg(long, help_heading = CONNECT)]
    pub wait: bool,
    /// Robot that carries the garment: a URDF file or `reference`. Positions of its joints become poses of the
    /// body's links, for contacts in the robot's base
    #[arg(long, value_name = "URDF", requires = "body", help_heading = SET)]
    pub robot: Option<String>,
    /// Positions of the joints, a JSON object a line: {"time_us": 5128, "positions": {"left_elbow": 0.5}}, in
    /// rad or m, at the board's time, the host's (host_time_us), or now; - for the standard input
    #[arg(long, value_name = "FILE", requires = "robot", help_heading = SET)]
    pub joint_states: Option<PathBuf>,
    /// Poses of the links sent to the board per second [default: 50]
    #[arg(long, value_name = "HZ", value_parser = poses_hz, allow_negative_numbers = true, help_heading = SET)]
    pub poses: Option<f64>,
    /// Bounds of the joints' motion, for the error of places in the base: angular=20 rad/s2, linear=5 m/s2,
    /// angular_velocity=10 rad/s, angular_error=0 rad, linear_error=0 m
    #[arg(long, value_name = "NAME=VALUE,...", help_heading = SET)]
    pub motion: Option<Motion>,
    /// End when the connection to the board is lost, instead of waiting for the board
    #[arg(long, help_heading = CONNECT)]
    pub once: bool,
    /// Seed of the simulation
    #[arg(long, value_name = "N", help_heading = CONNECT)]
    pub seed: Option<u64>,
    /// Ask the boards of a robot's file while they are followed, by lines: `tare [BOARD] [N]`, `scene [BOARD] FILE`,
    /// `self-test [BOARD]`, `host_input NAME VALUE [AGE_MS]`; - is the standard input
    #[arg(long, value_name = "FILE", help_heading = SET)]
    pub requests: Option<PathBuf>,
}

impl BoardArgs {
    /// A source with all options at their defaults.
    pub fn of(source: SourceSpec) -> BoardArgs {
        BoardArgs { config: BoardConfig::of(source), ..BoardArgs::default() }
    }

    /// The board, with the files that its options name. Error if one cannot be read, or is none of its kind.
    pub fn read(&self) -> Result<RobotBoard> {
        let option =
            self.requests.as_ref().map(|_| "--requests: this follows one board, which is asked by options");
        option.map_or(Ok(()), |why| bail!(Fault::usage(why)))?;
        let config = BoardConfig { source: self.named().cloned(), ..self.config.clone() };
        Ok(read_board(&config, ConfigPlace::Options)?)
    }

    /// The robot whose boards are all meant; none for a board.
    pub fn robot(&self) -> Result<Option<ReadRobot>> {
        let Some(SourceSpec::Robot { file, board: None }) = self.named() else { return Ok(None) };
        let of_one = [
            ("--robot", self.robot.is_some(), "name its `urdf` in the file"),
            ("--joint-states", self.joint_states.is_some(), "--requests has them"),
            ("--once", self.once, "a lost board is waited for"),
        ];
        if let Some((option, _, why)) = of_one.into_iter().find(|(_, is_there, _)| *is_there) {
            bail!(Fault::usage(format!(
                "{option} is for a board, {} is a robot's file: {why}",
                file.display()
            )));
        }
        let mut robot = ReadRobot::read_with(file, &self.config)?;
        robot.poses = self.poses.or(robot.poses);
        robot.motion = self.motion.or(robot.motion);
        let requests = self.requests.iter().filter(|path| path.as_os_str() != "-");
        robot.inputs.extend(requests.map(|path| path.display().to_string()));
        Ok(Some(robot))
    }

    /// Options of sources that are shown or offered: simulations take their time, and are repeated.
    pub fn at_real_time(&self, seconds: Option<f64>) -> SourceOptions {
        let seed = self.seed;
        SourceOptions { seed, realtime: true, repeat: true, seconds, ..SourceOptions::default() }
    }

    /// The source that was named; none for the board that is plugged in.
    pub fn named(&self) -> Option<&SourceSpec> {
        self.place.as_ref().or(self.config.source.as_ref())
    }

    /// The source.
    pub fn source(&self) -> SourceSpec {
        self.named().cloned().unwrap_or(SourceSpec::Auto)
    }

    /// Paths of the input files, which no output may replace. A preset's name is among them like a path.
    pub fn files(&self) -> Vec<PathBuf> {
        let (place, robot) =
            (self.place.as_ref().and_then(SourceSpec::file), self.robot.as_ref().map(PathBuf::from));
        self.config.files().into_iter().chain(place).chain(robot).chain(self.joint_states.clone()).collect()
    }

    /// Option that configures the board, if there is one.
    pub fn configures(&self) -> Option<&'static str> {
        self.config.configures().next().or(self.robot.as_ref().map(|_| "robot"))
    }

    /// Refuses options that configure the board if `label` names a recording.
    pub fn check_recorded(&self, label: &str) -> Result<()> {
        match self.configures() {
            Some(option) => {
                bail!(Fault::usage(format!(
                    "--{option}: {label} is a recording, whose board does not listen"
                )))
            }
            None => Ok(()),
        }
    }

    /// Reads the robot that carries the garment, if one is named.
    pub fn posing(&self) -> Result<Option<Posing>> {
        let Some((robot, body)) = self.robot.as_ref().zip(self.config.body.as_ref()) else { return Ok(None) };
        let motion = self.motion.unwrap_or_default();
        Ok(Some(Posing::open(body, robot, motion, self.poses.unwrap_or(POSES_HZ))?))
    }
}

/// Parses a rate of poses.
fn poses_hz(text: &str) -> Result<f64, String> {
    let rate = text.parse().ok().filter(|rate| POSES.contains(rate));
    rate.ok_or_else(|| format!("must be {} to {}", POSES.start(), POSES.end()))
}

/// Parses a time of the command line, such as 2s or 10min: in s.
pub fn time(text: &str) -> Result<f64, String> {
    let time = humantime::parse_duration(text).map_err(|_| "must be a time such as 500ms, 2s or 10min")?;
    Ok(time.as_secs_f64())
}
