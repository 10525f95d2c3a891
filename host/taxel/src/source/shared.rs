//! A value shared by threads, with waiting for changes.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The value. A panic of another thread does not poison it.
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

    /// Changes the value, and wakes all waiting threads.
    pub fn change(&self, change: impl FnOnce(&mut T)) {
        change(&mut self.lock());
        self.wake();
    }

    /// Wakes all waiting threads.
    pub fn wake(&self) {
        self.changed.notify_all();
    }

    /// Waits for a change or the timeout.
    pub fn wait<'a>(&self, value: MutexGuard<'a, T>, longest: Duration) -> MutexGuard<'a, T> {
        self.changed.wait_timeout(value, longest).unwrap_or_else(PoisonError::into_inner).0
    }
}
