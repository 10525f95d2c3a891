//! The garment on the robot: where each taxel lies and which way it faces, on the links of the robot's
//! description (URDF).
//!
//! All lengths are in metres, all vectors in the frame of a link. A panel is drawn as it is seen from outside:
//! columns (x) run to the right, rows (y) down, and the normals point to whoever looks.
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

mod config;
mod file;
mod form;
mod listed;
mod places;
mod pose;
mod send;
mod surface;
mod table;
mod wrench;

pub use config::{Body, Patch};
pub use file::{ReadBody, read};
pub use form::{Cone, Cylinder, Form, Grid, Plane};
pub use listed::{Listed, listed};
pub use places::text;
pub use pose::pose;
pub use send::send;
pub use surface::{Fit, Surface, TaxelPlace};
pub use table::table;
pub use wrench::{Wrench, wrenches};

/// A vector of three numbers.
pub use glam::DVec3;
