//! Tests of the commands and of the views from inside: dialogues, exports, reports, pages, hostile boards.

mod calibrate;
mod ghosts;
mod hostile;
mod maps;
mod mat;
mod record;
mod session;
mod settle;
mod setup;
mod sink;
mod view_recording;
