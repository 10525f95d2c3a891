//! A sensor's own times and numbers, which wrap.

use super::number::NumberForm;
use serde::Deserialize;

/// Unit of a sensor's time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TimeUnit {
    /// microseconds
    Us,
    /// milliseconds
    Ms,
    /// seconds
    S,
}

impl TimeUnit {
    /// Microseconds.
    pub fn us(self) -> u64 {
        match self {
            TimeUnit::Us => 1,
            TimeUnit::Ms => 1_000,
            TimeUnit::S => 1_000_000,
        }
    }
}

/// Time of a sensor whose counter wraps.
#[derive(Debug)]
pub struct SensorTime {
    /// Microseconds until it wraps; none if it does not.
    period_us: Option<u64>,
    /// Last time, and the sum of all wraps before it.
    last_us: u64,
    wrapped_us: u64,
}

impl SensorTime {
    /// A time of this unit; of this form if it is counted in bytes.
    pub fn new(unit: TimeUnit, form: Option<NumberForm>) -> SensorTime {
        let period_us = form.map(|form| unit.us() << form.bits());
        SensorTime { period_us, last_us: 0, wrapped_us: 0 }
    }

    /// Returns the time without wraps. A small step back is none.
    pub(crate) fn unwrapped(&mut self, time_us: u64) -> u64 {
        if let Some(period) = self.period_us
            && self.last_us > time_us
            && self.last_us - time_us > period / 2
        {
            self.wrapped_us = self.wrapped_us.saturating_add(period);
        }
        self.last_us = time_us;
        self.wrapped_us.saturating_add(time_us)
    }
}

/// Numbers of frames.
#[derive(Debug)]
pub struct SensorCount {
    bits: u32,
    last: Option<u32>,
}

impl SensorCount {
    /// Numbers of this form.
    pub fn new(form: NumberForm) -> SensorCount {
        SensorCount { bits: form.bits() as u32, last: None }
    }

    /// Returns how many frames are missing in front of this number. A step back by less than half of all numbers is
    /// a restart.
    pub fn gap(&mut self, number: u32) -> u64 {
        let Some(last) = self.last.replace(number) else { return 0 };
        let mask = u32::MAX >> (32 - self.bits);
        let step = number.wrapping_sub(last) & mask;
        if step > mask / 2 { 0 } else { u64::from(step).saturating_sub(1) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wraps_are_no_steps_back_and_gaps_are_counted() {
        let mut time = SensorTime::new(TimeUnit::Ms, Some(NumberForm::U16le));
        assert_eq!(
            [65_000_000, 65_535_000, 500_000].map(|us| time.unwrapped(us)),
            [65_000_000, 65_535_000, 66_036_000]
        );
        let mut count = SensorCount::new(NumberForm::U8);
        assert_eq!([250, 251, 255, 0, 3, 3, 2].map(|number| count.gap(number)), [0, 0, 3, 0, 2, 0, 0]);
    }
}
