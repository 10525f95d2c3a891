//! The command line: one variant for each subcommand, each with an example.

use crate::bench::{self, BenchArgs};
use crate::calibrate::{self, CalibrateArgs};
use crate::config::{self, ConfigArgs};
use crate::doctor::{self, DoctorArgs};
use crate::export::{self, ExportArgs};
use crate::fcm::{self, FcmArgs};
use crate::features::{self, FeaturesArgs};
use crate::flash::{self, FlashArgs};
#[cfg(feature = "foxglove")]
use crate::foxglove::{self, FoxgloveArgs};
use crate::gestures::{self, GesturesArgs};
use crate::health::{self, HealthArgs};
use crate::info::{self, InfoArgs};
use crate::intent::{self, IntentArgs};
use crate::live::{self, LiveArgs};
use crate::ports::{self, PortsArgs};
use crate::process::{self, ProcessArgs};
use crate::record::{self, RecordArgs};
use crate::replay::{self, ReplayArgs};
use crate::report::{self, ReportArgs};
use crate::save::{self, SaveArgs};
use crate::scenes::{self, ScenesArgs};
use crate::settle::{self, SettleArgs};
use crate::setup::{self, SetupArgs};
use crate::shapes::{self, ShapesArgs};
use crate::view::{self, ViewArgs};
use crate::words;
use anyhow::Result;
use clap::{Parser, Subcommand};

/// See, record and understand the touch on a robot's tactile garment
#[derive(Debug, Parser)]
#[command(version, after_help = TAXEL)]
pub struct Cli {
    /// What to do; without it, `live`
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// See what a board tells, or a simulated one; what the program does by itself
    #[command(after_help = LIVE)]
    Live(LiveArgs),
    /// See the same in the browser: panels, surface, body, map, health
    #[command(after_help = VIEW)]
    View(ViewArgs),
    /// Serve the same to Foxglove, live
    #[cfg(feature = "foxglove")]
    #[command(after_help = FOXGLOVE)]
    Foxglove(FoxgloveArgs),
    /// Record what a board tells, for Foxglove, Rerun, Python and ROS 2
    #[command(after_help = RECORD)]
    Record(RecordArgs),
    /// What is in a recording; and the end for one that a kill has left without
    #[command(after_help = INFO)]
    Info(InfoArgs),
    /// Play a recording as if its board were there
    #[command(after_help = REPLAY)]
    Replay(ReplayArgs),
    /// Recordings as CSV, NumPy arrays, images or a data set for LeRobot
    #[command(after_help = EXPORT)]
    Export(ExportArgs),
    /// What a recording or a board shows, as one page to send
    #[command(after_help = REPORT)]
    Report(ReportArgs),
    /// Perceive recorded frames as the board would
    #[command(after_help = PROCESS)]
    Process(ProcessArgs),
    /// Moments, NMI and axis of one recorded image as it stands
    #[command(after_help = FEATURES)]
    Features(FeaturesArgs),
    /// Fuzzy cognitive maps: run, validate, explain, combine, teach, draw
    #[command(after_help = FCM)]
    Fcm(FcmArgs),
    /// Which gesture a touch is: train and evaluate models that fit the board
    #[command(after_help = GESTURES)]
    Gestures(GesturesArgs),
    /// What a touch means, kindness, threat or attack: train and evaluate models that fit the board
    #[command(after_help = INTENT)]
    Intent(IntentArgs),
    /// Speed against error, as tables and charts
    #[command(after_help = BENCH)]
    Bench(BenchArgs),
    /// Find out by touch how an unknown bundle of wires is connected
    #[command(after_help = SETUP)]
    Setup(SetupArgs),
    /// Find out by known weights what a newton shows
    #[command(after_help = CALIBRATE)]
    Calibrate(CalibrateArgs),
    /// Find the shortest settling of a real garment
    #[command(after_help = SETTLE)]
    Settle(SettleArgs),
    /// Name the taxels that are ill
    #[command(after_help = HEALTH)]
    Health(HealthArgs),
    /// Let a board keep its garment, scene, gains and baseline over a restart
    #[command(after_help = SAVE)]
    Save(SaveArgs),
    /// Teach shapes, and see how well they are known
    #[command(after_help = SHAPES)]
    Shapes(ShapesArgs),
    /// What is wrong, if anything, and what to do about it
    #[command(after_help = DOCTOR)]
    Doctor(DoctorArgs),
    /// List serial ports, and which of them is a board
    #[command(after_help = PORTS)]
    Ports(PortsArgs),
    /// Write the firmware to a board
    #[command(after_help = FLASH)]
    Flash(FlashArgs),
    /// Begin and check the file of a garment
    #[command(after_help = CONFIG)]
    Config(ConfigArgs),
    /// List the simulated scenes
    #[command(after_help = SCENES)]
    Scenes(ScenesArgs),
}

