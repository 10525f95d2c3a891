//! A robot of several boards: its file, and all their streams as one.
//!
//! | file | holds |
//! |---|---|
//! | `config.rs` | [`RobotConfig`]: the file `robot.toml` as its author writes it |
//! | `place.rs` | file, line, board and key of an error |
//! | `board.rs` | [`RobotBoard`]: how a board is opened and recognised, and what is asked of it first |
//! | `seam.rs` | [`RobotSeam`]: edges of panels of different boards, sewn together |
//! | `file.rs` | [`ReadRobot`]: the file and what it names, checked |
//! | `identity.rs` | [`Identity`]: which board is which |
//! | `recognise.rs` | recognises a board before anything is asked of it |
//! | `event.rs` | [`RobotEvent`]: what the boards say, and how they are |
//! | `line.rs` | how a board is, as JSON |
//! | `queue.rs` | the events that wait, bounded for each board |
//! | `refused.rs` | refusals of what a board is asked first |
//! | `follow.rs` | follows one board in a thread of its own |
//! | `order.rs` | [`BoardOrder`]: what boards are asked while they are followed |
//! | `session.rs` | [`RobotSession`]: all boards as one stream |
//! | `moments.rs` | [`RobotMoments`]: what boards have said lately, aligned by the time that they share |
//! | `recorded_board.rs` | a board's part of a recording, filled in the board's thread |
//! | `record_teller.rs` | records a board, in its thread |
//! | `recorder.rs` | [`RobotRecorder`]: one recording of all boards |
//! | `open.rs` | the boards of a file, followed |
//! | `plane.rs` | the plane of a seam, on which both panels lie |
//! | `seam_taxels.rs` | the taxels of a board along its seams |
//! | `seam_value.rs` | [`SeamValue`]: what is told of a taxel at a seam, and what one filter over all would leave |
//! | `seam_change.rs` | what one filter over both panels would change at a seam |
//! | `touched.rs` | [`BoardTouch`]: what touches a board |
//! | `faint.rs` | what touches a seam and is too faint to be a contact of its board |
//! | `scan.rs` | [`ScanReader`]: contacts of a board's scan, and what is too faint for that |
//! | `edges.rs` | what the boards' filters leave at the seams, judged with what presses beyond |
//! | `history.rs` | pressure and place of a touch in its last scans |
//! | `carried.rs` | a touch of a board, carried on to the time of another board's scan |
//! | `listed.rs` | what a board has told last of what touches it |
//! | `joined.rs` | which touches meet at the seams, and what they are together |
//! | `touch.rs` | [`RobotTouch`]: what touches the robot at a time, on one board or on several |
//! | `contact.rs` | [`RobotContact`]: a contact of the robot, on one board or on several |
//! | `contacts_line.rs` | the robot's contacts as JSON |
//! | `contacts_ros2.rs` | the robot's contacts as a message of ROS 2 |
//! | `contacts.rs` | [`RobotContacts`]: what touches both sides of a seam is one contact with one id |
//!
//! A board is followed by a [`Session`](crate::session::Session) like any other. Before anything is asked of
//! it, at the start and each time that it comes back, its serial number on USB and its garment are compared
//! with what is known of it: another board under its name is an event ([`BoardEvent::Other`]), and nothing
//! that it sends is passed on. A board that is lost does not hold up the others.

mod board;
mod carried;
mod config;
mod contact;
mod contacts;
mod contacts_line;
mod contacts_ros2;
mod edges;
mod event;
mod faint;
mod file;
mod follow;
mod history;
mod identity;
mod joined;
mod line;
mod listed;
mod moments;
mod open;
mod order;
mod place;
mod plane;
mod queue;
mod recognise;
mod record_teller;
mod recorded_board;
mod recorder;
mod refused;
mod scan;
mod seam;
mod seam_change;
mod seam_taxels;
mod seam_value;
mod session;
mod touch;
mod touched;

pub use board::{BoardGarment, RobotBoard};
pub use config::{BoardConfig, BoardEdge, BoardSeam, RobotConfig};
pub use contact::RobotContact;
pub use contacts::{CROSSING_US, RobotContacts};
#[cfg(feature = "schema")]
pub use contacts_line::robot_contacts_schema;
pub use contacts_line::{ROBOT_CONTACTS, ROBOT_CONTACTS_SCHEMA, RobotContactsLine};
pub use contacts_ros2::robot_contacts_message;
pub use event::{BoardEvent, RobotEvent, Teller};
pub use file::ReadRobot;
pub use follow::{Ask, Begin, BoardPlan, Opener};
pub use identity::Identity;
pub use line::BoardLine;
pub use moments::{BoardMoment, RobotMoments};
pub use order::BoardOrder;
pub use queue::{WAITING, WhenFull};
pub use record_teller::{BoardRecord, RecordTeller};
pub use recorder::{RobotRecorder, RobotTopic};
pub use scan::{BoardScan, ScanReader};
pub use seam::{RobotEdge, RobotSeam};
pub use seam_value::SeamValue;
pub use session::RobotSession;
pub use touch::{RobotTouch, RobotTouchPart};
pub use touched::BoardTouch;
