//! What a board of a robot says, as the lines of `taxel live`.

use crate::terminal::Lines;
use taxel::client::{Client, Event};
use taxel::json::MessagePrinter;
use taxel::mind::{BoardSense, MindReader};
use taxel::record::Stamp;
use taxel::robot::{ReadRobot, Teller};
use taxel::session::Show;
use taxel::source::Source;
use taxel::{Error, Result};

/// What is made of an event of a board.
pub struct BoardNews {
    /// Lines, each with its end.
    pub lines: String,
    /// What it says of touches.
    pub sense: Option<BoardSense>,
}

/// Makes JSON of a board's events.
pub struct JsonTeller {
    board: String,
    printer: MessagePrinter<std::io::Empty>,
    mind: Option<MindReader>,
}

impl JsonTeller {
    /// Of a board of a robot, with or without the pressure of every taxel; with what it says of touches if
    /// `is_minded`.
    pub fn new(robot: &ReadRobot, number: usize, pixels: bool, is_minded: bool) -> JsonTeller {
        let board = &robot.boards[number];
        JsonTeller {
            board: board.name.clone(),
            printer: MessagePrinter::new(pixels, std::io::empty()).calibrated(board.calibration.clone()),
            mind: is_minded.then(|| MindReader::new(robot, number)),
        }
    }
}

impl Teller<BoardNews> for JsonTeller {
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<Option<BoardNews>> {
        // How the board is, the robot says.
        if let Event::Lost { .. } | Event::Back { .. } = event {
            return Ok(None);
        }
        let mut line = self.printer.message(client, event)?;
        line["board"] = self.board.as_str().into();
        stamp.mark(&mut line);
        let sense = self.mind.as_mut().and_then(|mind| mind.sense(client, event));
        Ok(Some(BoardNews { lines: format!("{line}\n"), sense }))
    }
}

/// Makes lines of text of a board's events.
pub struct TextTeller {
    /// What precedes each line.
    head: String,
    /// None before the source is open.
    lines: Option<Lines<Vec<u8>>>,
    mind: Option<MindReader>,
}

impl TextTeller {
    /// Of a board of a robot, whose lines begin with this; with what it says of touches if `is_minded`.
    pub fn new(robot: &ReadRobot, number: usize, head: String, is_minded: bool) -> TextTeller {
        TextTeller { head, lines: None, mind: is_minded.then(|| MindReader::new(robot, number)) }
    }

    /// What has been written since, with the board before each line.
    fn told(&mut self) -> String {
        let Some(lines) = self.lines.as_mut() else { return String::new() };
        let written = std::mem::take(lines.output());
        let text = String::from_utf8_lossy(&written);
        text.lines().map(|line| format!("{}{line}\n", self.head)).collect()
    }
}

impl Teller<BoardNews> for TextTeller {
    fn opened(&mut self, source: &Source) {
        self.lines = Some(Lines::new(source, Vec::new()));
    }

    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> Result<Option<BoardNews>> {
        self.lines.as_mut().map_or(Ok(()), |lines| lines.event(client, event)).map_err(other)?;
        let sense = self.mind.as_mut().and_then(|mind| mind.sense(client, event));
        let lines = self.told();
        Ok((!lines.is_empty() || sense.is_some()).then_some(BoardNews { lines, sense }))
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> Result<Option<BoardNews>> {
        self.lines.as_mut().map_or(Ok(()), |lines| lines.end(client)).map_err(other)?;
        let lines = self.told();
        Ok((!lines.is_empty()).then_some(BoardNews { lines, sense: None }))
    }
}

fn other(error: anyhow::Error) -> Error {
    Error::other(error)
}
