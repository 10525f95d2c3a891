//! Recognition on a garment: the touch of one panel at a time, shown to the model at the model's own rate.

use super::announce::{Announced, Demand};
use super::certainty::Certainty;
use super::config::{GestureConfig, GestureError};
use super::model::Model;
use super::stage::{Decision, TouchClassifier};
use super::state::TouchState;
use crate::condition::Image;
use crate::format::{Micros, Name, Q15};
use crate::garment::{Area, Layout};
use core::num::NonZeroU32;

/// A score of 1, in the unit of a lead.
const ONE: u64 = 1 << 18;

/// Recognises the touches of a garment; see the [module](super).
#[derive(Debug, Clone, Copy)]
pub struct Gestures {
    config: GestureConfig,
    model: Model<'static>,
    period_us: u32,
}

/// State of the present touch of a garment.
#[derive(Debug, Clone)]
pub struct GestureState {
    touch: TouchState,
    /// Number of the touch, from 1.
    number: u32,
    /// Index of its panel; none without a touch.
    panel: Option<u8>,
    began: Micros,
    /// Last time at which something touched the panel.
    touched: Micros,
    /// Time from which the next frame is shown to the model.
    next: Micros,
    /// Time of the next decision.
    due: Micros,
    announced: Announced,
}

/// Classification of a touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Gesture {
    /// Number of the touch, from 1.
    pub touch: u32,
    /// Index of its panel.
    pub panel: u8,
    /// Index of the class in the model.
    pub class: u8,
    /// Score of the class, Q18.
    pub score: i32,
    /// Lead over the score of the second class, Q18.
    pub lead: u32,
    /// Share of such touches that are of that class; none if the model does not know.
    pub confidence: Option<Q15>,
    /// Time for which the touch was observed, ms.
    pub observed_ms: u32,
    /// True if the touch is over.
    pub ended: bool,
}

impl Default for GestureState {
    fn default() -> Self {
        Self::new()
    }
}

impl GestureState {
    /// State before the first touch.
    pub const fn new() -> GestureState {
        GestureState {
            touch: TouchState::new(),
            number: 0,
            panel: None,
            began: Micros(0),
            touched: Micros(0),
            next: Micros(0),
            due: Micros(0),
            announced: Announced::new(),
        }
    }

    /// Drops the present touch; numbers go on.
    pub fn forget(&mut self) {
        self.panel = None;
    }
}

impl Gestures {
    /// Checks the settings and loads the model.
    pub fn build(config: &GestureConfig) -> Result<Gestures, GestureError> {
        let model = config.check()?;
        let period_us = 1_000_000 / NonZeroU32::new(config.rate_hz.into()).unwrap_or(NonZeroU32::MIN);
        Ok(Gestures { config: *config, model, period_us })
    }

    /// The settings.
    pub const fn config(&self) -> &GestureConfig {
        &self.config
    }

    /// Name of a class.
    pub fn name(&self, class: u8) -> Name {
        self.model.name(class.into()).unwrap_or_default()
    }

    /// Takes the frame of time `now`; `present` gives the panel and the total of each contact. Returns a new
    /// announcement or the end of the touch. A touch begins on the panel of the contact with the greatest
    /// total and covers that panel alone; it ends when nothing has touched the panel for a while.
    pub fn process(
        &self,
        state: &mut GestureState,
        layout: &Layout,
        image: &Image<'_>,
        present: impl Iterator<Item = (u8, u32)> + Clone,
        now: Micros,
    ) -> Option<Gesture> {
        let panel = match state.panel {
            Some(panel) => panel,
            None => {
                let first = present.clone().max_by_key(|(_, total)| *total)?.0;
                self.begin(state, first, now);
                first
            }
        };
        let area = layout.areas().get(usize::from(panel))?;
        if present.into_iter().any(|(touched, _)| touched == panel) {
            state.touched = now;
        } else if now.since(state.touched) >= 1000 * u64::from(self.config.quiet_ms) {
            return Some(self.end(state, area));
        }
        if now < state.next {
            return None;
        }
        // If frames come more slowly than the model's rate, each is shown once.
        state.next = Micros(state.next.0.saturating_add(self.period_us.into()).max(now.0));
        let touches = self.touches(area);
        let start = usize::from(area.base);
        let taxels = usize::from(area.rows) * usize::from(area.columns);
        touches.process(&mut state.touch, image.values.get(start..)?.get(..taxels)?);
        if now < state.due {
            return None;
        }
        state.due = self.later(now);
        let decision = touches.decide(&state.touch);
        state.announced.take(&decision, now, &self.demand())?;
        Some(reported(state, panel, &decision, now, false))
    }

