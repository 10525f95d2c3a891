//! The command `taxel record`.

mod robot;

use crate::commands::views::view::{announce, bind, shown_robot};
use crate::folding::Folding;
use crate::on_robot::ShownRobot;
use crate::view::{PageHub, Viewer};
use crate::watch::{self, BoardArgs, Overwrite, WatchOptions, stop};
use anyhow::{Error, Result};
use clap::Args;
use std::net::TcpListener;
use std::path::PathBuf;
use std::sync::Arc;
use taxel::body;
use taxel::files::calibrate::Calibration;
use taxel::files::calibrate::ForceScale;
use taxel::record::{Origin, Plan, PlannedBoard, Recorder, Rotate};
use taxel::session::Observer;
use taxel::source::SourceOptions;

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel record -o touch.mcap
  taxel record --source sim:pat -o pat.mcap --ros2
  taxel record -o day.mcap --rotate 10min
  taxel record -o touch.mcap --view --open";

/// Record a board's stream for Foxglove, Rerun, Python and ROS 2
#[derive(Debug, Clone, Args)]
#[command(after_help = EXAMPLES)]
pub struct RecordArgs {
    /// File to write (.mcap)
    #[arg(short, long, value_name = "FILE")]
    pub output: PathBuf,
    /// The board.
    #[command(flatten)]
    pub board: BoardArgs,
    /// Stop after N images
    #[arg(long, value_name = "N")]
    pub frames: Option<u64>,
    /// Stop after this time of the board, such as 2s or 10min [default: a simulated scene is played once; a board is
    /// recorded until Ctrl-C]
    #[arg(long = "for", value_name = "TIME", value_parser = watch::time, allow_negative_numbers = true)]
    pub seconds: Option<f64>,
    /// Also write FILE.ros2.mcap with ROS 2 messages: images, point clouds, forces, diagnostics
    #[arg(long)]
    pub ros2: bool,
    /// Start a new file (FILE-0002.mcap, ...) after a time or a size: 10min, 1GB
    #[arg(long, value_name = "LIMIT")]
    pub rotate: Option<Rotate>,
    /// Whether an existing output is replaced.
    #[command(flatten)]
    pub force: Overwrite,
    /// Pace simulations to real time
    #[arg(long)]
    pub realtime: bool,
    /// Show the board in the browser meanwhile, as `taxel view` does
    #[arg(long)]
    pub view: bool,
    /// With --view: port of the page on this machine; 0: any that is free [default: 8295, or any if that is taken]
    #[arg(long, value_name = "N", requires = "view")]
    pub port: Option<u16>,
    /// With --view: open the page in the browser
    #[arg(long, requires = "view")]
    pub open: bool,
}

/// Parts of the pages beside the board's stream.
struct Pages {
    listener: TcpListener,
    shown_robot: Option<ShownRobot>,
    folding: Option<Folding>,
}

impl Pages {
    fn prepare(args: &RecordArgs) -> Result<Pages> {
        Ok(Pages {
            listener: bind(args.port)?,
            shown_robot: shown_robot(&args.board, "")?,
            folding: args.board.config.folds.as_deref().map(Folding::read).transpose()?,
        })
    }

    /// Serves them, and shows them what is recorded of this source.
    fn open(self, label: &str, calibration: Option<Calibration>, open: bool) -> Result<Viewer> {
        let hub = Arc::new(PageHub::default());
        self.shown_robot.into_iter().for_each(|shown_robot| hub.show_robot(shown_robot));
        announce(label, self.listener, hub.clone(), open)?;
        Ok(Viewer::new(hub, calibration).folding(self.folding).beside_recording())
    }
}

/// Runs the command.
pub fn run(args: RecordArgs) -> Result<()> {
    if let Some(robot) = args.board.robot()? {
        return robot::run(&args, &robot);
    }
    let options = SourceOptions {
        realtime: args.realtime,
        frames: args.frames,
        seconds: args.seconds,
        ..SourceOptions::default()
    };
    let (source, calibration) = args.board.open(options)?;
    let pages = args.view.then(|| Pages::prepare(&args)).transpose()?;
    stop::catch()?;
    let body = args.board.config.body.as_deref().map(body::read).transpose()?;
    let origin = Origin { scale: ForceScale::new(calibration.clone(), None), ..Origin::default() };
    let recorder = Recorder::create(Plan {
        rotate: args.rotate,
        ros2: args.ros2,
        force: args.force.force,
        inputs: args.board.files(),
        ..Plan::of(args.output, PlannedBoard { origin, body, ..PlannedBoard::default() })
    })?;
    let label = source.label.clone();
    let unlimited = args.frames.is_none() && args.seconds.is_none();
    recorder.expect(args.seconds.unwrap_or(0.0));
    let watched = WatchOptions { frames: args.frames, seconds: args.seconds, ..WatchOptions::on(args.board) };
    let mut viewer = pages.map(|pages| pages.open(&label, calibration, args.open)).transpose()?;
    let mut record = recorder.board(0);
    let viewers = viewer.iter_mut().map(|viewer| viewer as &mut dyn Observer);
    let mut observers: Vec<&mut dyn Observer> = viewers.collect();
    observers.push(&mut record);
    let done = watch::watch(&watched, source, &mut observers);
    // The recording is completed even if the source fails.
    let ended = recorder.finish();
    eprintln!("{}", recorder.summary());
    if label.starts_with("sim:") && unlimited && done.is_ok() && !stop::asked() {
        eprintln!("{label} is over: a simulated scene is played once, --for TIME records for longer");
    }
    done.and(ended.map_err(Error::from))
}
