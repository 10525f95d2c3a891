//! Shape of the greatest contact of an image.
#![allow(dead_code)] // each test that uses this takes a part of it

use taxel_core::condition::{ConditionConfig, ConditionState, Feedback, Image, Sampled};
use taxel_core::contact::{Contact, ContactConfig, ContactState, Moments, Quartic};
use taxel_core::format::{Code, Micros};
use taxel_core::garment::{Garment, Layout};
use taxel_core::shape::{Base, Shape, ShapeConfig, Shapes};

/// The shape stage with the built-in base.
pub fn shapes() -> Shapes {
    ShapeConfig::default().build(Base::BUILT_IN).unwrap()
}

/// Shape of the greatest contact of an image.
pub fn shape_of(layout: &Layout, image: &Image) -> Option<Shape> {
    greatest(layout, image, |moments, quartic, contact| shapes().process(moments, quartic, contact))
}

/// Applies `of` to the greatest contact of an image.
pub fn greatest<T>(
    layout: &Layout,
    image: &Image,
    of: impl Fn(&Moments, &Quartic, &Contact) -> T,
) -> Option<T> {
    let mut state: ContactState<8, 1024> = ContactState::new();
    let contacts = ContactConfig::default().build().unwrap();
    let touches = contacts.process(&mut state, layout, image, Micros(0));
    let all = touches.moments().zip(touches.quartics).zip(touches.present);
    let greatest = all.max_by_key(|(_, contact)| contact.total);
    greatest.map(|((moments, quartic), contact)| of(moments, quartic, contact))
}

/// Shape of the greatest contact of a frame of codes.
pub fn shape_of_codes(layout: &Layout, codes: &[Code]) -> Option<Shape> {
    greatest_of_codes(layout, codes, |moments, quartic, contact| shapes().process(moments, quartic, contact))
}

/// Applies `of` to the greatest contact of a frame of codes.
pub fn greatest_of_codes<T>(
    layout: &Layout,
    codes: &[Code],
    of: impl Fn(&Moments, &Quartic, &Contact) -> T,
) -> Option<T> {
    let mut state: Box<ConditionState<2048>> = Box::default();
    state.reset(layout, Code(0));
    let condition = ConditionConfig::default().build().unwrap();
    let sampled = Sampled { codes, falling: false, panels: 1, now: Micros(0) };
    greatest(layout, &condition.process(&mut state, layout, &sampled, &Feedback::<8>::new()), of)
}

/// A garment of one panel, like that of a recording.
pub fn recorded(rows: u16, columns: u16) -> Layout {
    Layout::build(&Garment::recorded(rows, columns), 2048, u16::MAX).unwrap()
}
