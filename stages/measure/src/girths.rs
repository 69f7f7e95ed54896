//! The stage that measures: contour, tape and the paper's spline at each landmark.

use crate::causes::{Evidence, Tall, disputed, explain, left_out};
use crate::derive::{Known, compress, derive, profile, withhold};
use crate::features::body::Body;
use crate::growth::growth;
use crate::named::named;
use crate::remarks::{Unsure, warnings};
use crate::sections::one::SectionMeasurement;
use crate::sections::picked::picked;
use crate::sections::taken::taken;
use crate::uncertainty::clothes::{Hem, hem};
use crate::uncertainty::contradicted::Outlines;
use crate::uncertainty::covered::Covers;
use crate::uncertainty::edges::{Edges, Unseen};
use crate::uncertainty::interval::{Level, level_spread};
use crate::uncertainty::outlines::{by_silhouettes, open_mm};
use crate::uncertainty::reported::{Seen, Sure};
use shape::{
    BodyFeatures, BodyPart, Cameras, GirthId, Girths, Landmark, Landmarks, LostParts, Masks, Mesh,
    Missing, Person, Photos, Refusal,
};
use stage::{Ctx, Message, Stage, Stop};
use std::f64::consts::TAU;
use std::sync::Arc;

stage::params! {
    /// How sure the surface is, and points picked by hand.
    pub struct GirthParams {
        /// Standard deviation of the surface along its normal, even all over a section, beside what
        /// cells, cameras and silhouettes show.
        #[range(0.0..=50.0)]
        surface_mm: f64 = 0.3,
        /// By how much a tape presses in, as a share of its length: tapes and their intervals are
        /// shortened by it, and the files note it. Nothing unless you know it of your measurer. In %.
        #[range(0.0..=10.0)]
        #[source(structural)]
        compression_pct: f64 = 0.0,
        /// How far an interval may reach to either side of its tape, in % of it, in the mean of both where its level reaches unlike: a girth with a wider one is refused.
        #[range(1.0..=100.0)]
        #[source(cited = "ANSUR II: nine in ten waists of one sex are within so much of the middle one, and no girth differs more")]
        widest_pct: f64 = 19.4,
        /// Whether the surface is a hull that nothing made rounder: its tapes are too long by corners between outlines,
        /// which are taken off.
        hull: bool = false,
        /// Points picked around the body, `[[x, y, z], ...]` in millimetres in the turntable frame:
        /// the paper's procedure gives a girth through them, called PICKED.
        points: Vec<Vec<f64>> = vec![],
    }
}

stage::inputs! {
    /// A surface and where to measure it.
    pub struct GirthInput {
        /// The surface.
        mesh: Arc<Mesh>,
        /// What it shows of the body: ground, front, hip, neck.
        features: Arc<BodyFeatures>,
        /// Where.
        landmarks: Arc<Landmarks>,
        /// Cameras: how sure the scale is.
        cameras: Option<Arc<Cameras>>,
        /// Photos: what the user knows of the stature.
        photos: Option<Arc<Photos>>,
        /// Silhouettes: girths without the surface, where limbs are clear.
        masks: Option<Arc<Masks>>,
        /// Who is measured and when: indices, growth references for a child, thresholds for adults.
        person: Option<Arc<Person>>,
        /// Parts of the body that masks leave out: where most do, girths around them are refused.
        lost_parts: Option<Arc<LostParts>>,
    }
}

/// `measure.girths`: mesh, body features, landmarks → girths.
pub struct Measure;

/// Even error of a surface along its normal, as a share of its mean edge: cells bound what it shows, of one carved from
/// outlines. By hand: looked at three scans, at 0.7 and 1.4 of it: intervals change by at most 29 and 39 %.
const CARVED_EDGES: f64 = 0.1;
/// and of one from elsewhere. Fitted: with `surface_mm` it is what tapes around hip, waists, thighs and calves of the first
/// fifty bodies of `models/made/strangers.py` lose or gain where they are remeshed.
const REMESHED: f64 = 0.045;

impl Stage for Measure {
    const NAME: &'static str = "measure.girths";
    const VERSION: u32 = 50;
    const ABOUT: &'static str = "Measures girths at landmarks: along the skin, as a tape, and as the paper's closed spline (eq. 8).";
    type Params = GirthParams;
    type Input = GirthInput;
    type Output = Girths;

