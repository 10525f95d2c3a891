//! What a board of a robot says, as the lines of `taxel live`.

use crate::terminal::Lines;
use taxel::client::{Client, Event};
use taxel::json::MessagePrinter;
use taxel::record::Stamp;
use taxel::robot::{BoardScan, ReadRobot, ScanReader, Teller};
use taxel::session::Show;
use taxel::source::Source;
use taxel::{Error, Result};

/// What is made of an event of a board.
pub struct BoardNews {
    /// Lines, each with its end.
    pub lines: String,
    /// The scan that it is about.
    pub scan: Option<BoardScan>,
}

/// Makes JSON of a board's events.
pub struct JsonTeller {
    board: String,
    printer: MessagePrinter<std::io::Empty>,
    reader: ScanReader,
}

impl JsonTeller {
    /// Of a board of a robot, with or without the pressure of every taxel.
    pub fn new(robot: &ReadRobot, number: usize, pixels: bool) -> JsonTeller {
        let board = &robot.boards[number];
        JsonTeller {
            board: board.name.clone(),
            printer: MessagePrinter::new(pixels, std::io::empty()).calibrated(board.calibration.clone()),
            reader: ScanReader::new(robot, number),
        }
    }
}

impl Teller<BoardNews> for JsonTeller {
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<Option<BoardNews>> {
        let mut line = self.printer.message(client, event)?;
        line["board"] = self.board.as_str().into();
        stamp.mark(&mut line);
        let scan = self.reader.scan(client, event);
        Ok(Some(BoardNews { lines: format!("{line}\n"), scan }))
    }
}

/// Makes lines of text of a board's events.
#[derive(Default)]
pub struct TextTeller {
    /// What precedes each line.
    head: String,
    /// None before the source is open.
    lines: Option<Lines<Vec<u8>>>,
}

impl TextTeller {
    /// Of a board, whose lines begin with this.
    pub fn new(head: String) -> TextTeller {
        TextTeller { head, lines: None }
    }

    /// What has been written since, with the board before each line.
    fn told(&mut self) -> Option<BoardNews> {
        let written = std::mem::take(self.lines.as_mut()?.output());
        let text = String::from_utf8_lossy(&written);
        let lines: String = text.lines().map(|line| format!("{}{line}\n", self.head)).collect();
        (!lines.is_empty()).then_some(BoardNews { lines, scan: None })
    }
}

impl Teller<BoardNews> for TextTeller {
    fn opened(&mut self, source: &Source) {
        self.lines = Some(Lines::new(source, Vec::new()));
    }

    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> Result<Option<BoardNews>> {
        self.lines.as_mut().map_or(Ok(()), |lines| lines.event(client, event)).map_err(other)?;
        Ok(self.told())
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> Result<Option<BoardNews>> {
        self.lines.as_mut().map_or(Ok(()), |lines| lines.end(client)).map_err(other)?;
        Ok(self.told())
    }
}

fn other(error: anyhow::Error) -> Error {
    Error::other(error)
}
