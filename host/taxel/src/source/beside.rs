//! Work beside the caller: boards that are built on a large stack, and those that run on. In WebAssembly, which has no
//! threads, the linker gives the only stack that size, and a board runs on whenever its host reads.

use crate::error::Result;
use std::future::Future;

/// Boards are boxed, but built on the stack.
#[cfg(not(target_family = "wasm"))]
const STACK: usize = 8 << 20;

#[cfg(not(target_family = "wasm"))]
pub use threads::{built, run, yielded};

#[cfg(target_family = "wasm")]
pub use polled::{built, run, step, yielded};

/// Threads for it.
#[cfg(not(target_family = "wasm"))]
mod threads {
    use super::*;
    use crate::error::SourceError;
    use std::sync::mpsc;
    use std::thread::Builder;
    use taxel_core::run::block_on;

    /// Builds a board.
    pub fn built<B: Send + 'static>(build: impl FnOnce() -> Result<B> + Send + 'static) -> Result<B> {
        let builder = Builder::new().name("board".into()).stack_size(STACK).spawn(build)?;
        builder.join().map_err(|_| error!(SourceError::Unstarted, "the board could not be built"))?
    }

    /// Builds a board, and runs it until it ends. Error if it cannot be built.
    pub fn run<F: Future<Output = ()>>(
        name: &str,
        build: impl FnOnce() -> Result<F> + Send + 'static,
    ) -> Result<()> {
        let (sender, built) = mpsc::channel();
        Builder::new().name(name.into()).stack_size(STACK).spawn(move || match build() {
            Ok(board) => {
                let _ = sender.send(Ok(()));
                block_on(board);
            }
            Err(error) => drop(sender.send(Err(error))),
        })?;
        built.recv().unwrap_or_else(|_| Err(error!(SourceError::Unstarted, "its thread ended")))
    }

    /// Lets the host go on: it does so by itself.
    pub async fn yielded() {}
}

/// Boards that are polled.
#[cfg(target_family = "wasm")]
mod polled {
    use super::*;
    use std::cell::RefCell;
    use std::future::poll_fn;
    use std::pin::Pin;
    use std::task::{Context, Poll, Waker};

    thread_local! {
        /// The boards that run.
        static BOARDS: RefCell<Vec<Pin<Box<dyn Future<Output = ()>>>>> = const { RefCell::new(Vec::new()) };
    }

    /// Builds a board.
    pub fn built<B: 'static>(build: impl FnOnce() -> Result<B>) -> Result<B> {
        build()
    }

    /// Builds a board, and keeps it until it ends. Error if it cannot be built.
    pub fn run<F: Future<Output = ()> + 'static>(_: &str, build: impl FnOnce() -> Result<F>) -> Result<()> {
        let board = build()?;
        BOARDS.with_borrow_mut(|boards| boards.push(Box::pin(board)));
        Ok(())
    }

    /// Runs each board until it [yields](yielded) or ends.
    pub fn step() {
        let mut context = Context::from_waker(Waker::noop());
        BOARDS.with_borrow_mut(|boards| {
            boards.retain_mut(|board| board.as_mut().poll(&mut context).is_pending())
        });
    }

    /// Lets the host go on until its next [`step`].
    pub async fn yielded() {
        let mut has_yielded = false;
        poll_fn(|_| if std::mem::replace(&mut has_yielded, true) { Poll::Ready(()) } else { Poll::Pending })
            .await;
    }
}
