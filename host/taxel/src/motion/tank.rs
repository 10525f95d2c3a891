//! Energy tank: what commands may give to what touches.

/// Energy that is left, J.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tank {
    left_j: f64,
}

impl Tank {
    /// A full tank, J.
    pub fn full(joules: f64) -> Tank {
        Tank { left_j: joules }
    }

    /// Energy that is left, J.
    pub(crate) fn left_j(&self) -> f64 {
        self.left_j
    }

    /// Share, 0 to 1, of velocities with these powers, W, that it can pay for so many seconds; takes that. A power is
    /// that of a contact's force along its motion: above 0 it pushes what touches. What is absorbed from what pushes
    /// fills the tank again, `full_j` at most; it does not pay in the same cycle.
    pub(crate) fn pay(&mut self, powers: &[f64], seconds: f64, full_j: f64) -> f64 {
        let given: f64 = powers.iter().map(|power| power.max(0.0)).sum::<f64>() * seconds;
        let absorbed: f64 = powers.iter().map(|power| (-power).max(0.0)).sum::<f64>() * seconds;
        let share = if given > self.left_j { self.left_j / given } else { 1.0 };
        self.left_j = (self.left_j - share * given + share * absorbed).clamp(0.0, full_j);
        share
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_never_pays_more_than_it_has_and_was_given() {
        let mut random = fastrand::Rng::with_seed(5);
        for _ in 0..1000 {
            let (mut tank, mut paid, mut absorbed) = (Tank::full(1.0), 0.0, 0.0);
            for _ in 0..200 {
                let powers: Vec<f64> = (0..3).map(|_| 40.0 * (random.f64() - 0.4)).collect();
                let share = tank.pay(&powers, 0.005, 1.0);
                assert!((0.0..=1.0).contains(&share) && (0.0..=1.0).contains(&tank.left_j()));
                paid += share * 0.005 * powers.iter().map(|power| power.max(0.0)).sum::<f64>();
                absorbed += share * 0.005 * powers.iter().map(|power| (-power).max(0.0)).sum::<f64>();
            }
            assert!(paid <= 1.0 + absorbed + 1e-9, "{paid} {absorbed}");
        }
    }
}
