//! What is remarked of girths: each kind of remark and each reason of a refusal once, for all girths that it concerns.

use crate::derive::no_density;
use crate::uncertainty::reported::Seen;
use shape::{
    Girth, Girths, Landmark, NamedGirth, Note, PhotoId, Photos, Region, Unit, by_reason,
    girth_names, some_photos,
};
use stage::{Field, Message, message};
use std::collections::BTreeSet;

stage::messages! {
    COVERED = "warn-covered": "the section crosses a hole of the scan that is closed by a flat cover: the interval is wider by what the skin may bulge there";
    COLORS_ALIKE = "warn-colors-alike": "what is worn and what is behind look alike along the outline there on {names}: intervals are wider by what masks may leave out or keep; wear another colour";
    OPEN = "warn-open": "no photo shows the outline along part of this section (hands in front, or too few photos): up to {length} may not be body; take more photos, or hold the hands farther away";
    SPLIT = "warn-split": "the arms touch the trunk and were separated by estimation: intervals are wider; hold the arms farther from the body";
    THIGHS_SPLIT = "warn-thighs-split": "the thighs touch and were parted by estimation between the folds before and behind them: intervals are wider; place the feet farther apart";
    NO_INTERVAL = "warn-no-interval": "no interval is given, for a part of it that matters is not known (the report names it)";
    SHORTENED = "warn-shortened": "tapes and their intervals are shortened by {by} %, as given by compression_pct";
    NOTHING = "warn-nothing": "nothing was measured: {why}";
    NOT_MEASURED = "warn-not-measured": "{girths} not measured: {why}";
}

/// What a girth is shown to; what is shorter is not remarked (structural). \[mm\]
const SHOWN_MM: f64 = 1.0;

/// What scan and photos leave unsure of sections, with the girths that it concerns.
#[derive(Default)]
pub(crate) struct Unsure<'a> {
    covered: Vec<NamedGirth<'a>>,
    alike: Vec<NamedGirth<'a>>,
    photos: BTreeSet<PhotoId>,
}

impl<'a> Unsure<'a> {
    /// Notes a section that crosses a hole that was closed, or of which photos do not show the outlines, where that shows in
    /// its interval.
    pub(crate) fn note(
        &mut self,
        landmark: &'a Landmark,
        (seen, tape_mm, girth): (&Seen, f64, Option<&Girth>),
    ) {
        let name = (Some(landmark.id), landmark.name.as_str());
        if seen.covered_mm > SHOWN_MM {
            self.covered.push(name);
        }
        if seen.unseen.shows(tape_mm, girth.map(|g| &g.sigmas)) {
            self.alike.push(name);
            self.photos.extend(&seen.unseen.photos);
        }
    }

    /// A warning of each kind.
    fn warnings(&self, photos: Option<&Photos>) -> Vec<Message> {
        let of = self.photos.iter().filter_map(|id| photos?.get(*id));
        let names: Vec<String> = of.map(|photo| photo.name.clone()).collect();
        let covered = (!self.covered.is_empty()).then(|| message!(COVERED));
        let alike = some_photos(&names).map(|names| message!(COLORS_ALIKE, names = names));
        let covered = covered.map(|w| w.of_what(girth_names(&self.covered)));
        let alike = alike.map(|w| w.of_what(girth_names(&self.alike)));
        covered.into_iter().chain(alike).collect()
    }
}

/// All warnings of a result.
pub(crate) fn warnings(
    girths: &Girths,
    unsure: &Unsure<'_>,
    photos: Option<&Photos>,
) -> Vec<Message> {
    let mut warnings = unsure.warnings(photos);
    warnings.extend(refused(girths));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::uncertainty::edges::Unseen;
    use shape::{GirthId, Part, Photo, Plane, Side, Split};

    #[test]
    fn what_photos_do_not_show_is_one_warning_of_all_girths_and_photos_that_it_concerns() {
        let level = Plane {
            point_mm: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
        };
        let seen = |photos: &[u32], tape_mm: f64| Seen {
            outline: None,
            open_mm: None,
            left_out_mm: 0.0,
            unseen: Unseen {
                tape_mm,
                photos: photos.iter().copied().map(PhotoId).collect(),
            },
            covered_mm: 0.0,
            worn_mm: 0.0,
        };
        let ids = [GirthId::Hip, GirthId::Waist, GirthId::Chest];
        let landmarks = ids.map(|id| Landmark::new(id, level, Part::Trunk));
        let mut unsure = Unsure::default();
        unsure.note(&landmarks[0], (&seen(&[2, 0], 40.0), 1000.0, None));
        unsure.note(&landmarks[1], (&seen(&[1], 5.0), 1000.0, None));
        unsure.note(&landmarks[2], (&seen(&[2, 3], 40.0), 1000.0, None));
        let photo = |k: u32| Photo::of(format!("{k}.jpg"), [1, 1], vec![]);
        let photos = Photos {
            photos: (0..5).map(photo).collect(),
            ..Photos::default()
        };
        let [warning] = &unsure.warnings(Some(&photos))[..] else {
            panic!("one warning");
        };
        let text = warning.to_string();
        assert!(text.starts_with("hip, chest: what is worn"), "{text}");
        assert!(text.contains("there on 0.jpg, 2.jpg, 3.jpg: "), "{text}");
        assert!(unsure.warnings(None).is_empty());
    }
    #[test]
    fn thighs_that_touch_each_other_are_remarked_as_such() {
        let level = Plane {
            point_mm: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
        };
        let remark = |id: GirthId, part: Part| {
            let mut girth = Girth::at(&Landmark::new(id, level, part), 500.0);
            girth.split = Some(Split { share: 0.25 });
            girth.remarks().remove(0)
        };
        let thigh = remark(GirthId::Thigh(Side::Left), Part::LegLeft);
        assert!(thigh.starts_with("the thighs touch"), "{thigh}");
        let chest = remark(GirthId::Chest, Part::Trunk);
        assert!(chest.starts_with("the arm touches the trunk"), "{chest}");
    }
}
