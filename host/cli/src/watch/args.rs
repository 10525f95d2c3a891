//! Arguments of `taxel live`, and those shared by every command that configures a board before it watches it.

use super::{GestureModel, Overwrite, TaxelPlace, feed, forms};
use crate::fault::Fault;
use anyhow::{Result, bail};
use clap::Args;
use std::path::PathBuf;
use taxel::body::posture::Motion;
use taxel::session::{POSES, POSES_HZ, Posing};
use taxel::source::SourceSpec;
use taxel_core::intent::Feed;

/// A board, and what is requested of it before it is watched.
#[derive(Debug, Clone, Args)]
pub struct BoardArgs {
    /// `auto`, `usb[:SERIAL]`, `sim[:TOUCHES]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`,
    /// `zenoh:ROBOT/BOARD[@FILE]`, `emulator[:TOUCHES]`, `file:FILE` or `replay:FILE[#BOARD][@SPEED]`
    /// [default: auto, the board that is plugged in]
    #[arg(long, value_name = "SOURCE")]
    pub source: Option<SourceSpec>,
    /// Wait for the board if it cannot be opened yet, instead of ending with an error
    #[arg(long)]
    pub wait: bool,
    /// Garment to send to the board, real or simulated: a preset or a TOML file
    #[arg(long, value_name = "G")]
    pub garment: Option<String>,
    /// Scene to send to the board: a TOML file; missing keys have the shipped values
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    /// Calibration to send to the board, for forces in newtons: a file written by `taxel calibrate`
    #[arg(long, value_name = "FILE")]
    pub calibration: Option<PathBuf>,
    /// Take the mean of the first N frames as the baseline [default: that of a simulated scene, else 0]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=4096))]
    pub tare: Option<u16>,
    /// Timing reports of the board per second; 65535: one for each frame [default: 1]
    #[arg(long, value_name = "HZ")]
    pub budget: Option<u16>,
    /// Gesture model to run on the board
    #[arg(long, value_name = "MODEL", value_enum)]
    pub gestures: Option<GestureModel>,
    /// With --gestures: scale factor from the garment's counts to those that the model was trained on
    /// [default: 1]
    #[arg(long, value_name = "G", requires = "gestures")]
    pub gesture_gain: Option<f64>,
    /// With --gestures: announce a class once the model's confidence reaches this share, 0 to 0.999; the
    /// board keeps this until it restarts [default: when it has led for 250 ms]
    #[arg(long, value_name = "SHARE", requires = "gestures")]
    pub gesture_certainty: Option<f64>,
    /// Number of contacts per frame, in turn, whose form (outline, azimuth, breadth, shape) is computed: 1 to
    /// 254, or all; also requests the ages of the forms. The board keeps this until it restarts [default: 1]
    #[arg(long, value_name = "N", value_parser = forms)]
    pub forms: Option<u8>,
    /// Set a concept: value, -1 to 1; its age; the age from which the value expires [default: never]; the
    /// value that replaces it then [default: 0]
    #[arg(long, value_name = "NAME=VALUE[,AGE_MS[,TIMEOUT_MS[,DEFAULT]]]", value_parser = feed)]
    pub feed: Vec<Feed>,
    /// Base of shapes to send to the board: a file, or the name of a shipped base
    #[arg(long, value_name = "BASE")]
    pub shapes: Option<PathBuf>,
    /// Body of the garment, which the board stores, to report what presses on each link: a TOML file or
    /// `reference`
    #[arg(long, value_name = "BODY")]
    pub body: Option<String>,
    /// Table of what the garment's folds press, which the board stores: a file of `taxel body learn`
    #[arg(long, value_name = "FILE")]
    pub folds: Option<PathBuf>,
    /// Reports per second of what presses on each link, of a board that has a body; 65535: one for each frame
    /// [default: 65535 with --body, else 0]
    #[arg(long, value_name = "HZ")]
    pub pressing: Option<u16>,
    /// Robot that wears the garment: a URDF file or `reference`. Positions of its joints become poses of the
    /// body's links, for contacts in the robot's base
    #[arg(long, value_name = "URDF", requires = "body")]
    pub robot: Option<String>,
    /// Positions of the joints, a JSON object a line: {"time_us": 5128, "positions": {"left_elbow": 0.5}}, in
    /// rad or m, at the board's time, the host's (host_time_us), or now; - for the standard input
    #[arg(long, value_name = "FILE", requires = "robot")]
    pub joint_states: Option<PathBuf>,
    /// Poses of the links sent to the board per second [default: 50]
    #[arg(long, value_name = "HZ", requires = "robot", value_parser = poses_hz, allow_negative_numbers = true)]
    pub poses: Option<f64>,
    /// What bounds the joints' motion, for the error of places in the base: angular=20 rad/s2, linear=5 m/s2,
    /// angular_velocity=10 rad/s, angular_error=0 rad, linear_error=0 m
    #[arg(long, value_name = "NAME=VALUE,...", requires = "robot")]
    pub motion: Option<Motion>,
    /// End when the connection to the board is lost, instead of waiting for the board
    #[arg(long)]
    pub once: bool,
    /// Seed of the simulation
    #[arg(long, value_name = "N")]
    pub seed: Option<u64>,
}

