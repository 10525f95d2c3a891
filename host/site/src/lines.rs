//! A board's stream as lines of JSON.

use super::serial::SerialPipe;
use anyhow::Result;
use taxel::json::MessagePrinter;
use taxel::robot::{BoardPlan, Following, Required, Supervisor, follow_alone};
use taxel::session::{Returns, RunLimit};
use taxel::source::{self, Source, SourceOptions, SourceSpec};

/// Follows a board to its end.
struct ToItsEnd;

impl Supervisor for ToItsEnd {
    fn goes_on(&mut self) -> bool {
        true
    }
}

/// Plays a script once; returns what `taxel live --json --source sim:SCRIPT` prints.
pub fn lines(script: &str) -> Result<Vec<u8>> {
    let spec = SourceSpec::Sim(script.into());
    let source = source::open(&spec, &SourceOptions::default())?;
    let mut printed = Vec::new();
    let plan = alone(source, Returns::Never);
    follow_alone(plan, &mut MessagePrinter::new(false, &mut printed), &mut ToItsEnd)?;
    Ok(printed)
}

/// Follows a board whose bytes come in these pieces, and answers nothing; returns what `taxel live --json` prints of it.
pub fn lines_of<'a>(pieces: impl Iterator<Item = &'a [u8]>) -> Result<Vec<u8>> {
    let pipe = SerialPipe::default();
    let mut printed = Vec::new();
    let mut printer = MessagePrinter::new(false, &mut printed);
    let mut board = Following::open(alone(real("serial", pipe.clone()), Returns::Never), &mut printer)?;
    for piece in pieces {
        pipe.receive(piece);
        while board.turn(&mut printer)? && board.bytes() > 0 {}
        pipe.take();
    }
    board.end(&mut printer)?;
    Ok(printed)
}

/// A board on a port that the page reads. It is back once the page has opened the port again.
pub fn real(name: &str, port: SerialPipe) -> Source {
    let (again, known) = (port.clone(), name.to_string());
    Source::real(name, port, move || again.check().map(|()| real(&known, again.clone())))
}

/// Plan for an open source, whose whole stream is requested.
pub fn alone(source: Source, returns: Returns) -> BoardPlan {
    let name = source.label.clone();
    let mut source = Some(source);
    BoardPlan {
        waits: false,
        identity: None,
        is_among: false,
        returns,
        limit: RunLimit::of(None, None),
        ..BoardPlan::of(
            name,
            move || source.take().ok_or_else(|| taxel::Error::other("it has been opened before")),
            |session| {
                let (client, source) = session.parts();
                client.start(source.tare)?;
                Ok(Required::of(client))
            },
        )
    }
}
