//! Cross-validation: stratified k-fold assignment.

/// Assigns units, given by their class, to `folds` folds: classes evenly, in an order drawn by the seed.
/// Returns the fold of each unit.
pub fn stratified(classes: &[usize], folds: usize, seed: u64) -> Vec<usize> {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut order: Vec<usize> = (0..classes.len()).collect();
    random.shuffle(&mut order);
    // Stable: keeps the random order within a class.
    order.sort_by_key(|unit| classes[*unit]);
    let mut fold = vec![0; classes.len()];
    order.into_iter().enumerate().for_each(|(place, unit)| fold[unit] = place % folds.max(1));
    fold
}
