//! What the filter withholds at the edge of a panel is told.

use super::{BoardAndHost, FINGER};
use taxel_core::condition::{Filter, WithheldTaxel};
use taxel_core::scene::Scene;
use taxel_core::wire::{Report, Request};

fn started(scene: Scene) -> BoardAndHost {
    let mut bench = BoardAndHost::new(scene);
    bench.ask(&Request::Start);
    bench.drain(usize::MAX, |_| ());
    bench
}

/// What is withheld of the next scan; none without a report. It comes before the contacts and the image.
fn withheld(bench: &mut BoardAndHost) -> Option<Vec<WithheldTaxel>> {
    bench.scan();
    let (mut told, mut others) = (None, 0);
    bench.drain(usize::MAX, |report| match report {
        Report::Withheld(report) => {
            assert_eq!((others, report.time.0), (0, 5_000 * u64::from(report.frame)));
            told = Some(report.taxels.to_vec());
        }
        Report::Contacts(_) | Report::Frame(_) => others += 1,
        _ => {}
    });
    told
}

#[test]
fn a_press_at_an_edge_is_withheld_until_it_lasts() {
    let mut bench = started(Scene::shipped());
    assert_eq!(withheld(&mut bench), None);
    // The corners, the ends of rows and of columns of a panel of 4 x 16.
    for taxel in [0, 15, 48, 63, 16, 31, 7, 56] {
        bench.press(&[taxel], 900);
        let told = WithheldTaxel { taxel: taxel as u16, value: 900, filtered: 0 };
        assert_eq!(withheld(&mut bench), Some(vec![told]));
        assert_eq!(withheld(&mut bench), None, "it lasts");
        bench.press(&[taxel], 2_000);
        let told = WithheldTaxel { taxel: taxel as u16, value: 2_000, filtered: 900 };
        assert_eq!(withheld(&mut bench), Some(vec![told]), "more than lasted");
        assert_eq!(withheld(&mut bench), None, "it lasts");
        bench.press(&[taxel], 2_000 + 2_000 / 16);
        assert_eq!(withheld(&mut bench), None, "no more than noise");
        bench.press(&[taxel], 2_300);
        let told = WithheldTaxel { taxel: taxel as u16, value: 2_300, filtered: 2_125 };
        assert_eq!(withheld(&mut bench), Some(vec![told]), "a little more");
        bench.press(&[taxel], 0);
        (0..9).for_each(|_| assert_eq!(withheld(&mut bench), None));
    }
}

#[test]
fn within_a_panel_beside_as_much_and_in_noise_nothing_is_withheld() {
    let mut bench = started(Scene::shipped());
    bench.press(&FINGER, 900);
    bench.press(&[40], 3_000);
    assert_eq!(withheld(&mut bench), None, "nothing of it is at the edge");
    bench.press(&[40], 0);
    bench.press(&[0, 1], 900);
    assert_eq!(withheld(&mut bench), None, "the one has the other beside it");
    bench.press(&[0], 900 + 900 / 16 + 64);
    assert_eq!(withheld(&mut bench), None, "no more than noise");
    bench.press(&[0], 900 + 900 / 16 + 65);
    assert_eq!(withheld(&mut bench).map(|told| told.len()), Some(1));
}

#[test]
fn only_a_filter_that_remembers_withholds() {
    for filter in [Filter::Off, Filter::Conservative, Filter::Median, Filter::Square] {
        let mut scene = Scene::shipped();
        scene.condition.filter = filter;
        let mut bench = started(scene);
        bench.press(&[0], 900);
        assert_eq!(withheld(&mut bench), None);
    }
}
