//! State of the display: draws what is known of a garment into a buffer of characters.

use super::curve::Curve;
use super::head::Head;
use super::map::Grid;
use super::panes;
use super::ramp::{GLYPHS, Paint, color};
use super::scale::PressureScale;
use crate::palette::{STEPS, ramp};
use crate::watch::narrate::{Narrator, force};
use crate::watch::rate::Rate;
use ratatui::buffer::Buffer;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::{Color, Modifier, Style};
use std::collections::VecDeque;
use std::time::Duration;
use taxel::client::{Client, Event};
use taxel::source::Source;

/// Log lines kept.
const LOG: usize = 100;
/// Width that the panes beside the maps need.
const SIDE: u16 = 57;
/// Smallest width at which the panes are beside the maps instead of below them.
const WIDE: u16 = 98;
/// Smallest width of the panes at which the log is beside the others instead of below them.
const BROAD: u16 = 110;
/// Smallest height at which nothing is left out.
const TALL: u16 = 30;
/// Height of the curve of force and its title.
const CURVE: u16 = 5;

/// State of the display beyond the client's.
#[derive(Debug, Clone)]
pub struct View {
    label: String,
    narrator: Narrator,
    log: VecDeque<String>,
    rate: Rate,
    head: Head,
    curve: Curve,
    scale: PressureScale,
    /// Half of the last round trip to the board.
    pub latency: Option<Duration>,
    paint: Paint,
    /// Reason why the board is lost; none while it is there.
    lost: Option<String>,
    /// Shown while paused: the client and the view at that moment.
    paused: Option<Box<(Client, View)>>,
}

impl View {
    /// A view of a source.
    pub fn new(source: &Source) -> View {
        View {
            label: source.label.clone(),
            narrator: Narrator::default(),
            log: VecDeque::new(),
            rate: Rate::default(),
            head: Head::default(),
            curve: Curve::default(),
            scale: PressureScale::new(),
            latency: None,
            paint: Paint::Colours,
            lost: None,
            paused: None,
        }
    }

    /// Sets how pressure is drawn.
    pub fn painted(self, paint: Paint) -> View {
        View { paint, ..self }
    }

    /// Handles an event.
    pub fn event(&mut self, client: &Client, event: &Event) {
        match event {
            Event::Frame { time, .. } => {
                self.rate.add(*time);
                self.head.take(client, *time);
                self.curve.add(client, *time);
                if let (Some((_, image)), Some(description)) = (client.image(), client.description()) {
                    self.scale.follow(image, description.scene.contact.low);
                }
            }
            Event::Lost { why, .. } => {
                self.lost = Some(why.clone());
                self.head = Head::default();
            }
            Event::Back { .. } | Event::Other { .. } => self.lost = None,
            _ => {}
        }
        for line in self.narrator.narrate(client, event) {
            self.note(line);
        }
    }

    /// Adds a line to the log, also while paused.
    pub fn say(&mut self, line: String) {
        if let Some((_, view)) = self.paused.as_deref_mut() {
            view.note(line.clone());
        }
        self.note(line);
    }

    fn note(&mut self, line: String) {
        self.log.push_front(line);
        self.log.truncate(LOG);
    }

    /// Pauses the display including its clock and log, or resumes it.
    pub fn pause(&mut self, client: &Client) {
        self.paused = match self.paused {
            Some(_) => None,
            None => Some(Box::new((client.clone(), self.clone()))),
        };
    }

    /// Doubles or halves the end of the scale that is shown, which then stays.
    pub fn zoom(&mut self, up: bool) {
        if let Some((_, view)) = self.paused.as_deref_mut() {
            self.scale = view.scale;
            view.scale.zoom(up);
        }
        self.scale.zoom(up);
    }

    /// Draws everything.
    pub fn draw(&self, client: &Client, buffer: &mut Buffer) {
        match self.paused.as_deref() {
            Some((client, view)) => view.paint(client, true, buffer),
            None => self.paint(client, false, buffer),
        }
    }