    fn memory(_: &GirthParams, input: &GirthInput) -> u64 {
        (input.photos.as_deref().filter(|_| input.masks.is_some())).map_or(0, Edges::memory)
    }

    fn run(p: &GirthParams, input: GirthInput, ctx: &Ctx<'_>) -> Result<Girths, Stop> {
        let (mesh, landmarks) = (&input.mesh, &input.landmarks);
        let mut body = Body::of(mesh, (*input.features).clone());
        body.carved = input.masks.is_some();
        // Of a body without a ground, nothing was found.
        let body = Some(&body).filter(|body| body.is_measurable());
        let mut girths = Girths {
            unit: input.cameras.as_ref().map_or(mesh.unit, |c| c.scale.unit()),
            missing: missing(&input),
            ..Girths::default()
        };
        let ((outlines, edges), hem) = (outlines(&input, body), body.and_then(hem));
        let (covers, mut unsure) = (Covers::of(mesh), Unsure::default());
        let steps = ctx.steps("girths", 2 * landmarks.found.len());
        let mut all: Vec<(&Landmark, SectionMeasurement, Seen)> = Vec::new();
        let lost = |l: &&Landmark| lost(&input, l).is_some();
        for landmark in landmarks.found.iter().filter(|l| !lost(l)) {
            match taken(mesh, body, landmark) {
                Ok(here) => {
                    let by = (outlines.as_ref(), hem, &covers, edges.as_ref());
                    let seen = seen(body, (landmark, p.hull), &here, &input, by);
                    all.push((landmark, here, seen));
                }
                Err(reason) => refuse(landmark, (reason, None), &mut girths),
            }
            steps.tick()?;
        }
        let sure = sure(p, &input, &all);
        for (landmark, here, seen) in all {
            let level = body.map_or(Level::default(), |b| level_spread(mesh, b, landmark, &here));
            let worn = hem.filter(|_| seen.worn_mm > 0.0);
            let (tape_mm, girth) = (here.tape_mm, sure.girth(landmark, here, &seen, level));
            unsure.note(landmark, (&seen, tape_mm, girth.as_ref().ok()));
            match girth {
                Ok(girth) => girths.girths.push(girth),
                Err(reason) => refuse(landmark, (reason, worn), &mut girths),
            }
            steps.tick()?;
        }
        if !p.points.is_empty() {
            match sure.picked(picked(mesh, &p.points)?) {
                Ok(girth) => girths.girths.push(girth),
                Err(reason) => girths.missing.push(Missing::new(GirthId::Picked, reason)),
            }
        }
        girths.profile = body.map_or_else(Default::default, |body| profile(body, &girths));
        compress(&mut girths, p.compression_pct);
        let rig = (input.photos.as_ref()).map_or_else(Default::default, |all| all.rig.clone());
        let person = input.person.clone().unwrap_or_default();
        let evidence = Evidence {
            mesh,
            cameras: input.cameras.as_deref(),
            masks: input.masks.as_deref(),
            lost_parts: input.lost_parts.as_deref(),
            rig: &rig,
            kg: person.weight_kg,
        };
        let tall = Tall {
            mm: landmarks.stature_mm,
            sigma_mm: landmarks.stature_sigma_mm,
        };
        let disputed = disputed(&evidence, tall, girths.unit);
        let known = Known {
            measured_mm: landmarks.stature_mm,
            given_mm: rig.stature_mm.filter(|_| disputed.is_none()),
            kg: person.weight_kg,
        };
        let odd = named(&mut girths, &person, rig.date.clone());
        girths.scale_sigma = input.cameras.as_ref().and_then(|c| c.scale_sigma);
        girths.stature_sigma_mm = landmarks.stature_sigma_mm;
        derive(&mut girths, mesh, &known);
        girths.growth = growth(&girths, known.given_mm);
        if let Some(between) = disputed {
            withhold(&mut girths, between);
        }
        explain(&mut girths, &evidence);
        let warnings = warnings(&girths, &unsure, input.photos.as_deref());
        odd.into_iter().chain(warnings).for_each(|w| ctx.warn(w));
        Ok(girths)
    }
}

