//! Photos to the folder that a capture is read from: images, plate, `capture.toml`.

use shape::{Photos, Rig};
use std::fmt::Write;

/// The files of a capture: `images/` with the photos, the plate, and `capture.toml`. Names and bytes.
pub fn photos_to_capture(photos: &Photos) -> Vec<(String, Vec<u8>)> {
    let image = |p: &shape::Photo| (format!("images/{}", p.name), p.file.to_vec());
    let mut files: Vec<_> = photos.photos.iter().map(image).collect();
    files.extend(
        photos
            .plate
            .iter()
            .map(|p| (p.name.clone(), p.file.to_vec())),
    );
    let mut text = format!("views = {}\n", photos.photos.len());
    if let Some(plate) = &photos.plate {
        writeln!(text, "plate = {:?}", plate.name).expect("bug: text");
    }
    text.push_str(&rig_to_toml(&photos.rig));
    files.push(("capture.toml".into(), text.into_bytes()));
    files
}

/// What `capture.toml` has of a rig.
fn rig_to_toml(rig: &Rig) -> String {
    let mut text = String::new();
    let mut line = |key: &str, value: Option<f64>| {
        if let Some(value) = value {
            writeln!(text, "{key} = {value:?}").expect("bug: text");
        }
    };
    line("step_deg", rig.step.map(f64::to_degrees));
    line("camera.focal_35mm", rig.focal_35mm);
    line("camera.focal_px", rig.focal_px);
    line("subject.height_cm", rig.stature_mm.map(|mm| mm / 10.0));
    line("disk.diameter_cm", rig.disk_diameter_mm.map(|mm| mm / 10.0));
    line("mat.tag_size_mm", rig.tag_mm.filter(|_| rig.mat.is_none()));
    if let Some(mat) = &rig.mat {
        line("mat.tag_size_mm", Some(mat.tag_mm));
        line("mat.ring_radius_mm", Some(mat.ring_mm));
        let last = mat.first_id + mat.count - 1;
        let (first, count) = (mat.first_id, mat.count);
        writeln!(text, "mat.count = {count}\nmat.ids = [{first}, {last}]").expect("bug: text");
    }
    if let Some(rim) = &rig.rim {
        let (first, count) = (rim.first_id, rim.count);
        let (tag, radius, last) = (rim.tag_mm, rim.radius_mm, first + count - 1);
        writeln!(
            text,
            "rim.tag_size_mm = {tag}\nrim.radius_mm = {radius}\nrim.count = {count}\nrim.ids = [{first}, {last}]"
        )
        .expect("bug: text");
    }
    if let Some([x, y]) = rig.centre_px {
        writeln!(text, "camera.centre_px = [{x:?}, {y:?}]").expect("bug: text");
    }
    if let Some(known) = &rig.reference {
        let (kind, length) = (&known.kind, known.length_mm);
        writeln!(
            text,
            "reference.kind = {kind:?}\nreference.length_mm = {length:?}"
        )
        .expect("bug: text");
    }
    text
}
