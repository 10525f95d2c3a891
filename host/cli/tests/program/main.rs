//! Tests of the program and its examples from outside.

mod answering_board;
mod bodies;
mod builds;
mod called;
mod cli;
mod commands;
mod documents;
#[path = "../../../../core/tests/core/shape/drawn.rs"]
mod drawn;
mod exchanged;
mod exports;
mod fitted;
mod folded;
#[cfg(feature = "foxglove")]
mod foxglove;
mod hostile;
mod imageless;
mod inputs;
mod joints;
mod live;
mod maps;
mod mistakes;
mod motion;
mod one_bus;
mod original;
mod outputs;
mod own_garment;
#[cfg(feature = "schema")]
mod page_types;
#[cfg(all(unix, feature = "port-table"))]
mod plugged;
#[cfg(all(unix, feature = "port-table"))]
mod pressed;
#[path = "../../../../core/tests/core/random.rs"]
mod random;
mod record_view;
mod recordings;
#[cfg(all(feature = "full", not(feature = "zenoh")))]
mod reference_pages;
mod repair;
mod robot;
mod robot_cost;
mod robot_recorded;
mod robot_view;
#[cfg(feature = "ros2")]
mod ros2;
mod schemas;
mod set_up;
mod settings;
#[path = "../commands/sink.rs"]
mod sink;
mod socket;
mod start;
mod status;
mod steps;
mod teach;
mod tools;
#[path = "../../../taxel/tests/library/validator.rs"]
mod validator;
mod version;
mod view;
