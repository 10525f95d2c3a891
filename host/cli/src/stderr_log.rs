//! Logger of the program: warnings of the library on standard error, with `-v` its steps, too.

use log::{Level, LevelFilter, Log, Metadata, Record};
use taxel::text::words;

/// Prints what the library reports. The crates below it report to nobody.
struct StderrLog;

/// Begins to print warnings, and with `verbose` each step: `taxel: garment block-4x16 sent`.
pub fn begin(verbose: bool) {
    // The logger of a process that has one already, such as Python, stays.
    _ = log::set_logger(&StderrLog);
    log::set_max_level(if verbose { LevelFilter::Info } else { LevelFilter::Warn });
}

impl Log for StderrLog {
    fn enabled(&self, metadata: &Metadata) -> bool {
        metadata.target().starts_with("taxel") && metadata.level() <= log::max_level()
    }

    fn log(&self, record: &Record) {
        if self.enabled(record.metadata()) {
            // StderrLog quote boards and files.
            let text = record.args().to_string();
            let text = words::printable(&text);
            if record.level() <= Level::Warn {
                eprintln!("{text}");
            } else {
                eprintln!("taxel: {text}");
            }
        }
    }

    fn flush(&self) {}
}
