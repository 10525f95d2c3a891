//! The taxels that a shift of the garment may bring to where one lies.

use taxel_core::garment::{ASSUMED_PITCH_UM, Area, Layout};

/// Numbers of the taxels of the same panel within `shift_mm` of a taxel, itself among them.
pub(super) fn near(layout: &Layout, taxel: usize, shift_mm: f32) -> Vec<usize> {
    let holds = |area: &&Area| {
        let first = usize::from(area.base);
        (first..first + usize::from(area.rows) * usize::from(area.columns)).contains(&taxel)
    };
    let Some(area) = layout.areas().iter().find(holds) else { return vec![taxel] };
    let columns = usize::from(area.columns);
    let (row, column) =
        ((taxel - usize::from(area.base)) / columns, (taxel - usize::from(area.base)) % columns);
    let pitch = area.pitch_um.map(|um| if um == 0 { ASSUMED_PITCH_UM } else { um } as f32 / 1000.0);
    let place = |row: usize, column: usize| usize::from(area.base) + row * columns + column;
    let within = |at: &(usize, usize)| {
        let away = [at.1.abs_diff(column) as f32 * pitch[0], at.0.abs_diff(row) as f32 * pitch[1]];
        away[0].hypot(away[1]) <= shift_mm
    };
    let all = (0..usize::from(area.rows)).flat_map(|row| (0..columns).map(move |column| (row, column)));
    all.filter(within).map(|(row, column)| place(row, column)).collect()
}
