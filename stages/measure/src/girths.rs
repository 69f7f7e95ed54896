//! The stage that measures: contour, tape and the paper's spline at each landmark.

use crate::body::{Body, body};
use crate::landmarks::{merged, ring_of};
use crate::section::{flat, length, tape};
use crate::slices::without_arms;
use crate::spline::{closed_spline_length, paper_girth};
use nalgebra::{Point3, Vector3};
use shape::{Cameras, Girth, Girths, Landmark, Landmarks, Mesh, Missing, Photos, Plane, Profile};
use stage::{Ctx, Stage, Stop};
use std::sync::Arc;

stage::params! {
    /// How sure the surface is.
    pub struct GirthParams {
        /// Standard deviation of the surface along its normal, all over a section.
        #[range(0.0..=50.0)]
        surface_mm: f64 = 0.6,
        /// Standard deviation of a girth as a share of it: a hull of eighteen views of a body that
        /// sways comes out one or two hundredths too long.
        #[range(0.0..=0.2)]
        hull_share: f64 = 0.015,
        /// Uncertainty of the level at which a girth is taken.
        #[range(0.0..=100.0)]
        level_mm: f64 = 5.0,
    }
}

stage::inputs! {
    /// A surface and where to measure it.
    pub struct GirthInput {
        /// The surface.
        mesh: Arc<Mesh>,
        /// Where.
        landmarks: Arc<Landmarks>,
        /// Cameras: how sure the scale is, and where the ground is.
        cameras: Option<Arc<Cameras>>,
        /// Photos: what the user said of stature and weight.
        photos: Option<Arc<Photos>>,
    }
}

/// `measure.girths`: mesh, landmarks → girths.
pub struct Measure;

/// How much the trunk's tape may change from where the arms join it to the chest.
const PLAUSIBLE: std::ops::RangeInclusive<f64> = 0.94..=1.05;
/// Nine times in ten, in standard deviations.
const NINE_IN_TEN: f64 = 1.645;

impl Stage for Measure {
    const NAME: &'static str = "measure.girths";
    const VERSION: u32 = 3;
    const ABOUT: &'static str = "Measures girths at landmarks: along the skin, as a tape, and as the paper's closed spline (eq. 8).";
    type Params = GirthParams;
    type Input = GirthInput;
    type Output = Girths;

    fn run(p: &GirthParams, input: GirthInput, ctx: &Ctx<'_>) -> Result<Girths, Stop> {
        let (mesh, landmarks) = (&input.mesh, &input.landmarks);
        let ground = input.cameras.as_ref().map_or(0.0, |c| c.ground_mm);
        let scale_sigma = input.cameras.as_ref().map_or(0.0, |c| c.scale_sigma);
        let body = body(mesh, ground);
        let mut girths = Girths {
            missing: landmarks.missing.clone(),
            ..Girths::default()
        };
        let steps = ctx.steps("girths", landmarks.found.len());
        for landmark in &landmarks.found {
            match girth(p, mesh, landmark, body.as_ref(), scale_sigma) {
                Some(girth) => girths.girths.push(girth),
                None => {
                    let why = "the section there goes around more than this part: arms and trunk are one on \
                               the surface, as a visual hull makes them"
                        .into();
                    girths.missing.push(Missing {
                        name: landmark.name.clone(),
                        why,
                    });
                }
            }
            steps.tick()?;
        }
        let rig = input
            .photos
            .as_ref()
            .map(|photos| photos.rig.clone())
            .unwrap_or_default();
        derive(&mut girths, landmarks, mesh, rig.stature_mm, rig.weight_kg);
        if let Some(body) = &body {
            girths.profile = profile(body, &girths);
        }
        Ok(girths)
    }
}

/// What one section gives.
struct Section {
    contour: Vec<Point3<f64>>,
    contour_mm: f64,
    tape_mm: f64,
    spline_mm: Option<f64>,
    cut: bool,
}

/// Measures a section; arms are cut off where they are one with the trunk.
fn measure(mesh: &Mesh, landmark: &Landmark, body: Option<&Body>) -> Option<Section> {
    let ring = ring_of(mesh, landmark)?;
    let points = flat(&ring.curve, &landmark.plane);
    let z = landmark.plane.point_mm[2];
    let chest = landmark.name == "CC";
    if let Some(body) = body.filter(|body| chest && merged(body, z)) {
        let own = |v: Vector3<f64>| [v.x, v.y];
        let kept = without_arms(&ring, own(body.left), own(body.front))?;
        // What is left must go on where the trunk last stood clear of the arms.
        let clear = body
            .slices
            .iter()
            .rfind(|s| s.z < z && !merged(body, s.z))?;
        let change = tape(&kept) / clear.rings.first()?.tape;
        if !PLAUSIBLE.contains(&change) || length(&kept) > 1.05 * tape(&kept) {
            return None;
        }
        let place = |p: &[f64; 2]| ring.centre + body.left * p[0] + body.front * p[1];
        return Some(Section {
            contour: kept.iter().map(place).collect(),
            contour_mm: length(&kept),
            tape_mm: tape(&kept),
            spline_mm: closed_spline_length(&every(&kept, 72)),
            cut: true,
        });
    }
    Some(Section {
        contour_mm: length(&points),
        tape_mm: tape(&points),
        spline_mm: paper_girth(mesh, &ring.curve),
        contour: ring.curve,
        cut: false,
    })
}

