//! Robots: a URDF's links and joints, where the links are in a posture, and how far off they may be.
//!
//! | file | holds |
//! |---|---|
//! | `element.rs` | elements of the XML, and errors with their line |
//! | `urdf.rs` | links and joints as the file has them |
//! | `model.rs` | the robot |
//! | `tree.rs` | links and joints joined to a robot |
//! | `kinematics.rs` | where the links are |
//! | `jacobian.rs` | how the joints move a point of a link |
//! | `reach.rs` | how far a point is off if the joints are |
//! | `positions.rs` | positions of joints by name, limits |
//! | `shapes.rs` | meshes that a link names, and other shapes |
//! | `file.rs` | files and the preset |

mod element;
mod file;
mod jacobian;
mod kinematics;
mod model;
mod positions;
mod reach;
mod shapes;
mod tree;
mod urdf;

pub use file::{parse, read};
pub use kinematics::Poses;
pub use model::{Drive, JointKind, Robot, RobotJoint, RobotLink};
pub use shapes::{LinkMesh, LinkShape, LinkSolid, SolidsOf, meshes, solids};

pub(super) use file::text;
