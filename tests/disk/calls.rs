//! The system's calls that change files, under the names by which the C library offers them.
//!
//! Each has the C library's contract: pointers lead to texts of C, or to as many bytes as are reported.

use super::place::{named, of_open};
use super::plan::{Kind, Verdict, fail, kill, next};
use libc::{
    AT_FDCWD, AT_REMOVEDIR, SYS_copy_file_range, SYS_fchmod, SYS_fchmodat, SYS_ftruncate, SYS_linkat,
    SYS_mkdirat, SYS_openat, SYS_pwrite64, SYS_renameat2, SYS_sendfile, SYS_symlinkat, SYS_unlinkat,
    SYS_write, SYS_writev, c_char, c_int, c_long, c_uint, c_void, iovec, mode_t, off_t, size_t, ssize_t,
    syscall,
};

/// A call on a path or on an open file; none: it concerns nobody.
fn meet(name: &str, path: Option<std::path::PathBuf>, kind: Kind, go: impl FnOnce() -> c_long) -> c_long {
    let Some(path) = path else { return go() };
    match next(name, &path, kind) {
        Verdict::Go | Verdict::Half => go(),
        Verdict::Fail(error) => fail(error),
        Verdict::GoAndKill => {
            go();
            kill()
        }
        Verdict::HalfAndKill => kill(),
    }
}

/// A call that writes `length` bytes, and can write fewer.
fn take(name: &str, file: c_int, length: size_t, go: impl FnOnce(size_t) -> c_long) -> ssize_t {
    let Some(path) = of_open(file) else { return go(length) as ssize_t };
    let done = match next(name, &path, Kind::Takes) {
        Verdict::Go => go(length),
        Verdict::Fail(error) => fail(error),
        Verdict::Half if length < 2 => fail(libc::ENOSPC),
        Verdict::Half => go(length / 2),
        Verdict::GoAndKill => {
            go(length);
            kill()
        }
        Verdict::HalfAndKill => {
            go(length / 2);
            kill()
        }
    };
    done as ssize_t
}

fn opened(at: c_int, path: *const c_char, flags: c_int, mode: mode_t) -> c_int {
    // SAFETY: as the C library's call.
    let go = || unsafe { syscall(SYS_openat, at, path, flags, mode) };
    let writes = flags & libc::O_ACCMODE != libc::O_RDONLY || flags & libc::O_CREAT != 0;
    // SAFETY: as the C library's call.
    let path = (writes && flags & libc::O_TMPFILE != libc::O_TMPFILE).then(|| unsafe { named(at, path) });
    let kind = if flags & libc::O_CREAT != 0 { Kind::Takes } else { Kind::Gives };
    meet("open", path, kind, go) as c_int
}

/// Brings a file to the disk, in pretence. A file, not a folder, that is open for reading alone is refused, as Windows
/// does.
///
/// # Safety
///
/// As the C library's.
unsafe fn synced(file: c_int) -> c_long {
    // SAFETY: the system writes one `stat`, which is all numbers.
    let (flags, is_file) = unsafe {
        let mut known: libc::stat = std::mem::zeroed();
        let is_file = libc::fstat(file, &raw mut known) == 0 && known.st_mode & libc::S_IFMT == libc::S_IFREG;
        (libc::fcntl(file, libc::F_GETFL), is_file)
    };
    if flags >= 0 && is_file && flags & libc::O_ACCMODE == libc::O_RDONLY {
        return fail(libc::EACCES);
    }
    c_long::from(flags.min(0))
}

/// Defines calls on one path: name, its arguments, what they do and the system's call.
macro_rules! on_a_path {
    ($($(#[$doc:meta])* $name:ident($($arg:ident: $type:ty),*) $kind:ident $at:expr, $path:ident => $call:expr;)*) => {$(
        $(#[$doc])*
        ///
        /// # Safety
        ///
        /// As the C library's.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($($arg: $type),*) -> c_int {
            // SAFETY: as the C library's call.
            let (path, go) = (unsafe { named($at, $path) }, || unsafe { $call });
            meet(stringify!($name), Some(path), Kind::$kind, go) as c_int
        }
    )*};
}

on_a_path! {
    /// Gives a file another name.
    rename(from: *const c_char, to: *const c_char) Moves AT_FDCWD, to
        => syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
    /// Gives a file another name, or exchanges two.
    renameat2(at: c_int, from: *const c_char, to_at: c_int, to: *const c_char, flags: c_uint) Moves to_at, to
        => syscall(SYS_renameat2, at, from, to_at, to, flags);
    /// Gives a file one more name.
    link(from: *const c_char, to: *const c_char) Takes AT_FDCWD, to
        => syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0);
    /// Gives a file one more name.
    linkat(at: c_int, from: *const c_char, to_at: c_int, to: *const c_char, flags: c_int) Takes to_at, to
        => syscall(SYS_linkat, at, from, to_at, to, flags);
    /// Makes a symbolic link.
    symlink(from: *const c_char, to: *const c_char) Takes AT_FDCWD, to
        => syscall(SYS_symlinkat, from, AT_FDCWD, to);
    /// Removes a name.
    unlink(path: *const c_char) Gives AT_FDCWD, path => syscall(SYS_unlinkat, AT_FDCWD, path, 0);
    /// Removes a name.
    unlinkat(at: c_int, path: *const c_char, flags: c_int) Gives at, path
        => syscall(SYS_unlinkat, at, path, flags);
    /// Removes a folder.
    rmdir(path: *const c_char) Gives AT_FDCWD, path => syscall(SYS_unlinkat, AT_FDCWD, path, AT_REMOVEDIR);
    /// Makes a folder.
    mkdir(path: *const c_char, mode: mode_t) Takes AT_FDCWD, path => syscall(SYS_mkdirat, AT_FDCWD, path, mode);
    /// Changes who may use a file.
    chmod(path: *const c_char, mode: mode_t) Gives AT_FDCWD, path
        => syscall(SYS_fchmodat, AT_FDCWD, path, mode);
}

