//! Removes prototypes that do not affect decisions.

use crate::files::bases::BoardGallery;
use taxel_core::shape::{Exemplar, Point};

/// Hart's condensed nearest neighbour rule: starting with the first prototype of each class, keeps only those
/// that the kept ones would misclassify. From then on one neighbour votes, because the remaining prototypes
/// lie where classes meet.
pub fn prune(gallery: &mut BoardGallery) {
    let all: Vec<Exemplar> = gallery.prototypes.to_vec();
    let mut kept = vec![false; all.len()];
    for class in 0..gallery.names.len() {
        if let Some(first) = all.iter().position(|exemplar| usize::from(exemplar.class) == class) {
            kept[first] = true;
        }
    }
    loop {
        let before = kept.iter().filter(|kept| **kept).count();
        for (at, exemplar) in all.iter().enumerate() {
            let known = all.iter().zip(&kept).filter(|(_, kept)| **kept).map(|(exemplar, _)| exemplar);
            let nearest = known.min_by_key(|known| distance(&known.at, &exemplar.at));
            kept[at] |= nearest.is_some_and(|nearest| nearest.class != exemplar.class);
        }
        if kept.iter().filter(|kept| **kept).count() == before {
            break;
        }
    }
    gallery.prototypes =
        all.iter().zip(&kept).filter(|(_, kept)| **kept).map(|(exemplar, _)| *exemplar).collect();
    gallery.k = 1;
}

fn distance(a: &Point, b: &Point) -> u64 {
    a.iter().zip(b).map(|(a, b)| u64::from(a.abs_diff(*b)).pow(2)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::bases::{Base, shipped_names};

    #[test]
    fn what_is_kept_decides_the_same_of_all_prototypes() {
        for name in shipped_names() {
            let whole = Base::open(name.as_ref()).unwrap().gallery;
            let mut pruned = whole.clone();
            prune(&mut pruned);
            assert!(pruned.prototypes.len() < whole.prototypes.len(), "{name}");
            for exemplar in &whole.prototypes {
                let nearest = pruned.prototypes.iter().min_by_key(|known| distance(&known.at, &exemplar.at));
                assert_eq!(nearest.unwrap().class, exemplar.class, "{name}");
            }
        }
    }
}
