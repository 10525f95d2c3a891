//! The built-in base, from codes to class, on a generator that it was not learned from: discs, rotated
//! rectangles and fingers of 1 : 1.8 to 1 : 2.5 at gains of 0.2 to 0.9.

use crate::random::Noise;
use crate::shape::drawn::{CLASSES, DrawnTouch};
use crate::shape::rig::{recorded, shape_of_codes};
use taxel_core::condition::{Image, Rows};
use taxel_core::contact::{ContactConfig, ContactState};
use taxel_core::format::{Code, Micros};
use taxel_core::shape::{Base, Class, ShapeConfig};

#[test]
fn drawn_shapes_are_recognised() {
    let mut noise = Noise(42);
    for (rows, columns, least) in [(4u16, 16u16, 84), (16, 16, 86), (32, 64, 85)] {
        let layout = recorded(rows, columns);
        let (mut right, mut all) = (0, 0);
        for class in CLASSES.into_iter().cycle().take(600) {
            let touch = DrawnTouch::random(class, rows, columns, &mut noise);
            let shape = shape_of_codes(&layout, &touch.codes(rows, columns)).expect("a contact");
            right += u32::from(shape.class == class);
            all += 1;
        }
        let percent = 100.0 * f64::from(right) / f64::from(all);
        println!("drawn shapes, {rows} x {columns}: {percent:.1} % of {all} right (chance 33 %)");
        assert!(percent >= f64::from(least));
    }
}

#[test]
fn forms_do_not_follow_pressure() {
    let layout = recorded(32, 64);
    let mut touch = DrawnTouch::random(Class::ROUND, 32, 64, &mut Noise(3));
    (touch.size, touch.x, touch.y) = (7.3, 31.2, 15.9);
    let mut at = |gain: f64| {
        touch.gain = gain;
        shape_of_codes(&layout, &touch.codes(32, 64)).unwrap()
    };
    let (soft, firm) = (at(0.05), at(0.8));
    // The published NMI scales with one over the root of the pressure: 4 times less at 16 times the pressure.
    let ratio = soft.nmi.to_f64() / firm.nmi.to_f64();
    assert!((ratio - 4.0).abs() < 0.1, "{ratio}");
    for (form, ideal) in
        [(soft.nmi_peak, 0.41), (firm.nmi_peak, 0.41), (soft.nmi_s2, 0.39), (firm.nmi_s2, 0.39)]
    {
        assert!((form.to_f64() - ideal).abs() < 0.02, "{}", form.to_f64());
    }
    assert_eq!((soft.class, firm.class), (Class::ROUND, Class::ROUND));
}

#[test]
fn what_is_none_of_them_is_unknown() {
    let layout = recorded(32, 64);
    let codes = |inside: fn(i32, i32) -> bool| -> Vec<Code> {
        (0..2048).map(|i| Code(if inside(i % 64, i / 64) { 2000 } else { 0 })).collect()
    };
    let class = |inside| shape_of_codes(&layout, &codes(inside)).unwrap().class;
    let ring = |x: i32, y: i32| (49..100).contains(&((x - 30).pow(2) + (y - 15).pow(2)));
    assert_eq!(class(ring), Class::UNKNOWN);
    assert_eq!(class(|x, y| y == 9 && x > 3), Class::UNKNOWN);
    assert_eq!(class(|x, y| x == y), Class::UNKNOWN);
    assert_eq!(Base::BUILT_IN.name(Class::UNKNOWN), "unknown");
    assert_eq!(Base::BUILT_IN.name(Class::FINGER), "finger");
}

#[test]
fn settings_are_checked() {
    let refused = |config: ShapeConfig| config.build(Base::BUILT_IN).unwrap_err().parameter;
    let config = ShapeConfig::default();
    assert_eq!(refused(ShapeConfig { k: 0, ..config }), "shape.k");
    assert_eq!(refused(ShapeConfig { k: 10, ..config }), "shape.k");
    assert_eq!(refused(ShapeConfig { reject: 0, ..config }), "shape.reject");
    let base = Base { names: &Base::BUILT_IN.names[..2], ..Base::BUILT_IN };
    assert_eq!(config.build(base).unwrap_err().parameter, "shape.base");
    for k in 1..=9 {
        let shape = ShapeConfig { k, ..config }.build(Base::BUILT_IN).unwrap();
        let layout = recorded(16, 16);
        let codes = DrawnTouch::random(Class::FINGER, 16, 16, &mut Noise(5)).codes(16, 16);
        let values: Vec<u16> = codes.iter().map(|code| code.0).collect();
        let mut state: ContactState<8, 128> = ContactState::new();
        let image = Image { values: &values, rows: &Rows::ALL };
        let stage = ContactConfig::default().build().unwrap();
        let touches = stage.process(&mut state, &layout, &image, Micros(0));
        let shape =
            shape.process(touches.moments().next().unwrap(), &touches.quartics[0], &touches.present[0]);
        assert_eq!(shape.class, Class::FINGER);
        assert!(shape.confidence.0 > 16384 && shape.confidence.0 <= 32768);
    }
}
