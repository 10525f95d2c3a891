//! The garment on the robot.

mod figure;
mod fit;
mod link;
mod mesh;
mod on_robot;
mod posture;
mod regions;
mod rig;
mod robot;
mod surface;
mod urdf;
