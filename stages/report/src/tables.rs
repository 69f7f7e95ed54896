//! The tables of the page: girths with intervals, what is missing, ratios, scale.

use shape::{Cameras, Girths, Rig, Scale};
use std::fmt::Write;

/// Text that may stand in HTML.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('{', "&#123;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// The girths, one a row.
pub(crate) fn girths(girths: &Girths) -> String {
    let mut html = String::from(
        "<table id=\"girths\"><thead><tr><th>girth</th><th class=\"n\">tape [cm]</th><th class=\"n\">interval</th>\
         <th class=\"n\">contour</th><th class=\"n\">spline</th><th class=\"n\">silhouette</th></tr></thead><tbody>",
    );
    let cm = |mm: f64| format!("{:.1}", mm / 10.0);
    for g in &girths.girths {
        let cells = [
            (cm(g.contour_mm), "contour"),
            (cm(g.spline_mm), "spline"),
            (g.silhouette_mm.map_or("–".into(), cm), "silhouette"),
        ];
        let cells: String = cells
            .iter()
            .map(|(text, of)| format!("<td class=\"n more\" data-of=\"{of}\">{text}</td>"))
            .collect();
        let _ = write!(
            html,
            "<tr data-name=\"{name}\" title=\"{definition}\" tabindex=\"0\"><td><b>{name}</b> {label} <span class=\"note\">{iso}</span></td>\
             <td class=\"n big\">{}</td><td class=\"n range\">{} – {}</td>{cells}</tr>",
            cm(g.tape_mm),
            cm(g.interval_mm[0]),
            cm(g.interval_mm[1]),
            name = escaped(&g.name),
            label = escaped(&g.label),
            iso = standard(&g.definition),
            definition = escaped(&g.definition),
        );
    }
    html += "</tbody></table>";
    html + &missing(girths)
}

/// What is not measured, and why; the same reason once.
fn missing(girths: &Girths) -> String {
    let mut reasons: Vec<(&str, Vec<String>)> = Vec::new();
    for m in &girths.missing {
        match reasons.iter_mut().find(|(why, _)| *why == m.why) {
            Some((_, names)) => names.push(escaped(&m.name)),
            None => reasons.push((&m.why, vec![escaped(&m.name)])),
        }
    }
    let line = |(why, names): &(&str, Vec<String>)| {
        format!("<li><b>{}</b>: {}</li>", names.join(", "), escaped(why))
    };
    let lines: String = reasons.iter().map(line).collect();
    match lines.is_empty() {
        true => lines,
        false => format!("<ul class=\"missing\">{lines}</ul>"),
    }
}

/// The number that the standard, or the body behind it, gives a girth: what the definition names in brackets.
fn standard(definition: &str) -> String {
    let inside = definition
        .split_once('(')
        .and_then(|(_, rest)| rest.split_once(')'));
    escaped(inside.map_or("", |(inside, _)| inside))
}

/// Ratios and the like, with the thresholds of the WHO beside them as text.
pub(crate) fn derived(girths: &Girths) -> String {
    let mut rows: Vec<(String, String, String)> = Vec::new();
    if let Some(mm) = girths.stature_mm {
        rows.push((
            "stature".into(),
            format!("{:.1} cm", mm / 10.0),
            String::new(),
        ));
    }
    if let Some(kg) = girths.weight_kg {
        rows.push(("weight".into(), format!("{kg:.1} kg"), "as given".into()));
    }
    if let Some(bmi) = girths.bmi {
        let note = "WHO, adults: 18.5 to 24.9 normal, from 25 overweight, from 30 obese".into();
        rows.push(("body mass index".into(), format!("{bmi:.1} kg/m²"), note));
    }
    for (name, value, note) in &girths.ratios {
        let note = match (name.as_str(), note.is_empty()) {
            ("WHR", true) => "WHO 2008, adults: risk raised from 0.90 (men), 0.85 (women)".into(),
            ("WHtR", true) => "often used bound: 0.5".into(),
            _ => note.clone(),
        };
        rows.push((name.clone(), format!("{value:.3}"), note));
    }
    if let Some(litres) = girths.volume_l {
        rows.push((
            "volume".into(),
            format!("{litres:.1} l"),
            "experimental".into(),
        ));
    }
    let row = |(name, value, note): &(String, String, String)| {
        let (name, value, note) = (escaped(name), escaped(value), escaped(note));
        format!(
            "<tr><td>{name}</td><td class=\"n\">{value}</td><td class=\"note\">{note}</td></tr>"
        )
    };
    let rows: String = rows.iter().map(row).collect();
    format!("<table class=\"facts\">{rows}</table><p class=\"note\">Numbers, no diagnosis.</p>")
}

/// Where the lengths come from, as a sentence.
pub(crate) fn origin(scale: Scale) -> &'static str {
    match scale {
        Scale::Mat => "lengths come from the marker mat on the disk",
        Scale::Reference => "lengths come from the reference length that was given",
        Scale::Disk => "lengths come from the disk's diameter",
        Scale::Stature => "lengths come from the subject's stature",
        Scale::Given => "lengths come from the cameras that were given, taken at their word",
        Scale::Nothing => "lengths are relative: the camera ring's radius is called 1000 mm",
    }
}

/// Where the millimetres come from, what else was known, and how sure the cameras are.
pub(crate) fn scale(cameras: &Cameras, rig: &Rig) -> String {
    let count = cameras.views.len().max(1) as f64;
    let mean = |f: fn(&shape::View) -> f64| cameras.views.values().map(f).sum::<f64>() / count;
    // Zero is unknown: cameras that were given, and those of a subject that sways.
    let centres = match mean(|v| v.sigma_mm) {
        mm if mm > 0.0 && mm < 100.0 => format!("camera centres ± {mm:.1} mm"),
        _ => "how sure the camera centres are cannot be told".into(),
    };
    let mut html = format!(
        "<p>The {}, ± {:.2} %. {} cameras; mean reprojection error {:.2} px; {centres}.</p>",
        origin(cameras.scale),
        cameras.scale_sigma * 100.0,
        cameras.views.len(),
        mean(|v| v.rms_px),
    );
    let cm = |mm: f64| format!("{:.1} cm", mm / 10.0);
    let mut known: Vec<(&str, String, Option<Scale>)> = Vec::new();
    if let Some(mat) = &rig.mat {
        let text = format!(
            "{} tags of {:.1} mm on a ring of {:.1} mm",
            mat.count, mat.tag_mm, mat.ring_mm
        );
        known.push(("marker mat", text, Some(Scale::Mat)));
    }
    if let Some(reference) = &rig.reference {
        let kind = escaped(&reference.kind.replace('_', " "));
        let text = format!("{kind}, {:.1} mm", reference.length_mm);
        known.push(("reference", text, Some(Scale::Reference)));
    }
    if let Some(mm) = rig.disk_diameter_mm {
        known.push(("disk's diameter", cm(mm), Some(Scale::Disk)));
    }
    if let Some(mm) = rig.stature_mm {
        known.push(("stature", cm(mm), Some(Scale::Stature)));
    }
    if let Some(kg) = rig.weight_kg {
        known.push(("weight", format!("{kg:.1} kg"), None));
    }
    html += "<table id=\"scale\" class=\"facts\">";
    for (what, text, scale) in known {
        let role = match scale {
            Some(scale) if scale == cameras.scale => "<b>sets the scale</b>",
            Some(_) => "given, does not set the scale",
            None => "given, for the body mass index",
        };
        let _ = write!(
            html,
            "<tr><td>{what}</td><td>{text}</td><td class=\"note\">{role}</td></tr>"
        );
    }
    html + "</table>"
}
