//! Generalised learning vector quantisation (Sato and Yamada 1996): prototypes placed by k-means, then moved
//! so that the nearest of an example's own class is nearer than the nearest of another.

use crate::shape::drawn::CLASSES;
use crate::shape::range;
use fastrand::Rng;
use taxel_core::shape::{Base, Class, FEATURES, ShapeFeatures};

/// An example: features, class, how much it counts.
pub type Example = (ShapeFeatures, Class, f64);

/// Prototypes of each class.
const EACH: usize = Base::BUILT_IN.prototypes.len() / CLASSES.len();
/// Rounds of k-means, and the examples that it takes of a class.
const ROUNDS: usize = 20;
const SAMPLE: usize = 3000;
/// Steps, and examples of each.
const STEPS: usize = 3000;
const BATCH: usize = 256;
/// Length of the first step in units of the features; it falls to nothing.
const RATE: f64 = 3.0;
/// How sharply an example counts that is near the border.
const SHARPNESS: f64 = 10.0;

type FeaturePoint = [f64; FEATURES];

/// A prototype while it learns.
struct LearningPrototype {
    class: Class,
    at: FeaturePoint,
    /// Means of its pull and of the pull's square, as Adam takes them (Kingma and Ba 2015).
    pull: FeaturePoint,
    square: FeaturePoint,
}

/// Prototypes in their final steps.
pub struct Learned {
    prototypes: Vec<(Class, ShapeFeatures)>,
}

fn point(features: &ShapeFeatures) -> FeaturePoint {
    features.map(f64::from)
}

fn distance(a: &FeaturePoint, b: &FeaturePoint) -> f64 {
    (0..FEATURES).map(|i| (a[i] - b[i]).powi(2)).sum()
}

/// Index of the nearest, and its squared distance.
fn nearest<'a>(points: impl Iterator<Item = (usize, &'a FeaturePoint)>, to: &FeaturePoint) -> (usize, f64) {
    let all = points.map(|(index, at)| (index, distance(at, to)));
    all.min_by(|a, b| a.1.total_cmp(&b.1)).expect("there are prototypes")
}

/// Draws examples as often as they count.
struct Urn<'a> {
    examples: &'a [Example],
    sums: Vec<f64>,
}

impl<'a> Urn<'a> {
    fn new(examples: &'a [Example]) -> Urn<'a> {
        let running = examples.iter().scan(0.0, |sum, (.., weight)| {
            *sum += weight;
            Some(*sum)
        });
        Urn { examples, sums: running.collect() }
    }

    fn draw(&self, rng: &mut Rng) -> &'a Example {
        let at = range(rng, 0.0, *self.sums.last().expect("there are examples"));
        let index = self.sums.partition_point(|sum| *sum <= at);
        &self.examples[index.min(self.examples.len() - 1)]
    }
}

/// Centres of the examples of a class.
fn centres(urn: &Urn<'_>, class: Class, rng: &mut Rng) -> Vec<FeaturePoint> {
    let own = std::iter::repeat_with(|| urn.draw(rng)).filter(|example| example.1 == class);
    let points: Vec<FeaturePoint> = own.take(SAMPLE).map(|example| point(&example.0)).collect();
    // Each further one begins at an example drawn by its squared distance to those before (k-means++).
    let mut centres = vec![points[0]];
    while centres.len() < EACH {
        let sums: Vec<f64> = points
            .iter()
            .scan(0.0, |sum, at| {
                *sum += nearest(centres.iter().enumerate(), at).1;
                Some(*sum)
            })
            .collect();
        let at = range(rng, 0.0, sums[SAMPLE - 1]);
        centres.push(points[sums.partition_point(|sum| *sum <= at).min(SAMPLE - 1)]);
    }
    for _ in 0..ROUNDS {
        let mut sums = vec![([0.0; FEATURES], 0.0); EACH];
        for at in &points {
            let (sum, count) = &mut sums[nearest(centres.iter().enumerate(), at).0];
            (0..FEATURES).for_each(|i| sum[i] += at[i]);
            *count += 1.0;
        }
        for (centre, (sum, count)) in centres.iter_mut().zip(&sums).filter(|(_, (_, count))| *count > 0.0) {
            *centre = sum.map(|value| value / count);
        }
    }
    centres
}

