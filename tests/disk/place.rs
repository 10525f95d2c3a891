//! Which file a call concerns.

use libc::{AT_FDCWD, c_char, c_int};
use std::ffi::{CStr, OsStr, OsString};
use std::os::unix::ffi::{OsStrExt, OsStringExt};
use std::path::{Path, PathBuf};

/// The path that a call names, from the folder `at`.
///
/// # Safety
///
/// `path` is a text of C.
pub unsafe fn named(at: c_int, path: *const c_char) -> PathBuf {
    // SAFETY: by the contract.
    let path = Path::new(OsStr::from_bytes(unsafe { CStr::from_ptr(path) }.to_bytes()));
    if path.is_absolute() {
        return path.into();
    }
    let from = if at == AT_FDCWD { link(c"/proc/self/cwd") } else { of_open(at) };
    let mut whole = from.unwrap_or_default();
    whole.extend(path.components().filter(|part| *part != std::path::Component::CurDir));
    whole
}

/// The path of a file that is open; one that has no name any more keeps its last.
pub fn of_open(file: c_int) -> Option<PathBuf> {
    link(&std::ffi::CString::new(format!("/proc/self/fd/{file}")).ok()?)
}

/// Where a link leads to.
fn link(path: &CStr) -> Option<PathBuf> {
    let mut bytes = vec![0u8; libc::PATH_MAX as usize];
    // SAFETY: the system writes at most as many bytes as there are.
    let length = unsafe {
        libc::syscall(libc::SYS_readlinkat, AT_FDCWD, path.as_ptr(), bytes.as_mut_ptr(), bytes.len())
    };
    bytes.truncate(usize::try_from(length).ok()?);
    Some(OsString::from_vec(bytes).into())
}
