//! Unit of a page: newtons if the counts per newton are known, else counts.

/// Converts counts to the unit of the page, which uses no other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PageUnit {
    per_newton: Option<f64>,
}

impl PageUnit {
    /// Unit for these counts per newton, if known.
    pub fn of(counts_per_newton: Option<f64>) -> PageUnit {
        PageUnit { per_newton: counts_per_newton }
    }

    /// Name of the unit.
    pub fn unit(self) -> &'static str {
        if self.per_newton.is_some() { "N" } else { "counts" }
    }

    /// Converts counts to the unit.
    pub fn value(self, counts: f64) -> f64 {
        counts / self.per_newton.unwrap_or(1.0)
    }

    /// Formats counts in the unit, without its name.
    pub fn text_of(self, counts: impl Into<f64>) -> String {
        let value = self.value(counts.into());
        match self.per_newton {
            None => value.to_string(),
            Some(_) if value >= 10.0 => format!("{value:.1}"),
            Some(_) if value >= 1.0 => format!("{value:.2}"),
            Some(_) => format!("{value:.3}"),
        }
    }
}
