//! Touches by hand on a simulated board: what is felt while they are made is what their script plays.

use fastrand::Rng;
use taxel::client::Event;
use taxel::files::scripts;
use taxel::json::message;
use taxel::session::Session;
use taxel::sim::{Script, TOOLS};
use taxel::source::{self, FingerPress, Hand, SourceOptions};

/// Frames of a session by hand.
const FRAMES: u32 = 1200;

/// The lines of frames that name contacts, up to a frame; `act` is called before each.
fn felt(mut session: Session, mut act: impl FnMut(u32)) -> Vec<String> {
    let mut lines = Vec::new();
    while let Some(event) = session.wait().unwrap() {
        let Event::Frame { frame, .. } = event else { continue };
        if frame >= FRAMES {
            return lines;
        }
        act(frame);
        let line = message(session.client(), &event);
        if line["contacts"].as_array().is_some_and(|contacts| !contacts.is_empty()) {
            lines.push(line.to_string());
        }
    }
    lines
}

fn session(script: Script, options: &SourceOptions) -> (Session, Hand) {
    let source = source::simulated(script, options).unwrap();
    let hand = source.hand.clone().unwrap();
    (Session::over(source).unwrap(), hand)
}

/// Presses, moves and lifts up to five fingers at random.
struct Fingers {
    rng: Rng,
    down: Vec<FingerPress>,
}

impl Fingers {
    fn act(&mut self, hand: &Hand) {
        let rng = &mut self.rng;
        if rng.u8(..40) == 0 && self.down.len() < 5 {
            let at = [rng.f64() * 16.0 - 0.5, rng.f64() * 32.0 - 0.5];
            let finger = (0..5).find(|finger| self.down.iter().all(|down| down.finger != *finger)).unwrap();
            let (tool, angle_deg) = (TOOLS[rng.usize(..TOOLS.len())], f64::from(rng.u16(..360)));
            let (panel, force_n) = (rng.usize(..4), rng.f64() * 30.0);
            self.down.push(FingerPress { finger, tool, angle_deg, panel, at, force_n });
        }
        for press in &mut self.down {
            if rng.u8(..3) == 0 {
                press.at = press.at.map(|at| at + rng.f64() - 0.5);
                press.force_n = (press.force_n + 4.0 * rng.f64() - 2.0).max(0.0);
                assert!(hand.press(press.clone()));
            }
        }
        if rng.u8(..60) == 0 && !self.down.is_empty() {
            hand.release(self.down.swap_remove(rng.usize(..self.down.len())).finger);
        }
    }
}

#[test]
fn what_a_hand_presses_is_what_its_file_plays() {
    let options = SourceOptions { repeat: true, waits: true, ..SourceOptions::default() };
    for seed in 0..3 {
        let (live, hand) = session(scripts::load("pat").unwrap(), &options);
        let mut fingers = Fingers { rng: Rng::with_seed(seed), down: Vec::new() };
        let pressed = felt(live, |frame| {
            match frame {
                // Before the garment is tared nobody presses.
                0..40 => {}
                300 => hand.play(scripts::load("five").unwrap()).unwrap(),
                1100.. => fingers.down.drain(..).for_each(|press| hand.release(press.finger)),
                _ => fingers.act(&hand),
            }
        });
        assert!(pressed.len() > 500 && hand.touches() > 5, "{} {}", pressed.len(), hand.touches());
        let text = scripts::text(&hand.script()).unwrap();
        assert!(text.contains("path = [[") && text.contains("[[touch]]"), "{text}");
        let seconds = Some(10.0);
        let saved = scripts::parse(&text, "mine.toml").unwrap();
        let played = felt(session(saved, &SourceOptions { seconds, ..SourceOptions::default() }).0, |_| ());
        assert_eq!(pressed.len(), played.len());
        pressed.iter().zip(&played).for_each(|(live, file)| assert_eq!(live, file));
    }
}

#[test]
fn a_script_waits_for_ten_seconds_of_nobody_and_what_was_pressed_is_played_again() {
    let options = SourceOptions { repeat: true, waits: true, ..SourceOptions::default() };
    let (mut live, hand) = session(scripts::load("finger").unwrap(), &options);
    let press =
        FingerPress { finger: 3, tool: TOOLS[2], angle_deg: 0.0, panel: 1, at: [7.0, 9.0], force_n: 8.0 };
    let (mut contacts, mut pressed) = (Vec::new(), 0);
    while let Some(event) = live.wait().unwrap() {
        let Event::Frame { frame, time, .. } = event else { continue };
        match frame {
            100 => assert!(hand.press(press.clone())),
            400 => hand.again(),
            _ => {}
        }
        let panels: Vec<u8> = live.client().contacts().iter().map(|seen| seen.contact.panel).collect();
        // It lifts by what was felt: how far the board is ahead depends on what else the machine does.
        pressed += usize::from(panels.contains(&1));
        if pressed == 20 {
            hand.release(3);
        }
        contacts.push((time.0, panels));
        if time.0 > 20_000_000 {
            break;
        }
    }
    let on = |from: f64, to: f64, panel: u8| {
        let within = |us: &u64| (from..to).contains(&(*us as f64 / 1e6));
        contacts.iter().filter(|(us, panels)| within(us) && panels.contains(&panel)).count()
    };
    // The hand on the back, and again. The board may be half a second ahead of what was read.
    assert!(on(0.0, 1.9, 1) > 10 && on(1.9, 4.0, 1) > 10, "{} {}", on(0.0, 1.9, 1), on(1.9, 4.0, 1));
    assert_eq!(on(0.0, 12.0, 0), 0, "the script waits");
    assert!(on(12.0, 20.0, 0) > 100, "then it plays, on the chest");
    assert_eq!((on(4.0, 20.0, 1), hand.touches()), (0, 1));
    hand.clear();
    assert_eq!(hand.script().traces.len(), 1, "the board does as it is asked after its next frame");
}

#[test]
fn what_cannot_be_pressed_is_refused() {
    let (_session, hand) = session(scripts::load("idle").unwrap(), &SourceOptions::default());
    let tool = TOOLS[0];
    let press = FingerPress { finger: 0, tool, angle_deg: 0.0, panel: 3, at: [1.0, 1e300], force_n: 200.0 };
    assert!(hand.press(press.clone()), "a place is kept on the panel");
    for wrong in [
        FingerPress { panel: 4, ..press.clone() },
        FingerPress { at: [f64::NAN, 0.0], ..press.clone() },
        FingerPress { angle_deg: f64::INFINITY, ..press.clone() },
        FingerPress { force_n: 200.1, ..press.clone() },
        FingerPress { force_n: -1.0, ..press.clone() },
    ] {
        assert!(!hand.press(wrong.clone()), "{wrong:?}");
    }
    let pressed =
        (0..100).filter(|finger| hand.press(FingerPress { finger: *finger, ..press.clone() })).count();
    assert_eq!(pressed, 16);
    let [none, seventeen] = [Script { touches: Vec::new(), ..hand.script() }, {
        let text = "duration_s = 1\n[[touch]]\npanel = \"tail\"\nshape = \"palm\"\nat = [1, 1]\nforce_n = 1\nstart_s = 0";
        scripts::parse(text, "tail.toml").unwrap()
    }];
    hand.play(none).unwrap();
    assert!(hand.play(seventeen).unwrap_err().to_string().contains("`panel` is \"tail\""));
}
