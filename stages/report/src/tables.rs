//! The tables of the page: girths with intervals, what is missing, scale.

use crate::lengths::Lengths;
use shape::{Cameras, Girth, Girths, NamedGirth, Rig, Scale, Unit, by_reason, listed};
use stage::Message;
use std::fmt::Write;

/// Text that may be in HTML.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('{', "&#123;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// The line below the table: what all its lengths are.
pub(crate) fn unit(girths: &Girths, lengths: Lengths) -> String {
    let unit = match lengths {
        Lengths::Cm => "All in centimetres.",
        Lengths::Inch => "All in inches; files beside this page are in centimetres.",
        Lengths::Relative => "All relative: 1 is the radius of the camera ring.",
    };
    match girths.compression_pct {
        percent if percent > 0.0 => format!(
            "{unit} Tapes and their intervals are shortened by {percent} %, as was declared."
        ),
        _ => unit.into(),
    }
}

/// What an interval is made of, as a sentence: standard deviations, and what is not known.
pub(crate) fn sureness(g: &Girth, lengths: Lengths) -> String {
    let part = |(name, mm): (&str, Option<f64>)| match mm {
        Some(mm) => format!("{name} {}", lengths.fine(mm)),
        None => format!("{name} unknown"),
    };
    let parts = g.sigmas.named().map(part).join(", ");
    let again = match g.repeat_mm {
        Some(mm) => format!("measured again within ± {} (90 %)", lengths.fine(mm)),
        None => "how near it comes when measured again is unknown".into(),
    };
    let mut text = format!("standard deviations [{}]: {parts}; {again}", lengths.word());
    for remark in g.remarks() {
        let _ = write!(text, "; {remark}");
    }
    text
}

/// The girths, one a row. What an interval is made of shows on hover, and when a row is reached by
/// keyboard or finger.
pub(crate) fn girths(girths: &Girths, lengths: Lengths) -> String {
    let mut html = format!(
        "<table id=\"girths\" data-head=\"tape [{0}], interval below it\"><thead><tr><th>girth</th><th class=\"n\">tape [{0}]</th>\
         <th class=\"n\">interval</th><th class=\"n\">contour</th><th class=\"n\">spline</th><th class=\"n\">silhouette</th></tr></thead><tbody>",
        lengths.word()
    );
    let cm = |mm: f64| lengths.text(mm);
    for g in &girths.girths {
        let interval = match g.interval_mm {
            Some([low, high]) => format!("{} – {}", cm(low), cm(high)),
            None => format!("unknown: {}", g.sigmas.unknown().join(", ")),
        };
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
            "<tr data-name=\"{name}\" title=\"{definition}\" data-sure=\"{sure}\" aria-describedby=\"sure\" tabindex=\"0\"><td><b>{name}</b> {label} \
             <span class=\"note\">{iso}</span></td><td class=\"n big\">{}</td><td class=\"n range\" title=\"{sure}\">{interval}</td>{cells}</tr>",
            cm(g.tape_mm),
            sure = escaped(&sureness(g, lengths)),
            name = escaped(&g.name),
            label = escaped(&g.label),
            iso = escaped(&g.by.definition().standards()),
            definition = escaped(&g.definition),
        );
    }
    html += "</tbody></table><p id=\"sure\" class=\"note\" aria-live=\"polite\"></p>";
    html + &missing(girths)
}

/// Kilograms; pounds beside them where lengths are in inches.
pub(crate) fn weight(kg: f64, lengths: Lengths) -> String {
    match lengths {
        Lengths::Inch => format!("{kg:.1} kg ({:.1} lb)", kg / 0.453_592_37),
        _ => format!("{kg:.1} kg"),
    }
}

/// What is not measured, and why; the same reason once, with the short names that commands take.
fn missing(girths: &Girths) -> String {
    let reasons = by_reason(&girths.missing);
    let line = |(why, all): &(&Message, Vec<NamedGirth<'_>>)| {
        let names = all.iter().map(|(_, name)| *name).collect::<Vec<_>>();
        let (listed, names) = (listed(all), names.join(", "));
        let names = match names == listed {
            true => String::new(),
            false => format!(" ({})", escaped(&names)),
        };
        format!(
            "<li><b>{}</b>{names}: {}</li>",
            escaped(&listed),
            escaped(why)
        )
    };
    let lines: String = reasons.iter().map(line).collect();
    match lines.is_empty() {
        true => lines,
        false => format!("<ul class=\"missing\">{lines}</ul>"),
    }
}