/// Learns a base.
pub fn learn(examples: &[Example]) -> Learned {
    let (urn, mut rng) = (Urn::new(examples), Rng::with_seed(1));
    let mut moving = Vec::new();
    for class in CLASSES {
        let new = |at| LearningPrototype { class, at, pull: [0.0; FEATURES], square: [0.0; FEATURES] };
        moving.extend(centres(&urn, class, &mut rng).into_iter().map(new));
    }
    for step in 0..STEPS {
        let mut pulls = vec![[0.0; FEATURES]; moving.len()];
        for _ in 0..BATCH {
            let (features, class, _) = urn.draw(&mut rng);
            let at = point(features);
            let of = |own: bool| {
                let group = moving.iter().enumerate().filter(|(_, one)| (one.class == *class) == own);
                nearest(group.map(|(index, one)| (index, &one.at)), &at)
            };
            let ((own, near), (other, far)) = (of(true), of(false));
            let sum = near + far + 1e-9;
            let cost = 1.0 / (1.0 + (-SHARPNESS * (near - far) / sum).exp());
            let weight = cost * (1.0 - cost) / (sum * sum);
            for i in 0..FEATURES {
                pulls[own][i] += weight * far * (at[i] - moving[own].at[i]);
                pulls[other][i] -= weight * near * (at[i] - moving[other].at[i]);
            }
        }
        let rate = RATE * (1.0 - step as f64 / STEPS as f64);
        moving.iter_mut().zip(&pulls).for_each(|(one, pull)| one.step(pull, rate, step));
    }
    let mut prototypes: Vec<_> =
        moving.iter().map(|one| (one.class, one.at.map(|value| value.round() as i16))).collect();
    // By size within a class.
    prototypes.sort_by_key(|(class, features)| (class.0, features[FEATURES - 1]));
    Learned { prototypes }
}

impl LearningPrototype {
    /// A step of Adam along a pull.
    fn step(&mut self, pull: &FeaturePoint, rate: f64, step: usize) {
        let past = |keep: f64| 1.0 - keep.powi(step as i32 + 1);
        let means = self.pull.iter_mut().zip(&mut self.square);
        for ((at, (mean, square)), pull) in self.at.iter_mut().zip(means).zip(pull) {
            *mean = 0.9 * *mean + 0.1 * pull;
            *square = 0.999 * *square + 0.001 * pull * pull;
            let size = (*square / past(0.999)).sqrt();
            if size > 0.0 {
                *at += rate * *mean / past(0.9) / size;
            }
        }
    }
}

impl Learned {
    /// The prototypes, by class and size.
    pub fn prototypes(&self) -> Vec<(Class, ShapeFeatures)> {
        self.prototypes.clone()
    }

    /// Of which examples the nearest prototype has the class, in percent.
    pub fn percent(&self, examples: &[(ShapeFeatures, Class)]) -> f64 {
        let points: Vec<FeaturePoint> = self.prototypes.iter().map(|(_, features)| point(features)).collect();
        let known = |(features, class): &&(ShapeFeatures, Class)| {
            let (index, _) = nearest(points.iter().enumerate(), &point(features));
            self.prototypes[index].0 == *class
        };
        100.0 * examples.iter().filter(known).count() as f64 / examples.len() as f64
    }

    /// Prints the tables of `core/src/shape/base.rs`.
    pub fn print(&self) {
        for (class, name) in CLASSES.into_iter().zip(["RECTANGLE", "ROUND", "FINGER"]) {
            println!("const {name}: [ShapeFeatures; {EACH}] = [");
            let own = self.prototypes.iter().filter(|(other, _)| *other == class);
            own.for_each(|(_, features)| println!("    {features:?},"));
            println!("];\n");
        }
    }
}
