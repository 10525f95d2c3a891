//! Logger: warnings of the library go to Python's `logging.getLogger("taxel")`, which prints them unless the
//! program says otherwise. The steps that `taxel -v` asks for go to standard error.

use log::{Level, LevelFilter, Log, Metadata, Record};
use pyo3::prelude::*;
use std::io::Write;
use taxel::text::words;

struct Logger;

/// Begins to pass on warnings.
pub fn begin() {
    if log::set_logger(&Logger).is_ok() {
        log::set_max_level(LevelFilter::Warn);
    }
}

impl Log for Logger {
    fn enabled(&self, metadata: &Metadata) -> bool {
        metadata.target().starts_with("taxel") && metadata.level() <= log::max_level()
    }

    fn log(&self, record: &Record) {
        if !self.enabled(record.metadata()) {
            return;
        }
        let text = record.args().to_string();
        let text = words::printable(&text);
        // Nobody is left to hear of a warning that cannot be given.
        if record.level() <= Level::Warn {
            _ = Python::attach(|py| warn(py, &text));
        } else {
            _ = writeln!(std::io::stderr(), "taxel: {text}");
        }
    }

    fn flush(&self) {}
}

fn warn(py: Python<'_>, text: &str) -> PyResult<()> {
    let logger = py.import("logging")?.call_method1("getLogger", ("taxel",))?;
    logger.call_method1("warning", ("%s", text)).map(drop)
}
