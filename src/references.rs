//! What the numbers of a sweep are compared with on its plots: the truth, limits of a standard, what a survey allows.

use crate::repeat::allowed_mm;
use crate::score::{iso_mm, true_tapes};
use std::path::Path;
use tables::Reference;

/// Lines across the plots of a metric: of a girth its true tape, of its error nothing, the limit of ISO 20685-1 (9 or
/// 4 mm) and what ANSUR II allows two measurers; of other errors nothing.
pub(crate) fn references(metric: &str, unit: &str, truth: Option<&Path>) -> Vec<Reference> {
    let line = |label: &str, value: f64| Reference {
        label: label.to_owned(),
        value,
    };
    let own = |prefix: &str| metric.strip_prefix(prefix);
    if let (Some(girth), "mm tape") = (own("error."), unit) {
        let (limit, allowed) = (iso_mm(girth, None), allowed_mm(girth, None));
        let mut lines = vec![
            line("truth", 0.0),
            line("ISO 20685-1", limit),
            line("ISO 20685-1", -limit),
        ];
        if let Some(allowed) = allowed {
            lines.extend([line("ANSUR II", allowed), line("ANSUR II", -allowed)]);
        }
        return lines;
    }
    if let (Some(girth), Some(truth), "cm tape") = (own("girths."), truth, unit) {
        let tapes = true_tapes(truth).unwrap_or_default();
        let of = tapes.get(girth).map(|mm| {
            let limit = iso_mm(girth, None);
            [
                ("truth", 0.0),
                ("ISO 20685-1", limit),
                ("ISO 20685-1", -limit),
            ]
            .map(|(label, off)| line(label, (mm + off) / 10.0))
        });
        return of.map_or(vec![], |lines| lines.to_vec());
    }
    let signed =
        metric.starts_with("error.") || metric.ends_with(" error") || metric.ends_with(" outward");
    let mean = ["mean error", "worst error"]
        .iter()
        .any(|e| metric.ends_with(e));
    match signed && !mean {
        true => vec![line("truth", 0.0)],
        false => vec![],
    }
}
