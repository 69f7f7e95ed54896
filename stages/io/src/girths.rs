//! Girths as JSON.

use serde_json::{Map, Value, json};
use shape::{Girth, GirthId, Girths, Growth, Missing, Plane, Region, Score, Side, Sigmas, Unit};

/// How lengths are written: their unit in names of keys and columns, and the numbers themselves.
#[derive(Clone, Copy)]
pub(crate) struct Written {
    pub(crate) unit: &'static str,
    pub(crate) suffix: &'static str,
    per_mm: f64,
    digits: i32,
}

impl Written {
    pub(crate) fn of(unit: Unit) -> Self {
        match unit {
            Unit::Metric => Written {
                unit: "cm",
                suffix: "cm",
                per_mm: 0.1,
                digits: 2,
            },
            // 1 is the radius of the camera ring.
            Unit::Relative => Written {
                unit: "relative",
                suffix: "rel",
                per_mm: 0.001,
                digits: 5,
            },
        }
    }

    /// A length as a number.
    pub(crate) fn length(&self, mm: f64) -> f64 {
        let tens = 10f64.powi(self.digits);
        (mm * self.per_mm * tens).round() / tens
    }

    /// `tape` as `tape_cm`.
    pub(crate) fn key(&self, what: &str) -> String {
        format!("{what}_{}", self.suffix)
    }

    /// A cell of a table.
    pub(crate) fn cell(&self, mm: Option<f64>) -> String {
        let digits = self.digits as usize;
        mm.map_or(String::new(), |mm| format!("{:.digits$}", self.length(mm)))
    }
}

/// A girth as files have it; the mean of both upper arms is one, too.
pub(crate) struct Row {
    pub(crate) id: GirthId,
    pub(crate) by: GirthId,
    pub(crate) name: String,
    pub(crate) label: String,
    pub(crate) definition: String,
    pub(crate) region: Region,
    pub(crate) contour_mm: f64,
    pub(crate) tape_mm: f64,
    pub(crate) spline_mm: f64,
    pub(crate) silhouette_mm: Option<f64>,
    pub(crate) interval_mm: Option<[f64; 2]>,
    pub(crate) sigmas: Sigmas,
    pub(crate) repeat_mm: Option<f64>,
    pub(crate) split: Option<f64>,
    pub(crate) remarks: Vec<String>,
    pub(crate) plane: Option<Plane>,
}

fn row(g: &Girth) -> Row {
    Row {
        id: g.id,
        by: g.by,
        name: g.name.clone(),
        label: g.label.clone(),
        definition: g.definition.clone(),
        region: g.region,
        contour_mm: g.contour_mm,
        tape_mm: g.tape_mm,
        spline_mm: g.spline_mm,
        silhouette_mm: g.silhouette_mm,
        interval_mm: g.interval_mm,
        sigmas: g.sigmas,
        repeat_mm: g.repeat_mm,
        split: g.split.map(|s| s.share),
        remarks: g.remarks(),
        plane: Some(g.plane),
    }
}

/// The mean of both upper arms; its parts are means as well, as if both erred alike.
fn mean_of_arms(girths: &Girths) -> Option<Row> {
    let [l, r] = Side::BOTH.map(|side| girths.of(GirthId::UpperArm(side)));
    let (l, r) = (l?, r?);
    let mean = |a: f64, b: f64| (a + b) / 2.0;
    let both = |a: Option<f64>, b: Option<f64>| Some(mean(a?, b?));
    let (s, t) = (l.sigmas, r.sigmas);
    let id = GirthId::UpperArmMean;
    let intervals = l.interval_mm.zip(r.interval_mm);
    Some(Row {
        id,
        by: id,
        name: id.name(),
        label: id.label(),
        definition: id.definition().sentence.into(),
        region: id.definition().region,
        contour_mm: mean(l.contour_mm, r.contour_mm),
        tape_mm: mean(l.tape_mm, r.tape_mm),
        spline_mm: mean(l.spline_mm, r.spline_mm),
        silhouette_mm: None,
        interval_mm: intervals.map(|(a, b)| [mean(a[0], b[0]), mean(a[1], b[1])]),
        sigmas: Sigmas {
            level_mm: both(s.level_mm, t.level_mm),
            surface_mm: both(s.surface_mm, t.surface_mm),
            scale_mm: both(s.scale_mm, t.scale_mm),
            split_mm: both(s.split_mm, t.split_mm),
            cover_mm: both(s.cover_mm, t.cover_mm),
        },
        repeat_mm: both(l.repeat_mm, r.repeat_mm),
        split: None,
        remarks: vec![],
        plane: None,
    })
}

