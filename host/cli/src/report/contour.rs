//! Contours by marching squares between the centres of taxels.

/// A segment of a contour, in taxels: x0, y0, x1, y1.
pub type Stretch = [f64; 4];

/// Contour at `level` through an image with `columns` columns. The surroundings of a panel count as 0, so
/// that lines close there.
pub fn lines(values: &[u16], columns: usize, level: f64) -> Vec<Stretch> {
    let rows = values.len().checked_div(columns).unwrap_or(0);
    let at = |row: isize, column: isize| {
        let inside = (0..rows as isize).contains(&row) && (0..columns as isize).contains(&column);
        if inside { f64::from(values[row as usize * columns + column as usize]) } else { 0.0 }
    };
    let mut all = Vec::new();
    for row in -1..rows as isize {
        for column in -1..columns as isize {
            let corner = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(y, x)| at(row + y, column + x));
            square(corner, level, [column as f64, row as f64], &mut all);
        }
    }
    all
}

/// Segments in one square, whose corners run clockwise from its top left.
fn square(corner: [f64; 4], level: f64, [x, y]: [f64; 2], all: &mut Vec<Stretch>) {
    const PLACES: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let cut = |side: usize| -> Option<[f64; 2]> {
        let (a, b) = (corner[side], corner[(side + 1) % 4]);
        if (a >= level) == (b >= level) {
            return None;
        }
        let part = (level - a) / (b - a);
        let ([ax, ay], [bx, by]) = (PLACES[side], PLACES[(side + 1) % 4]);
        Some([x + ax + part * (bx - ax), y + ay + part * (by - ay)])
    };
    let cuts: Vec<_> = (0..4).filter_map(cut).collect();
    // Four crossings are a saddle: each high corner is cut off alone.
    let order = if corner[0] >= level { [3, 0, 1, 2] } else { [0, 1, 2, 3] };
    let pairs = if cuts.len() == 4 { vec![[order[0], order[1]], [order[2], order[3]]] } else { vec![[0, 1]] };
    for [from, to] in pairs {
        if let (Some(from), Some(to)) = (cuts.get(from), cuts.get(to)) {
            all.push([from[0], from[1], to[0], to[1]]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_lies_where_the_pressure_is_its_level() {
        let mut image = [0; 25];
        image[12] = 100;
        let around = lines(&image, 5, 50.0);
        // A diamond of half a taxel around the pressed one.
        assert_eq!(around.len(), 4);
        for [x0, y0, x1, y1] in around {
            assert_eq!([(x0 - 2.0).abs() + (y0 - 2.0).abs(), (x1 - 2.0).abs() + (y1 - 2.0).abs()], [0.5; 2]);
        }
        // At the border it closes outside.
        assert_eq!(lines(&[100], 1, 50.0).len(), 4);
        // Two that touch at a corner stay separate.
        assert_eq!(lines(&[100, 0, 0, 100], 2, 50.0).len(), 8);
        assert!(lines(&[], 0, 50.0).is_empty());
    }
}
