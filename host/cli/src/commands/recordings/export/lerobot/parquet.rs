//! Parquet files: columns of numbers, of nested lists of numbers, of texts.

use anyhow::{Result, bail};
use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, FloatType, Int64Type};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};
use std::fs::File;
use std::io::BufWriter;
use std::sync::Arc;
use taxel::files::output::Folder;

/// Type of a column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ColumnType {
    /// Floats in this shape; one number for shape \[1\].
    Floats(Vec<usize>),
    /// An integer.
    Whole,
    /// A text.
    Text,
    /// A list of one text.
    Texts,
}

/// A column.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Name.
    pub name: String,
    /// Type.
    pub kind: ColumnType,
}

/// Rows of a column, one after the other.
#[derive(Debug, Clone)]
pub enum Values {
    /// Of [`ColumnType::Floats`].
    Floats(Vec<f32>),
    /// Of [`ColumnType::Whole`].
    Whole(Vec<i64>),
    /// Of [`ColumnType::Text`] and [`ColumnType::Texts`].
    Texts(Vec<String>),
}

impl ColumnType {
    /// Shape of a row.
    fn shape(&self) -> &[usize] {
        match self {
            ColumnType::Floats(shape) if shape[..] != [1] => shape,
            ColumnType::Texts => &[1],
            _ => &[],
        }
    }

    /// No rows.
    pub fn none(&self) -> Values {
        match self {
            ColumnType::Floats(_) => Values::Floats(Vec::new()),
            ColumnType::Whole => Values::Whole(Vec::new()),
            ColumnType::Text | ColumnType::Texts => Values::Texts(Vec::new()),
        }
    }

    fn leaf(&self) -> (Physical, Option<LogicalType>) {
        match self {
            ColumnType::Floats(_) => (Physical::FLOAT, None),
            ColumnType::Whole => (Physical::INT64, None),
            ColumnType::Text | ColumnType::Texts => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
        }
    }

    /// Parquet type of a column with this depth of lists.
    fn column(&self, name: &str, lists: usize) -> parquet::errors::Result<TypePtr> {
        let Some(inner) = lists.checked_sub(1) else {
            let (physical, logical) = self.leaf();
            let leaf = Type::primitive_type_builder(name, physical).with_logical_type(logical);
            return Ok(Arc::new(leaf.with_repetition(Repetition::REQUIRED).build()?));
        };
        let element = self.column("element", inner)?;
        let repeated = Type::group_type_builder("list").with_repetition(Repetition::REPEATED);
        let repeated = Arc::new(repeated.with_fields(vec![element]).build()?);
        let list = Type::group_type_builder(name).with_repetition(Repetition::REQUIRED);
        Ok(Arc::new(list.with_logical_type(Some(LogicalType::List)).with_fields(vec![repeated]).build()?))
    }
}

impl Values {
    fn len(&self) -> usize {
        match self {
            Values::Floats(all) => all.len(),
            Values::Whole(all) => all.len(),
            Values::Texts(all) => all.len(),
        }
    }

    /// The numbers; none for texts.
    pub fn numbers(&self) -> impl ExactSizeIterator<Item = f64> + '_ {
        let count = if matches!(self, Values::Texts(_)) { 0 } else { self.len() };
        (0..count).map(|index| match self {
            Values::Floats(all) => all[index].into(),
            Values::Whole(all) => all[index] as f64,
            Values::Texts(_) => f64::NAN,
        })
    }

    /// Appends rows of the same kind.
    pub fn append(&mut self, more: Values) {
        match (self, more) {
            (Values::Floats(all), Values::Floats(more)) => all.extend(more),
            (Values::Whole(all), Values::Whole(more)) => all.extend(more),
            (Values::Texts(all), Values::Texts(more)) => all.extend(more),
            _ => {}
        }
    }

    /// Removes all rows.
    pub fn clear(&mut self) {
        match self {
            Values::Floats(all) => all.clear(),
            Values::Whole(all) => all.clear(),
            Values::Texts(all) => all.clear(),
        }
    }
}

/// A file being written.
pub struct Table {
    columns: Vec<Column>,
    writer: SerializedFileWriter<BufWriter<File>>,
}

impl Table {
    /// Begins a file of the data set; `note` is a key and value of its metadata.
    pub fn create(
        folder: &Folder,
        path: &str,
        columns: Vec<Column>,
        note: Option<[String; 2]>,
    ) -> Result<Table> {
        let types = columns.iter().map(|column| column.kind.column(&column.name, column.kind.shape().len()));
        let types = types.collect::<parquet::errors::Result<_>>()?;
        let schema = Arc::new(Type::group_type_builder("schema").with_fields(types).build()?);
        let note = note.map(|[name, text]| vec![KeyValue::new(name, text)]);
        let properties = WriterProperties::builder()
            .set_created_by(concat!("taxel ", env!("CARGO_PKG_VERSION")).into())
            .set_key_value_metadata(note)
            .build();
        let file = folder.file(path)?;
        Ok(Table { columns, writer: SerializedFileWriter::new(file, schema, Arc::new(properties))? })
    }

    /// Writes rows, with their values by column.
    pub fn rows(&mut self, values: &[Values]) -> Result<()> {
        let mut group = self.writer.next_row_group()?;
        for (column, values) in self.columns.iter().zip(values) {
            let shape = column.kind.shape();
            let depths: Option<[Vec<i16>; 2]> = (!shape.is_empty()).then(|| levels(shape, values.len()));
            let [defined, repeated] =
                depths.as_ref().map_or([None; 2], |[a, b]| [Some(a.as_slice()), Some(b.as_slice())]);
            let Some(mut writer) = group.next_column()? else { bail!("{} has no place", column.name) };
            match values {
                Values::Floats(all) => writer.typed::<FloatType>().write_batch(all, defined, repeated)?,
                Values::Whole(all) => writer.typed::<Int64Type>().write_batch(all, defined, repeated)?,
                Values::Texts(all) => {
                    let bytes: Vec<ByteArray> = all.iter().map(|text| text.as_str().into()).collect();
                    writer.typed::<ByteArrayType>().write_batch(&bytes, defined, repeated)?
                }
            };
            writer.close()?;
        }
        group.close()?;
        Ok(())
    }

    /// Writes the end.
    pub fn finish(self) -> Result<()> {
        self.writer.close()?;
        Ok(())
    }
}

/// Repetition and definition levels of `count` values in lists: all lists around a value exist; the
/// repetition level says how many of them continue from the value before.
fn levels(shape: &[usize], count: usize) -> [Vec<i16>; 2] {
    let sizes: Vec<usize> = (0..shape.len()).map(|list| shape[list..].iter().product()).collect();
    let goes_on = |index: usize| {
        let begins = sizes.iter().position(|size| index.is_multiple_of((*size).max(1)));
        begins.unwrap_or(shape.len()) as i16
    };
    [vec![shape.len() as i16; count], (0..count).map(goes_on).collect()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_begins_at_0_and_a_list_in_it_at_1() {
        let [defined, repeated] = levels(&[2, 3], 12);
        assert_eq!(defined, [2; 12]);
        assert_eq!(repeated, [0, 2, 2, 1, 2, 2, 0, 2, 2, 1, 2, 2]);
        assert_eq!(levels(&[3], 4)[1], [0, 1, 1, 0]);
    }
}