    fn touches(&self, area: &Area) -> TouchClassifier<'static> {
        TouchClassifier::new(self.model, area.rows, area.columns).with_gain(self.config.gain)
    }

    fn demand(&self) -> Demand {
        let GestureConfig { onset_ms, lead, certainty, .. } = self.config;
        Demand {
            onset_us: 1000 * u64::from(onset_ms),
            lead: (u64::from(lead) * ONE / 1000) as u32,
            // Checked with the settings.
            certainty: Certainty::of(certainty).unwrap_or_default(),
        }
    }

    /// Time of the decision after `now`.
    fn later(&self, now: Micros) -> Micros {
        Micros(now.0.saturating_add(1000 * u64::from(self.config.decide_ms)))
    }

    fn begin(&self, state: &mut GestureState, panel: u8, now: Micros) {
        state.touch.reset();
        state.number = state.number.wrapping_add(1);
        state.panel = Some(panel);
        (state.began, state.touched, state.next) = (now, now, now);
        state.due = self.later(now);
        state.announced = Announced::new();
    }

    /// Concludes the touch. It ended with the last contact: the quiet time since then is not part of
    /// `observed_ms`, but the model has seen it, as in training.
    fn end(&self, state: &mut GestureState, area: &Area) -> Gesture {
        let decision = self.touches(area).conclude(&state.touch);
        let panel = state.panel.take().unwrap_or_default();
        reported(state, panel, &decision, state.touched, true)
    }
}

