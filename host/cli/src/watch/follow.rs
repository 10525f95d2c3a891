//! Follows a board until it ends, or until the requested amount has come.

use super::{BoardArgs, stop};
use anyhow::Result;
use std::time::Duration;
use taxel::client::{Client, Event, Stamp, request_name};
use taxel::robot::{BoardPlan, Required, Supervisor, follow_alone};
use taxel::session::{JointStates, Observer, PATIENCE, Returns, RunLimit};
use taxel::source::{Source, SourceSpec};
use taxel_core::wire::Request;

/// A board to be watched.
#[derive(Debug, Clone)]
pub struct WatchOptions {
    /// The board.
    pub board: BoardArgs,
    /// Images after which it ends.
    pub frames: Option<u64>,
    /// Seconds of the board's time after which it ends.
    pub seconds: Option<f64>,
    /// True if its raw codes are requested; an image counts once its codes have come.
    pub codes: bool,
    /// The board may refuse the body, and reports of what presses on it: the observer can do without.
    pub body_may_fail: bool,
    /// Remarks are printed to the standard error.
    pub prints_remarks: bool,
}

impl WatchOptions {
    /// Everything from a source, with all options at their defaults.
    pub fn of(source: SourceSpec) -> WatchOptions {
        WatchOptions::on(BoardArgs::of(source))
    }

    /// Everything from a board, without limits.
    pub fn on(board: BoardArgs) -> WatchOptions {
        WatchOptions {
            board,
            frames: None,
            seconds: None,
            codes: false,
            body_may_fail: false,
            prints_remarks: true,
        }
    }
}

/// Hands an open source to an observer until it ends, or until the requested amount has come.
pub fn watch(args: &WatchOptions, source: Source, observer: &mut dyn Observer) -> Result<()> {
    if !source.listens {
        args.board.check_recorded(&source.label)?;
    }
    let board = args.board.read()?;
    let mut joints = args.board.joint_states.as_deref().map(JointStates::open).transpose()?;
    let posing = args.board.posing()?;
    let mut limit = run_limit(args.frames, args.seconds);
    if args.codes {
        limit = limit.with_codes();
    }
    let returns = match (args.board.once, limit.is_any()) {
        (true, _) => Returns::Never,
        (false, true) => Returns::Within(PATIENCE),
        (false, false) => Returns::Always,
    };
    let (name, listens) = (source.label.clone(), source.listens);
    let (is_tared, may_fail, codes) =
        (args.board.config.tare.is_some(), args.body_may_fail, args.codes && listens);
    let identity = (!board.is_dressed).then(|| board.identity());
    let mut source = Some(source);
    let plan = BoardPlan {
        name,
        open: Box::new(move || source.take().ok_or_else(|| taxel::Error::other("it has been opened before"))),
        waits: false,
        listens,
        identity,
        is_among: false,
        returns,
        begin: Box::new(move |session| {
            let (client, source) = session.parts();
            board.begin(client, source)?;
            let required = match (source.listens, is_tared) {
                (false, _) => Required::default(),
                // A tare that only a simulated scene asks for may be refused: somebody touches already.
                (true, false) => Required::of(client),
                (true, true) => Required::with_tare(client),
            };
            // A board without raw codes reports the pressure of the taxel all the same.
            if codes {
                client.request_codes()?;
            }
            posing.into_iter().for_each(|posing| session.pose_by(posing));
            Ok(if may_fail { required.without(&Request::SetTable(&[])) } else { required })
        }),
        gather: Duration::ZERO,
        limit,
    };
    let mut remarks = Remarks::default();
    let mut all: Vec<&mut dyn Observer> = Vec::new();
    all.extend(joints.iter_mut().map(|joints| joints as &mut dyn Observer));
    all.push(observer);
    if args.prints_remarks {
        all.push(&mut remarks);
    }
    if let Some(remark) = follow_alone(plan, &mut all, &mut UntilStopped)? {
        eprintln!("{remark}");
    }
    Ok(())
}

/// Returns where a run ends that is limited by options.
pub fn run_limit(frames: Option<u64>, seconds: Option<f64>) -> RunLimit {
    // A time that is too long for a `Duration` is none.
    RunLimit::of(frames, seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok()))
}

/// Follows a board until Ctrl-C, if that is caught.
struct UntilStopped;

impl Supervisor for UntilStopped {
    fn goes_on(&mut self) -> bool {
        !stop::asked()
    }
}

/// Prints remarks to the standard error.
#[derive(Debug, Default)]
pub struct Remarks {
    /// Name of the board in its robot.
    board: Option<String>,
}

impl Remarks {
    /// Makes the remarks of a board of a robot, and what it refuses: nobody waits for its answers.
    pub fn of(board: &str) -> Remarks {
        Remarks { board: Some(board.into()) }
    }
}

impl Observer for Remarks {
    fn event(&mut self, _: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        match (&self.board, event.remark(), event) {
            (None, Some(remark), _) => eprintln!("{remark}"),
            (Some(board), Some(remark), _) => eprintln!("board {board}: {remark}"),
            (Some(board), None, Event::Answer { request, refusal: Some(why) }) => {
                eprintln!("board {board}: the board refuses {}: {why}", request_name(*request));
            }
            _ => {}
        }
        Ok(())
    }

    fn follows_another(&self) -> bool {
        true
    }
}