impl BoardArgs {
    /// A source with all options at their defaults.
    pub fn of(source: SourceSpec) -> BoardArgs {
        BoardArgs {
            source: Some(source),
            wait: false,
            garment: None,
            scene: None,
            calibration: None,
            tare: None,
            budget: None,
            gestures: None,
            gesture_gain: None,
            gesture_certainty: None,
            forms: None,
            feed: Vec::new(),
            shapes: None,
            body: None,
            folds: None,
            pressing: None,
            robot: None,
            joint_states: None,
            poses: None,
            motion: None,
            once: false,
            seed: None,
        }
    }

    /// The source.
    pub fn source(&self) -> SourceSpec {
        self.source.clone().unwrap_or(SourceSpec::Auto)
    }

    /// Paths of the input files, which no output may replace. A preset's name is among them like a path.
    pub fn files(&self) -> Vec<PathBuf> {
        let text = |name: &Option<String>| name.clone().map(PathBuf::from);
        let named = [text(&self.garment), text(&self.body), text(&self.robot), self.source().file()];
        let told =
            [&self.scene, &self.calibration, &self.shapes, &self.folds, &self.joint_states].map(Clone::clone);
        named.into_iter().chain(told).flatten().collect()
    }

    /// Option that configures the board, if there is one.
    pub fn configures(&self) -> Option<&'static str> {
        let options = [
            ("--garment", self.garment.is_some()),
            ("--scene", self.scene.is_some()),
            ("--tare", self.tare.is_some()),
            ("--budget", self.budget.is_some()),
            ("--gestures", self.gestures.is_some()),
            ("--forms", self.forms.is_some()),
            ("--feed", !self.feed.is_empty()),
            ("--shapes", self.shapes.is_some()),
            ("--body", self.body.is_some()),
            ("--folds", self.folds.is_some()),
            ("--pressing", self.pressing.is_some()),
            ("--robot", self.robot.is_some()),
        ];
        options.into_iter().find(|(_, is_there)| *is_there).map(|(option, _)| option)
    }

    /// Refuses options that configure the board if `label` names a recording.
    pub fn check_recorded(&self, label: &str) -> Result<()> {
        match self.configures() {
            Some(option) => {
                bail!(Fault::usage(format!("{option}: {label} is a recording, whose board does not listen")))
            }
            None => Ok(()),
        }
    }

    /// Reads the robot that wears the garment, if one is named.
    pub fn posing(&self) -> Result<Option<Posing>> {
        let Some((robot, body)) = self.robot.as_ref().zip(self.body.as_ref()) else { return Ok(None) };
        let motion = self.motion.unwrap_or_default();
        Ok(Some(Posing::open(body, robot, motion, self.poses.unwrap_or(POSES_HZ))?))
    }
}

/// Arguments of `taxel live`.
#[derive(Debug, Clone, Args)]
pub struct LiveArgs {
    /// The board.
    #[command(flatten)]
    pub board: BoardArgs,
    /// Stop after N images
    #[arg(long, value_name = "N")]
    pub frames: Option<u64>,
    /// Stop after S seconds of the board's time [default: a simulated scene is played once; the terminal
    /// repeats it]
    #[arg(long, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    pub seconds: Option<f64>,
    /// Print messages as JSON, one per line
    #[arg(long)]
    pub json: bool,
    /// With --json: also print the pressure of every taxel
    #[arg(long, requires = "json")]
    pub pixels: bool,
    /// Also save the received bytes, for --source file:FILE
    #[arg(long, value_name = "FILE")]
    pub save: Option<PathBuf>,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// Print one taxel's time, code and pressure, frame by frame
    #[arg(long, value_name = "PANEL,ROW,COL")]
    pub taxel: Option<TaxelPlace>,
    /// The board may refuse the body, and reports of what presses on it: whoever watches can do without.
    #[arg(skip)]
    pub body_may_fail: bool,
    /// Raw codes are asked for.
    #[arg(skip)]
    pub raw: bool,
    /// Pace simulations to real time
    #[arg(long)]
    pub realtime: bool,
    /// Write the terminal's last picture as SVG
    #[arg(long, value_name = "FILE", hide = true)]
    pub svg: Option<PathBuf>,
}

impl LiveArgs {
    /// Everything from a source, with all options at their defaults.
    pub fn of(source: SourceSpec) -> LiveArgs {
        LiveArgs::on(BoardArgs::of(source))
    }

    /// Everything from a board, without limits.
    pub fn on(board: BoardArgs) -> LiveArgs {
        LiveArgs {
            board,
            frames: None,
            seconds: None,
            json: false,
            pixels: false,
            save: None,
            force: Overwrite::default(),
            taxel: None,
            body_may_fail: false,
            raw: false,
            realtime: false,
            svg: None,
        }
    }
}

/// Parses a rate of poses.
fn poses_hz(text: &str) -> Result<f64, String> {
    let rate = text.parse().ok().filter(|rate| POSES.contains(rate));
    rate.ok_or_else(|| format!("must be {} to {}", POSES.start(), POSES.end()))
}

/// Parses a time of the command line, s.
pub fn seconds(text: &str) -> Result<f64, String> {
    let time = text.parse().ok().filter(|time: &f64| time.is_finite() && *time >= 0.0);
    time.ok_or_else(|| "must be a time of 0 or more".into())
}
