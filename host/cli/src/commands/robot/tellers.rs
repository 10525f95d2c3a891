//! What a board of a robot says, as the lines of `taxel live`.

use crate::terminal::Lines;
use taxel::client::{Client, Event};
use taxel::json::MessagePrinter;
use taxel::record::Stamp;
use taxel::robot::Teller;
use taxel::session::Show;
use taxel::source::Source;
use taxel::{Error, Result};

/// Makes JSON of a board's events.
pub struct JsonTeller {
    board: String,
    printer: MessagePrinter<std::io::Empty>,
}

impl JsonTeller {
    /// Of this board, with or without the pressure of every taxel.
    pub fn new(board: &str, pixels: bool) -> JsonTeller {
        JsonTeller { board: board.into(), printer: MessagePrinter::new(pixels, std::io::empty()) }
    }
}

impl Teller<String> for JsonTeller {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> Result<Option<String>> {
        let mut line = self.printer.message(client, event)?;
        line["board"] = self.board.as_str().into();
        Ok(Some(format!("{line}\n")))
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
    fn told(&mut self) -> Option<String> {
        let written = std::mem::take(self.lines.as_mut()?.output());
        let text = String::from_utf8_lossy(&written);
        let told: String = text.lines().map(|line| format!("{}{line}\n", self.head)).collect();
        (!told.is_empty()).then_some(told)
    }
}

impl Teller<String> for TextTeller {
    fn opened(&mut self, source: &Source) {
        self.lines = Some(Lines::new(source, Vec::new()));
    }

    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> Result<Option<String>> {
        self.lines.as_mut().map_or(Ok(()), |lines| lines.event(client, event)).map_err(other)?;
        Ok(self.told())
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> Result<Option<String>> {
        self.lines.as_mut().map_or(Ok(()), |lines| lines.end(client)).map_err(other)?;
        Ok(self.told())
    }
}

fn other(error: anyhow::Error) -> Error {
    Error::other(error)
}