const TAXEL: &str = "Examples:
  taxel
  taxel live --source sim:lash
  taxel scenes

Exit status:
  0  done
  1  failed: a file, the disk, a result that is not good enough
  2  wrong use: another command line is needed
  3  the board is at fault: no answer, a refusal, faulty lines or taxels";

const LIVE: &str = "Examples:
  taxel live
  taxel live --source sim:lash --frames 200 --json
  taxel live --source serial:/dev/ttyACM0 --save touch.taxel
  taxel live --source file:touch.taxel";

const VIEW: &str = "Examples:
  taxel view --open
  taxel view --source sim:five
  taxel view --source serial:/dev/ttyACM0 --garment block-4x16 --tare 32";

#[cfg(feature = "foxglove")]
const FOXGLOVE: &str = "Examples:
  taxel foxglove --source sim:pat
  taxel foxglove --source serial:/dev/ttyACM0 --garment block-4x16 --tare 32";

const RECORD: &str = "Examples:
  taxel record -o touch.mcap
  taxel record --source sim:pat -o pat.mcap --ros2
  taxel record -o day.mcap --rotate 10min";

const INFO: &str = "Examples:
  taxel info touch.mcap
  taxel info touch.mcap --repair";

const REPLAY: &str = "Examples:
  taxel replay touch.mcap
  taxel replay touch.mcap --speed 0.25
  taxel live --source replay:touch.mcap@max --json";

const EXPORT: &str = "Examples:
  taxel export touch.mcap --to npz -o touch.npz
  taxel export touch.mcap --to csv --touched -o touch.csv
  taxel export touch.mcap --to png -o images
  taxel export *.mcap --to lerobot --task \"pat the robot\" -o data";

const REPORT: &str = "Examples:
  taxel report touch.mcap -o report.html
  taxel report --source sim:source -o source.html";

const PROCESS: &str = "Examples:
  taxel process subject_01.npz --array posture_03 --rate 1 --json
  taxel process frames.npy --full-scale 1000 --tare 16";

const FEATURES: &str = "Examples:
  taxel features image.npy
  taxel features subject_01.npz --array posture_03 --frame 20 --json";

const FCM: &str = "Examples:
  taxel fcm map.json --rule mkosko --transfer sigmoid --lambda 1 --steps 50 --json
  taxel fcm tactile --input press=0.8 --input time=0.1
  taxel fcm why tactile --input press=0.8 --input time=0.1 --set shape=1
  taxel fcm why --source sim:lash
  taxel fcm check my-map.toml
  taxel fcm combine anna.toml ben.toml carla.toml -o ours.toml
  taxel fcm draw tactile --input shape=1 -o tactile.svg";

const GESTURES: &str = "Examples:
  taxel gestures eval --frames train.npz --labels train.csv --cross participant --json
  taxel gestures train --frames train.npz --labels train.csv -o my.model
  taxel gestures eval --model my.model --frames test.npz --labels test.csv";

const INTENT: &str = "Examples:
  taxel intent eval --frames frames.npz --labels labels.csv --cross day --json
  taxel intent train --frames frames.npz --labels labels.csv -o my.model";

const BENCH: &str = "Examples:
  taxel bench
  taxel bench acquisition
  taxel bench nmi --json
  taxel bench record";

const SETUP: &str = "Examples:
  taxel setup --garment reference -o garment.toml
  taxel setup --source serial:/dev/ttyACM0 --garment mine.toml -o garment.toml
  taxel setup --simulate 7 --json";

