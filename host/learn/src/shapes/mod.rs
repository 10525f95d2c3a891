//! Recognition of objects by the shape of their contact.
//!
//! Images become descriptors ([`view`](taxel::files::bases::view), and `descriptor` of the core). A discriminant
//! analysis finds the directions that separate the classes ([`discriminant`]). In this space the examples of
//! each class become prototypes, at most 200 in all ([`train`]). The confidence of votes is measured on left-out
//! folds ([`cross`], [`calibrate`]). The resulting gallery is in integers and runs on a board; every figure
//! is that of these integers.

pub mod calibrate;
pub mod classes;
pub mod cross;
pub mod data;
pub mod discriminant;
pub mod labels;
pub mod select;
pub mod sheet;
pub mod train;
pub mod trained;
