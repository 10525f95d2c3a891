//! Number of taxels in each range of pressure.

use super::scale::PageUnit;
use super::svg::colour;
use crate::palette::BANDS;
use std::fmt::Write;

/// Lower limits of the ranges: equal parts of `top`, the first at 0.
pub fn limits(top: u16) -> Vec<u16> {
    (0..BANDS).map(|index| (u32::from(top) * u32::from(index) / u32::from(BANDS)) as u16).collect()
}

/// Number of taxels without pressure, then in each range.
pub fn counts(values: &[u16], limits: &[u16]) -> Vec<usize> {
    let mut counts = vec![0; limits.len() + 1];
    for value in values {
        let range = if *value == 0 { 0 } else { limits.partition_point(|limit| limit < value) };
        counts[range] += 1;
    }
    counts
}

/// Table with a row per range: colour, and numbers of taxels at the moment and at their maxima, as bars.
pub fn table(then: &[u16], hold: &[u16], top: u16, scale: PageUnit) -> String {
    let limits = limits(top);
    let (now, held) = (counts(then, &limits), counts(hold, &limits));
    let most = now.iter().skip(1).chain(held.iter().skip(1)).copied().max().unwrap_or(0).max(1);
    let mut html = format!(
        "<table><tr><th>colour</th><th>on a taxel, {}</th><th>taxels at that moment</th><th>at their greatest</th></tr>\n",
        scale.unit()
    );
    for (index, (now, held)) in now.iter().zip(&held).enumerate() {
        let from = if index == 0 { 0 } else { limits[index - 1] + 1 };
        let to = if index == 0 { 0 } else { limits.get(index).copied().unwrap_or(top) };
        let range = match index {
            0 => "0".to_string(),
            _ if index == limits.len() => format!("{} and more", scale.text_of(from)),
            _ => format!("{} to {}", scale.text_of(from), scale.text_of(to)),
        };
        let fill = colour(f64::midpoint(f64::from(from), f64::from(to)), top);
        let bar = |count: usize| {
            // Taxels without pressure far outnumber the others.
            let wide = if index == 0 { 0.0 } else { 120.0 * count as f64 / most as f64 };
            format!(
                "<td><span class=\"bar\" style=\"width:{wide:.0}px;background:{fill}\"></span>{count}</td>"
            )
        };
        // Writing to a string cannot fail.
        let _ = writeln!(
            html,
            "<tr><td><span class=\"swatch\" style=\"background:{fill}\"></span></td><td>{range}</td>{}{}</tr>",
            bar(*now),
            bar(*held)
        );
    }
    html + "</table>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_taxel_lies_in_one_range() {
        let limits = limits(1000);
        assert_eq!(limits, [0, 200, 400, 600, 800]);
        assert_eq!(counts(&[0, 0, 1, 200, 201, 999, 1000, 4095], &limits), [2, 2, 1, 0, 0, 3]);
    }
}