const CALIBRATE: &str = "Examples:
  taxel calibrate --simulate 7
  taxel calibrate --source usb --over block --weights 0.5,1,2,5,10 --kg --by Anna --save -o anna.toml
  taxel calibrate check anna.toml";

const SETTLE: &str = "Examples:
  taxel settle --garment garment.toml -o garment.toml
  taxel settle --source serial:/dev/ttyACM0 --error 2 --json";

const HEALTH: &str = "Examples:
  taxel health
  taxel health --source sim:press
  taxel health --source serial:/dev/ttyACM0 --tare 32 --json";

const SAVE: &str = "Examples:
  taxel save
  taxel save --source serial:/dev/ttyACM0 --garment block-4x16 --tare 32";

const SHAPES: &str = "Examples:
  taxel shapes list
  taxel shapes learn mug -o mine.json
  taxel live --shapes mine.json
  taxel shapes train --images images.npz --labels labels.csv -o objects.json
  taxel shapes eval --images images.npz --labels labels.csv --cross 5 --json
  taxel shapes eval --images shapes.npz --set 32x64_C_n3 --classes three
  taxel shapes card objects";

const DOCTOR: &str = "Examples:
  taxel doctor
  taxel doctor --source serial:/dev/ttyACM0 --seconds 20 --json";

const PORTS: &str = "Examples:
  taxel ports
  taxel ports --json";

const FLASH: &str = "Examples:
  taxel flash taxel.uf2
  taxel flash taxel.elf";

const CONFIG: &str = "Examples:
  taxel config new mine.toml --like block-4x16
  taxel config check mine.toml --scene scene.toml
  taxel config schema";

const SCENES: &str = "Examples:
  taxel scenes
  taxel scenes --json";

impl Cli {
    /// Reads the command line; the program ends here where it is wrong, or asks for help.
    pub fn read() -> Cli {
        Cli::try_parse().unwrap_or_else(|error| in_words(error).exit())
    }

    /// Runs what was asked for.
    pub fn run(self) -> Result<()> {
        let live = || Cli::parse_from(["taxel", "live"]).command;
        match self.command.or_else(live).expect("live is a command") {
            Command::Live(args) => live::run(args),
            Command::View(args) => view::run(args),
            #[cfg(feature = "foxglove")]
            Command::Foxglove(args) => foxglove::run(args),
            Command::Record(args) => record::run(args),
            Command::Info(args) => info::run(args),
            Command::Replay(args) => replay::run(args),
            Command::Export(args) => export::run(args),
            Command::Report(args) => report::run(args),
            Command::Process(args) => process::run(args),
            Command::Features(args) => features::run(args),
            Command::Fcm(args) => fcm::run(args),
            Command::Gestures(args) => gestures::run(args),
            Command::Intent(args) => intent::run(args),
            Command::Bench(args) => bench::run(args),
            Command::Setup(args) => setup::run(&args),
            Command::Calibrate(args) => calibrate::run(&args),
            Command::Settle(args) => settle::run(&args),
            Command::Health(args) => health::run(args),
            Command::Save(args) => save::run(args),
            Command::Shapes(args) => shapes::run(args),
            Command::Doctor(args) => doctor::run(&args),
            Command::Ports(args) => ports::run(&args),
            Command::Flash(args) => flash::run(&args),
            Command::Config(args) => config::run(&args),
            Command::Scenes(args) => scenes::run(args),
        }
    }
}

/// A number that is none, in plain words.
fn in_words(error: clap::Error) -> clap::Error {
    let Some(theirs) = std::error::Error::source(&error).map(ToString::to_string) else { return error };
    let ours = words::plain(&theirs);
    if ours == theirs {
        return error;
    }
    let told = error.to_string();
    let message = told.trim_start_matches("error: ").replacen(&theirs, &ours, 1);
    clap::Error::raw(error.kind(), message)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn every_help_has_an_example() {
        let command = Cli::command();
        command.clone().debug_assert();
        for command in command.get_subcommands().chain([&command]) {
            let after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            assert!(after.starts_with("Example") && after.contains("taxel"), "{}", command.get_name());
        }
    }
}
