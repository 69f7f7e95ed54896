//! Sentences of stages in the reader's language: those of `capture.look`, and the texts that take their place
//! in `words/`; those of warnings are in `warnings.rs`, of failures in `errors.rs`. A sentence that is not known stays as it is.

use super::errors::ERRORS;
use super::language::{Language, Words};
use super::warnings::WARNINGS;

/// Sentences, `*` for what is put in, and their texts, in which that is `a` and `b`.
#[rustfmt::skip]
const FINDINGS: [(&str, &str); 60] = [
    ("only * % of the picture stands still: the camera, or all behind the subject, moved between the photos", "find-moved"),
    ("a turn wants one camera on a tripod and the subject on a disk; is this a walk around somebody who stands still? Then say --walk", "find-moved-mend"),
    ("the subject, which all other photos show, is not seen here", "find-empty"),
    ("if this is the empty scene, say plate = * in capture.toml, or --plate *; else leave it out, or take it again", "find-empty-plate"),
    ("leave it out, or take it again", "find-empty-mend"),
    ("photos are more like others far away in order than like their neighbours: they are not in turning order", "find-shuffled"),
    ("name photos in turning order, or list them with `images = [...]`; `tailor run pipelines/any-order.toml` finds cameras without an order", "find-shuffled-mend"),
    ("far more like one far away in order than like its neighbours", "find-stranger"),
    ("look whether these photos are in their place", "find-stranger-mend"),
    ("nothing turned between these photos and the next", "find-same"),
    ("leave one of each two out", "find-same-mend"),
    ("the next photo differs by far more than others do", "find-gap"),
    ("look whether a photo is missing there", "find-gap-mend"),
    ("blurred beside the others", "find-blurred"),
    ("take them again, or leave them out", "find-blurred-mend"),
    ("overexposed over a tenth of the picture or more", "find-burnt"),
    ("black over a tenth of the picture or more", "find-black"),
    ("take them again with the exposure held", "find-lost-mend"),
    ("exposed from * to * EV against the middle", "find-uneven"),
    ("hold exposure and white balance (on phones: press and hold until AE/AF lock shows)", "find-uneven-mend"),
    ("the photos have noise of * grey levels", "find-noise"),
    ("masks may lose parts where clothes have the background's colour: take them in more light, at a lower ISO, or in clothes that differ more from the background", "find-noise-mend"),
    ("photos of *×* pixels are small", "find-pixels"),
    ("hand over the camera's own files", "find-pixels-mend"),
    ("what moves reaches the upper border: the head may be cut off", "find-head"),
    ("leave room above the head", "find-head-mend"),
    ("what moves reaches both sides: arms may be cut off, or people walk behind the subject", "find-arms"),
    ("step back, and keep the background still", "find-arms-mend"),
    ("a mat is told of, but no tag of it was found", "find-mat"),
    ("is it in view, in good light, and flat?", "find-mat-mend"),
    ("of the mat's * tags only * can be read on a photo", "find-tags"),
    ("they are too small in the picture, blurred or hidden: hand over the camera's own files, come nearer, or print a mat with fewer, larger tags", "find-tags-mend"),
    ("the body is cut off at the lower edge", "find-feet"),
    ("keep the whole person in view, with a margin below the feet: without feet nothing tells heights, and no girth is given", "find-feet-mend"),
    ("* photos are few: without a mat features are followed over steps of 30° at most", "find-few"),
    ("take 18 to 36 photos of a full turn, or lay a mat on the disk", "find-few-mend"),
    ("nothing tells of the focal length", "find-focal"),
    ("keep EXIF in the photos, or say --focal", "find-focal-mend"),
    ("nothing of known length is given: lengths will be relative", "find-length"),
    ("say --stature, or --disk-diameter, or lay a mat on the disk", "find-length-mend"),
    ("there is no photo of the empty scene", "find-plate"),
    ("take one without the subject and call it plate.jpg: silhouettes become surer", "find-plate-mend"),
    ("no, as it is: see above", "find-can-stopped"),
    ("from the mat, photo by photo", "find-can-mat"),
    ("from what turns with the subject: clothes with a pattern, a patterned cloth on the disk", "find-can-features"),
    ("not as a turn", "find-can-walked"),
    ("in centimetres, from *", "find-can-cm"),
    ("relative: ratios hold, no centimetres", "find-can-relative"),
    ("no", "find-can-no"),
    ("yes, with ratios and the body mass index", "find-can-bmi"),
    ("yes, with ratios; the body mass index wants --weight and --stature", "find-can-ratios"),
    ("the marker mat", "find-from-mat"),
    ("the reference length", "find-from-reference"),
    ("the disk's diameter, if its edge is seen", "find-from-disk"),
    ("the stature", "find-from-stature"),
    ("WHO 2008: raised risk from 0.90 (men); no diagnosis", "note-who-men"),
    ("WHO 2008: raised risk from 0.85 (women); no diagnosis", "note-who-women"),
    ("WHO 2008: raised risk from 0.90 (men), 0.85 (women); no diagnosis", "note-who"),
    ("waist to height: NICE 2022 names 0.5 as a boundary to keep below; no diagnosis", "note-nice"),
    ("experimental; includes air in the lungs; 1 % error in volume means 1 % error in density", "note-density"),
];

