//! The largest layout on which everything is exact, and the first that is refused.

use crate::plain::Plain;
use taxel_core::contact::Moments;
use taxel_core::garment::{Garment, GarmentError, Layout, Seam, SeamEdge, Side};

fn build(rows: u16, columns: u16, full_scale: u16) -> Result<Layout, GarmentError> {
    Layout::build(&Garment::recorded(rows, columns), usize::from(u16::MAX), full_scale)
}

/// `J m` of the saturated panel. `m J` is the sum of `f_i f_j d_ij^2` over all pairs: no other touch has a
/// greater one.
fn most(rows: u16, columns: u16, full_scale: u16) -> i128 {
    let (n, w, h) = (i128::from(rows) * i128::from(columns), i128::from(columns), i128::from(rows));
    (i128::from(full_scale) * n).pow(2) * (w * w + h * h - 2) / 12
}

#[test]
fn the_longest_strip_is_exact_and_the_next_is_refused() {
    for (full_scale, longest) in [(255, 7638), (1023, 3813), (4095, 1906), (u16::MAX, 476)] {
        for (rows, columns) in [(1, longest), (longest, 1)] {
            assert!(build(rows, columns, full_scale).is_ok(), "{rows} x {columns}");
            let taxels: Vec<(u32, u32, u16)> = (0..u32::from(rows))
                .flat_map(|y| (0..u32::from(columns)).map(move |x| (x, y, full_scale)))
                .collect();
            let plain = Plain::of(&taxels);
            assert_eq!(plain.jm(), most(rows, columns, full_scale));
            assert!(plain.jm() < 1 << 64 && plain.jm() > 1 << 63);
            let image = vec![full_scale; taxels.len()];
            assert!(plain.agrees(&Moments::of_image(&image, columns.into())));
            // One more would wrap.
            let (rows, columns) = (rows + u16::from(rows > 1), columns + u16::from(columns > 1));
            assert!(most(rows, columns, full_scale) >= 1 << 64);
            let refused = build(rows, columns, full_scale).unwrap_err();
            assert!(
                matches!(refused, GarmentError::Inexact { full_scale: stated, .. } if stated == full_scale)
            );
        }
    }
}

/// Every panel of up to 256 x 256 at 12 and 16 bits: accepted exactly where the saturated panel fits.
#[test]
fn a_panel_is_refused_exactly_where_it_would_wrap() {
    let mut refused = 0;
    for full_scale in [4095, u16::MAX] {
        for (rows, columns) in (1..256u16).flat_map(|rows| (1..256).map(move |columns| (rows, columns))) {
            let fits = most(rows, columns, full_scale) < 1 << 64;
            let built = build(rows, columns, full_scale);
            assert_eq!(built.is_ok(), fits, "{rows} x {columns} at {full_scale}");
            refused += u32::from(!fits);
        }
    }
    println!("{refused} of 130050 panels refused");
    assert!(refused > 50_000);
    // What ships fits at any depth of the converter.
    for garment in [Garment::mat(), Garment::reference(), Garment::block()] {
        assert!(Layout::build(&garment, 2048, u16::MAX).is_ok());
    }
}

/// Sewn panels count as one with their lengths end to end, because a contact may reach over all of them.
#[test]
fn sewn_panels_are_refused_together() {
    let strip = |panels: usize, length: u16| {
        let mut garment = Garment::recorded(1, length);
        for index in 1..panels {
            let mut next = garment.panels[0].clone();
            next.name = taxel_core::format::name(&index.to_string());
            garment.panels.push(next).unwrap();
            let edge = |panel: usize, side| SeamEdge { panel: panel as u8, side, start: 0 };
            let seam = Seam {
                a: edge(index - 1, Side::Right),
                b: edge(index, Side::Left),
                length: 1,
                reversed: false,
            };
            garment.seams.push(seam).unwrap();
        }
        Layout::build(&garment, usize::from(u16::MAX), u16::MAX)
    };
    assert!(strip(1, 400).is_ok());
    assert!(matches!(strip(2, 400), Err(GarmentError::Inexact { .. })));
    // Two boxes of side 2 n: (F 2 n)^2 (8 n^2 - 2) / 12 < 2^64 up to n = 200.
    assert!(strip(2, 200).is_ok());
    assert!(matches!(strip(2, 201), Err(GarmentError::Inexact { .. })));
}