pub(crate) fn missed(m: &Missing) -> Value {
    let mut file = json!({ "name": m.name, "reason": m.reason.code(), "why": m.why.as_str() });
    if let Value::Object(coded) = json!(m.why) {
        for key in ["code", "fields"] {
            file[key] = coded.get(key).cloned().unwrap_or_default();
        }
    }
    file
}

/// One girth of `girths.json`.
fn girth_json(row: &Row, to: Written) -> Value {
    let length = |mm: Option<f64>| json!(mm.map(|mm| to.length(mm)));
    let sigmas: Map<String, Value> = row
        .sigmas
        .named()
        .into_iter()
        .map(|(name, mm)| (name.to_owned(), length(mm)))
        .collect();
    let definition = row.by.definition();
    let mut one = Map::new();
    let mut put = |key: &str, value: Value| one.insert(key.to_owned(), value);
    put("name", json!(row.name));
    put("label", json!(row.label));
    put("definition", json!(row.definition));
    put("iso8559", json!(definition.iso));
    put("part", json!(row.region.word()));
    put(to.suffix, length(Some(row.contour_mm)));
    put(&to.key("tape"), length(Some(row.tape_mm)));
    put(&to.key("spline"), length(Some(row.spline_mm)));
    put(&to.key("silhouette"), length(row.silhouette_mm));
    let interval = row.interval_mm.map(|ends| ends.map(|mm| to.length(mm)));
    put(&to.key("interval"), json!(interval));
    put(&to.key("sigma"), Value::Object(sigmas));
    put(&to.key("repeat"), length(row.repeat_mm));
    put("split_share", json!(row.split));
    put("notes", json!(row.remarks));
    if let Some(plane) = row.plane {
        let point = match to.unit {
            "cm" => json!({ "point_mm": plane.point_mm, "normal": plane.normal }),
            _ => {
                json!({ "point_rel": plane.point_mm.map(|mm| to.length(mm)), "normal": plane.normal })
            }
        };
        put("plane", point);
    }
    Value::Object(one)
}

/// Every girth, the mean of the arms behind them.
pub(crate) fn rows(girths: &Girths) -> Vec<Row> {
    let own = girths.girths.iter().map(row);
    own.chain(mean_of_arms(girths)).collect()
}

/// `girths.json`: `cm` along the contour, `tape_cm` convex in the plane, `spline_cm` the paper's;
/// where nothing of known length was given, `rel` takes the place of `cm`, and 1 is the camera ring's radius.
pub fn girths_to_json(girths: &Girths) -> String {
    let to = Written::of(girths.unit);
    let list: Vec<Value> = rows(girths).iter().map(|r| girth_json(r, to)).collect();
    let ratios: Map<String, Value> = girths
        .ratios
        .iter()
        .map(|(name, value, _)| (name.clone(), json!(value)))
        .collect();
    let missing: Vec<_> = girths.missing.iter().map(missed).collect();
    let mut file = Map::new();
    let mut put = |key: &str, value: Value| file.insert(key.to_owned(), value);
    put("unit", json!(to.unit));
    put("capture", json!(girths.capture));
    put("date", json!(girths.date));
    let percent = |share: f64| (share * 1e6).round() / 1e4;
    put("scale_sigma_pct", json!(girths.scale_sigma.map(percent)));
    put("compression_pct", json!(girths.compression_pct));
    put("girths", json!(list));
    put("ratios", json!(ratios));
    put("missing", json!(missing));
    let stature = girths.stature_mm.map(|mm| to.length(mm));
    put(&to.key("stature"), json!(stature));
    let sigma = girths.stature_sigma_mm.map(|mm| to.length(mm));
    put(&to.key("stature_sigma"), json!(sigma));
    put("weight_kg", json!(girths.weight_kg));
    put("bmi", json!(girths.bmi));
    put("volume_l", json!(girths.volume_l));
    if let Some(growth) = &girths.growth {
        put("growth", grown(growth));
    }
    serde_json::to_string_pretty(&file).expect("bug: girths JSON cannot hold")
}

/// A child beside the growth reference.
fn grown(growth: &Growth) -> Value {
    let round = |x: f64, tens: f64| (x * tens).round() / tens;
    let score = |s: Option<Score>| {
        s.map(|s| json!({ "z": round(s.z, 1e2), "centile": round(s.centile, 1e1) }))
    };
    json!({ "reference": "WHO 2007", "bmi_for_age": score(growth.bmi), "height_for_age": score(growth.height) })
}

/// The JSON schema (draft 2020-12) of what [`girths_to_json`] writes.
pub fn girths_schema() -> &'static str {
    include_str!("girths.schema.json")
}
