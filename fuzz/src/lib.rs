//! Properties that hold whatever a board, a host, a file or a page says: functions of any bytes, which panic where one
//! does not. A fuzzer calls them (`cargo xtask fuzz`), and tests with the inputs that it found worth keeping
//! (`corpus/`).
//!
//! | target | bytes are | what must hold |
//! |---|---|---|
//! | [`board`] | requests behind a valid CRC, scans, faults, and the time | each message is one that a client understands, none is lost, what was stored is loaded |
//! | [`client`] | reports behind a valid CRC | every way to show them stands it; memory is bounded |
//! | [`recording`] | a recording | no reader fails on what `repair` has written |
//! | [`robots`] | a robot's description (URDF) or a mesh | a robot is a tree with poses, an error names the file |
//! | [`arrays`] | an array file | frames are as large as they say |
//! | [`streams`] | a description and the stream of an array of others | its frames are the same however it is cut |
//! | [`texts`] | a garment, scene, script, map, table or calibration | what was read and is written is read again |
//! | [`store`] | what a flash holds | what is saved then is loaded |
//! | [`network`] | what others in the network send: frames, stamps, requests, names, answers | only what a program sends is taken, in its order; memory is bounded |
//! | [`page`] | what a browser sends | no more waits than there is room for |
#![forbid(unsafe_code)]

pub mod arrays;
pub mod board;
mod bytes;
pub mod client;
mod mcap;
pub mod network;
pub mod page;
mod plain;
pub mod recording;
pub mod robots;
mod scratch;
pub mod store;
pub mod streams;
pub mod texts;

/// A function of any bytes.
pub type Target = fn(&[u8]);

/// All of them by the names of their corpora.
pub const TARGETS: [(&str, Target); 10] = [
    ("arrays", arrays::run),
    ("board", board::run),
    ("client", client::run),
    ("network", network::run),
    ("page", page::run),
    ("recording", recording::run),
    ("robots", robots::run),
    ("store", store::run),
    ("streams", streams::run),
    ("texts", texts::run),
];
