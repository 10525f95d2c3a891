//! The library: simulated boards and garments, maps, shapes, touches, recordings.

mod bases;
mod calibrate;
mod clock;
mod drawn;
mod drift;
mod faults;
mod fcm;
mod ghosts;
mod health;
mod hostile;
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
mod shape_of;
mod shapes;
mod tables;
mod touch;
mod view_recording;
mod watchdog;
