//! `taxel view`: shows a board's stream or a recording in the browser.

mod robot;

pub use robot::{pages, viewer};

use crate::fault::Fault;
use crate::folding::Folding;
use crate::on_robot::ShownRobot;
use crate::view::{PageHub, PageHubs, Player, Token, Viewer, browser, serve, serve_guests};
use crate::watch::{self, BoardArgs, WatchOptions};
use anyhow::{Context, Result, ensure};
use std::io::{IsTerminal, stdout};
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::thread;
use taxel::files::calibrate::Calibration;
use taxel::recording::BoardRecording;
use taxel::robot::BoardConfig;
use taxel::source::{SourceOptions, SourceSpec, Speed};

/// Default port, unless it is taken: T, A, X, L on a telephone keypad.
const PORT: u16 = 8295;

/// Preset of a garment's body, and of the robot that carries it.
const REFERENCE: &str = "reference";

/// Shown below the help.
const EXAMPLES: &str = "Examples:
  taxel view --open
  taxel view --source sim:five
  taxel view walk.mcap --open
  taxel view robot.toml --open
  taxel view --source sim:five --body reference --robot reference --open
  taxel view --source serial:/dev/ttyACM0 --garment block-4x16 --tare 32";

/// Watch a board or a recording in the browser: panels, surface, body, map, health
#[derive(Debug, Clone, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct ViewArgs {
    /// The board.
    #[command(flatten)]
    pub board: BoardArgs,
    /// Positions of joints in which the robot is shown, until others are sent, deg, rad or m:
    /// elbow=30deg,wrist=-0.5rad; the others rest
    #[arg(long, value_name = "JOINTS", requires = "robot")]
    pub joints: Option<String>,
    /// Port of the page on this machine; 0: any that is free [default: 8295, or any if that is taken]
    #[arg(long, value_name = "N")]
    pub port: Option<u16>,
    /// Let other machines open the page, too: whoever has its address, which holds a token, watches the board and, without
    /// --read-only, sets it
    #[arg(long)]
    pub listen: bool,
    /// Let pages look alone: no tare, no limits, no press on a simulated garment
    #[arg(long)]
    pub read_only: bool,
    /// Open the page in the browser
    #[arg(long)]
    pub open: bool,
    /// Stop after this time of the board, such as 2s or 10min [default: go on until Ctrl-C]
    #[arg(long = "for", value_name = "TIME", value_parser = watch::time, allow_negative_numbers = true)]
    pub seconds: Option<f64>,
}

impl ViewArgs {
    /// Recording to show, and its speed; none for a board.
    fn recording(&self) -> Option<(BoardRecording, f64)> {
        match self.board.source() {
            SourceSpec::Replay { recording, speed } => {
                let times = match speed {
                    Speed::AsAsked => 1.0,
                    Speed::Times(times) => times,
                    Speed::Max => f64::INFINITY,
                };
                Some((recording, times))
            }
            _ => None,
        }
    }

    /// Binds to this machine's own interface, or to all of them.
    fn bind(&self) -> Result<TcpListener> {
        bind_at(if self.listen { Ipv4Addr::UNSPECIFIED } else { Ipv4Addr::LOCALHOST }, self.port)
    }

    /// Serves the pages, and prints their address.
    fn announce(&self, what: &str, listener: TcpListener, hub: Arc<PageHub>) -> Result<()> {
        if !self.listen {
            return announce(what, listener, hub, self.open);
        }
        let token = Token::random();
        let port = serve_guests(listener, hub, token.clone())?;
        let url = format!("http://127.0.0.1:{port}/{}/", token.as_str());
        println!("{what} at {url} (Ctrl-C ends)");
        println!("{}", words_to_guests(port));
        if self.open { browser::open(&url) } else { Ok(()) }
    }

    /// The robot that carries the garment; none without a body.
    fn shown_robot(&self) -> Result<Option<ShownRobot>> {
        shown_robot(&self.board, self.joints.as_deref().unwrap_or_default())
    }
}

/// The robot that carries a board's garment, with its joints at these positions; none without a body.
pub fn shown_robot(board: &BoardArgs, joints: &str) -> Result<Option<ShownRobot>> {
    let read = |body: &String| ShownRobot::read(body, board.robot.as_deref(), joints);
    board.config.body.as_ref().map(read).transpose()
}

