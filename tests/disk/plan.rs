//! What is to happen at which call.

use libc::{AT_FDCWD, SIGKILL, c_int, c_long};
use std::ffi::{CStr, CString};
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// What a call does to a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Brings bytes or a name to the disk, for which there must be room.
    Takes,
    /// May come upon a disk without room only now: a name or a buffer that is moved.
    Moves,
    /// Gives room back, or changes what is there.
    Gives,
}

/// What becomes of a call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// It goes on.
    Go,
    /// It fails with this error of the system.
    Fail(c_int),
    /// Only half of its bytes are written.
    Half,
    /// Half of its bytes are written, then the process is killed.
    HalfAndKill,
    /// It goes on, then the process is killed.
    GoAndKill,
}

/// The faults of a run, as the environment reports them.
struct Plan {
    folder: PathBuf,
    notes: CString,
    call: u64,
    fault: String,
    target: CString,
    precious: CString,
    held: PathBuf,
    count: AtomicU64,
}

fn plan() -> Option<&'static Plan> {
    static PLAN: OnceLock<Option<Plan>> = OnceLock::new();
    PLAN.get_or_init(|| {
        let reported = |name: &str| std::env::var_os(format!("TAXEL_DISK_{name}")).unwrap_or_default();
        let path = |name| CString::new(reported(name).as_bytes()).unwrap_or_default();
        let folder = PathBuf::from(reported("FOLDER"));
        (folder.is_absolute()).then(|| Plan {
            folder,
            notes: path("NOTES"),
            call: reported("CALL").to_str().and_then(|call| call.parse().ok()).unwrap_or(0),
            fault: reported("FAULT").to_string_lossy().into_owned(),
            target: path("TARGET"),
            precious: path("PRECIOUS"),
            held: PathBuf::from(reported("HELD")),
            count: AtomicU64::new(0),
        })
    })
    .as_ref()
}

/// Counts a call that concerns `path`, and says what becomes of it.
pub fn next(name: &str, path: &Path, kind: Kind) -> Verdict {
    let Some(plan) = plan().filter(|plan| path.starts_with(&plan.folder)) else { return Verdict::Go };
    let number = plan.count.fetch_add(1, Ordering::Relaxed) + 1;
    append(&plan.notes, &format!("{number} {name} {}\n", path.display()));
    if plan.call == 0 || number < plan.call {
        return Verdict::Go;
    }
    if number == plan.call {
        plan.keep_what_is_held();
    }
    plan.fate(number == plan.call, kind)
}

impl Plan {
    /// Of the call that was chosen, or of one that follows it.
    fn fate(&self, is_chosen: bool, kind: Kind) -> Verdict {
        let without_room = kind == Kind::Takes || is_chosen && kind == Kind::Moves;
        match (self.fault.as_str(), is_chosen) {
            ("short", true) if kind == Kind::Takes => Verdict::Half,
            ("full" | "short", _) if without_room => Verdict::Fail(libc::ENOSPC),
            ("read-only", _) => Verdict::Fail(libc::EROFS),
            ("io", true) => Verdict::Fail(libc::EIO),
            ("denied", true) => Verdict::Fail(libc::EACCES),
            ("interrupted", true) => Verdict::Fail(libc::EINTR),
            ("kill-before", true) => kill(),
            ("kill-half", true) => Verdict::HalfAndKill,
            ("kill-after", true) => Verdict::GoAndKill,
            ("link", true) => {
                self.lead_astray();
                Verdict::Go
            }
            ("grown", true) => {
                append(&self.target, "more");
                Verdict::Go
            }
            _ => Verdict::Go,
        }
    }

    /// Copies the folder's files to another, where no call is counted: none of them may hold less after the
    /// fault.
    fn keep_what_is_held(&self) {
        for entry in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            if entry.file_type().is_ok_and(|kind| kind.is_file()) {
                // What is missing there is found by the test, which knows what there must be.
                _ = fs::copy(entry.path(), self.held.join(entry.file_name()));
            }
        }
    }

    /// Puts a link to what is precious in the place of the output; a folder moves aside.
    fn lead_astray(&self) {
        let (target, precious) = (self.target.as_ptr(), self.precious.as_ptr());
        let mut aside = self.target.to_bytes().to_vec();
        aside.extend_from_slice(b".aside\0");
        // SAFETY: paths live as long as the calls.
        unsafe {
            if libc::syscall(libc::SYS_unlinkat, AT_FDCWD, target, 0) != 0 {
                libc::syscall(libc::SYS_renameat2, AT_FDCWD, target, AT_FDCWD, aside.as_ptr(), 0);
            }
            libc::syscall(libc::SYS_symlinkat, precious, AT_FDCWD, target);
        }
    }
}

/// Appends to a file, by calls that are not counted.
fn append(path: &CStr, text: &str) {
    let flags = libc::O_WRONLY | libc::O_CREAT | libc::O_APPEND | libc::O_CLOEXEC;
    // SAFETY: paths and bytes live as long as the calls.
    unsafe {
        let file = libc::syscall(libc::SYS_openat, AT_FDCWD, path.as_ptr(), flags, 0o644);
        libc::syscall(libc::SYS_write, file, text.as_ptr(), text.len());
        libc::syscall(libc::SYS_close, file);
    }
}

/// Ends the process as a power cut would: nothing more runs.
pub fn kill() -> ! {
    loop {
        // SAFETY: it takes no pointers.
        unsafe { libc::syscall(libc::SYS_kill, libc::getpid(), SIGKILL) };
    }
}

/// The answer of a call that fails.
pub fn fail(error: c_int) -> c_long {
    // SAFETY: the place of this thread's error is always there.
    unsafe { *libc::__errno_location() = error };
    -1
}
