//! The garment on the robot: where each taxel lies and which way it faces, on the links of the robot's
//! description (URDF).
//!
//! All lengths are in metres, all vectors in the frame of a link. A panel is drawn as it is seen from
//! outside: columns (x) run to the right, rows (y) down, and the normals point to whoever looks.
//!
//! ```
//! use taxel::body::{Body, Surface, wrenches};
//! use taxel_core::garment::{Garment, Layout};
//!
//! let body: Body = toml::from_str(
//!     r#"
//!     [[patches]]
//!     panel = "mat"
//!     on.cylinder = { at = [0, 0, 0.4], axis = [0, 0, -1], radius = 0.06, facing = [1, 0, 0] }
//!     "#,
//! )?;
//! let garment = Garment::mat();
//! let surface = Surface::build(&body, &garment, &Layout::build(&garment, 2048, 4095)?)?;
//! // 2 N on each taxel of the first row.
//! let newtons: Vec<f64> = (0..2048).map(|taxel| if taxel < 32 { 2.0 } else { 0.0 }).collect();
//! let on_base = &wrenches(&surface, &newtons)[0];
//! assert_eq!((surface.links()[on_base.link].as_str(), on_base.pressed), ("base", 64.0));
//! assert!((on_base.center.z - 0.4 - 0.315).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`robot`] reads a URDF and knows where its links are, [`posture`] the joints at the time of a frame:
//!
//! ```
//! use std::sync::Arc;
//! use taxel::body::posture::{JointHistory, Motion};
//! use taxel::body::{self, robot, wrenches};
//! use taxel_core::format::Micros;
//! use taxel_core::garment::{Garment, Layout};
//!
//! let garment = Garment::reference();
//! let layout = Layout::build(&garment, 2048, 4095)?;
//! let robot = Arc::new(robot::read("reference")?);
//! let on_robot = body::read("reference")?.on_robot(&garment, &layout, robot.clone())?;
//!
//! let mut joints = JointHistory::new(robot.clone(), Motion { angular: 10.0, ..Motion::default() })?;
//! let base = 0;
//! // Elbows do not move the reference garment.
//! joints.need(&on_robot.moving(base));
//! // Two readings, 20 ms apart; times are the board's, in microseconds.
//! for (time_us, angle) in [(0, 0.0), (20_000, 0.02)] {
//!     let arms = ["left", "right"].map(|side| ["pitch", "roll", "yaw"].map(|way| format!("{side}_shoulder_{way}")));
//!     let angles = arms.iter().flatten().map(|name| (name.as_str(), angle));
//!     joints.take(Micros(time_us), angles.chain([("waist", 0.0)]))?;
//! }
//! // A frame between the readings, and one after them.
//! let aligned = joints.aligned(Micros(13_000), Micros(45_000)).unwrap();
//! let live = joints.live(Micros(25_000)).unwrap();
//! assert!((aligned.posture[1] - 0.013).abs() < 1e-9 && (live.posture[1] - 0.025).abs() < 1e-9);
//! assert!(on_robot.displacement(&aligned, base) < on_robot.displacement(&live, base) && live.age.as_millis() == 5);
//!
//! // 2 N on each taxel of the chest, in the frame of the base.
//! let newtons: Vec<f64> = (0..2048).map(|taxel| if taxel < 512 { 2.0 } else { 0.0 }).collect();
//! let seen = on_robot.seen_from(&aligned.posture, base)?;
//! let on_torso = &wrenches(&seen, &newtons)[0];
//! assert!(on_torso.force.x < -500.0 && on_torso.pressed == 1024.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chart;
mod config;
mod file;
pub mod fit;
mod form;
mod listed;
pub mod mesh;
mod on_robot;
mod panel_frame;
mod places;
mod pose;
pub mod posture;
mod regions;
mod rigid;
pub mod robot;
mod slides;
mod solid;
mod surface;
mod table;
mod taxel_place;
mod wrench;

pub use config::{Body, BodyRegion, Patch, PatchOffset, Slide};
pub use file::{ReadBody, read};
pub use form::{Cone, Cylinder, Form, Grid, Plane};
pub use listed::{Listed, listed};
pub use on_robot::RobotSurface;
pub use places::text;
pub use pose::Pose;
pub use solid::{Sector, Solid, SolidBox};
pub use surface::{Fit, Surface};
pub use table::table;
pub use taxel_place::TaxelPlace;
pub use wrench::{Wrench, wrenches};

/// A vector of three numbers.
pub use glam::DVec3;
