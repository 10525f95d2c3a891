//! Tests of the library: simulated boards and garments, maps, shapes, touches, recordings.

mod bases;
mod calibrate;
mod clock;
#[path = "../../../core/tests/core/shape/drawn.rs"]
mod drawn;
mod drift;
mod faults;
mod fcm;
mod ghosts;
mod health;
mod hostile;
mod link;
mod maps;
mod mat;
mod meaning;
mod people;
mod points;
mod record;
mod scan;
mod session;
mod settle;
mod setup;
#[path = "../../../core/tests/core/shape/rig.rs"]
mod shape_of;
mod shapes;
mod sink;
mod tables;
mod touch;
mod view_recording;
mod watchdog;
