//! A robot and its boards as their author writes them.

use super::feed::feed;
use super::forms_in_frame::FormsInFrame;
use super::gesture_model::GestureModel;
use crate::body::posture::Motion;
use crate::source::SourceSpec;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer};
use std::path::PathBuf;
use std::str::FromStr;
use taxel_core::intent::Feed;

/// A robot: `robot.toml`. Paths are relative to the folder of the file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RobotConfig {
    /// Name of the robot.
    pub name: String,
    /// Description of the robot: a URDF file, or `reference`.
    pub urdf: Option<String>,
    /// Poses of the links sent to each board per second; 50 if left out.
    pub poses: Option<f64>,
    /// Bounds on the joints' motion, for the error of places in the base, as for `--motion`.
    #[serde(default, deserialize_with = "parsed")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<String>"))]
    pub motion: Option<Motion>,
    /// Meaning of touches to it: maps of a robot, TOML files or shipped ones, which are united; `robot` and `probe`
    /// if left out.
    pub maps: Option<Vec<String>>,
    /// Boards of the robot.
    pub boards: Vec<BoardConfig>,
}

/// A board and what it is asked before its stream: the keys of a board of `robot.toml`, the options of commands that
/// follow a board, and the keywords of Python.
#[derive(Debug, Clone, Default, PartialEq, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
// clap would go on with the heading in the struct that has these options: the second form is called behind them.
#[cfg_attr(feature = "clap", command(next_help_heading = "Set", next_help_heading(None::<&'static str>)))]
#[serde(deny_unknown_fields)]
pub struct BoardConfig {
    /// Name in a robot: 1 to 32 letters, digits, `_` and `-`.
    #[cfg_attr(feature = "clap", arg(skip))]
    pub name: String,
    /// `auto`, `usb[:SERIAL]`, `sim[:TOUCHES]`, `serial:PATH[@BAUD]`, `tcp:HOST:PORT`,
    /// `zenoh:ROBOT/BOARD[@FILE]` or `replay:FILE[#BOARD][@SPEED]`
    /// [default: auto, the board that is plugged in]
    #[cfg_attr(feature = "clap", arg(long, value_name = "SOURCE", help_heading = "Connect"))]
    #[serde(default, deserialize_with = "source")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<String>"))]
    pub source: Option<SourceSpec>,
    /// Garment to send to the board, real or simulated: a preset or a TOML file. In a robot's file the garment by
    /// which a real board is recognised
    #[cfg_attr(feature = "clap", arg(long, value_name = "G"))]
    pub garment: Option<String>,
    /// Scene to send to the board: a TOML file; missing keys have the shipped values
    #[cfg_attr(feature = "clap", arg(long, value_name = "FILE"))]
    pub scene: Option<PathBuf>,
    /// Calibration to send to the board, for forces in newtons: a file written by `taxel calibrate`
    #[cfg_attr(feature = "clap", arg(long, value_name = "FILE"))]
    pub calibration: Option<PathBuf>,
    /// Take the mean of the first N frames, at most 4096, as the baseline [default: that of a simulated scene, else 0]
    #[cfg_attr(feature = "clap", arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=4096)))]
    #[cfg_attr(feature = "schema", schemars(range(max = 4096)))]
    pub tare: Option<u16>,
    /// Timing reports of the board per second; 65535: one for each frame [default: 1]
    #[cfg_attr(feature = "clap", arg(long, value_name = "HZ"))]
    pub budget: Option<u16>,
    /// Also the converter's raw code of every taxel
    #[cfg_attr(feature = "clap", arg(long))]
    #[serde(default)]
    pub raw: bool,
    /// Gesture model to run on the board
    #[cfg_attr(feature = "clap", arg(long, value_name = "MODEL", value_enum))]
    pub gestures: Option<GestureModel>,
    /// With gestures: scale factor from the garment's counts to those that the model was trained on [default: 1]
    #[cfg_attr(feature = "clap", arg(long, value_name = "G", requires = "gestures"))]
    pub gesture_gain: Option<f64>,
    /// With gestures: announce a class once the model's confidence reaches this share, 0 to 0.999; the board keeps this
    /// until it restarts [default: when it has led for 250 ms]
    #[cfg_attr(feature = "clap", arg(long, value_name = "SHARE", requires = "gestures"))]
    pub gesture_certainty: Option<f64>,
    /// Number of contacts per frame, in turn, whose form (outline, azimuth, breadth, shape) is computed: 1 to 254, or
    /// all; also requests the ages of the forms. The board keeps this until it restarts [default: 1]
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    #[cfg_attr(feature = "schema", schemars(with = "Option<serde_json::Value>"))]
    pub forms: Option<FormsInFrame>,
    /// Set a concept: value, -1 to 1; its age; the age from which the value expires [default: never]; the value that
    /// replaces it then [default: 0]
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME=VALUE[,AGE_MS[,TIMEOUT_MS[,DEFAULT]]]", value_parser = feed))]
    #[serde(default, deserialize_with = "feeds")]
    #[cfg_attr(feature = "schema", schemars(with = "Vec<String>"))]
    pub feed: Vec<Feed>,
    /// Base of shapes to send to the board: a file, or the name of a shipped base
    #[cfg_attr(feature = "clap", arg(long, value_name = "BASE"))]
    pub shapes: Option<PathBuf>,
    /// Body of the garment, which the board stores, to report what presses on each link: a TOML file or `reference`
    #[cfg_attr(feature = "clap", arg(long, value_name = "BODY"))]
    pub body: Option<String>,
    /// Table of what the garment's folds press, which the board stores: a file of `taxel body learn`
    #[cfg_attr(feature = "clap", arg(long, value_name = "FILE"))]
    pub folds: Option<PathBuf>,
    /// Reports per second of what presses on each link, of a board that has a body; 65535: one for each frame
    /// [default: 65535 with a body, else 0]
    #[cfg_attr(feature = "clap", arg(long, value_name = "HZ"))]
    pub pressing: Option<u16>,
    /// Link of the robot that carries the whole garment, if there is no body.
    #[cfg_attr(feature = "clap", arg(skip))]
    pub link: Option<String>,
}