/// At most so many of the points, evenly.
fn every(points: &[[f64; 2]], most: usize) -> Vec<[f64; 2]> {
    points
        .iter()
        .step_by(points.len().div_ceil(most).max(1))
        .copied()
        .collect()
}

fn girth(
    p: &GirthParams,
    mesh: &Mesh,
    landmark: &Landmark,
    body: Option<&Body>,
    scale_sigma: f64,
) -> Option<Girth> {
    let here = measure(mesh, landmark, body)?;
    let n = Vector3::from(landmark.plane.normal);
    let moved = |by: f64| {
        let point = Point3::from(landmark.plane.point_mm) + n * by;
        let plane = Plane {
            point_mm: point.into(),
            ..landmark.plane
        };
        measure(
            mesh,
            &Landmark {
                plane,
                ..landmark.clone()
            },
            body,
        )
        .map(|s| s.tape_mm)
    };
    let shift =
        [-p.level_mm, p.level_mm].map(|by| moved(by).unwrap_or(here.tape_mm) - here.tape_mm);
    let level = shift[0].abs().max(shift[1].abs()).min(0.1 * here.tape_mm);
    // An even error of the surface along its normal changes a closed curve by 2π of it.
    let surface = std::f64::consts::TAU * p.surface_mm;
    let cut = if here.cut { 0.02 * here.tape_mm } else { 0.0 };
    let scale = scale_sigma * here.tape_mm;
    let hull = p.hull_share * here.tape_mm;
    let sigma = [level, surface, cut, scale, hull]
        .iter()
        .map(|s| s * s)
        .sum::<f64>()
        .sqrt();
    let (low, high) = (
        here.tape_mm - NINE_IN_TEN * sigma,
        here.tape_mm + NINE_IN_TEN * sigma,
    );
    let note = if here.cut {
        "; arms cut off at the folds of the armpits"
    } else {
        ""
    };
    Some(Girth {
        name: landmark.name.clone(),
        label: landmark.label.clone(),
        definition: format!("{}{note}", landmark.definition),
        contour_mm: here.contour_mm,
        tape_mm: here.tape_mm,
        spline_mm: here.spline_mm.unwrap_or(here.contour_mm),
        silhouette_mm: None,
        interval_mm: [low, high],
        plane: landmark.plane,
        contour: here
            .contour
            .iter()
            .map(|p| [p.x as f32, p.y as f32, p.z as f32])
            .collect(),
    })
}

/// Ratios, body mass index, volume.
fn derive(
    girths: &mut Girths,
    landmarks: &Landmarks,
    mesh: &Mesh,
    stature: Option<f64>,
    kg: Option<f64>,
) {
    let get = |name: &str| girths.get(name).map(|g| g.contour_mm);
    let stature_mm = stature.or((landmarks.stature_mm > 0.0).then_some(landmarks.stature_mm));
    let mut ratios = Vec::new();
    if let (Some(w), Some(h)) = (get("WC"), get("HC")) {
        ratios.push(("WHR".into(), w / h, String::new()));
    }
    if let (Some(w), Some(s)) = (get("WC"), stature_mm) {
        ratios.push(("WHtR".into(), w / s, String::new()));
    }
    girths.ratios = ratios;
    girths.stature_mm = Some(landmarks.stature_mm).filter(|s| *s > 0.0);
    girths.weight_kg = kg;
    girths.bmi = kg
        .zip(stature_mm)
        .map(|(kg, mm)| kg / (mm / 1000.0).powi(2));
    girths.volume_l = Some(mesh.volume() * 1e-6);
}

/// The trunk's tape over height, from the hip to the chest.
fn profile(body: &Body, girths: &Girths) -> Profile {
    let z = |name: &str| {
        girths
            .get(name)
            .filter(|g| g.plane.normal[2] > 0.99)
            .map(|g| g.plane.point_mm[2])
    };
    let low = z("HC").or(body.crotch).unwrap_or(body.ground) - 0.03 * body.stature;
    let high = z("CC").unwrap_or(body.ground + 0.7 * body.stature) + 0.01 * body.stature;
    let mut profile = Profile::default();
    for slice in body.between(low, high) {
        if let Some(ring) = slice
            .rings
            .first()
            .filter(|_| !merged(body, slice.z) || girths.get("CC").is_none())
        {
            profile.height_mm.push(slice.z - body.ground);
            profile.tape_mm.push(ring.tape);
        }
    }
    profile
}