fn reported(state: &GestureState, panel: u8, decision: &Decision, now: Micros, ended: bool) -> Gesture {
    Gesture {
        touch: state.number,
        panel,
        class: decision.class as u8,
        score: decision.scores.get(decision.class).copied().unwrap_or(0),
        lead: decision.lead,
        confidence: decision.confidence,
        observed_ms: (now.since(state.began) / 1000).min(u32::MAX.into()) as u32,
        ended,
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use crate::condition::Rows;
    use crate::garment::Garment;
    use crate::gesture::{Sheet, ShippedModel};
    use std::vec::Vec;

    /// Frames at 195 a second.
    const SCAN_US: u64 = 5_128;

    /// A garment of two panels and its image.
    struct ShownFrame {
        layout: Layout,
        stage: Gestures,
        state: GestureState,
        frame: u64,
    }

    impl ShownFrame {
        fn new(edit: fn(&mut GestureConfig)) -> ShownFrame {
            let mut config = GestureConfig::default();
            edit(&mut config);
            let layout = Layout::build(&Garment::reference(), 2048, u16::MAX).unwrap();
            ShownFrame {
                layout,
                stage: Gestures::build(&config).unwrap(),
                state: GestureState::new(),
                frame: 0,
            }
        }

        /// Shows a hand of 16 by 8 taxels with this pressure, from a column of a panel on; shows nothing at
        /// 0.
        fn show(&mut self, panel: u8, column: usize, pressure: u16) -> Option<Gesture> {
            let mut values = [0; 2048];
            let base = usize::from(self.layout.areas()[usize::from(panel)].base);
            for row in 8..24 {
                values[base + row * 16 + column..][..8].fill(pressure);
            }
            let present = (pressure > 0).then_some((panel, 128 * u32::from(pressure)));
            self.frame += 1;
            let image = Image { values: &values, rows: &Rows::NONE };
            let now = Micros(self.frame * SCAN_US);
            let present = present.into_iter();
            self.stage.process(&mut self.state, &self.layout, &image, present, now)
        }

        fn reported(&mut self, frames: u64, panel: u8, of: fn(u64) -> (usize, u16)) -> Vec<Gesture> {
            (0..frames)
                .filter_map(|frame| {
                    let (column, pressure) = of(frame);
                    self.show(panel, column, pressure)
                })
                .collect()
        }
    }

    /// Contact for 0.2 s of every 0.5 s, five times.
    fn pats(frame: u64) -> (usize, u16) {
        (4, if frame % 98 < 39 { 60 } else { 0 })
    }

    #[test]
    fn pats_are_one_touch_that_ends_once_and_another_begins() {
        let mut shown = ShownFrame::new(|_| ());
        let reported = shown.reported(195 * 4, 2, pats);
        assert!(!reported.is_empty() && reported.len() < 5, "{reported:?}");
        assert!(reported.iter().all(|g| (g.touch, g.panel, g.ended) == (1, 2, false)));
        assert_eq!(shown.stage.name(reported.last().unwrap().class), "pat");
        let end = shown.reported(400, 2, |_| (0, 0));
        assert_eq!(end.len(), 1);
        assert_eq!(
            (end[0].touch, end[0].ended, shown.stage.name(end[0].class)),
            (1, true, "pat".try_into().unwrap())
        );
        assert!(end[0].observed_ms.abs_diff(3_700) < 100, "{end:?}");
        let next = shown.reported(200, 0, |_| (4, 60));
        assert!(next.iter().all(|g| (g.touch, g.panel) == (2, 0)) && !next.is_empty());
    }

    #[test]
    fn it_decides_as_the_model_does_on_the_frames_it_was_shown() {
        let mut shown = ShownFrame::new(|config| {
            (config.decide_ms, config.onset_ms, config.lead, config.gain) = (50, 0, 0, 512)
        });
        let reported =
            shown.reported(195 * 3, 1, |frame| ((frame as usize / 20) % 8, 300 + 5 * (frame as u16 % 60)));
        // The same frames without a garment, one every 1/54 s.
        let model = Model::read(ShippedModel::Gestures.bytes()).unwrap();
        let (touches, mut state) = (TouchClassifier::new(model, 32, 16), TouchState::new());
        let (mut next, mut decisions) = (SCAN_US as f64, Vec::new());
        for frame in 0..195 * 3u64 {
            let now = (frame + 1) * SCAN_US;
            if (now as f64) < next - 1e-6 {
                continue;
            }
            next = (next + (1e6 / 54.0f64).floor()).max(now as f64);
            let mut image = [0; 512];
            for row in 8..24 {
                image[row * 16 + (frame as usize / 20) % 8..][..8].fill(2 * (300 + 5 * (frame as u16 % 60)));
            }
            touches.process(&mut state, &image);
            decisions.push((now, touches.decide(&state)));
        }
        assert!(reported.len() > 1, "{reported:?}");
        for gesture in reported {
            let at = SCAN_US + 1000 * u64::from(gesture.observed_ms);
            let (_, decision) = decisions.iter().find(|(now, _)| now.abs_diff(at) < 1000).unwrap();
            assert_eq!((gesture.class as usize, gesture.lead), (decision.class, decision.lead));
            assert_eq!(gesture.score, decision.scores[decision.class]);
        }
    }

    #[test]
    fn another_panel_is_not_watched_meanwhile() {
        let mut shown = ShownFrame::new(|_| ());
        shown.reported(100, 3, |_| (4, 60));
        let other = shown.reported(300, 1, |_| (4, 900));
        // The touch of panel 3 ends a second after its last frame, then that of panel 1 begins.
        assert_eq!(
            other.iter().filter(|g| g.ended).map(|g| (g.touch, g.panel)).collect::<Vec<_>>(),
            [(1, 3)]
        );
        assert!(
            other
                .iter()
                .filter(|g| !g.ended)
                .all(|g| g.touch == 1 && g.panel == 3 || g.touch == 2 && g.panel == 1)
        );
        shown.state.forget();
        assert!(shown.reported(300, 1, |_| (4, 0)).is_empty());
        assert_eq!(Sheet::new(32, 16).with_gain(128).cells(&[10; 512])[0], 40);
    }
}
