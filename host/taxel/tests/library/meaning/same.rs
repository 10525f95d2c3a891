//! A touch in millimetres, newtons and seconds has the same meaning on any garment, at any frame rate that
//! resolves it.

use crate::meaning::family::Act;
use crate::meaning::judge::hear;
use crate::meaning::strangers::{self, FAMILIES, Make};
use std::collections::BTreeSet;
use taxel_core::garment::Garment;

/// Intentions announced for a touch, in any order, except for "none".
fn said(act: Act) -> BTreeSet<&'static str> {
    let announced = hear(act).announced;
    announced.iter().map(|(leading, _)| leading.as_str()).filter(|word| *word != "none").collect()
}

/// Frame periods in us, for 25 to 1,562 frames per second.
const PERIODS_US: [u64; 6] = [40_000, 20_000, 10_000, 5_128, 2_000, 640];

/// A blow within one frame may have been slow: it takes two frames to be resolved.
fn is_resolved(family: &str, period_us: u64) -> bool {
    let quick = ["slap of 80 N", "punch", "lash", "stab"].contains(&family);
    !quick || period_us <= 5_128
}

#[test]
fn one_touch_has_one_meaning_on_every_garment_at_every_rate() {
    let large = ["pat", "push", "slap of 80 N", "punch", "leaning"];
    let small = ["tap", "drops"];
    let (mut count, mut wrong) = (0, Vec::new());
    for (family, of) in FAMILIES.iter().enumerate() {
        let garments = match of.name {
            name if large.contains(&name) => vec![Garment::reference(), Garment::mat(), strangers::sheet()],
            name if small.contains(&name) => {
                vec![Garment::reference(), Garment::mat(), strangers::sheet(), Garment::block()]
            }
            _ => continue,
        };
        let wanted = said(strangers::touch_on(family, 0, (Garment::reference(), Make::Uneven), Some(5_128)));
        for garment in garments {
            for period_us in PERIODS_US.into_iter().filter(|period_us| is_resolved(of.name, *period_us)) {
                let have =
                    said(strangers::touch_on(family, 0, (garment.clone(), Make::Uneven), Some(period_us)));
                count += 1;
                if have != wanted {
                    let name = garment.name.clone();
                    wrong.push(format!("{} on {name} at {period_us} us: {have:?}, not {wanted:?}", of.name));
                }
            }
        }
    }
    println!("{} of {count} say what the reference garment does", count - wrong.len());
    wrong.iter().for_each(|line| println!("  {line}"));
    assert!(wrong.len() * 20 <= count, "{wrong:#?}");
}
