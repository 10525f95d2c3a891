//! Teaching by touch: objects, folds of the garment, and checks of what was recorded. Models are trained on data
//! sets by the crate `taxel-learn` of the repository.

pub mod confusion;
pub mod doubts;
pub mod fingerprint;
pub mod folds;
pub mod model;
pub mod shapes;
