//! Faults of a disk, for tests: a library that is loaded before a program (`LD_PRELOAD`) and stands between it
//! and the system's calls that change files.
//!
//! Only calls that concern the folder `TAXEL_DISK_FOLDER` count. Each is noted in the file `TAXEL_DISK_NOTES`;
//! at number `TAXEL_DISK_CALL` the fault `TAXEL_DISK_FAULT` happens:
//!
//! | fault | at that call | afterwards |
//! |---|---|---|
//! | `full` | ENOSPC | what needs room fails, too |
//! | `short` | half of it is written | as `full` |
//! | `io` | EIO | all is well |
//! | `read-only` | EROFS | every call fails |
//! | `denied` | EACCES | all is well |
//! | `interrupted` | EINTR | all is well |
//! | `kill-before`, `kill-half`, `kill-after` | SIGKILL: before it, when half is written, when it is done | |
//! | `link` | `TAXEL_DISK_TARGET` becomes a link to `TAXEL_DISK_PRECIOUS`, then the call goes on | all is well |
//! | `grown` | another process appends to `TAXEL_DISK_TARGET`, then the call goes on | all is well |
//!
//! Nothing is synchronised: a kill leaves what the system has taken, and tests take less time.
#![cfg(all(target_os = "linux", target_env = "gnu"))]

mod calls;
mod place;
mod plan;
