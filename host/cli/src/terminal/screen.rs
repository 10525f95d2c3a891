//! Display in a terminal, and its keys.

use super::ramp::Paint;
use super::{View, lines};
use anyhow::Result;
use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, KeyCode, KeyEventKind, KeyModifiers};
use std::time::{Duration, Instant};
use taxel::client::{Client, Event, Stamp};
use taxel::session::Observer;
use taxel_core::wire::Request;

/// Time between two redraws.
const PERIOD: Duration = Duration::from_millis(33);
/// Frames averaged by a tare with the key `t`.
const TARE: u16 = 32;

/// A terminal that shows a view; it is restored when dropped, and on a panic.
pub struct Screen {
    terminal: DefaultTerminal,
    view: View,
    drawn: Option<Instant>,
    asked: Instant,
    token: u32,
    /// The terminal has been restored.
    left: bool,
    /// A key has ended it.
    is_done: bool,
}

impl Screen {
    /// Takes over the terminal.
    pub fn open(view: View) -> Result<Screen> {
        Ok(Screen {
            terminal: ratatui::try_init()?,
            view: view.painted(Paint::wanted()),
            drawn: None,
            asked: Instant::now(),
            token: 0,
            left: false,
            is_done: false,
        })
    }

    /// Handles a key. Returns false to stop.
    fn key(&mut self, client: &mut Client, key: event::KeyEvent) -> taxel::Result<bool> {
        match key.code {
            KeyCode::Char('q') | KeyCode::Esc => return Ok(false),
            KeyCode::Char('c') if key.modifiers.contains(KeyModifiers::CONTROL) => return Ok(false),
            KeyCode::Char(' ') => self.view.pause(client),
            KeyCode::Char('t') => {
                client.request(&Request::Tare { frames: TARE })?;
                self.view.say(format!("tare over {TARE} frames"));
            }
            KeyCode::Char('+' | '=') => self.view.zoom(true),
            KeyCode::Char('-') => self.view.zoom(false),
            _ => {}
        }
        self.drawn = None;
        Ok(true)
    }
}

impl Observer for Screen {
    fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
        if matches!(event, Event::Sync(report) if report.token == self.token) {
            self.view.latency = Some(self.asked.elapsed() / 2);
        }
        self.view.event(client, event);
        Ok(())
    }

    fn follows_another(&self) -> bool {
        true
    }

    fn idle(&mut self, client: &mut Client) -> taxel::Result<()> {
        while event::poll(Duration::ZERO)? {
            match event::read()? {
                event::Event::Key(key) if key.kind == KeyEventKind::Press => {
                    self.is_done |= !self.key(client, key)?
                }
                event::Event::Resize(..) => self.drawn = None,
                _ => {}
            }
        }
        if client.description().is_some() && self.asked.elapsed() > Duration::from_secs(1) {
            self.token = self.token.wrapping_add(1);
            client.request(&Request::Sync { token: self.token })?;
            self.asked = Instant::now();
        }
        if self.drawn.is_none_or(|drawn| drawn.elapsed() >= PERIOD) {
            let view = &self.view;
            self.terminal.draw(|frame| view.draw(client, frame.buffer_mut()))?;
            self.drawn = Some(Instant::now());
        }
        Ok(())
    }

    fn is_done(&self) -> bool {
        self.is_done
    }

    fn ended(&mut self, client: &Client, _: Stamp) -> taxel::Result<()> {
        self.left = true;
        ratatui::try_restore()?;
        print!("{}", lines::total(client));
        Ok(())
    }
}

impl Drop for Screen {
    fn drop(&mut self) {
        // Restoring twice would move the cursor.
        if !self.left {
            ratatui::restore();
        }
    }
}
