//! The unit of a page: newtons where it is known what a newton shows, else counts.

/// From counts to what the page shows. Nothing on a page is in the other unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    per_newton: Option<f64>,
}

impl Scale {
    /// `counts_per_newton`: none, not known.
    pub fn of(counts_per_newton: Option<f32>) -> Scale {
        Scale { per_newton: counts_per_newton.map(f64::from).filter(|counts| *counts > 0.0) }
    }

    /// The unit's name.
    pub fn unit(self) -> &'static str {
        if self.per_newton.is_some() { "N" } else { "counts" }
    }

    /// Counts in the unit.
    pub fn value(self, counts: f64) -> f64 {
        counts / self.per_newton.unwrap_or(1.0)
    }

    /// Counts in the unit, without its name.
    pub fn told(self, counts: impl Into<f64>) -> String {
        let value = self.value(counts.into());
        match self.per_newton {
            None => value.to_string(),
            Some(_) if value >= 10.0 => format!("{value:.1}"),
            Some(_) if value >= 1.0 => format!("{value:.2}"),
            Some(_) => format!("{value:.3}"),
        }
    }
}
