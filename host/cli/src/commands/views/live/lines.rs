//! Lines of `taxel live` for what a board of a robot says.

use crate::terminal::Lines;
use taxel::Result;
use taxel::client::{Client, Event, Stamp};
use taxel::json::MessagePrinter;
use taxel::mind::{BoardSense, MindReader};
use taxel::robot::{BoardQueue, RobotBoard};
use taxel::session::Observer;
use taxel::source::Source;

/// Result of an event of a board.
pub struct BoardNews {
    /// Lines, each with its end.
    pub lines: String,
    /// Content of the event about touches.
    pub sense: Option<BoardSense>,
}

/// Queues a board's events as JSON.
pub struct JsonLines {
    board: String,
    printer: MessagePrinter<std::io::Empty>,
    mind: Option<MindReader>,
    queue: BoardQueue<BoardNews>,
}

impl JsonLines {
    /// Makes the lines of a board, with or without the pressure of every taxel, and with what this reader hears of
    /// touches.
    pub fn new(
        board: &RobotBoard,
        pixels: bool,
        mind: Option<MindReader>,
        queue: &BoardQueue<BoardNews>,
    ) -> JsonLines {
        let printer = MessagePrinter::new(pixels, std::io::empty());
        JsonLines { board: board.name.clone(), printer, mind, queue: queue.clone() }
    }
}

impl Observer for JsonLines {
    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        // How the board is, the robot says.
        if let Event::Lost { .. } | Event::Back { .. } = event {
            return Ok(());
        }
        let mut line = self.printer.message(client, event)?;
        line["board"] = self.board.as_str().into();
        stamp.mark(&mut line);
        let sense = self.mind.as_mut().and_then(|mind| mind.sense(client, event));
        self.queue.add(event, stamp, BoardNews { lines: format!("{line}\n"), sense });
        Ok(())
    }
}

/// Queues a board's events as lines of text.
pub struct TextLines {
    /// Prefix of each line.
    head: String,
    lines: Lines<Vec<u8>>,
    mind: Option<MindReader>,
    queue: BoardQueue<BoardNews>,
}

impl TextLines {
    /// Makes the lines of a board, which begin with this, with what this reader hears of touches.
    pub fn new(head: String, mind: Option<MindReader>, queue: &BoardQueue<BoardNews>) -> TextLines {
        TextLines { head, lines: Lines::new(Vec::new()), mind, queue: queue.clone() }
    }

    /// Returns what has been written since, with the board before each line.
    fn written(&mut self) -> String {
        let written = std::mem::take(self.lines.output());
        let text = String::from_utf8_lossy(&written);
        text.lines().map(|line| format!("{}{line}\n", self.head)).collect()
    }
}

impl Observer for TextLines {
    fn opened(&mut self, source: &Source) -> Result<()> {
        self.lines.opened(source)
    }

    fn event(&mut self, client: &Client, event: &Event, stamp: Stamp) -> Result<()> {
        self.lines.event(client, event, stamp)?;
        let sense = self.mind.as_mut().and_then(|mind| mind.sense(client, event));
        let lines = self.written();
        if !lines.is_empty() || sense.is_some() {
            self.queue.add(event, stamp, BoardNews { lines, sense });
        }
        Ok(())
    }

    fn ended(&mut self, client: &Client, stamp: Stamp) -> Result<()> {
        self.lines.ended(client, stamp)?;
        let lines = self.written();
        if !lines.is_empty() {
            self.queue.add_last(stamp, BoardNews { lines, sense: None });
        }
        Ok(())
    }
}
