//! Reads a source until it ends, or until the requested amount has come.

use super::{LiveArgs, stop};
use crate::fault::Fault;
use anyhow::{Error, Result, bail};
use std::time::{Duration, Instant};
use taxel::client::{Client, Event, ImageNews, request_name};
use taxel::error::SourceError;
use taxel::robot::Required;
use taxel::session::{JointStates, PATIENCE, Returns, Session, Show, TimeLimit, Turn};
use taxel::source::Source;
use taxel::tell::verbose;
use taxel_core::wire::Request;

/// Silence after which a message is printed.
const QUIET: Duration = Duration::from_secs(3);

/// Shows a source until it ends, or until the requested amount has come.
pub fn watch(args: &LiveArgs, source: Source, show: &mut dyn Show<anyhow::Error>) -> Result<()> {
    let limited = args.frames.is_some() || args.seconds.is_some();
    let returns = match (args.board.once, limited) {
        (true, _) => Returns::Never,
        (false, true) => Returns::Within(PATIENCE),
        (false, false) => Returns::Always,
    };
    let mut session = Session::new(source, returns);
    let (client, source) = session.parts();
    if !source.listens {
        args.board.check_recorded(&source.label)?;
    }
    let board = args.board.read()?;
    board.begin(client, source)?;
    let mut joints = args.board.joint_states.as_deref().map(JointStates::open).transpose()?;
    let mut required = if source.listens { required(client, args) } else { Required::default() };
    let mut refusal = None;
    // A board without raw codes tells the pressure of the taxel all the same.
    if args.taxel.is_some() && source.listens {
        client.request_codes()?;
    }
    let mut limits = Limits::of(args);
    args.board.posing()?.into_iter().for_each(|posing| session.pose_by(posing));
    if !board.is_dressed {
        session.recognise(board.identity());
    }
    let mut patience = Patience { limited, began: Instant::now(), told: false };
    while !limits.ended && refusal.is_none() {
        pose(&mut session, joints.as_mut(), show)?;
        let turn = session.turn(&mut |client, bytes| show.asked(client, bytes))?;
        if turn == Turn::End {
            break;
        }
        patience.look(&session)?;
        limits.look(&mut session)?;
        while let Some(event) = session.next_event() {
            tell(session.client(), &event);
            if !show.tells_remarks() {
                event.remark().iter().for_each(|remark| eprintln!("{remark}"));
            }
            show.event(session.client(), &event)?;
            if let Event::Other { why } = &event
                && !show.follows_another()
            {
                // What is already shown or written of the other board is whole.
                show.end(session.client())?;
                bail!(taxel::Error::from(SourceError::Other(why.clone())));
            }
            refusal = required.answered(&session.source().label, &event).err();
            if limits.reached(&event) || refusal.is_some() {
                break;
            }
        }
        if !show.idle(session.parts().0)? || stop::asked() {
            break;
        }
    }
    let (client, source) = session.parts();
    let ended = show.end(client);
    if let Some(remark) = source.port.remark() {
        eprintln!("{}: {remark}", source.label);
    }
    match (refusal, client.worn()) {
        // The reason for whatever the receiver lacks at its end, too.
        (Some(refusal), _) => Err(taxel::Error::from(refusal).into()),
        (None, Some(_)) => ended,
        (None, None) => ended.and(Err(silent(source, client.counts().bytes))),
    }
}

/// Requests that the board must accept. A tare that only a simulated scene asks for may be refused: somebody touches
/// already.
fn required(client: &Client, args: &LiveArgs) -> Required {
    let all = match args.board.config.tare {
        Some(_) => Required::with_tare(client),
        None => Required::of(client),
    };
    if args.body_may_fail { all.without(&Request::SetTable(&[])) } else { all }
}

/// Hands positions of joints to whoever tells the board its posture, and to the receiver.
fn pose(
    session: &mut Session,
    joints: Option<&mut JointStates>,
    show: &mut dyn Show<anyhow::Error>,
) -> Result<()> {
    let Some((client, posing)) = session.posing() else { return Ok(()) };
    show.pose(client, posing)?;
    joints.map_or(Ok(()), |joints| joints.turn(client, posing))?;
    let taken = posing.taken();
    taken.iter().try_for_each(|taken| show.joints(client, taken))
}

/// Prints events for `-v`.
fn tell(client: &Client, event: &Event) {
    match event {
        Event::Hello => {
            if let Some(worn) = client.worn() {
                let (firmware, garment, scene) = (&worn.firmware, &worn.garment.name, &worn.scene.name);
                verbose::tell(format_args!("board {firmware}: garment {garment}, scene {scene}"));
            }
        }
        Event::Answer { request, refusal: None } => {
            verbose::tell(format_args!("the board has done {}", request_name(*request)));
        }
        Event::Answer { request, refusal: Some(why) } => {
            verbose::tell(format_args!("the board refuses {}: {why}", request_name(*request)));
        }
        _ => {}
    }
}

/// Error for a source without a `Hello`: a board is at fault, a recording is not.
fn silent(source: &Source, bytes: u64) -> Error {
    let why = format!("{}: no Hello of a taxel board in {bytes} bytes", source.label);
    if source.real_time { Fault::board(why).into() } else { Error::msg(why) }
}

/// Conditions for the end of a run.
struct Limits {
    frames: Option<u64>,
    time: TimeLimit,
    /// Wait for the raw codes of the last image, which follow it.
    codes: bool,
    ended: bool,
}

impl Limits {
    fn of(args: &LiveArgs) -> Limits {
        let longest =
            args.seconds.map_or(Duration::MAX, |seconds| Duration::from_micros((seconds * 1e6) as u64));
        let (frames, codes) = (args.frames, args.taxel.is_some());
        Limits { frames, time: TimeLimit::of(longest), codes, ended: false }
    }

    fn reached(&mut self, event: &Event) -> bool {
        if self.frames == Some(0) {
            self.ended |= matches!(event, Event::Raw { .. } | Event::Frame { .. });
        } else if let (Event::Frame { image: ImageNews::Whole, .. }, Some(frames)) = (event, &mut self.frames)
        {
            *frames = frames.saturating_sub(1);
            self.ended |= *frames == 0 && !self.codes;
        }
        self.ended |= self.time.take(event);
        self.ended
    }

    /// Ends a run to which no more images come.
    fn look(&mut self, session: &mut Session) -> Result<()> {
        self.ended |= self.time.look(session);
        if self.frames.is_some() && !self.ended {
            self.time.check_images(session).map_err(taxel::Error::from)?;
        }
        Ok(())
    }
}

/// Patience with a silent board.
struct Patience {
    /// The run is limited in time, so the wait is, too.
    limited: bool,
    began: Instant,
    /// The silence has been reported.
    told: bool,
}

impl Patience {
    fn look(&mut self, session: &Session) -> Result<()> {
        if session.client().worn().is_some() || session.is_gone() {
            return Ok(());
        }
        let passed = self.began.elapsed();
        if passed > QUIET && !std::mem::replace(&mut self.told, true) {
            eprintln!("No Hello yet from {}.", session.source().label);
        }
        if self.limited && passed > PATIENCE {
            return Err(silent(session.source(), session.client().counts().bytes));
        }
        Ok(())
    }
}