    fn paint(&self, client: &Client, paused: bool, buffer: &mut Buffer) {
        if buffer.area.is_empty() {
            // A terminal that is being resized may have no rows.
            return;
        }
        let is_tall = buffer.area.height >= TALL;
        let [header, head] = if is_tall { [2, 2] } else { [1, 1] }.map(Constraint::Length);
        let rows = [header, head, Constraint::Fill(1), Constraint::Length(1)];
        let [header, head, body, footer] = Layout::vertical(rows).areas(buffer.area);
        self.header(client, header, buffer);
        self.footer(client, paused, footer, buffer);
        let head = Rect { y: head.bottom().saturating_sub(1), height: head.height.min(1), ..head };
        self.head.draw(client, head, self.paint, buffer);
        if body.width < WIDE && is_tall {
            let parts = [Constraint::Fill(1), Constraint::Length(CURVE), Constraint::Length(12)];
            let [maps, curve, below] = Layout::vertical(parts).areas(body);
            self.maps(client, maps, buffer);
            self.force(client, curve, buffer);
            let [left, right] = Layout::horizontal([Constraint::Fill(3), Constraint::Fill(2)]).areas(below);
            self.contacts(client, left, buffer);
            return panes::concepts(client, right, buffer);
        }
        let room = if body.width >= WIDE { body.width - SIDE } else { body.width / 3 * 2 };
        let taken = self.maps(client, Rect { width: room, ..body }, buffer);
        let side = Rect { x: body.x + taken, width: body.width - taken, ..body };
        let parts = [Constraint::Length(CURVE), Constraint::Fill(1)];
        let [curve, below] = Layout::vertical(parts).spacing(u16::from(is_tall)).areas(side);
        self.force(client, curve, buffer);
        match body.width >= WIDE {
            true => self.side(client, below, buffer),
            false => panes::concepts(client, below, buffer),
        }
    }

    /// Draws the force of the last half minute below its name.
    fn force(&self, client: &Client, space: Rect, buffer: &mut Buffer) {
        if space.is_empty() {
            return;
        }
        let most = force(client, self.curve.most());
        let title = format!("force of the last 30 s, up to {most}");
        buffer.set_stringn(space.x, space.y, title, usize::from(space.width), Style::new());
        self.curve.draw(Rect { y: space.y + 1, height: space.height - 1, ..space }, buffer);
    }

    /// Draws the maps. Returns their width.
    fn maps(&self, client: &Client, space: Rect, buffer: &mut Buffer) -> u16 {
        let Some(grid) = client.layout().and_then(|layout| Grid::fit(layout, space)) else { return 0 };
        grid.draw(client, (self.scale.top(), self.paint), space, buffer);
        grid.width()
    }

    fn header(&self, client: &Client, space: Rect, buffer: &mut Buffer) {
        if space.is_empty() {
            return;
        }
        let width = usize::from(space.width);
        let bold = Style::new().add_modifier(Modifier::BOLD);
        let what = client.description().map_or("waiting for a Hello".into(), |description| {
            let taxels = description.layout.taxels();
            let simulated = if description.is_simulated() { "SIMULATED  " } else { "" };
            format!(
                "{simulated}garment {} ({taxels} taxels)  scene {}  {}",
                description.garment.name, description.scene.name, description.firmware
            )
        });
        buffer.set_stringn(space.x, space.y, format!("taxel  {}  {what}", self.label), width, bold);
        let counts = client.counts();
        let frame = client.image().map_or(0, |(frame, _)| frame);
        let time = self.rate.last().map_or(0.0, |time| time.0 as f64 / 1e6);
        let mut line = format!(
            "{:.1} frames/s  frame {frame}  {time:.2} s  lost {}  thinned {}  refused {}",
            self.rate.hz(),
            counts.lost,
            counts.thinned,
            counts.refused()
        );
        if let Some(latency) = self.latency {
            line += &format!("  latency {:.1} ms", latency.as_secs_f64() * 1e3);
        }
        if let Some(budget) = client.budget() {
            let [scan, perceive, encode, wait] =
                [budget.scan_us, budget.process_us, budget.encode_us, budget.send_us].map(ms);
            line += &format!(
                "  scan {scan:.2} ms  perceive {perceive:.2} ms  encode {encode:.2} ms  link {wait:.2} ms  overruns {}",
                budget.overruns
            );
        }
        if let Some(why) = &self.lost {
            line = format!("LOST  {why}");
        }
        if space.height > 1 {
            buffer.set_stringn(space.x, space.y + 1, line, width, Style::new());
        }
    }

