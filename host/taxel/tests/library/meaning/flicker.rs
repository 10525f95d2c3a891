//! Names and words do not flicker: they change with the touch, not with each frame.

use crate::meaning::family::{Act, Family};
use crate::meaning::judge::play;
use crate::meaning::{scripted, strangers};
use taxel_core::contact::Phase;

/// Changes during one touch.
#[derive(Default)]
struct Count {
    seconds: f64,
    ids: usize,
    /// Changes of the class, and of moving or still.
    classes: usize,
    moves: usize,
    events: usize,
}

/// Families, and the function that makes their touches.
type Author = (&'static [Family], fn(usize, u64) -> Act);

fn count(mut act: Act) -> Count {
    let mut count = Count { seconds: (act.span.1 - act.span.0) as f64 / 1e6, ..Count::default() };
    let mut said = std::collections::BTreeMap::new();
    play(&mut act, |_, percept| {
        for symbol in percept.events() {
            count.events += 1;
            count.ids += usize::from(symbol.phase == Phase::Onset);
            if let Some((class, moving)) =
                said.insert(symbol.contact, (symbol.words.class, symbol.words.moving))
            {
                count.classes += usize::from(class != symbol.words.class);
                count.moves += usize::from(moving != symbol.words.moving);
            }
        }
    });
    count
}

#[test]
fn a_held_touch_keeps_its_name() {
    let authors: [Author; 2] = [(&scripted::FAMILIES, scripted::act), (&strangers::FAMILIES, strangers::act)];
    println!("touch        author      seconds   ids  classes  moves  events");
    for (author, (families, act)) in ["scripted", "strangers"].into_iter().zip(authors) {
        for name in ["hug", "caress", "tickle", "handshake", "massage"] {
            let Some(family) = families.iter().position(|family| family.name == name) else { continue };
            for seed in 0..2 {
                let count = count(act(family, seed));
                let Count { seconds, ids, classes, moves, events } = count;
                println!("{name:<12} {author:<10} {seconds:8.1} {ids:5} {classes:8} {moves:6} {events:7}");
                // Each contact may change its class once at first, and once per second.
                assert!(classes as f64 <= ids as f64 + seconds, "{name} of {author}");
                assert!(moves as f64 <= 2.0 * ids as f64 + 2.0 * seconds, "{name} of {author}");
            }
        }
    }
}
