//! Models of touches and bases of shapes, trained on drawn data.

mod called;
#[path = "../../../../core/tests/core/shape/drawn.rs"]
mod drawn;
mod drawn_images;
#[path = "../../../../core/tests/core/random.rs"]
mod random;
mod recorded_doubts;
mod touches;
