//! What a board of a robot says, as the lines of `taxel live`.

use crate::terminal::Lines;
use taxel::client::{Client, Event};
use taxel::json::MessagePrinter;
use taxel::mind::{BoardHeard, HeardReader};
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
    pub heard: BoardHeard,
}

/// Makes JSON of a board's events.
pub struct JsonTeller {
    board: String,
    printer: MessagePrinter<std::io::Empty>,
    reader: HeardReader,
}

impl JsonTeller {
    /// Of a board of a robot, with or without the pressure of every taxel, and what it says of touches.
    pub fn new(robot: &ReadRobot, number: usize, pixels: bool, is_minded: bool) -> JsonTeller {
        let board = &robot.boards[number];
        JsonTeller {
            board: board.name.clone(),
            printer: MessagePrinter::new(pixels, std::io::empty()).calibrated(board.calibration.clone()),
            reader: HeardReader::new(robot, number, is_minded),
        }
    }
}

impl Teller<BoardNews> for JsonTeller {
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<Option<BoardNews>> {
        let mut line = self.printer.message(client, event)?;
        line["board"] = self.board.as_str().into();
        stamp.mark(&mut line);
        Ok(Some(BoardNews { lines: format!("{line}\n"), heard: self.reader.read(client, event) }))
    }
}

/// Makes lines of text of a board's events.
pub struct TextTeller {
    /// What precedes each line.
    head: String,
    /// None before the source is open.
    lines: Option<Lines<Vec<u8>>>,
    reader: HeardReader,
}

impl TextTeller {
    /// Of a board of a robot, whose lines begin with this, and what it says of touches.
    pub fn new(robot: &ReadRobot, number: usize, head: String, is_minded: bool) -> TextTeller {
        TextTeller { head, lines: None, reader: HeardReader::new(robot, number, is_minded) }
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
        let news = BoardNews { lines: self.told(), heard: self.reader.read(client, event) };
        Ok((!news.lines.is_empty() || news.heard.sense.is_some()).then_some(news))
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> Result<Option<BoardNews>> {
        self.lines.as_mut().map_or(Ok(()), |lines| lines.end(client)).map_err(other)?;
        let lines = self.told();
        Ok((!lines.is_empty()).then_some(BoardNews { lines, heard: BoardHeard::default() }))
    }
}

fn other(error: anyhow::Error) -> Error {
    Error::other(error)
}
