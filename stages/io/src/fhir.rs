//! Girths as FHIR R5 Observations: a bundle for records of health.
//!
//! Codes are LOINC's where LOINC has the very thing, else those of code systems of our own, whose codes are the table's
//! names and the clauses of ISO 8559-1:2017. No LOINC code is made up, and each waist has the code of where it
//! was taken.

use crate::write_error::WriteError;
use serde_json::{Map, Value, json};
use shape::{Girth, GirthId, Girths, Unit};

/// Lengths without a unit are no observation.
#[derive(Debug, thiserror::Error)]
#[error(
    "lengths are relative, for nothing of known length was given or known lengths contradict each other: FHIR observations need centimetres; give a length when measuring, such as --stature"
)]
pub struct NoLengths;

const LOINC: &str = "http://loinc.org";
const UCUM: &str = "http://unitsofmeasure.org";
/// Names of the table of girths, and derived numbers.
const OWN: &str = "urn:x-tailor:girth";
/// Clauses of ISO 8559-1:2017.
const ISO: &str = "urn:x-tailor:iso-8559-1-2017";
/// How it was measured.
const METHOD: &str =
    "photographs: tape length (convex hull) of a section of the reconstructed surface";

fn coding(system: &str, code: &str, display: &str) -> Value {
    json!({ "system": system, "code": code, "display": display })
}

/// LOINC's code of a waist, by where it was taken: at the navel, midway between the lowest rib and the iliac crest (as
/// the National Children's Fitness Survey does), at the top of the ilium (as NHANES does). Hip, chest and limbs have codes of
/// single studies' protocols only, or none that names the place.
fn loinc(girth: GirthId) -> Option<(&'static str, &'static str)> {
    match girth {
        GirthId::WaistNavel => Some(("8280-0", "Waist Circumference at umbilicus by Tape measure")),
        GirthId::WaistNatural => Some(("56115-9", "Waist Circumference by NCFS")),
        GirthId::WaistHipBone => Some(("56114-2", "Waist Circumference by NHANES")),
        _ => None,
    }
}

/// The codes of a girth, the most widely known first.
fn codes(girth: &Girth) -> Vec<Value> {
    let mut all = Vec::new();
    if let Some((code, display)) = loinc(girth.by) {
        all.push(coding(LOINC, code, display));
    }
    let definition = girth.by.definition();
    if let Some(clause) = definition.iso {
        all.push(coding(ISO, clause, definition.label));
    }
    all.push(coding(OWN, &girth.name, &girth.label));
    all
}

fn quantity(value: f64, digits: i32, unit: &str, code: &str) -> Value {
    let tens = 10f64.powi(digits);
    json!({ "value": (value * tens).round() / tens, "unit": unit, "system": UCUM, "code": code })
}

/// An observation, and a name by which the bundle knows it: of its own content, so that equal ones have equal names.
fn entry(
    girths: &Girths,
    codes: &[Value],
    text: &str,
    value: &Value,
    rest: Map<String, Value>,
) -> Value {
    let mut one = Map::new();
    let mut put = |key: &str, value: Value| one.insert(key.to_owned(), value);
    put("resourceType", json!("Observation"));
    put("status", json!("final"));
    put(
        "category",
        json!([{ "coding": [coding("http://terminology.hl7.org/CodeSystem/observation-category", "exam", "Exam")] }]),
    );
    put("code", json!({ "coding": codes, "text": text }));
    if let Some(capture) = &girths.capture {
        put("subject", json!({ "display": capture }));
    }
    if let Some(date) = &girths.date {
        put("effectiveDateTime", json!(date));
    }
    put("valueQuantity", value.clone());
    one.extend(rest);
    let one = Value::Object(one);
    json!({ "fullUrl": format!("urn:uuid:{}", uuid(&one.to_string())), "resource": one })
}

/// A UUID of version 8 (RFC 9562) from a hash.
fn uuid(text: &str) -> String {
    let mut id: [u8; 16] = blake3::hash(text.as_bytes()).as_bytes()[..16]
        .try_into()
        .expect("bug: a hash has 32 bytes");
    id[6] = id[6] & 0x0f | 0x80;
    id[8] = id[8] & 0x3f | 0x80;
    let hex: String = id.iter().map(|b| format!("{b:02x}")).collect();
    [
        &hex[..8],
        &hex[8..12],
        &hex[12..16],
        &hex[16..20],
        &hex[20..],
    ]
    .join("-")
}

fn of_girth(girths: &Girths, girth: &Girth) -> Value {
    let cm = |mm: f64| quantity(mm / 10.0, 2, "cm", "cm");
    let mut rest = Map::new();
    rest.insert("method".into(), json!({ "text": METHOD }));
    if let Some([low, high]) = girth.interval_mm {
        let end = |code: &str, display: &str, mm: f64| json!({ "code": { "coding": [coding(OWN, code, display)] }, "valueQuantity": cm(mm) });
        let ends = [
            end("interval-low", "90 % interval, low", low),
            end("interval-high", "90 % interval, high", high),
        ];
        rest.insert("component".into(), json!(ends));
    }
    let remarks = girth.remarks();
    if !remarks.is_empty() {
        let notes: Vec<Value> = remarks.iter().map(|text| json!({ "text": text })).collect();
        rest.insert("note".into(), json!(notes));
    }
    entry(
        girths,
        &codes(girth),
        &girth.definition,
        &cm(girth.tape_mm),
        rest,
    )
}

/// A FHIR R5 bundle (collection) of Observations as JSON: each girth's tape with its interval, height, weight, body mass
/// index and ratios. It has the day where the capture has one. The subject is named as the capture is.
///
/// # Errors
///
/// Lengths are relative ([`NoLengths`]).
pub fn girths_to_fhir(girths: &Girths) -> Result<String, WriteError> {
    if girths.unit == Unit::Relative {
        return Err(NoLengths.into());
    }
    let mut entries: Vec<Value> = girths.girths.iter().map(|g| of_girth(girths, g)).collect();
    let plain = |code: &str, display: &str, value: Value| {
        entry(
            girths,
            &[coding(LOINC, code, display)],
            display,
            &value,
            Map::new(),
        )
    };
    if let Some(mm) = girths.stature_mm {
        entries.push(plain(
            "8302-2",
            "Body height",
            quantity(mm / 10.0, 1, "cm", "cm"),
        ));
    }
    if let Some(kg) = girths.weight_kg {
        entries.push(plain("29463-7", "Body weight", quantity(kg, 1, "kg", "kg")));
    }
    if let Some(bmi) = girths.bmi {
        entries.push(plain(
            "39156-5",
            "Body mass index (BMI) [Ratio]",
            quantity(bmi, 1, "kg/m2", "kg/m2"),
        ));
    }
    let ratios = girths.ratios.iter().filter(|r| !r.0.starts_with("density"));
    for (name, value, note) in ratios {
        let mut rest = Map::new();
        if !note.is_empty() {
            rest.insert("note".into(), json!([{ "text": note.as_str() }]));
        }
        entries.push(entry(
            girths,
            &[coding(OWN, name, name)],
            name,
            &quantity(*value, 4, "1", "1"),
            rest,
        ));
    }
    let bundle = json!({ "resourceType": "Bundle", "type": "collection", "entry": entries });
    Ok(serde_json::to_string_pretty(&bundle).expect("bug: FHIR JSON cannot hold"))
}
