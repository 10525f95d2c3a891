//! `taxel index`: a table of many recordings, for DuckDB, Polars and everything else that reads Parquet.
//!
//! A row for each board of each recording; what cannot be read has a row with the reason (`error`).

mod columns;
mod found;
mod rows;

use crate::commands::tell;
use crate::watch::Overwrite;
use anyhow::Result;
use clap::Args;
use std::path::PathBuf;
use taxel::files::output::Output;

/// Arguments of `taxel index`.
#[derive(Debug, Clone, Args)]
pub struct IndexArgs {
    /// Folder with recordings (.mcap), also in folders inside
    folder: PathBuf,
    /// Table to write (.parquet), `-` for standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Whether an existing table is replaced.
    #[command(flatten)]
    force: Overwrite,
}

/// Runs the command.
pub fn run(args: &IndexArgs) -> Result<()> {
    let found = found::recordings(&args.folder)?;
    let paths = found.iter().filter_map(|found| found.as_ref().ok());
    let output = Output::stream(&args.output, args.force, paths)?;
    let is_standard = output.is_standard();
    let (files, rows) = (found.len(), rows::read(&args.folder, found));
    output.write(&columns::table(&rows)?)?;
    let unread: Vec<_> = rows.iter().filter(|row| row.read.is_err()).collect();
    tell(is_standard, &format!("{}: {files} recordings, {} rows\n", args.output.display(), rows.len()));
    if let Some(first) = unread.first() {
        let (count, file) = (unread.len(), &first.file);
        eprintln!("{count} of them cannot be read, see the column `error`; the first one: {file}");
    }
    Ok(())
}
