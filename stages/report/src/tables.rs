//! The tables of the page: girths with intervals, what is missing, ratios, scale.

use shape::{Cameras, Girths, Scale};
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
        "<table id=\"girths\"><thead><tr><th>girth</th><th>tape [cm]</th><th>interval</th>\
         <th>contour</th><th>spline</th><th>silhouette</th></tr></thead><tbody>",
    );
    for g in &girths.girths {
        let silhouette = g
            .silhouette_mm
            .map_or("–".into(), |mm| format!("{:.1}", mm / 10.0));
        let _ = write!(
            html,
            "<tr data-name=\"{name}\" title=\"{definition}\"><td><b>{name}</b> {label}</td>\
             <td class=\"n big\">{:.1}</td><td class=\"n\">{:.1} – {:.1}</td><td class=\"n\">{:.1}</td>\
             <td class=\"n\">{:.1}</td><td class=\"n\">{silhouette}</td></tr>",
            g.tape_mm / 10.0,
            g.interval_mm[0] / 10.0,
            g.interval_mm[1] / 10.0,
            g.contour_mm / 10.0,
            g.spline_mm / 10.0,
            name = escaped(&g.name),
            label = escaped(&g.label),
            definition = escaped(&g.definition),
        );
    }
    html += "</tbody></table>";
    if !girths.missing.is_empty() {
        html += "<ul class=\"missing\">";
        for m in &girths.missing {
            let _ = write!(
                html,
                "<li><b>{}</b>: {}</li>",
                escaped(&m.name),
                escaped(&m.why)
            );
        }
        html += "</ul>";
    }
    html
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
    format!("<table>{rows}</table><p class=\"note\">Numbers, no diagnosis.</p>")
}

/// Where the millimetres come from, and how sure the cameras are.
pub(crate) fn scale(cameras: &Cameras) -> String {
    let from = match cameras.scale {
        Scale::Mat => "the marker mat on the disk",
        Scale::Reference => "the reference length that was given",
        Scale::Disk => "the disk's diameter",
        Scale::Stature => "the subject's stature",
        Scale::Given => "cameras that came from elsewhere, taken at their word",
        Scale::Nothing => {
            "nothing: the camera ring's radius is called 1000 mm, so lengths are relative"
        }
    };
    let count = cameras.views.len().max(1) as f64;
    let mean = |f: fn(&shape::View) -> f64| cameras.views.values().map(f).sum::<f64>() / count;
    // A ring that a swaying subject leaves undetermined has variances beyond any use.
    let centres = match mean(|v| v.sigma_mm) {
        mm if mm.is_finite() && mm < 100.0 => format!("camera centres ± {mm:.1} mm"),
        _ => "how sure the camera centres are cannot be told".into(),
    };
    format!(
        "<p>Lengths come from {from} (± {:.2} %). {} cameras; mean reprojection error {:.2} px; {centres}.</p>",
        cameras.scale_sigma * 100.0,
        cameras.views.len(),
        mean(|v| v.rms_px),
    )
}