    fn side(&self, client: &Client, space: Rect, buffer: &mut Buffer) {
        let is_broad = space.width >= BROAD;
        let columns = if is_broad {
            [Constraint::Length(SIDE), Constraint::Fill(1)]
        } else {
            [Constraint::Fill(1), Constraint::Length(0)]
        };
        let [left, right] = Layout::horizontal(columns).spacing(u16::from(is_broad)).areas(space);
        let concepts = panes::rows(client);
        let contacts = client.contacts().len().max(3) as u16 + 1;
        let most = if is_broad { left.height } else { left.height / 2 };
        let rows = [contacts.min(left.height / 3), concepts.min(most)].map(Constraint::Length);
        let [upper, middle, lower] =
            Layout::vertical([rows[0], rows[1], Constraint::Fill(1)]).spacing(1).areas(left);
        self.contacts(client, upper, buffer);
        panes::concepts(client, middle, buffer);
        let lower = if is_broad { right } else { lower };
        let log: Vec<String> = self.log.iter().cloned().collect();
        panes::list("events, newest first", &log, lower, buffer);
    }

    fn contacts(&self, client: &Client, space: Rect, buffer: &mut Buffer) {
        let lines: Vec<_> = client.contacts().iter().map(|p| panes::contact(client, p)).collect();
        panes::list(panes::CONTACTS, &lines, space, buffer);
    }

    /// Draws keys and scale.
    fn footer(&self, client: &Client, paused: bool, space: Rect, buffer: &mut Buffer) {
        if space.is_empty() {
            return;
        }
        let mut keys = String::from("q quit  space pause  t tare  +/- scale   0 ");
        if paused {
            keys = format!("PAUSED  {keys}");
        }
        let (mut x, y) = buffer.set_stringn(space.x, space.y, keys, usize::from(space.width), Style::new());
        let steps: Vec<(char, Color)> = match self.paint {
            Paint::Colours => (0..16).map(|step| (' ', color(ramp(step * (STEPS - 1) / 15)))).collect(),
            Paint::Glyphs => GLYPHS.map(|glyph| (glyph, Color::Reset)).to_vec(),
        };
        for (glyph, ground) in steps {
            let Some(cell) = buffer.cell_mut((x, y)).filter(|_| x < space.right()) else { break };
            cell.set_char(glyph).set_bg(ground);
            x += 1;
        }
        let left = usize::from(space.right().saturating_sub(x));
        let top = self.scale.top();
        let end = match client.counts_per_newton() {
            Some(counts) => format!(" {:.2} N on a taxel", f64::from(top) / counts),
            None => format!(" {top} counts"),
        };
        buffer.set_stringn(x, y, end, left, Style::new());
    }
}

