//! Speed and slip; `tests/tracking` has more.

use crate::hard::rig::ContactRig;

#[test]
fn speed_and_slip() {
    let mut rig = ContactRig::mat();
    // A still finger with noise of +-3 counts never slips.
    let mut state = 1u32;
    for _ in 0..2000 {
        for (row, column) in [(8, 8), (8, 9), (9, 8), (9, 9)] {
            state = state.wrapping_mul(1664525).wrapping_add(1013904223);
            rig.set(0, row, column, 1000 - 3 + (state >> 24) as u16 % 7);
        }
        let contact = rig.only();
        assert!(!contact.slip && contact.vx.to_f64().hypot(contact.vy.to_f64()) < 0.3);
    }
    // Ten taxels per second: 0.05128 of a column in each frame, by sharing the pressure of two columns.
    let mut slips = 0;
    for frame in 0..195 {
        let at = 8.0 + f64::from(frame) * 0.05128;
        let (column, part) = (at.floor() as u16, (at.fract() * 1000.0) as u16);
        rig.clear().fill([8, 9], [column, column], 1000 - part).fill([8, 9], [column + 1, column + 1], 1000);
        rig.fill([8, 9], [column + 2, column + 2], part);
        let contact = rig.only();
        slips += usize::from(contact.slip);
        if frame > 100 {
            assert!((contact.vx.to_f64() - 10.0).abs() < 1.5, "{}", contact.vx.to_f64());
            assert!(contact.slip);
        }
    }
    assert!(slips > 170, "{slips}");
    assert!((rig.only().dx.to_f64() - 9.95).abs() < 0.1);
}
