//! What is said of girths: each kind of remark and each reason of a refusal once, for all girths that it concerns.

use crate::derive::no_density;
use shape::{Girth, Girths, NamedGirth, Note, Unit, by_reason, listed};

/// All warnings of a result.
pub(crate) fn warnings(girths: &Girths) -> Vec<String> {
    let mut told = refused(girths);
    let names = |of: &dyn Fn(&Girth) -> bool| -> Option<String> {
        let all = girths.girths.iter().filter(|g| of(g));
        let all: Vec<_> = all.map(|g| (Some(g.id), g.name.as_str())).collect();
        (!all.is_empty()).then(|| listed(&all))
    };
    let open = |g: &Girth| {
        let mm = |note: &Note| match note {
            Note::Open { share } => Some(share * g.tape_mm),
            _ => None,
        };
        g.notes.iter().find_map(mm)
    };
    let most = girths.girths.iter().filter_map(open).reduce(f64::max);
    if let Some((most, names)) = most.zip(names(&|g| open(g).is_some())) {
        let unit = match girths.unit {
            Unit::Metric => format!("{:.1} cm", most / 10.0),
            unit => unit.words(most),
        };
        told.push(format!(
            "{names}: no photo shows the outline along part of this section (hands in front, or too few photos): up to {unit} \
             may not be body; take more photos, or hold the hands farther away",
        ));
    }
    if let Some(names) = names(&|g| g.split.is_some()) {
        told.push(format!(
            "{names}: the arms touch the trunk and were separated by estimation: intervals are wider; hold the arms farther from the body"
        ));
    }
    if let Some(names) = names(&|g| g.interval_mm.is_none()) {
        told.push(format!(
            "{names}: no interval is given, for a part of it that matters is not known (the report says which)"
        ));
    }
    for girth in &girths.girths {
        let own = girth
            .notes
            .iter()
            .filter(|n| !matches!(n, Note::Open { .. }));
        let name = listed(&[(Some(girth.id), &girth.name)]);
        told.extend(own.map(|note| format!("{name}: {}", note.sentence())));
    }
    if girths.compression_pct > 0.0 {
        told.push(format!(
            "tapes and their intervals are shortened by {} %, as compression_pct declares",
            girths.compression_pct
        ));
    }
    told.extend(no_density(girths));
    told
}

/// What is not measured: a sentence a reason.
fn refused(girths: &Girths) -> Vec<String> {
    let reasons = by_reason(&girths.missing);
    let nothing = girths.girths.is_empty();
    if let ([(why, _)], true) = (reasons.as_slice(), nothing) {
        return vec![format!("nothing was measured: {why}")];
    }
    let line =
        |(why, all): (&str, Vec<NamedGirth<'_>>)| format!("{} not measured: {why}", listed(&all));
    reasons.into_iter().map(line).collect()
}
