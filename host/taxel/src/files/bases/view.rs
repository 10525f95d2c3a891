//! Which part of an image is the touch.

use serde::{Deserialize, Serialize};
use taxel_core::shape::{Descriptor, Patch, descriptor};

/// Settings of a view that are known before the images are.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Choice {
    /// Smallest value of a touched taxel, counts; none: that of the base, or 1/32 of the full scale.
    pub threshold: Option<u16>,
    /// Which touched taxels; none: as in the base, or all.
    pub touch: Option<Which>,
}

/// Which taxels above the threshold belong to the touch.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Which {
    /// All of them.
    #[default]
    All,
    /// The part, connected over sides and corners, with the greatest total: a contact.
    Greatest,
}

/// Which part of an image is the touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct View {
    /// Least counts of a touched taxel.
    pub threshold: u16,
    /// Which of them belong to the touch.
    pub touch: Which,
}

impl Choice {
    /// The chosen values, else those of `seen`, else defaults for images whose greatest value is `top`.
    pub fn build(&self, seen: Option<View>, top: u16) -> View {
        let threshold = (u32::from(top) + 1).next_power_of_two().div_ceil(32) as u16;
        let seen = seen.unwrap_or(View { threshold, touch: Which::All });
        View { threshold: self.threshold.unwrap_or(seen.threshold), touch: self.touch.unwrap_or(seen.touch) }
    }
}

impl View {
    /// Describes the touch of an image.
    pub fn describe(&self, image: &[u16], columns: u16) -> Descriptor {
        let columns = usize::from(columns);
        let above = |value: &u16| if *value >= self.threshold.max(1) { *value } else { 0 };
        let mut values: Vec<u16> = image.iter().map(above).collect();
        if self.touch == Which::Greatest {
            values = greatest(&values, columns);
        }
        let rows: Vec<&[u16]> = values.chunks(columns).collect();
        let held = |value: &u16| *value > 0;
        let top = rows.iter().position(|row| row.iter().any(held)).unwrap_or(0);
        let bottom = rows.iter().rposition(|row| row.iter().any(held)).unwrap_or(0);
        let left = rows.iter().filter_map(|row| row.iter().position(held)).min().unwrap_or(0);
        let right = rows.iter().filter_map(|row| row.iter().rposition(held)).max().unwrap_or(0);
        let inside = rows[top..=bottom].iter().flat_map(|row| &row[left..=right]);
        descriptor(&Patch::new(&inside.copied().collect::<Vec<u16>>(), right - left + 1))
    }
}

/// Only the part with the greatest total; of equals the first.
fn greatest(values: &[u16], columns: usize) -> Vec<u16> {
    let mut left: Vec<u16> = values.to_vec();
    let mut best = (0, Vec::new());
    for start in 0..values.len() {
        let (mut part, mut total, mut open) = (Vec::new(), 0u64, vec![start]);
        while let Some(at) = open.pop() {
            let value = std::mem::take(&mut left[at]);
            if value == 0 {
                continue;
            }
            total += u64::from(value);
            part.push(at);
            let (row, column) = (at / columns, at % columns);
            for y in row.saturating_sub(1)..=(row + 1).min(values.len() / columns - 1) {
                open.extend(
                    (column.saturating_sub(1)..=(column + 1).min(columns - 1)).map(|x| y * columns + x),
                );
            }
        }
        if total > best.0 {
            best = (total, part);
        }
    }
    let mut out = vec![0; values.len()];
    best.1.into_iter().for_each(|at| out[at] = values[at]);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_greatest_part_is_a_contact() {
        let image = [9, 0, 0, 3, 0, 9, 0, 3, 0, 0, 0, 3, 1, 0, 0, 8];
        assert_eq!(greatest(&image, 4), [9, 0, 0, 0, 0, 9, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    }
}
