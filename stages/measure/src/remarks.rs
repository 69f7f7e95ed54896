//! What is remarked of girths: each kind of remark and each reason of a refusal once, for all girths that it concerns.

use crate::derive::no_density;
use shape::{Girth, Girths, NamedGirth, Note, Region, Unit, by_reason, girth_names};
use stage::{Field, Message, message};

stage::messages! {
    OPEN = "warn-open": "no photo shows the outline along part of this section (hands in front, or too few photos): up to {length} may not be body; take more photos, or hold the hands farther away";
    SPLIT = "warn-split": "the arms touch the trunk and were separated by estimation: intervals are wider; hold the arms farther from the body";
    THIGHS_SPLIT = "warn-thighs-split": "the thighs touch and were parted by estimation between the folds before and behind them: intervals are wider; place the feet farther apart";
    NO_INTERVAL = "warn-no-interval": "no interval is given, for a part of it that matters is not known (the report names it)";
    SHORTENED = "warn-shortened": "tapes and their intervals are shortened by {by} %, as given by compression_pct";
    NOTHING = "warn-nothing": "nothing was measured: {why}";
    NOT_MEASURED = "warn-not-measured": "{girths} not measured: {why}";
}

/// All warnings of a result.
pub(crate) fn warnings(girths: &Girths) -> Vec<Message> {
    let mut warnings = refused(girths);
    let names = |of: &dyn Fn(&Girth) -> bool| -> Option<Field> {
        let all = girths.girths.iter().filter(|g| of(g));
        let all: Vec<_> = all.map(|g| (Some(g.id), g.name.as_str())).collect();
        (!all.is_empty()).then(|| girth_names(&all))
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
        let length = match girths.unit {
            Unit::Metric => Field::number(most / 10.0, 1, "cm"),
            unit => unit.field(most),
        };
        warnings.push(message!(OPEN, length = length).of_what(names));
    }
    let split = |thigh: bool| names(&|g| g.split.is_some() && (g.region == Region::Thigh) == thigh);
    let arms = split(false).map(|names| message!(SPLIT).of_what(names));
    let thighs = split(true).map(|names| message!(THIGHS_SPLIT).of_what(names));
    warnings.extend(arms.into_iter().chain(thighs));
    if let Some(names) = names(&|g| g.interval_mm.is_none()) {
        warnings.push(message!(NO_INTERVAL).of_what(names));
    }
    for girth in &girths.girths {
        // The spline is in the files and the report alone, and so is what is odd about it.
        let own = girth
            .notes
            .iter()
            .filter(|n| !matches!(n, Note::Open { .. } | Note::SplineLeft { .. }));
        let name = girth_names(&[(Some(girth.id), &girth.name)]);
        warnings.extend(own.map(|note| note.message().of_what(name.clone())));
    }
    if girths.compression_pct > 0.0 {
        warnings.push(message!(SHORTENED, by = girths.compression_pct));
    }
    warnings.extend(no_density(girths));
    warnings
}

/// What is not measured: a message a reason.
fn refused(girths: &Girths) -> Vec<Message> {
    let reasons = by_reason(&girths.missing);
    let nothing = girths.girths.is_empty();
    if let ([(why, _)], true) = (reasons.as_slice(), nothing) {
        return vec![message!(NOTHING, why = *why)];
    }
    let line = |(why, all): (&Message, Vec<NamedGirth<'_>>)| {
        message!(NOT_MEASURED, girths = girth_names(&all), why = why)
    };
    reasons.into_iter().map(line).collect()
}
