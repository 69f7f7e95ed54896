//! `sweep.parquet`: the points of a sweep with types, units beside (feature `parquet`).

use super::fault::Fault;
use ::parquet::basic::{LogicalType, Repetition, Type as Physical};
use ::parquet::data_type::{BoolType, ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use ::parquet::errors::ParquetError;
use ::parquet::file::metadata::KeyValue;
use ::parquet::file::properties::WriterProperties;
use ::parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use ::parquet::schema::types::{Type, TypePtr};
use engine::sweep::Row;
use std::sync::Arc;
use tables::{Cells, Column};

/// The file, by its name.
pub(super) fn columns(rows: &[Row]) -> Result<Vec<(String, Vec<u8>)>, Fault> {
    let bytes = written(&tables::typed(rows));
    let bytes = bytes.map_err(|why| Fault::stage(format!("sweep.parquet: {why}")))?;
    Ok(vec![("sweep.parquet".to_owned(), bytes)])
}

/// A column's place in the file: every cell may be empty.
fn field(column: &Column) -> Result<TypePtr, ParquetError> {
    let (physical, logical) = match column.cells {
        Cells::Truth(_) => (Physical::BOOLEAN, None),
        Cells::Whole(_) => (Physical::INT64, None),
        Cells::Number(_) => (Physical::DOUBLE, None),
        Cells::Text(_) => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
    };
    let field = Type::primitive_type_builder(&column.name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(logical);
    Ok(Arc::new(field.build()?))
}

fn written(columns: &[Column]) -> Result<Vec<u8>, ParquetError> {
    let fields = columns.iter().map(field).collect::<Result<_, _>>()?;
    let schema = Type::group_type_builder("points").with_fields(fields);
    let units = columns.iter().filter(|c| !c.unit.is_empty());
    let units = units.map(|c| KeyValue::new(format!("unit.{}", c.name), c.unit.clone()));
    let properties = WriterProperties::builder().set_key_value_metadata(Some(units.collect()));
    let mut bytes = Vec::new();
    let schema = Arc::new(schema.build()?);
    let mut file = SerializedFileWriter::new(&mut bytes, schema, Arc::new(properties.build()))?;
    let mut group = file.next_row_group()?;
    for column in columns {
        match &column.cells {
            Cells::Truth(cells) => put::<BoolType>(&mut group, cells.iter().copied())?,
            Cells::Whole(cells) => put::<Int64Type>(&mut group, cells.iter().copied())?,
            Cells::Number(cells) => put::<DoubleType>(&mut group, cells.iter().copied())?,
            Cells::Text(cells) => {
                let texts = cells.iter().map(|t| t.as_deref().map(ByteArray::from));
                put::<ByteArrayType>(&mut group, texts)?;
            }
        }
    }
    group.close()?;
    file.close()?;
    Ok(bytes)
}

/// Writes the next column.
fn put<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, &mut Vec<u8>>,
    cells: impl Iterator<Item = Option<T::T>>,
) -> Result<(), ParquetError> {
    let cells: Vec<Option<T::T>> = cells.collect();
    let there: Vec<i16> = cells.iter().map(|c| i16::from(c.is_some())).collect();
    let values: Vec<T::T> = cells.into_iter().flatten().collect();
    let Some(mut column) = group.next_column()? else {
        return Err(ParquetError::General("a column too many".into()));
    };
    column
        .typed::<T>()
        .write_batch(&values, Some(&there), None)?;
    column.close()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ::parquet::file::reader::{FileReader, SerializedFileReader};
    use ::parquet::record::Field;
    use std::io::Write;

    fn column(name: &str, unit: &str, cells: Cells) -> Column {
        let (name, unit) = (name.to_owned(), unit.to_owned());
        Column { name, unit, cells }
    }

    #[test]
    fn what_is_written_is_read_with_its_types_units_and_gaps() {
        let text = |t: &str| Some(t.to_owned());
        let bytes = written(&[
            column("variant", "", Cells::Text(vec![text("rigid"), None])),
            column("hull.fine", "", Cells::Truth(vec![Some(true), None])),
            column("replicate", "", Cells::Whole(vec![Some(1), Some(2)])),
            column(
                "girths.WC",
                "cm tape",
                Cells::Number(vec![None, Some(75.5)]),
            ),
        ]);
        let mut file = tempfile::tempfile().unwrap();
        file.write_all(&bytes.unwrap()).unwrap();
        let file = SerializedFileReader::new(file).unwrap();
        let units = file
            .metadata()
            .file_metadata()
            .key_value_metadata()
            .unwrap();
        assert_eq!(units.len(), 1);
        assert_eq!(
            (&*units[0].key, units[0].value.as_deref()),
            ("unit.girths.WC", Some("cm tape"))
        );
        let rows: Vec<Vec<Field>> = file
            .get_row_iter(None)
            .unwrap()
            .map(|row| {
                row.unwrap()
                    .get_column_iter()
                    .map(|(_, f)| f.clone())
                    .collect()
            })
            .collect();
        let text = |t: &str| Field::Str(t.to_owned());
        assert_eq!(
            rows,
            [
                vec![
                    text("rigid"),
                    Field::Bool(true),
                    Field::Long(1),
                    Field::Null
                ],
                vec![
                    Field::Null,
                    Field::Null,
                    Field::Long(2),
                    Field::Double(75.5)
                ],
            ]
        );
    }
}