/// Where the lengths come from, as a sentence.
pub(crate) fn origin(scale: Scale) -> &'static str {
    match scale {
        Scale::Mat => "lengths come from the marker mat on the disk",
        Scale::Tags => "lengths come from marker tags of known size",
        Scale::Reference => "lengths come from the reference length that was given",
        Scale::Disk => "lengths come from the disk's diameter",
        Scale::Stature => "lengths come from the subject's stature",
        Scale::Given => "lengths come from the cameras that were given, taken at their word",
        Scale::Nothing => "lengths are relative: 1 is the camera ring's radius",
        Scale::Disputed(_) => {
            "lengths are relative, for known lengths contradict each other: 1 is the camera ring's radius"
        }
    }
}

/// Where the millimetres come from, what else was known, and how sure the cameras are.
pub(crate) fn scale(cameras: &Cameras, rig: &Rig, lengths: Lengths) -> String {
    let mean = |f: fn(&shape::View) -> Option<f64>| {
        let known: Vec<f64> = cameras.views.values().filter_map(f).collect();
        (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
    };
    // Unknown of cameras that were given, and of those of a subject that sways.
    let centres = match mean(|v| v.sigma_mm) {
        Some(mm) if mm < 100.0 => match cameras.scale.unit() {
            Unit::Metric => format!("camera centres ± {mm:.1} mm"),
            unit => format!("camera centres ± {}", unit.words(mm)),
        },
        _ => "how sure the camera centres are: unknown".into(),
    };
    let pixels = match mean(|v| v.rms_px) {
        Some(px) => format!("mean reprojection error {px:.2} px"),
        None => "reprojection error unknown".into(),
    };
    let sure = match cameras.scale_sigma {
        Some(sigma) => format!(", ± {:.2} %", 100.0 * sigma),
        None if cameras.scale == Scale::Nothing => String::new(),
        None => "; how sure they are: unknown".into(),
    };
    let mut html = format!(
        "<p>The {}{sure}. {} cameras; {pixels}; {centres}.</p>",
        origin(cameras.scale),
        cameras.views.len(),
    );
    // What the user gave is known, whatever the scale.
    let known_in = match lengths {
        Lengths::Relative => Lengths::Cm,
        known => known,
    };
    let cm = |mm: f64| format!("{} {}", known_in.text(mm), known_in.word());
    let mut known: Vec<(&str, String, Scale)> = Vec::new();
    if let Some(mm) = rig.tag_mm {
        let text = format!("tags of {mm:.1} mm, their layout as photos show it");
        known.push(("marker mat", text, Scale::Mat));
    }
    if let Some(mat) = &rig.mat {
        let text = format!(
            "{} tags of {:.1} mm on a ring of {:.1} mm",
            mat.count, mat.tag_mm, mat.ring_mm
        );
        known.push(("marker mat", text, Scale::Mat));
    }
    if let Some(reference) = &rig.reference {
        let kind = escaped(&reference.kind.replace('_', " "));
        let text = format!("{kind}, {:.1} mm", reference.length_mm);
        known.push(("reference", text, Scale::Reference));
    }
    if let Some(mm) = rig.disk_diameter_mm {
        known.push(("disk's diameter", cm(mm), Scale::Disk));
    }
    if let Some(mm) = rig.stature_mm {
        known.push(("stature", cm(mm), Scale::Stature));
    }
    html += "<table id=\"scale\" class=\"facts\">";
    for (what, text, scale) in known {
        let role = match scale == cameras.scale {
            true => "<b>sets the scale</b>",
            false => "given, does not set the scale",
        };
        let _ = write!(
            html,
            "<tr><td>{what}</td><td>{text}</td><td class=\"note\">{role}</td></tr>"
        );
    }
    html + "</table>"
}
