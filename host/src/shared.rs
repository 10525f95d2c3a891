//! A value that threads share, and that one may wait for another to change.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The value; a thread that panicked leaves it as it was.
#[derive(Debug, Default)]
pub struct Shared<T> {
    value: Mutex<T>,
    changed: Condvar,
}

impl<T> Shared<T> {
    /// Locks the value.
    pub fn lock(&self) -> MutexGuard<'_, T> {
        self.value.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes it, and wakes who waits.
    pub fn change(&self, change: impl FnOnce(&mut T)) {
        change(&mut self.lock());
        self.wake();
    }

    /// Wakes who waits.
    pub fn wake(&self) {
        self.changed.notify_all();
    }

    /// Waits for a change or the timeout.
    pub fn wait<'a>(&self, value: MutexGuard<'a, T>, longest: Duration) -> MutexGuard<'a, T> {
        self.changed.wait_timeout(value, longest).unwrap_or_else(PoisonError::into_inner).0
    }
}