impl BoardConfig {
    /// A board at its source, which is asked nothing but its stream.
    pub fn of(source: SourceSpec) -> BoardConfig {
        BoardConfig { source: Some(source), ..BoardConfig::default() }
    }

    /// True unless its source is a recording, whose board takes no requests.
    pub(super) fn listens(&self) -> bool {
        !matches!(self.source, Some(SourceSpec::Replay { .. }))
    }

    /// The board, asked what `more` says in place of its own. Its name, source and link stay.
    pub(super) fn with(&self, more: &BoardConfig) -> BoardConfig {
        BoardConfig {
            name: self.name.clone(),
            source: self.source.clone(),
            garment: more.garment.clone().or_else(|| self.garment.clone()),
            scene: more.scene.clone().or_else(|| self.scene.clone()),
            calibration: more.calibration.clone().or_else(|| self.calibration.clone()),
            tare: more.tare.or(self.tare),
            budget: more.budget.or(self.budget),
            raw: more.raw || self.raw,
            gestures: more.gestures.or(self.gestures),
            gesture_gain: more.gesture_gain.or(self.gesture_gain),
            gesture_certainty: more.gesture_certainty.or(self.gesture_certainty),
            forms: more.forms.or(self.forms),
            feed: [self.feed.clone(), more.feed.clone()].concat(),
            shapes: more.shapes.clone().or_else(|| self.shapes.clone()),
            body: more.body.clone().or_else(|| self.body.clone()),
            folds: more.folds.clone().or_else(|| self.folds.clone()),
            pressing: more.pressing.or(self.pressing),
            link: self.link.clone(),
        }
    }

    /// The board with paths as `beside` makes them of those that it names.
    pub(super) fn resolved(&self, beside: &mut dyn FnMut(&str) -> String) -> BoardConfig {
        let mut text = |named: &Option<String>| named.as_deref().map(&mut *beside);
        let (garment, body) = (text(&self.garment), text(&self.body));
        let mut path =
            |path: &Option<PathBuf>| path.as_ref().map(|path| beside(&path.display().to_string()).into());
        let (scene, calibration, shapes, folds) =
            (path(&self.scene), path(&self.calibration), path(&self.shapes), path(&self.folds));
        let source = self.source.as_ref().map(|source| source.beside(beside));
        BoardConfig { source, garment, body, scene, calibration, shapes, folds, ..self.clone() }
    }

    /// Paths of the files that it names, which no output may replace. A preset's name is among them like a path.
    pub fn files(&self) -> Vec<PathBuf> {
        let source = self.source.as_ref().and_then(SourceSpec::file);
        let [garment, body] = [&self.garment, &self.body].map(|named| named.as_ref().map(PathBuf::from));
        let files = [&self.scene, &self.calibration, &self.shapes, &self.folds].map(Clone::clone);
        [source, garment, body].into_iter().chain(files).flatten().collect()
    }

    /// Keys by which the board is configured, which a recording cannot be.
    pub fn configures(&self) -> impl Iterator<Item = &'static str> {
        let keys = [
            ("garment", self.garment.is_some()),
            ("scene", self.scene.is_some()),
            ("tare", self.tare.is_some()),
            ("budget", self.budget.is_some()),
            ("raw", self.raw),
            ("gestures", self.gestures.is_some()),
            ("forms", self.forms.is_some()),
            ("feed", !self.feed.is_empty()),
            ("shapes", self.shapes.is_some()),
            ("body", self.body.is_some()),
            ("folds", self.folds.is_some()),
            ("pressing", self.pressing.is_some()),
        ];
        keys.into_iter().filter(|(_, is_there)| *is_there).map(|(key, _)| key)
    }
}

/// Reads a source by its name.
fn source<'de, D: Deserializer<'de>>(text: D) -> Result<Option<SourceSpec>, D::Error> {
    let text = String::deserialize(text)?;
    let wrong = |why| D::Error::custom(format!("there is no source \"{text}\": {why}"));
    text.parse().map(Some).map_err(wrong)
}

/// Reads feeds as the command line has them.
fn feeds<'de, D: Deserializer<'de>>(texts: D) -> Result<Vec<Feed>, D::Error> {
    let texts = Vec::<String>::deserialize(texts)?;
    texts.iter().map(|text| feed(text).map_err(D::Error::custom)).collect()
}

/// Reads what has a form of its own on the command line.
fn parsed<'de, T: FromStr<Err: std::fmt::Display>, D: Deserializer<'de>>(
    text: D,
) -> Result<Option<T>, D::Error> {
    String::deserialize(text)?.parse().map(Some).map_err(D::Error::custom)
}