/// Runs the command.
pub fn run(args: ViewArgs) -> Result<()> {
    if let Some(robot) = args.board.robot()? {
        return robot::run(&args, &robot);
    }
    if let Some((file, speed)) = args.recording() {
        return play(&args, &file, speed);
    }
    let shown_robot = args.shown_robot()?;
    let listener = args.bind()?;
    // Who came to press is not disturbed, unless a script was asked for.
    let waits = args.board.named().is_none();
    let options = SourceOptions { realtime: true, repeat: true, waits, ..SourceOptions::default() };
    let (source, calibration) = args.board.open_to_show(options, stdout().is_terminal())?;
    let hub = Arc::new(PageHub::default());
    if args.read_only {
        hub.read_only();
    }
    // The garment that is played where nothing was named is on a robot, too.
    let unnamed = waits && source.hand.is_some() && args.board.config.garment.is_none();
    let reference = || ShownRobot::read(REFERENCE, Some(REFERENCE), "");
    let shown_robot = if unnamed && shown_robot.is_none() { Some(reference()?) } else { shown_robot };
    shown_robot.into_iter().for_each(|shown_robot| hub.show_robot(shown_robot));
    args.announce(&source.label, listener, hub.clone())?;
    let folding = args.board.config.folds.as_deref().map(Folding::read).transpose()?;
    let mut viewer = Viewer::new(hub, calibration).folding(folding);
    // Where a board does not listen, the host alone knows the body.
    let mut board = args.board;
    if !source.listens {
        (board.config.body, board.robot) = (None, None);
    }
    let live = WatchOptions { body_may_fail: true, seconds: args.seconds, ..WatchOptions::on(board) };
    watch::watch(&live, source, &mut viewer)?;
    if args.seconds.is_some() {
        return Ok(());
    }
    println!("Stream ended; showing the last frame (Ctrl-C ends).");
    loop {
        thread::park();
    }
}

/// Shows a recording.
fn play(args: &ViewArgs, recording: &BoardRecording, speed: f64) -> Result<()> {
    // The host places the taxels of a recording, and knows where it folds: its board is not asked.
    let config = BoardConfig { body: None, folds: None, ..args.board.config.clone() };
    BoardArgs { config, ..BoardArgs::default() }.check_recorded(&recording.to_string())?;
    ensure!(
        args.board.joint_states.is_none(),
        Fault::usage(format!("--joint-states: {recording} is a recording, whose robot does not move now"))
    );
    let calibration = args.board.config.calibration.as_deref().map(Calibration::read).transpose()?;
    let hub = Arc::new(PageHub::default());
    args.shown_robot()?.into_iter().for_each(|shown_robot| hub.show_robot(shown_robot));
    let folding =
        args.board.config.folds.as_deref().map(|folds| Folding::recorded(folds, recording)).transpose()?;
    let player = Player::open(recording, speed, calibration, folding, hub.clone())?;
    args.announce(&recording.to_string(), args.bind()?, hub)?;
    player.run()
}

/// Serves the pages, and prints their address.
pub fn announce(what: &str, listener: TcpListener, hubs: impl Into<PageHubs>, open: bool) -> Result<()> {
    let port = serve(listener, hubs)?;
    let url = format!("http://127.0.0.1:{port}/");
    println!("{what} at {url} (Ctrl-C ends)");
    if open { browser::open(&url) } else { Ok(()) }
}

/// Sentences for whoever lets other machines in.
fn words_to_guests(port: u16) -> String {
    format!(
        "On another machine or a telephone, put this machine's name or address in place of 127.0.0.1. Whoever has the\n\
         address has the page. It is not encrypted: whoever listens on the network reads all of it, the token too.\n\
         Encrypted, without --listen: ssh -L {port}:127.0.0.1:{port} THIS-MACHINE, then http://127.0.0.1:{port}/ there."
    )
}

/// Binds to the loopback interface.
pub fn bind(port: Option<u16>) -> Result<TcpListener> {
    bind_at(Ipv4Addr::LOCALHOST, port)
}

/// Binds to an interface.
fn bind_at(interface: Ipv4Addr, port: Option<u16>) -> Result<TcpListener> {
    let listen = |port| TcpListener::bind((interface, port));
    let wanted = port.unwrap_or(PORT);
    let listener = match (listen(wanted), port) {
        (Err(_), None) => listen(0),
        (result, _) => result,
    };
    listener.with_context(|| format!("port {wanted} of this machine cannot be used for the page"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_port_that_is_taken_is_named_unless_nobody_asked_for_it() {
        let taken = bind(Some(0)).unwrap();
        let port = taken.local_addr().unwrap().port();
        assert!(taken.local_addr().unwrap().ip().is_loopback());
        let why = format!("{:#}", bind(Some(port)).unwrap_err());
        assert!(
            why.starts_with(&format!("port {port} of this machine cannot be used for the page: ")),
            "{why}"
        );
        assert!(bind(None).is_ok());
    }
}
