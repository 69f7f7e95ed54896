//! Surfaces from 3MF (core specification 1.3; parts in several files by its production extension 1.1).

use super::given::{MOST_FACES, Read, Unit};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use shape::Mesh;
use std::collections::BTreeMap;
use std::io::{BufReader, Cursor, Read as _};
use zip::ZipArchive;

/// Bytes of models, unpacked: what four million faces take in long numbers (structural: a limit of memory).
const MOST_BYTES: u64 = 1 << 30;

/// A matrix of twelve numbers, its fourth row the shift (core specification, 3.3).
type Place = [f32; 12];

/// An object: its triangles, or other objects that are placed.
#[derive(Default)]
struct Object {
    mesh: Mesh,
    parts: Vec<(Name, Place)>,
}

/// The file of the package and the number in it.
type Name = (String, String);

/// A package, read.
#[derive(Default)]
struct Package {
    objects: BTreeMap<Name, Object>,
    items: Vec<(Name, Place)>,
    unit: Option<Unit>,
}

/// Reads the triangles of all that is to be built, and the unit that the file names.
///
/// # Errors
///
/// What is wrong with the file, in words.
pub(super) fn read(bytes: &[u8]) -> Result<Read, String> {
    let mut zip = ZipArchive::new(Cursor::new(bytes)).map_err(|e| e.to_string())?;
    let names: Result<Vec<String>, _> = zip.file_names().map(|n| n.map(Into::into)).collect();
    let names = names.map_err(|e| e.to_string())?;
    let mut package = Package::default();
    let mut left = MOST_BYTES;
    for name in names.iter().filter(|n| n.ends_with(".model")) {
        let file = zip.by_name(name).map_err(|e| e.to_string())?;
        let mut bounded = file.take(left);
        model(name, &mut bounded, &mut package)?;
        left = bounded.limit();
        if left == 0 {
            return Err("unpacked it is larger than 1 GiB".into());
        }
    }
    let mut mesh = Mesh::default();
    let mut open: Vec<(Name, Place, usize)> = Vec::new();
    open.extend(package.items.iter().map(|(n, p)| (n.clone(), *p, 0)));
    while let Some((name, place, depth)) = open.pop() {
        let object = package.objects.get(&name);
        let object = object.ok_or_else(|| format!("object {} is not there", name.1))?;
        // Deeper than there are objects, one contains itself.
        if depth > package.objects.len() {
            return Err(format!("object {} contains itself", name.1));
        }
        if mesh.faces.len() + object.mesh.faces.len() > MOST_FACES || open.len() > MOST_FACES {
            return Err(format!(
                "it has more than {} million faces",
                MOST_FACES / 1_000_000
            ));
        }
        let first = mesh.positions.len() as u32;
        mesh.positions
            .extend(object.mesh.positions.iter().map(|p| put(p, &place)));
        mesh.faces
            .extend(object.mesh.faces.iter().map(|f| f.map(|v| v + first)));
        let inner = |(n, p): &(Name, Place)| (n.clone(), product(p, &place), depth + 1);
        open.extend(object.parts.iter().map(inner));
    }
    Ok(Read {
        mesh,
        unit: package.unit,
    })
}

/// Reads one model of a package.
fn model(name: &str, bytes: &mut impl std::io::Read, package: &mut Package) -> Result<(), String> {
    let mut reader = Reader::from_reader(BufReader::new(bytes));
    let mut buffer = Vec::new();
    let mut own = String::new();
    let fault = |e: &dyn std::fmt::Display| format!("{name}: {e}");
    loop {
        let event = reader.read_event_into(&mut buffer).map_err(|e| fault(&e))?;
        let (Event::Start(element) | Event::Empty(element)) = event else {
            if matches!(event, Event::Eof) {
                return Ok(());
            }
            buffer.clear();
            continue;
        };
        element_in(name, &element, &mut own, package).map_err(|e| fault(&e))?;
        buffer.clear();
    }
}

