//! The first line that one reads: what is felt now, and on what its newtons rest.

use super::ramp::{Paint, color};
use crate::palette::intention;
use crate::watch::Felt;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};
use taxel::client::Client;
use taxel_core::format::Micros;
use taxel_core::intent::Leading;

/// Time for which a touch that has ended is still reported, us of the board: the pause between two pats.
const LASTS: u64 = 800_000;

/// The sentence, and whether its touch has just ended.
#[derive(Debug, Default, Clone)]
pub struct Head {
    felt: Option<Felt>,
    /// Time at which something touched last.
    touched: Option<Micros>,
    is_over: bool,
}

impl Head {
    /// Handles a frame.
    pub fn take(&mut self, client: &Client, time: Micros) {
        let touches = !client.contacts().is_empty();
        if touches {
            self.touched = Some(time);
        }
        let lasts = |at: Micros| time.0.wrapping_sub(at.0) <= LASTS;
        self.is_over = !touches && self.touched.is_some_and(lasts);
        let felt = Felt::of(client);
        if let Some(reported) = self.felt.as_mut().filter(|_| self.is_over) {
            reported.what.clone_from(&reported.peak);
        }
        match &mut self.felt {
            Some(_) if self.is_over && client.leading() == Leading::None => {}
            Some(reported) if self.is_over => reported.meaning = felt.meaning,
            reported => *reported = Some(felt),
        }
    }

    /// Draws it in one row, the meaning on its colour.
    pub fn draw(&self, client: &Client, space: Rect, paint: Paint, buffer: &mut Buffer) {
        let (Some(felt), false) = (&self.felt, space.is_empty()) else { return };
        let bold = Style::new().add_modifier(Modifier::BOLD);
        let room = |x: u16| usize::from(space.right().saturating_sub(x));
        let mut put = |x: u16, text: &str, style| buffer.set_stringn(x, space.y, text, room(x), style).0;
        let mut letters = felt.what.chars();
        let what: String = letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect();
        let mut x = put(space.x, &what, bold);
        if !felt.meaning.is_empty() {
            x = put(x, ": ", bold);
            let leading = Leading::INTENTIONS.into_iter().find(|known| known.as_str() == felt.meaning);
            x = match (leading, paint) {
                (Some(leading), Paint::Colours) => {
                    let style = bold.fg(Color::Black).bg(color(intention(leading)));
                    put(x, &format!(" {} ", felt.meaning), style)
                }
                _ => put(x, felt.meaning, bold),
            };
        }
        let now = if self.is_over { "just now" } else { "now" };
        if let Some(newtons) = client.newtons() {
            let basis = newtons.basis().map(|basis| format!("{} newtons", basis.as_str()));
            let basis = basis.unwrap_or_else(|| "not calibrated".into());
            put(x, &format!("   {now}, {basis}"), Style::new());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::watch::{WatchOptions, watch};
    use taxel::client::Event;
    use taxel::client::Stamp;
    use taxel::session::Observer;
    use taxel::source::{SourceOptions, SourceSpec, open};

    /// Greatest force of the first touch, and the force that is reported once it has ended, N.
    #[derive(Default)]
    struct FirstTouch {
        head: Head,
        most: f64,
        ended: Option<f64>,
    }

    impl Observer for FirstTouch {
        fn event(&mut self, client: &Client, event: &Event, _: Stamp) -> taxel::Result<()> {
            let Event::Frame { time, .. } = event else { return Ok(()) };
            self.head.take(client, *time);
            let what = self.head.felt.as_ref().and_then(|felt| felt.what.split(" N").next());
            let force = what.and_then(|what| what.rsplit(' ').next()?.parse::<f64>().ok());
            match (force, self.head.is_over, self.ended) {
                (Some(force), false, None) => self.most = self.most.max(force),
                (Some(force), true, None) => self.ended = Some(force),
                _ => {}
            }
            Ok(())
        }
    }

    #[test]
    fn a_touch_that_has_ended_is_reported_with_its_greatest_force() {
        let spec: SourceSpec = "sim:pat".parse().unwrap();
        let source = open(&spec, &SourceOptions::default()).unwrap();
        let mut first = FirstTouch::default();
        watch(&WatchOptions::of(spec), source, &mut first).unwrap();
        assert_eq!(first.ended, Some(first.most));
        assert!(first.most > 5.0, "{} N", first.most);
    }
}
