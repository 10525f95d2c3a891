//! The command `taxel record`.

use super::viewed::ViewedRecorder;
use crate::commands::views::view::{announce, bind, wearer};
use crate::folding::Folding;
use crate::on_robot::Wearer;
use crate::view::{PageHub, Tape, Viewer};
use crate::watch::{self, BoardArgs, LiveArgs, Overwrite, stop};
use anyhow::{Error, Result};
use clap::Args;
use std::net::TcpListener;
use std::path::PathBuf;
use std::sync::Arc;
use taxel::body;
use taxel::record::{Origin, Plan, Recorder, Rotate};
use taxel::source::{Source, SourceOptions};

/// Arguments of `taxel record`.
#[derive(Debug, Clone, Args)]
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
    /// Stop after S seconds of the board's time [default: a simulated scene is played once; a board is
    /// recorded until Ctrl-C]
    #[arg(long, value_name = "S", value_parser = watch::seconds, allow_negative_numbers = true)]
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

/// What the pages show beside the board's stream.
struct Pages {
    listener: TcpListener,
    wearer: Option<Wearer>,
    folding: Option<Folding>,
}

impl Pages {
    fn prepare(args: &RecordArgs) -> Result<Pages> {
        Ok(Pages {
            listener: bind(args.port)?,
            wearer: wearer(&args.board, "")?,
            folding: args.board.config.folds.as_deref().map(Folding::read).transpose()?,
        })
    }

    /// Serves them, and shows them what is recorded.
    fn open(self, source: &Source, origin: Origin, open: bool) -> Result<(Viewer, Arc<PageHub>)> {
        let hub = Arc::new(PageHub::default());
        hub.tape(Tape::Live(Arc::new(origin)));
        self.wearer.into_iter().for_each(|wearer| hub.wear(wearer));
        announce(&source.label, self.listener, hub.clone(), open)?;
        Ok((Viewer::new(source, hub.clone()).folding(self.folding).beside_recording(), hub))
    }
}

/// Runs the command.
pub fn run(args: RecordArgs) -> Result<()> {
    let options = SourceOptions {
        realtime: args.realtime,
        frames: args.frames,
        seconds: args.seconds,
        ..SourceOptions::default()
    };
    let (source, calibration) = args.board.open(options)?;
    let pages = args.view.then(|| Pages::prepare(&args)).transpose()?;
    stop::catch()?;
    let origin =
        Origin { label: source.label.clone(), counts_per_newton: source.counts_per_newton, calibration };
    let mut recorder = Recorder::create(Plan {
        path: args.output,
        rotate: args.rotate,
        ros2: args.ros2,
        body: args.board.config.body.as_deref().map(body::read).transpose()?,
        force: args.force.force,
        inputs: args.board.files(),
        origin: origin.clone(),
    })?;
    let label = source.label.clone();
    let unlimited = args.frames.is_none() && args.seconds.is_none();
    recorder.expect(args.seconds.unwrap_or(0.0));
    let watched = LiveArgs { frames: args.frames, seconds: args.seconds, ..LiveArgs::on(args.board) };
    let pages = pages.map(|pages| pages.open(&source, origin, args.open)).transpose()?;
    let done = match pages {
        Some((viewer, hub)) => {
            watch::watch(&watched, source, &mut ViewedRecorder { recorder: &mut recorder, viewer, hub })
        }
        None => watch::watch(&watched, source, &mut recorder),
    };
    // The recording is completed even if the source fails.
    let ended = recorder.finish();
    eprintln!("{}", recorder.progress());
    if label.starts_with("sim:") && unlimited && done.is_ok() && !stop::asked() {
        eprintln!("{label} is over: a simulated scene is played once, --seconds S records for longer");
    }
    done.and(ended.map_err(Error::from))
}
