//! The table as a Parquet file. Every column but `file` may be null.

use super::rows::IndexRow;
use anyhow::{Context, Result};
use parquet::basic::{LogicalType, Repetition, TimeUnit, Type as Physical};
use parquet::data_type::{BoolType, ByteArray, ByteArrayType, Int64Type};
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};
use std::sync::Arc;
use taxel::record::BoardSummary;

/// Rows that are written at a time.
const GROUP: usize = 100_000;

/// A column: its name, and its value in a row.
type IndexColumn = (&'static str, ColumnValue);

/// Value of a column: null where it is none.
#[derive(Clone, Copy)]
enum ColumnValue {
    /// A text of any row.
    OfRow(fn(&IndexRow) -> Option<&str>),
    Text(fn(&BoardSummary) -> Option<&str>),
    Count(fn(&BoardSummary) -> u64),
    /// Microseconds since 1970, UTC.
    Time(fn(&BoardSummary) -> Option<u64>),
    Is(fn(&BoardSummary) -> bool),
}

use ColumnValue::{Count, Is, OfRow, Text, Time};

/// All columns, as docs/commands.md describes them.
const COLUMNS: &[IndexColumn] = &[
    ("file", OfRow(|row| Some(&row.file))),
    ("robot", Text(|board| board.robot.as_deref())),
    ("board", Text(|board| board.board.as_deref())),
    ("garment", Text(|board| board.garment.as_deref())),
    ("scene", Text(|board| board.scene.as_deref())),
    ("firmware", Text(|board| board.firmware.as_deref())),
    ("source", Text(|board| board.source.as_deref())),
    ("calibration", Text(|board| board.calibration.as_deref())),
    ("start", Time(|board| board.time_us.map(|[start, _]| start))),
    ("end", Time(|board| board.time_us.map(|[_, end]| end))),
    ("frames", Count(|board| board.tally.frames)),
    ("contacts", Count(|board| board.contacts)),
    ("kindness", Count(|board| board.intentions[0])),
    ("threat", Count(|board| board.intentions[1])),
    ("attack", Count(|board| board.intentions[2])),
    ("reactions", Count(|board| board.reactions)),
    ("lost", Count(|board| board.tally.lost)),
    ("thinned", Count(|board| board.tally.thinned)),
    ("undecoded", Count(|board| board.tally.undecoded)),
    ("refused", Count(|board| board.tally.refused)),
    ("restarts", Count(|board| board.tally.restarts)),
    ("faulty_taxels", Count(|board| board.faulty_taxels)),
    ("damaged_chunks", Count(|board| board.skipped.chunks)),
    ("whole", Is(|board| board.is_whole)),
    ("error", OfRow(|row| row.read.as_ref().err().map(String::as_str))),
];

/// Names of the columns.
#[cfg(test)]
fn names() -> impl Iterator<Item = &'static str> {
    COLUMNS.iter().map(|(name, _)| *name)
}

/// The table as a file.
pub fn table(rows: &[IndexRow]) -> Result<Vec<u8>> {
    let types = COLUMNS.iter().map(kind).collect::<parquet::errors::Result<_>>()?;
    let schema = Arc::new(Type::group_type_builder("schema").with_fields(types).build()?);
    let properties = WriterProperties::builder()
        .set_created_by(concat!("taxel ", env!("CARGO_PKG_VERSION")).into())
        .build();
    let mut writer = SerializedFileWriter::new(Vec::new(), schema, Arc::new(properties))?;
    for rows in rows.chunks(GROUP) {
        let mut group = writer.next_row_group()?;
        COLUMNS.iter().try_for_each(|column| write(&mut group, column, rows))?;
        group.close()?;
    }
    Ok(writer.into_inner()?)
}

/// Parquet type of a column.
fn kind((name, value): &IndexColumn) -> parquet::errors::Result<TypePtr> {
    let (physical, logical) = match value {
        OfRow(_) | Text(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        Count(_) => (Physical::INT64, None),
        Time(_) => (Physical::INT64, Some(LogicalType::timestamp(true, TimeUnit::MICROS))),
        Is(_) => (Physical::BOOLEAN, None),
    };
    let repetition = if *name == "file" { Repetition::REQUIRED } else { Repetition::OPTIONAL };
    let leaf = Type::primitive_type_builder(name, physical).with_logical_type(logical);
    Ok(Arc::new(leaf.with_repetition(repetition).build()?))
}

/// Writes a column of a group.
fn write(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    column: &IndexColumn,
    rows: &[IndexRow],
) -> Result<()> {
    let (name, value) = *column;
    let mut writer = group.next_column()?.with_context(|| format!("{name} has no place"))?;
    let boards = rows.iter().map(|row| row.read.as_ref().ok());
    let whole = |count: u64| i64::try_from(count).unwrap_or(i64::MAX);
    match value {
        OfRow(of) => {
            let (there, values) = split(rows.iter().map(|row| of(row).map(ByteArray::from)));
            // A column without nulls has no levels.
            let levels = (name != "file").then_some(&there[..]);
            writer.typed::<ByteArrayType>().write_batch(&values, levels, None)?
        }
        Text(of) => {
            let (there, values) = split(boards.map(|board| board.and_then(of).map(ByteArray::from)));
            writer.typed::<ByteArrayType>().write_batch(&values, Some(&there), None)?
        }
        Count(of) => {
            let (there, values) = split(boards.map(|board| board.map(of).map(whole)));
            writer.typed::<Int64Type>().write_batch(&values, Some(&there), None)?
        }
        Time(of) => {
            let (there, values) = split(boards.map(|board| board.and_then(of).map(whole)));
            writer.typed::<Int64Type>().write_batch(&values, Some(&there), None)?
        }
        Is(of) => {
            let (there, values) = split(boards.map(|board| board.map(of)));
            writer.typed::<BoolType>().write_batch(&values, Some(&there), None)?
        }
    };
    writer.close()?;
    Ok(())
}

/// Definition levels, and the values that are there.
fn split<T>(values: impl Iterator<Item = Option<T>>) -> (Vec<i16>, Vec<T>) {
    let (mut there, mut all) = (Vec::new(), Vec::new());
    for value in values {
        there.push(i16::from(value.is_some()));
        all.extend(value);
    }
    (there, all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_documentation_has_every_column() {
        let page = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/commands.md"));
        let missing: Vec<_> = names().filter(|name| !page.contains(&format!("`{name}`"))).collect();
        assert!(missing.is_empty(), "{missing:?}");
    }

    #[test]
    fn an_empty_table_is_a_table() {
        let bytes = table(&[]).unwrap();
        assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
    }
}