fn ms(us: u32) -> f64 {
    f64::from(us) / 1000.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use taxel::source::{self, SourceOptions};

    /// A terminal in which a box is pressed on the chest for a second.
    struct Seat {
        source: Source,
        client: Client,
        view: View,
    }

    impl Seat {
        fn take(paint: Paint) -> Seat {
            let source = source::open(&"sim:box".parse().unwrap(), &SourceOptions::default()).unwrap();
            let mut client = Client::new();
            client.start(source.tare).unwrap();
            client.weigh_by(source.scale.clone());
            let view = View::new(&source).painted(paint);
            Seat { source, client, view }
        }

        /// Runs until a frame of this time, us.
        fn until(&mut self, time_us: u64) {
            let mut buffer = [0; 512];
            self.source.port.write(&self.client.take_requests()).unwrap();
            while self.view.rate.last().is_none_or(|last| last.0 < time_us) {
                let count = self.source.port.read(&mut buffer).unwrap().expect("the scene lasts longer");
                for byte in &buffer[..count] {
                    if let Some(event) = self.client.push(*byte) {
                        self.view.event(&self.client, &event);
                    }
                }
            }
        }

        fn picture(&self) -> Vec<String> {
            let mut buffer = Buffer::empty(Rect::new(0, 0, 120, 40));
            self.view.draw(&self.client, &mut buffer);
            let row = |y| (0..120).map(|x| buffer.cell((x, y)).unwrap().symbol()).collect::<String>();
            (0..40).map(row).collect()
        }
    }

    #[test]
    fn without_colour_pressure_is_read_by_the_weight_of_characters() {
        let mut seat = Seat::take(Paint::Glyphs);
        seat.until(100_000);
        assert!(
            seat.picture()[0].starts_with("taxel  sim:box  SIMULATED  garment "),
            "{}",
            seat.picture()[0]
        );
        let count = |picture: &[String], glyph| picture.iter().flat_map(|row| row.matches(glyph)).count();
        let rest = seat.picture();
        assert!(!rest.iter().any(|row| row.contains('▀')), "{rest:#?}");
        // All 1,024 pairs of taxels are drawn, and the scale once.
        assert!(count(&rest, '.') > 900 && count(&rest, '#') + count(&rest, '%') <= 2, "{rest:#?}");
        seat.until(600_000);
        let pressed = seat.picture();
        let heavy = |picture: &[String]| {
            ['*', '#', '%', '@'].map(|glyph| count(picture, glyph)).iter().sum::<usize>()
        };
        assert!(heavy(&pressed) > heavy(&rest) + 5, "{pressed:#?}");
        assert!(pressed[39].contains(".:-=+o*#%@ 1.60 N on a taxel"), "{}", pressed[39]);
    }

    #[test]
    fn a_lost_board_is_said_to_be_lost_and_not_drawn() {
        let mut seat = Seat::take(Paint::Glyphs);
        seat.until(100_000);
        let heavy = |picture: &[String]| {
            ['*', '#', '%', '@'].map(|glyph| picture.concat().matches(glyph).count()).iter().sum::<usize>()
        };
        let rest = heavy(&seat.picture());
        seat.until(400_000);
        assert!(heavy(&seat.picture()) > rest + 5);
        let touches = |picture: &[String]| {
            ["  1 chest ", "A touch on the chest"].map(|part| picture.concat().contains(part))
        };
        assert_eq!(touches(&seat.picture()), [true; 2]);
        seat.client.lost("usb is gone; waiting for it".into(), 5);
        while let (_, Some(event)) = seat.client.next_event(&[]) {
            seat.view.event(&seat.client, &event);
        }
        let lost = seat.picture();
        assert!(lost[1].starts_with("LOST  usb is gone; waiting for it"), "{}", lost[1]);
        assert!(heavy(&lost) <= rest && touches(&lost) == [false; 2], "{lost:#?}");
    }

    #[test]
    fn a_paused_picture_stands_still_with_its_clock_and_its_log() {
        let mut seat = Seat::take(Paint::Colours);
        seat.until(250_000);
        seat.view.pause(&seat.client);
        let still = seat.picture();
        assert!(still[39].starts_with("PAUSED"), "{}", still[39]);
        seat.until(1_000_000);
        assert_eq!(seat.picture(), still);
        seat.view.pause(&seat.client);
        let on = seat.picture();
        assert!(on[1] != still[1] && !on[39].starts_with("PAUSED"), "{}", on[1]);
    }
}
