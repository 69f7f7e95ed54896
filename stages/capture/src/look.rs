//! The stage that looks at a capture before minutes are spent on it.

use crate::cut_off::cut_off;
use crate::error::CaptureError;
use crate::glance::{Glance, glance, together};
use crate::noise::{noisy, of_photos};
use crate::odd::{seen_in_facts, seen_in_pictures};
use crate::ordered::in_order;
use crate::sharpness::{Sharpness, against_the_middle, sharpness};
use crate::verdict::{Seen, camera_is_fixed, can, lengths};
use rayon::prelude::*;
use serde_json::{Map, Value, json};
use shape::{Document, People, Person, Photo, Photos, Tags};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// Nothing is to be tuned.
    pub struct LookParams {}
}

stage::inputs! {
    /// What was handed over.
    pub struct LookInput {
        /// The photos.
        photos: Arc<Photos>,
        /// Tags of some of them.
        tags: Option<Arc<Tags>>,
        /// Who is on them.
        people: Option<Arc<People>>,
        /// Who is measured: whether a weight is known.
        person: Option<Arc<Person>>,
    }
}

/// `capture.look`: photos, tags, people → document (JSON).
pub struct Look;

impl Stage for Look {
    const NAME: &'static str = "capture.look";
    const VERSION: u32 = 14;
    const ABOUT: &'static str = "Looks at photos at a glance: order, gaps, blur, exposure, noise, tags, frame, feet, and what can be measured with them.";
    type Params = LookParams;
    type Input = LookInput;
    type Output = Document;
    const METRICS: &'static [&'static str] = &["stands still", "findings", "noise"];

    fn run(_: &LookParams, input: LookInput, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        let photos = &*input.photos;
        let (found, least) = (photos.photos.len(), 3);
        if found < least as usize {
            return Err(CaptureError::TooFew { found, least }.into());
        }
        let steps = ctx.steps("photos", photos.photos.len());
        let one = |photo: &Photo| -> Result<(Glance, Sharpness), Stop> {
            let pixels = photo.decode()?;
            let seen = (glance(&pixels), sharpness(&pixels));
            steps.tick()?;
            Ok(seen)
        };
        let seen: Vec<(Glance, Sharpness)> = in_order(photos.photos.par_iter().map(one))?;
        let (glances, sharp): (Vec<Glance>, Vec<_>) = seen.into_iter().unzip();
        let together = together(&glances);
        let sharpness = against_the_middle(&sharp);
        let tags = input.tags.as_ref();
        let seen = Seen {
            photos,
            glances: &glances,
            together: &together,
            sharpness: &sharp,
            tags: tags.map(|t| &**t),
            people: input.people.as_deref(),
        };
        let mut findings = seen_in_pictures(&seen);
        findings.extend(seen_in_facts(&seen));
        findings.extend(seen.people.and_then(|people| cut_off(photos, people)));
        let noise = of_photos(photos, &together)?;
        if let Some((levels, _)) = noise {
            ctx.metric("noise", levels, "levels");
            findings.extend(noisy(levels));
        }
        findings.sort_by_key(|f| f.grade as u8);
        ctx.metric("stands still", 100.0 * together.still, "%");
        ctx.metric("findings", findings.len() as f64, "");
        let weighed = input.person.is_some_and(|p| p.weight_kg.is_some());
        let can: Map<String, Value> = can(&seen, weighed, &findings)
            .into_iter()
            .map(|(what, how)| (what.to_owned(), json!(how)))
            .collect();
        let round = |x: f64, tens: f64| (x * tens).round() / tens;
        let views: Vec<Value> = photos
            .iter()
            .map(|(id, photo)| {
                let i = id.0 as usize;
                json!({
                    "name": photo.name,
                    "taken_s": photo.time_s.map(|s| round(s, 1e1)),
                    "sharpness": round(sharpness[i], 1e3),
                    "exposure_ev": together.exposure_ev.get(i).map(|ev| round(*ev, 1e3)),
                    "overexposed_pct": round(100.0 * glances[i].burnt, 1e2),
                    "to_next": round(together.steps[i], 1e2),
                    "tags": tags.and_then(|t| t.views.get(id)).map(Vec::len),
                })
            })
            .collect();
        let (first, rig) = (&photos.photos[0], &photos.rig);
        let file = json!({
            "photos": views.len(), "width": first.width, "height": first.height,
            "camera": first.device, "focal_35mm": rig.focal_35mm, "plate": photos.plate.as_ref().map(|p| &p.name),
            "step_deg": rig.step.map(f64::to_degrees), "lengths_from": lengths(rig).map(|from| from.english),
            "still_pct": (1e3 * together.still).round() / 10.0,
            "noise_levels": noise.map(|(levels, _)| round(levels, 1e2)), "noise_against": noise.map(|(_, against)| against),
            "motion": if camera_is_fixed(&together) { "turn" } else { "walk" },
            "findings": findings, "can": can, "views": views,
        });
        Ok(Document {
            media: "application/json".into(),
            bytes: serde_json::to_vec_pretty(&file).expect("bug: JSON"),
        })
    }
}