/// Defines calls on an open file.
macro_rules! on_a_file {
    ($($(#[$doc:meta])* $name:ident($file:ident: c_int $(, $arg:ident: $type:ty)*) $kind:ident => $call:expr;)*) => {$(
        $(#[$doc])*
        ///
        /// # Safety
        ///
        /// As the C library's.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($file: c_int $(, $arg: $type)*) -> c_int {
            // SAFETY: as the C library's call.
            meet(stringify!($name), of_open($file), Kind::$kind, || unsafe { $call }) as c_int
        }
    )*};
}

on_a_file! {
    /// Brings a file to the disk.
    fsync(file: c_int) Moves => synced(file);
    /// Brings a file's bytes to the disk.
    fdatasync(file: c_int) Moves => synced(file);
    /// Cuts a file.
    ftruncate(file: c_int, length: off_t) Gives => syscall(SYS_ftruncate, file, length);
    /// Cuts a file.
    ftruncate64(file: c_int, length: off_t) Gives => syscall(SYS_ftruncate, file, length);
    /// Changes who may use a file.
    fchmod(file: c_int, mode: mode_t) Gives => syscall(SYS_fchmod, file, mode);
}

/// Defines calls that open a file. In C the mode is one of any number of arguments; it lies where it lies here.
macro_rules! opens {
    ($($name:ident($($at:ident)?);)*) => {$(
        /// Opens a file.
        ///
        /// # Safety
        ///
        /// As the C library's.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($($at: c_int,)? path: *const c_char, flags: c_int, mode: mode_t) -> c_int {
            let folder = AT_FDCWD;
            $(let folder = { _ = folder; $at };)?
            opened(folder, path, flags, mode)
        }
    )*};
}

opens! {
    open();
    open64();
    openat(at);
    openat64(at);
}

/// Writes bytes.
///
/// # Safety
///
/// As the C library's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn write(file: c_int, bytes: *const c_void, length: size_t) -> ssize_t {
    // SAFETY: as the C library's call, of no more bytes.
    take("write", file, length, |length| unsafe { syscall(SYS_write, file, bytes, length) })
}

/// Writes bytes at a place.
///
/// # Safety
///
/// As the C library's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pwrite64(file: c_int, bytes: *const c_void, length: size_t, at: off_t) -> ssize_t {
    // SAFETY: as the C library's call, of no more bytes.
    take("pwrite64", file, length, |length| unsafe { syscall(SYS_pwrite64, file, bytes, length, at) })
}

/// Writes several pieces; half of them are the first ones.
///
/// # Safety
///
/// As the C library's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn writev(file: c_int, pieces: *const iovec, count: c_int) -> ssize_t {
    // SAFETY: as the C library's call, of no more pieces.
    take("writev", file, count as size_t, |count| unsafe { syscall(SYS_writev, file, pieces, count) })
}

/// Copies from one file to another.
///
/// # Safety
///
/// As the C library's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn copy_file_range(
    from: c_int,
    from_at: *mut off_t,
    file: c_int,
    at: *mut off_t,
    length: size_t,
    flags: c_uint,
) -> ssize_t {
    // SAFETY: as the C library's call, of no more bytes.
    take("copy_file_range", file, length, |length| unsafe {
        syscall(SYS_copy_file_range, from, from_at, file, at, length, flags)
    })
}

/// Copies from one file to another.
///
/// # Safety
///
/// As the C library's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sendfile64(file: c_int, from: c_int, at: *mut off_t, length: size_t) -> ssize_t {
    // SAFETY: as the C library's call, of no more bytes.
    take("sendfile64", file, length, |length| unsafe { syscall(SYS_sendfile, file, from, at, length) })
}