/// All outlines, and what photos show of them, where a body was found.
fn outlines(input: &GirthInput, body: Option<&Body>) -> (Option<Outlines>, Option<Edges>) {
    let outlines = input.cameras.as_deref().zip(input.masks.as_deref());
    let Some(((cameras, masks), body)) = outlines.zip(body) else {
        return (None, None);
    };
    let photos = input.photos.as_deref();
    let edges = photos.map(|photos| Edges::of(cameras, masks, photos, body.stature));
    (Outlines::of(cameras, masks, body.stature), edges)
}

/// Takes down why a girth is not given: because of a hem, if one hides it.
fn refuse(landmark: &Landmark, (reason, hem): (Refusal, Option<Hem>), girths: &mut Girths) {
    let why = hem.map_or_else(|| reason.message(), |hem| hem.hides(girths.unit));
    girths.missing.push(Missing {
        name: landmark.name.clone(),
        ..Missing::because(landmark.id, reason, why)
    });
}

/// What the landmarks lack, and girths around a part that most masks leave out.
fn missing(input: &GirthInput) -> Vec<Missing> {
    let without = |landmark: &Landmark| {
        lost(input, landmark).map(|why| Missing {
            name: landmark.name.clone(),
            ..Missing::because(landmark.id, Refusal::Incomplete, why)
        })
    };
    let landmarks = &input.landmarks;
    let lost = landmarks.found.iter().filter_map(without);
    landmarks.missing.iter().cloned().chain(lost).collect()
}

/// Why a girth around a part that most masks leave out is not given.
fn lost(input: &GirthInput, landmark: &Landmark) -> Option<Message> {
    let part = BodyPart::of(landmark.region)?;
    left_out(input.lost_parts.as_deref()?, part)
}

/// What outlines tell of a section.
fn seen(
    body: Option<&Body>,
    (landmark, hull): (&Landmark, bool),
    here: &SectionMeasurement,
    input: &GirthInput,
    (outlines, hem, covers, edges): (Option<&Outlines>, Option<Hem>, &Covers, Option<&Edges>),
) -> Seen {
    let cut = (here.contour.as_slice(), &landmark.plane);
    let covered_mm = covers.bulge_mm(&input.mesh, cut, here.tape_mm);
    let worn_mm = hem.map_or(0.0, |hem| hem.around_mm(landmark));
    let (cameras, masks) = (input.cameras.as_deref(), input.masks.as_deref());
    let (Some(body), Some((cameras, masks))) = (body, cameras.zip(masks)) else {
        return Seen {
            outline: None,
            // A surface that no photos made has no corners of theirs.
            open_mm: cameras.is_none().then_some(0.0),
            left_out_mm: 0.0,
            unseen: Unseen::default(),
            covered_mm,
            worn_mm,
        };
    };
    Seen {
        outline: by_silhouettes(body, (landmark, hull), here, cameras, masks),
        open_mm: Some(open_mm(body, landmark, here, cameras)),
        left_out_mm: outlines.map_or(0.0, |all| all.left_out_mm(&here.contour, &landmark.plane)),
        unseen: edges.map_or(Unseen::default(), |all| {
            all.unseen(&here.contour, &landmark.plane)
        }),
        covered_mm,
        worn_mm,
    }
}

/// What is known of the surface's error; how far it is off the silhouettes' girths, the surer of them first, is an even error
/// along its normal.
fn sure<'a>(
    p: &GirthParams,
    input: &'a GirthInput,
    all: &[(&Landmark, SectionMeasurement, Seen)],
) -> Sure<'a> {
    let even = match input.masks {
        Some(_) => CARVED_EDGES,
        None => REMESHED,
    };
    let surface_mm = libm::hypot(p.surface_mm, even * input.mesh.mean_edge());
    let (mut square, mut weights) = (0.0, 0.0);
    for (_, here, seen) in all {
        if let Some(outline) = seen.outline {
            let [off, sigma] = [here.tape_mm - outline.girth, outline.sigma].map(|mm| mm / TAU);
            let weight = 1.0 / (sigma * sigma + surface_mm * surface_mm).max(1e-12);
            square += weight * off * off;
            weights += weight;
        }
    }
    Sure {
        mesh: &input.mesh,
        surface_mm,
        off_mm: if weights > 0.0 {
            (square / weights).sqrt()
        } else {
            0.0
        },
        cameras: input.cameras.as_deref(),
        hull: p.hull,
        widest: p.widest_pct / 100.0,
    }
}
