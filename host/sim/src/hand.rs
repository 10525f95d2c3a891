//! Touches that begin while the simulated board runs.

use super::act::Act;
use super::hardware::Bus;
use super::touch::Touch;
use super::trace::{Knot, Trace};
use std::rc::Rc;

/// A hand on the garment of a [`SimBoard`](super::SimBoard).
///
/// Its touches are felt from the next sample on. Touches and traces are numbered, each kind from those of the
/// script on: one after the other, in the order in which a script would list them. Then forces are added as they
/// are when that script is played, to the last bit. A touch must fit the garment, as a script's.
#[derive(Debug, Clone)]
pub struct SimHand {
    pub(super) bus: Rc<Bus>,
}

impl SimHand {
    /// Begins a touch, whose times are those of the board.
    pub fn touch(&self, number: u64, touch: Touch) {
        self.act(Act::Touch(number, touch));
    }

    /// Begins a touch along a path. If it `lasts`, its last place and force stay until the path is drawn on.
    pub fn trace(&self, number: u64, trace: Trace, lasts: bool) {
        self.act(Act::Trace { number, trace, lasts });
    }

    /// Draws the path of a touch that lasts on: `path` begins with a knot that is not in the future. Ends the touch
    /// at its last knot, unless it `lasts`.
    pub fn draw(&self, number: u64, path: Vec<Knot>, lasts: bool) {
        self.act(Act::Draw { number, path, lasts });
    }

    fn act(&self, act: Act) {
        self.bus.acts.borrow_mut().push(act);
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Script, SimBoard, World};
    use super::*;
    use taxel_core::acquire::Adc;
    use taxel_core::garment::Garment;

    const IDLE: &str = "duration_s = 1\n";
    const TOUCHES: &str = "duration_s = 1\n\
        [[touch]]\npanel = \"chest\"\nshape = \"ball\"\nat = [1, 1]\nforce_n = 3\nstart_s = 0\n\
        [[touch]]\npanel = \"chest\"\nshape = \"palm\"\nat = [1, 1]\nforce_n = 0.7\nstart_s = 0\n\
        [[trace]]\npanel = \"chest\"\nshape = \"palm\"\npath = [[0.001, 0, 0, 0], [0.002, 1, 0, 0.3], [0.003, 1, 1, 5]]\n\
        [[trace]]\npanel = \"chest\"\nshape = \"finger\"\npath = [[0.0025, 0, 0, 0.1], [0.004, 0, 1, 0]]\n";

    /// Codes of the taxel that the board reads at rest, sample by sample.
    fn codes(mut board: SimBoard, mut between: impl FnMut(&SimHand, u64)) -> Vec<u16> {
        let mut code = |_| {
            between(&board.hand, board.clock.now_ns());
            board.adc.read(26).unwrap()
        };
        (0..3000).map(&mut code).collect()
    }

    #[test]
    fn what_a_hand_draws_is_what_its_script_plays() {
        let garment = Garment::reference();
        let [idle, script] = [IDLE, TOUCHES].map(|text| text.parse::<Script>().unwrap());
        let board = |script| SimBoard::new(&garment, script, 1).unwrap();
        let played = codes(board(&script), |_, _| ());
        assert_ne!(played, codes(board(&idle), |_, _| ()));
        let mut drawn = 0;
        let live = codes(board(&idle), |hand, now| {
            for (number, trace) in script.traces.iter().enumerate() {
                let (number, path) = (number as u64, trace.knots());
                // Each knot becomes known when the one before is reached.
                let due = |at: usize| at.checked_sub(1).map_or(path[0].t_ns, |before| path[before].t_ns);
                for at in (0..path.len()).filter(|at| (now.saturating_sub(1_999)..=now).contains(&due(*at))) {
                    drawn += 1;
                    let (first, lasts) = (at.saturating_sub(1), at + 1 < path.len());
                    match at {
                        0 => hand.trace(number, Trace { path: vec![trace.path[0]], ..trace.clone() }, lasts),
                        _ => hand.draw(number, path[first..=at].to_vec(), lasts),
                    }
                }
            }
            if now == 0 {
                // In the wrong order, after a trace: numbers decide.
                let [one, other] = &script.touches[..] else { panic!("two touches") };
                hand.touch(1, other.clone());
                hand.touch(0, one.clone());
            }
        });
        assert_eq!(drawn, 5);
        assert_eq!(live, played);
        assert!(World::build(&script, &garment).unwrap().newtons(0, 2_999_999) > 0.05);
    }
}