/// Girths and lengths as they are listed in sentences, and their texts.
#[rustfmt::skip]
const LISTED: [(&str, &str); 25] = [
    ("hip", "girth-HC"), ("greatest hip", "girth-HC-max"),
    ("waist", "girth-WC"), ("natural waist", "girth-WC-natural"), ("narrowest waist", "girth-WC-narrowest"),
    ("waist at the navel", "girth-WC-navel"), ("waist at the hip bone", "girth-WC-hip-bone"),
    ("chest", "girth-CC"), ("neck", "girth-NC"),
    ("upper arms", "girth-arms"), ("left upper arm", "girth-AC-L"), ("right upper arm", "girth-AC-R"),
    ("thighs", "girth-thighs"), ("left thigh", "girth-TC-L"), ("right thigh", "girth-TC-R"),
    ("calves", "girth-calves"), ("left calf", "girth-CFC-L"), ("right calf", "girth-CFC-R"),
    ("stature", "girth-stature"),
    ("the mat", "find-from-mat"), ("the marker tags", "find-from-tags"), ("the unit of the surface", "find-from-surface"), ("the reference length", "find-from-reference"),
    ("the disk's diameter", "find-from-disk-alone"), ("the stature", "find-from-stature"),
];

/// A list of girths or lengths in the reader's language; what is not known stays.
pub(crate) fn listed(words: Words, text: &str) -> String {
    if words.language == Language::En {
        return text.to_owned();
    }
    let one = |part: &str| {
        let known = LISTED.iter().find(|(name, _)| *name == part);
        known.map_or_else(|| part.to_owned(), |(_, key)| words.text(key))
    };
    text.split(", ").map(one).collect::<Vec<_>>().join(", ")
}

/// What a text has where a pattern has `*`, if it fits.
fn put_in<'a>(pattern: &str, text: &'a str) -> Option<Vec<&'a str>> {
    let mut parts = pattern.split('*');
    let mut rest = text.strip_prefix(parts.next()?)?;
    let mut found = Vec::new();
    for part in parts {
        let at = if part.is_empty() {
            rest.len()
        } else {
            rest.find(part)?
        };
        found.push(&rest[..at]);
        rest = &rest[at + part.len()..];
    }
    rest.is_empty().then_some(found)
}

/// What comes as a warning, and is none: nothing is wrong, and nothing has to be done.
const NEWS: [&str; 2] = ["warn-mat-known", "warn-shortened"];

/// Whether a warning only names what was found.
pub(crate) fn is_news(text: &str) -> bool {
    let fits = |(pattern, _): &&(&str, &str)| put_in(pattern, text).is_some();
    let known = WARNINGS.iter().find(fits);
    known.is_some_and(|(_, key)| NEWS.contains(key))
}

