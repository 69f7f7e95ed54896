//! What is given beside `capture.toml`, by its keys: on the command line, in a pipeline. It wins.

use crate::keys::RigError;
use stage::Value;
use std::collections::BTreeMap;
use toml::Table;

/// Keys of `capture.toml` with their values.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Facts(pub BTreeMap<String, Value>);

impl Facts {
    /// As a table of TOML.
    pub(crate) fn table(&self) -> Table {
        let entry = |(key, value): (&String, &Value)| (key.clone(), plain(value));
        self.0.iter().map(entry).collect()
    }

    /// Reads a `capture.toml` with these facts over it.
    pub(crate) fn read_over<T>(
        &self,
        text: &str,
        read: impl Fn(Table) -> Result<T, RigError>,
    ) -> Result<T, RigError> {
        let table = text.parse();
        let table: Table = table.map_err(|e: toml::de::Error| RigError::wrong(e.to_string()))?;
        read(self.over(table)).map_err(|error| RigError {
            beside: !self.0.is_empty(),
            ..error
        })
    }

    /// A file's table with these facts over it. What the file has on the same thing in other words goes:
    /// a focal length in pixels under one in millimetres, a reference length of what is given here.
    pub(crate) fn over(&self, mut file: Table) -> Table {
        let given = self.table();
        let has = |table: &str, key: &str| {
            let table = given.get(table).and_then(toml::Value::as_table);
            table.is_some_and(|t| t.contains_key(key))
        };
        if has("camera", "focal_35mm")
            && let Some(camera) = file.get_mut("camera").and_then(toml::Value::as_table_mut)
        {
            camera.remove("focal_px");
        }
        let kind = file.get("reference").and_then(|r| r.get("kind"));
        let again = match kind.and_then(toml::Value::as_str) {
            Some("subject_height") => has("subject", "height_cm"),
            Some("disk_diameter") => has("disk", "diameter_cm"),
            Some("tag_size") => has("mat", "tag_size_mm"),
            _ => false,
        };
        if again {
            file.remove("reference");
        }
        // An age and a day of birth mean the same.
        for (key, other) in [("born", "age_years"), ("age_years", "born")] {
            if has("subject", key)
                && let Some(subject) = file.get_mut("subject").and_then(toml::Value::as_table_mut)
            {
                subject.remove(other);
            }
        }
        merge(&mut file, given);
        file
    }
}

/// Tables entry by entry, all else as a whole.
fn merge(under: &mut Table, over: Table) {
    for (key, value) in over {
        match (under.get_mut(&key), value) {
            (Some(toml::Value::Table(old)), toml::Value::Table(new)) => merge(old, new),
            (_, value) => drop(under.insert(key, value)),
        }
    }
}

fn plain(value: &Value) -> toml::Value {
    match value {
        Value::Bool(b) => (*b).into(),
        Value::Int(i) => (*i).into(),
        Value::Float(x) => (*x).into(),
        Value::Text(t) => t.clone().into(),
        Value::List(l) => toml::Value::Array(l.iter().map(plain).collect()),
        Value::Table(t) => Facts(t.clone()).table().into(),
    }
}
