//! A robot of several boards: its file, and all their streams as one.
//!
//! | file | holds |
//! |---|---|
//! | `gesture_model.rs`, `forms_in_frame.rs`, `feed.rs` | what a board is asked, in words |
//! | `config.rs` | [`RobotConfig`], [`BoardConfig`]: a robot and its boards as their author writes them |
//! | `place.rs` | file, line, board and key of an error |
//! | `board.rs` | [`RobotBoard`]: how a board is opened and recognised, and what is asked of it first |
//! | `board_reader.rs` | reads the files that a board's configuration names |
//! | `file.rs` | [`ReadRobot`]: the file and what it names, checked |
//! | `recognise.rs` | recognises a board before anything is asked of it |
//! | `event.rs` | [`RobotEvent`]: what the boards say, and how they are |
//! | `line.rs` | how a board is, as JSON |
//! | `queue.rs` | the events that wait, bounded for each board |
//! | `refused.rs` | refusals of what a board is asked first |
//! | `follow.rs` | the loop that follows a board, alone or in a thread of its own |
//! | `board_queue.rs` | [`BoardQueue`]: a board's end of the queue |
//! | `plans.rs` | the boards of a file, to be followed |
//! | `order.rs` | [`BoardOrder`]: what boards are asked while they are followed |
//! | `stream.rs` | [`RobotStream`]: all boards as one stream |
//! | `contact.rs` | [`BoardContact`]: a contact of a board, with its force if newtons are known |
//! | `moments.rs` | [`RobotMoments`]: what boards have said lately, aligned by the time that they share |
//! | `alone.rs` | a board that is followed alone |
//!
//! A board is followed by a [`Session`](crate::session::Session) like any other. Before anything is asked of
//! it, at the start and each time that it comes back, it is [recognised](crate::client::Identity): another board under
//! its name is an event ([`BoardState::Other`]), and nothing that it sends is passed on. A board that is lost does not
//! hold up the others.

mod alone;
mod board;
mod board_queue;
mod board_reader;
mod config;
mod contact;
mod event;
mod feed;
mod file;
mod follow;
mod forms_in_frame;
mod gesture_model;
mod line;
mod moments;
mod order;
mod place;
mod plans;
mod queue;
mod recognise;
mod refused;
mod stream;

pub use alone::read_board;
pub use board::{BoardGarment, RobotBoard};
pub use board_queue::BoardQueue;
pub use board_reader::ConfigPlace;
pub use config::{BoardConfig, RobotConfig};
pub use contact::BoardContact;
pub use event::{BoardEvent, BoardState, RobotEvent};
pub use feed::feed;
pub use file::ReadRobot;
pub use follow::{Ask, Begin, BoardPlan, Following, Opener, Supervisor, follow_alone};
pub use forms_in_frame::FormsInFrame;
pub use gesture_model::GestureModel;
pub use line::BoardLine;
pub use moments::{BoardMoment, RobotMoments};
pub use order::BoardOrder;
pub use queue::{WAITING, WhenFull};
pub use refused::Required;
pub use stream::RobotStream;
