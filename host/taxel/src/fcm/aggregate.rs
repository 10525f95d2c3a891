//! Combines several fuzzy weights into one: aggregates the sets and takes the centroid.

use super::terms::Triangle;

/// Aggregation of memberships of several sets.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Aggregation {
    /// Add memberships: repeated statements count.
    Sum,
    /// Take the greatest membership: repeated statements change nothing.
    Max,
}

/// Centroid of the aggregated sets; 0 without any.
pub fn centroid(sets: &[Triangle], how: Aggregation) -> f64 {
    let (area, moment) = match how {
        // The area under a sum is the sum of the areas.
        Aggregation::Sum => sets.iter().fold((0.0, 0.0), |(area, moment), set| {
            (area + set.area(), moment + set.area() * set.centroid())
        }),
        Aggregation::Max => envelope(sets),
    };
    if area > 0.0 { moment / area } else { 0.0 }
}

/// Exact area and first moment under the maximum of the memberships, which is linear between corners and
/// crossings.
fn envelope(sets: &[Triangle]) -> (f64, f64) {
    let mut points: Vec<f64> = sets.iter().flat_map(|set| [set.from, set.peak, set.to]).collect();
    points.sort_by(f64::total_cmp);
    let corners = points.clone();
    for ends in corners.windows(2) {
        let line = |set: &Triangle| (set.membership(ends[0]), set.membership(ends[1]));
        for (at, one) in sets.iter().enumerate() {
            for other in &sets[at + 1..] {
                let ((a0, a1), (b0, b1)) = (line(one), line(other));
                let (before, after) = (a0 - b0, a1 - b1);
                if before * after < 0.0 {
                    points.push(ends[0] + (ends[1] - ends[0]) * before / (before - after));
                }
            }
        }
    }
    points.sort_by(f64::total_cmp);
    let height = |x: f64| sets.iter().map(|set| set.membership(x)).fold(0.0, f64::max);
    points.windows(2).fold((0.0, 0.0), |(area, moment), ends| {
        let (x0, x1, f0, f1) = (ends[0], ends[1], height(ends[0]), height(ends[1]));
        let width = x1 - x0;
        let own = width / 6.0 * (f0 * (2.0 * x0 + x1) + f1 * (x0 + 2.0 * x1));
        (area + width * (f0 + f1) / 2.0, moment + own)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Centroid by summing a million strips.
    fn counted(sets: &[Triangle], how: Aggregation) -> f64 {
        let strips = 1_000_000;
        let (mut area, mut moment) = (0.0, 0.0);
        for strip in 0..strips {
            let x = (f64::from(strip) + 0.5) * 2.0 / f64::from(strips) - 1.0;
            let all = sets.iter().map(|set| set.membership(x));
            let height = if how == Aggregation::Sum { all.sum() } else { all.fold(0.0, f64::max) };
            (area, moment) = (area + height, moment + height * x);
        }
        moment / area
    }

    #[test]
    fn centroids_are_those_of_the_counted_strips() {
        let of = |terms: &[&str]| -> Vec<Triangle> {
            terms.iter().map(|term| Triangle::of_term(term).unwrap()).collect()
        };
        let mut sets = vec![
            of(&["strong +"]),
            of(&["weak +", "strong +"]),
            of(&["weak +", "weak +", "very strong +"]),
            of(&["medium -", "weak +", "none", "very strong -"]),
        ];
        sets.push(vec![Triangle::of_number(0.9), Triangle::of_number(0.95), Triangle::of_number(-0.3)]);
        for sets in sets {
            for how in [Aggregation::Sum, Aggregation::Max] {
                let (have, want) = (centroid(&sets, how), counted(&sets, how));
                assert!((have - want).abs() < 1e-6, "{how:?} {sets:?}: {have} {want}");
            }
        }
        assert_eq!(centroid(&[], Aggregation::Sum), 0.0);
    }

    #[test]
    fn repeating_a_statement_counts_in_the_sum_alone() {
        let [weak, strong] = ["weak +", "strong +"].map(|term| Triangle::of_term(term).unwrap());
        assert_eq!(
            centroid(&[weak, strong], Aggregation::Max),
            centroid(&[weak, weak, strong], Aggregation::Max)
        );
        assert!(centroid(&[weak, weak, strong], Aggregation::Sum) < 0.45);
    }
}
