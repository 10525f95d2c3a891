//! Checks recorded frames before conclusions are drawn: start-up transients, saturation, implausible units.

/// Number of frames at the start of a recording that a transient may spoil.
const FIRST: usize = 3;

/// Least number of frames by which a transient can be distinguished from a touch.
const FEWEST: usize = 8;

/// Factor by which the total of a transient exceeds that of any later frame.
const ABOVE: u64 = 8;

/// Least number of values at a ceiling, and the factor by which they outnumber any value just below.
const PILED: usize = 100;
const OUTNUMBER: usize = 10;

/// Warning about recordings (name and frames) that begin with a transient; none if none does.
pub fn start_ups<'a, F: Iterator<Item = &'a [u16]>>(
    recordings: impl Iterator<Item = (String, F)>,
) -> Option<String> {
    let (mut count, mut found) = (0, Vec::new());
    for (name, frames) in recordings {
        count += 1;
        let totals: Vec<u64> =
            frames.map(|frame| frame.iter().map(|value| u64::from(*value)).sum()).collect();
        found.extend(transient(&totals).map(|(frame, times)| (name, frame, times)));
    }
    let (name, frame, times) = found.first()?;
    let all = if count == 1 { String::new() } else { format!("{} of {count} recordings, ", found.len()) };
    let what = format!("{all}{name}: frame {frame} has {times} times the total of any frame after the third");
    Some(format!("{what}, as when a sensor starts up; cut the first frames"))
}

/// Index of the last start-up frame that is a transient, and the factor by which its total exceeds any later
/// frame's.
fn transient(totals: &[u64]) -> Option<(usize, u64)> {
    let (first, later) = totals.split_at_checked(FIRST).filter(|_| totals.len() >= FEWEST)?;
    let most = later.iter().copied().max().unwrap_or(0).max(1);
    let frame = first.iter().rposition(|total| *total > most.saturating_mul(ABOVE))?;
    Some((frame, first[frame] / most))
}

/// Returns the greatest value if values saturate there: many have it, and few the values just below.
pub fn top(values: impl Iterator<Item = u16>) -> Option<u16> {
    let mut counts = vec![0usize; 1 << 16];
    values.for_each(|value| counts[usize::from(value)] += 1);
    let top = counts.iter().rposition(|count| *count > 0)?;
    let below = counts[top - top / 10..top].iter().copied().max().unwrap_or(0);
    (top > 0 && counts[top] >= PILED && counts[top] >= OUTNUMBER * below).then_some(top as u16)
}

/// Warning about frames whose greatest value does not fit the full scale; none if it does.
pub fn full_scale(greatest: u16, full_scale: u16) -> Option<String> {
    if greatest > full_scale {
        Some(format!(
            "values reach {greatest}, more than the full scale of {full_scale}: set it with --full-scale"
        ))
    } else if greatest > 0 && greatest < full_scale / 16 {
        let why = "the scene's limits are shares of it, so that few touches or none are found";
        Some(format!("no value is above {greatest} of a full scale of {full_scale}: {why}; see --full-scale"))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_start_up_is_reported_and_a_touch_at_the_beginning_is_not() {
        let reported = |totals: &[u16]| {
            let frames: Vec<Vec<u16>> = totals.iter().map(|total| vec![*total, 1]).collect();
            start_ups([("a".to_string(), frames.iter().map(Vec::as_slice))].into_iter())
        };
        let spoilt = reported(&[6, 2200, 70, 71, 72, 73, 70, 71]).unwrap();
        assert!(
            spoilt.starts_with("a: frame 1 has 29 times the total of any frame after the third"),
            "{spoilt}"
        );
        assert_eq!(reported(&[80, 90, 85, 71, 40, 12, 12, 12]), None);
        assert_eq!(reported(&[6, 2200, 70, 71, 72, 73, 70]), None, "too short to say");
        let two = [vec![vec![9u16]; 8], [vec![vec![900]], vec![vec![9]; 7]].concat()];
        let named = two.iter().enumerate().map(|(n, r)| (n.to_string(), r.iter().map(Vec::as_slice)));
        assert!(start_ups(named).unwrap().starts_with("1 of 2 recordings, 1: frame 0 has 100 times"));
    }

    #[test]
    fn values_stop_where_many_are_and_few_just_below() {
        let rising = || (0..1000u16).cycle().take(5000);
        assert_eq!(top(rising()), None);
        assert_eq!(top(rising().map(|value| value.min(510))), Some(510));
        assert_eq!(top(std::iter::repeat_n(0, 5000)), None);
    }

    #[test]
    fn a_full_scale_fits_from_a_sixteenth_on() {
        assert_eq!((full_scale(4095, 4095), full_scale(255, 4095), full_scale(0, 4095)), (None, None, None));
        assert!(full_scale(254, 4095).unwrap().starts_with("no value is above 254 of a full scale of 4095"));
        assert!(full_scale(4096, 4095).unwrap().starts_with("values reach 4096, more than"));
    }
}
