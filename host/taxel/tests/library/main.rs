//! Tests of the library: simulated boards and garments, maps, shapes, touches, sessions.

mod arrays;
mod bases;
mod body;
mod clock;
mod delays;
#[path = "../../../../core/tests/core/shape/drawn.rs"]
mod drawn;
mod drift;
mod errors;
mod faults;
mod fcm;
mod folds;
mod hand;
mod health;
mod landed;
mod lines;
mod link;
mod maps;
mod meaning;
mod mind;
mod moments;
mod motion;
mod people;
mod points;
mod pressing;
#[cfg(feature = "schema")]
mod python_types;
#[path = "../../../../core/tests/core/random.rs"]
mod random;
mod reference;
mod robot;
mod ros2;
mod scan;
#[cfg(feature = "schema")]
mod schemas;
mod session;
#[path = "../../../../core/tests/core/shape/rig.rs"]
mod shape_of;
mod shapes;
mod timed_line;
#[cfg(feature = "schema")]
mod validator;
mod versions;
mod virtual_board;
mod watchdog;
