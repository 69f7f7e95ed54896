//! One result as text.

use crate::reader::{Reader, number, signed, words};
use crate::score::Score;
use stage::{Message, message};
use std::fmt::Write;

stage::messages! {
    ALL = "score-all": "all";
    AT_PLANE = "score-at-plane": "tape at the measured plane   truth there cm  tape cm  surface %  surface mm";
    CAMERAS = "score-cameras": "cameras   {found} of {of}; scale {scale} %; centres {median} mm median, {worst} mm worst; rotation {rotation} °; focal {focal} %";
    FAIL = "score-fail": "FAIL (±{mm} mm)";
    GIRTHS = "score-girths": "girth      truth cm      cm   error %   tape %  tape mm = surface + level  ISO 20685-1";
    MASKS = "score-masks": "masks     {count} compared; intersection over union {mean} mean, {worst} worst";
    NOTHING = "score-nothing": "nothing to compare: neither cameras, masks, a surface nor girths are on both sides";
    NOT_MEASURED = "score-not-measured": "not measured";
    NO_SECTION = "score-no-section": "the true surface has no such section there: limb and trunk are one, or the plane misses it";
    OPEN = "score-open": "surface   {faces} faces, NOT closed";
    OUTSIDE = "score-outside": "outside its interval";
    PART = "score-part": "{mean} mm mean, 90 % within {within} mm, bias {bias} mm; complete {at_2} % at 2 mm, {at_5} % at 5 mm";
    PASS = "score-pass": "pass (±{mm} mm)";
    SURFACE = "score-surface": "surface   {faces} faces, closed";
    TRUNK = "score-trunk": "trunk";
}

/// A line of its own.
pub(super) fn line(reader: &dyn Reader, message: &Message) -> String {
    reader.message(message) + "\n"
}

/// One result, in plain lines.
pub fn text(score: &Score, reader: &dyn Reader) -> String {
    let plus = |value: Option<f64>, digits| signed(reader, value, digits);
    let plain = |value: f64, digits| number(reader, Some(value), digits);
    let mut text = String::new();
    if let Some(c) = &score.cameras {
        let cameras = message!(
            CAMERAS,
            found = c.registered,
            of = c.of,
            scale = plus(c.scale_error_pct, 3),
            median = plus(c.centre_mm_median, 2),
            worst = plus(c.centre_mm_max, 2),
            rotation = plus(c.rotation_deg_median, 3),
            focal = plus(c.focal_error_pct, 3)
        );
        text += &line(reader, &cameras);
    }
    if let Some(m) = &score.masks {
        let (mean, worst) = (plain(m.iou_mean, 4), plain(m.iou_min, 4));
        let masks = message!(MASKS, count = m.count, mean = mean, worst = worst);
        text += &line(reader, &masks);
    }
    if let Some(m) = &score.mesh {
        let surface = match m.closed {
            true => message!(SURFACE, faces = m.faces),
            false => message!(OPEN, faces = m.faces),
        };
        text += &line(reader, &surface);
        let [all, trunk] = words(reader, [ALL, TRUNK]);
        for (name, p) in [(all, Some(&m.all)), (trunk, m.trunk.as_ref())] {
            let Some(p) = p else { continue };
            let part = message!(
                PART,
                mean = plain(p.accuracy_mean_mm, 2),
                within = plain(p.accuracy_90_mm, 2),
                bias = plus(Some(p.bias_mm), 2),
                at_2 = plain(p.complete_2mm * 100.0, 1),
                at_5 = plain(p.complete_5mm * 100.0, 1)
            );
            text += &format!("  {name:<7} {}", line(reader, &part));
        }
    }
    text += &girths(score, reader);
    text += &at_planes(score, reader);
    if text.is_empty() {
        text = line(reader, &message!(NOTHING));
    }
    text
}

/// The girths beside their truth.
fn girths(score: &Score, reader: &dyn Reader) -> String {
    if score.girths.is_empty() {
        return String::new();
    }
    let mut text = line(reader, &message!(GIRTHS));
    for (name, girth) in &score.girths {
        let Some(g) = girth else {
            text += &format!("{name:<8}  {}", line(reader, &message!(NOT_MEASURED)));
            continue;
        };
        let iso = match g.within_iso() {
            Some(true) => reader.message(&message!(PASS, mm = g.iso_mm)),
            Some(false) => reader.message(&message!(FAIL, mm = g.iso_mm)),
            None => "–".into(),
        };
        let outside = match g.interval_holds {
            Some(false) => format!("  {}", reader.message(&message!(OUTSIDE))),
            _ => String::new(),
        };
        let plus = |value: Option<f64>, digits| signed(reader, value, digits);
        let _ = writeln!(
            text,
            "{name:<8} {:>10} {:>7} {:>9} {:>8} {:>8} {:>9} {:>7}  {iso}{outside}",
            number(reader, Some(g.truth_cm), 2),
            number(reader, g.cm, 2),
            plus(g.error_pct, 2),
            plus(g.tape_error_pct, 2),
            plus(g.tape_error_mm, 1),
            plus(g.surface_mm, 1),
            plus(g.level_mm, 1),
        );
    }
    text
}

/// Tapes against the true surface at the planes that were measured: what the surface errs.
fn at_planes(score: &Score, reader: &dyn Reader) -> String {
    let mut text = String::new();
    if !score.girths_at_measured_planes.is_empty() {
        text = line(reader, &message!(AT_PLANE));
    }
    for (name, plane) in &score.girths_at_measured_planes {
        let plain = |value: f64| number(reader, Some(value), 2);
        let _ = match plane {
            Some(t) => writeln!(
                text,
                "{name:<24} {:>14} {:>8} {:>10} {:>11}",
                plain(t.truth_there_cm),
                plain(t.tape_cm),
                signed(reader, Some(t.tape_pct), 2),
                signed(reader, Some(t.tape_mm), 1)
            ),
            None => writeln!(text, "{name:<24} {}", reader.message(&message!(NO_SECTION))),
        };
    }
    text
}
