//! Writing of all outputs that the user names with `-o` and the like.
//!
//! An output is checked before a command begins its work: a name that leads to an input of the same command
//! is refused (whatever the spelling or link), and another existing file is replaced only with `--force`. The
//! bytes go to a temporary file beside the output (`taxel-PROCESS-N.part`), are flushed to the disk, and only
//! then get the name: at every moment the name has either all of the old content or all of the new. For
//! folders this holds, too, on Linux even through a kill.
//!
//! | file | holds |
//! |---|---|
//! | `force.rs` | the option `--force` |
//! | `same.rs` | whether two names lead to one file |
//! | `place.rs` | what a name leads to: a file, a device, the standard output |
//! | `file.rs` | [`Output`]: an output file; [`Begun`]: a recording, named once there is something in it |
//! | `named.rs` | its name, and how a temporary file gets it |
//! | `draft.rs` | [`Draft`]: its content, before it has the name |
//! | `folder.rs` | [`Folder`]: an output folder |
//! | `scratch.rs` | [`Scratch`]: a temporary file for data that is needed later |
//! | `part.rs` | names of temporary files, and flushing of names to the disk |
//!
//! A command asks for the output first:
//!
//! ```
//! use std::io::Write;
//! use taxel::files::output::{Force, Output};
//!
//! # fn main() -> taxel::error::Result<()> {
//! # let folder = std::env::temp_dir().join(format!("taxel-output-{}", std::process::id()));
//! # std::fs::create_dir_all(&folder)?;
//! # let (recording, table) = (folder.join("touch.mcap"), folder.join("touch.csv"));
//! # std::fs::write(&recording, "recorded")?;
//! let force = Force::default();
//! // What cannot be written is refused here, before the work. `stream`: `-` is the standard output.
//! let output = Output::stream(&table, force, [&recording])?;
//! output.write(b"time,pressure\n")?;
//!
//! // Piece by piece. What is dropped before `keep` leaves no trace.
//! let replaced = Force { force: true };
//! let mut draft = Output::file(&table, replaced, [&recording])?.draft()?;
//! writeln!(draft, "time,panel,pressure")?;
//! draft.keep()?;
//! assert_eq!(std::fs::read_to_string(&table)?, "time,panel,pressure\n");
//!
//! // An input is never an output.
//! let same = folder.join(".").join("touch.mcap");
//! assert!(Output::file(&same, replaced, [&recording]).is_err());
//! # std::fs::remove_dir_all(folder)?;
//! # Ok(())
//! # }
//! ```

mod draft;
mod file;
mod folder;
mod force;
mod named;
mod part;
mod place;
mod same;
mod scratch;

#[cfg(test)]
mod tests;

pub use draft::Draft;
pub use file::{Begun, Output};
pub use folder::Folder;
pub use force::Force;
pub use same::is_same;
pub use scratch::Scratch;
