//! The map of shapes, beside the k-NN of `core/tests/core/shape`.

use crate::drawn::{CLASSES, DrawnTouch};
use crate::random::Noise;
use crate::shape_of::*;
use taxel::fcm::{board::BoardMap, load};
use taxel_core::contact::{Contact, Moments, Quartic};
use taxel_core::format::Q15;
use taxel_core::shape::nmi;

/// The shipped map for shapes uses only the NMI by peak: 0.399 for a disc, more for elongated shapes.
#[test]
fn the_shape_map_stands_beside_the_knn() {
    let map = BoardMap::build(&load::map("shape").unwrap()).unwrap();
    let concepts = ["rectangle", "round", "finger"].map(|name| map.map.find(name).unwrap());
    let mut rng = Noise(42);
    for (rows, columns, least) in [(4u16, 16u16, 45), (16, 16, 80), (32, 64, 95)] {
        let layout = recorded(rows, columns);
        // Rows are true shapes, columns decisions.
        let mut confusion = [[0; 3]; 3];
        for (index, class) in CLASSES.into_iter().enumerate().cycle().take(300) {
            let touch = DrawnTouch::random(class, rows, columns, &mut rng);
            let form =
                |moments: &Moments, _: &Quartic, contact: &Contact| nmi(moments, contact.peak).peak_sheppard;
            let form = greatest_of_codes(&layout, &touch.codes(rows, columns), form).expect("a contact");
            let run = map.infer(&map.map.encode(None, &[Q15((form.0 >> 9) as i32)]));
            let answer = (0..3).max_by_key(|answer| run.state[concepts[*answer]]).expect("there are three");
            confusion[index][answer] += 1;
        }
        let percent = (0..3).map(|class| f64::from(confusion[class][class])).sum::<f64>() / 3.0;
        println!(
            "drawn shapes by the map, {rows} x {columns}: {percent:.1} % of 300 right (chance 33 %): {confusion:?}"
        );
        assert!(percent >= f64::from(least));
    }
}