/// Takes one element; `own` is the object it is in.
fn element_in(
    file: &str,
    element: &BytesStart<'_>,
    own: &mut String,
    package: &mut Package,
) -> Result<(), String> {
    let place = || match text(element, "transform")? {
        None => Ok([1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]),
        Some(numbers) => {
            let numbers: Vec<f32> = numbers.split_whitespace().flat_map(str::parse).collect();
            numbers
                .try_into()
                .map_err(|_| "a transform has not twelve numbers".to_owned())
        }
    };
    let named = || {
        let path = text(element, "path")?.unwrap_or_else(|| file.to_owned());
        let id = text(element, "objectid")?.ok_or("an object is placed without its number")?;
        Ok::<Name, String>((path.trim_start_matches('/').to_owned(), id))
    };
    let object = |package: &mut Package, own: &str, f: &mut dyn FnMut(&mut Object)| {
        f(package
            .objects
            .entry((file.to_owned(), own.to_owned()))
            .or_default());
    };
    match element.local_name().as_ref() {
        b"model" if package.unit.is_none() => {
            package.unit = match text(element, "unit")?.as_deref() {
                None | Some("millimeter") => Some(Unit::Mm),
                Some("centimeter") => Some(Unit::Cm),
                Some("meter") => Some(Unit::M),
                Some("inch") => Some(Unit::Inch),
                Some(_) => None,
            };
        }
        b"object" => {
            *own = text(element, "id")?.ok_or("an object without a number")?;
            object(package, own, &mut |_| {});
        }
        b"vertex" => {
            let at = [
                number(element, "x")?,
                number(element, "y")?,
                number(element, "z")?,
            ];
            object(package, own, &mut |o| o.mesh.positions.push(at));
        }
        b"triangle" => {
            let corners = [
                number(element, "v1")?,
                number(element, "v2")?,
                number(element, "v3")?,
            ];
            object(package, own, &mut |o| o.mesh.faces.push(corners));
        }
        b"component" => {
            let (name, place) = (named()?, place()?);
            object(package, own, &mut |o| o.parts.push((name.clone(), place)));
        }
        b"item" => package.items.push((named()?, place()?)),
        _ => {}
    }
    Ok(())
}

/// An attribute of this name, whatever its namespace.
fn text(element: &BytesStart<'_>, name: &str) -> Result<Option<String>, String> {
    for attribute in element.attributes() {
        let attribute = attribute.map_err(|e| e.to_string())?;
        if attribute.key.local_name().as_ref() == name.as_bytes() {
            let value = std::str::from_utf8(&attribute.value);
            return Ok(Some(value.map_err(|_| "no text")?.to_owned()));
        }
    }
    Ok(None)
}

fn number<T: std::str::FromStr>(element: &BytesStart<'_>, name: &str) -> Result<T, String> {
    let value = text(element, name)?.and_then(|v| v.trim().parse().ok());
    value.ok_or_else(|| format!("the number {name} is missing"))
}

fn put([x, y, z]: &[f32; 3], m: &Place) -> [f32; 3] {
    std::array::from_fn(|k| x * m[k] + y * m[3 + k] + z * m[6 + k] + m[9 + k])
}

/// First `a`, then `b`.
fn product(a: &Place, b: &Place) -> Place {
    let mut both = [0.0; 12];
    for (row, out) in both.chunks_exact_mut(3).enumerate() {
        let own = [a[3 * row], a[3 * row + 1], a[3 * row + 2]];
        let turned: [f32; 3] =
            std::array::from_fn(|k| own[0] * b[k] + own[1] * b[3 + k] + own[2] * b[6 + k]);
        let shift = if row == 3 {
            [b[9], b[10], b[11]]
        } else {
            [0.0; 3]
        };
        out.copy_from_slice(&std::array::from_fn::<f32, 3, _>(|k| turned[k] + shift[k]));
    }
    both
}