/// A sentence of a stage in the reader's language; none if it is not known. What it is about may be
/// before it (`NC: `).
pub(crate) fn translated(words: Words, text: &str) -> Option<String> {
    let all = FINDINGS.iter().chain(&WARNINGS).chain(&ERRORS);
    let fits = |(pattern, key): &(&str, &'static str)| Some((*key, put_in(pattern, text)?));
    let Some((key, found)) = all.clone().find_map(fits) else {
        // What is odd, and what mends it.
        let parts = text.split_once("; ");
        let parts =
            parts.and_then(|(odd, mend)| Some((translated(words, odd)?, translated(words, mend)?)));
        if let Some((odd, mend)) = parts {
            return Some(format!("{odd}; {mend}"));
        }
        let (about, rest) = text.split_once(": ")?;
        let rest = translated(words, rest)?;
        return Some(format!("{}: {rest}", listed(words, about)));
    };
    // A number as it is written there, with its unit; or something that is translated itself: where centimetres come from.
    let shown = |inner: &&str| {
        let (lead, inner) = inner.split_at(inner.len() - inner.trim_start().len());
        let number = inner.split(' ').next().unwrap_or_default();
        let shown = match number.parse::<f64>() {
            Ok(_) => words.written(number) + &inner[number.len()..],
            Err(_) => translated(words, inner).unwrap_or_else(|| listed(words, inner)),
        };
        lead.to_owned() + &shown
    };
    let shown: Vec<String> = found.iter().map(shown).collect();
    let put: Vec<_> = ["a", "b", "c", "d", "e", "f", "g", "h"]
        .into_iter()
        .zip(shown.iter().map(|s| s.as_str().into()))
        .collect();
    Some(words.with(key, &put))
}

#[cfg(test)]
mod tests {
    use super::super::language::Language;
    use super::*;

    /// The sentences of a file of the crate: long literals, with `*` where something is put in.
    fn sentences(file: &str) -> Vec<String> {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(root.join("stages/capture/src").join(file)).unwrap();
        let code: Vec<&str> = text
            .lines()
            .filter(|l| !l.trim_start().starts_with("//"))
            .collect();
        let code = code.join("\n");
        let literals = code
            .split('"')
            .skip(1)
            .step_by(2)
            .filter(|l| l.contains(' '));
        let stars = |literal: &str| {
            let mut parts = literal.split('{');
            let first = parts.next().unwrap().to_owned();
            parts.fold(first, |all, part| {
                all + "*" + part.split_once('}').unwrap().1
            })
        };
        literals.map(stars).collect()
    }

    #[test]
    fn every_sentence_of_the_crate_is_known() {
        let all = ["odd.rs", "noise.rs", "verdict.rs", "empty.rs"]
            .map(sentences)
            .concat();
        assert!(all.len() > 40, "{all:?}");
        // What only joins names and sentences has no words, but for the count of photos.
        let is_sentence =
            |s: &&String| s.contains(char::is_alphabetic) && !s.ends_with("photos): ");
        for sentence in all.iter().filter(is_sentence) {
            let known = FINDINGS.iter().any(|(pattern, _)| pattern == sentence);
            assert!(known, "findings.rs does not know: {sentence}");
        }
    }

    #[test]
    fn a_sentence_is_translated_with_what_is_put_in() {
        let de = Words {
            language: Language::De,
            inches: false,
        };
        let german = |text: &str| translated(de, text);
        let uneven = german("exposed from -0.31 to +0.50 EV against the middle").unwrap();
        assert_eq!(
            uneven,
            "von -0,31 bis +0,50 EV gegen die mittlere belichtet"
        );
        assert_eq!(
            german("in centimetres, from the stature").unwrap(),
            "in Zentimetern, aus: Körpergröße"
        );
        assert_eq!(german("no").unwrap(), "nein");
        let empty = "0018.jpg: the subject, which all other photos show, is not seen here; if this is the empty scene, say \
                     plate = \"0018.jpg\" in capture.toml, or --plate 0018.jpg; else leave it out, or take it again";
        let de = german(empty).unwrap();
        assert!(
            de.starts_with("0018.jpg: die Person")
                && de.contains("leere Szene")
                && !de.contains("--"),
            "{de}"
        );
        assert_eq!(german("no such sentence"), None);
    }
}
