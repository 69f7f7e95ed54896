//! The stage that measures: contour, tape and the paper's spline at each landmark.

use crate::derive::{derive, no_density, profile};
use crate::features::body::body;
use crate::geometry::spline::has_left;
use crate::sections::picked::picked;
use crate::sections::taken::{Taken, taken};
use crate::uncertainty::interval::{NINE_IN_TEN, Spread, interval, level_spread, together};
use crate::uncertainty::outlines::{by_silhouettes, open_mm, shared_border, surface_by_cameras};
use crate::uncertainty::silhouette::Support;
use nalgebra::Point3;
use shape::{Cameras, Girth, Girths, Landmark, Landmarks, Masks, Mesh, Missing, Photos};
use stage::{Ctx, Stage, Stop};
use std::f64::consts::TAU;
use std::sync::Arc;

stage::params! {
    /// How sure the surface is, and points picked by hand.
    pub struct GirthParams {
        /// Standard deviation of the surface along its normal, even all over a section, beside what
        /// cells, cameras and silhouettes say.
        #[range(0.0..=50.0)]
        surface_mm: f64 = 0.3,
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
        /// Where.
        landmarks: Arc<Landmarks>,
        /// Cameras: how sure the scale is, and where the ground is.
        cameras: Option<Arc<Cameras>>,
        /// Photos: what the user said of stature and weight.
        photos: Option<Arc<Photos>>,
        /// Silhouettes: girths without the surface, where limbs stand clear.
        masks: Option<Arc<Masks>>,
    }
}

/// `measure.girths`: mesh, landmarks → girths.
pub struct Measure;

/// How much longer than its tape the skin around a waist may be: more points to a hole.
const WAIST_FOLDS: f64 = 1.05;

/// What the definition of a girth says whose section was split.
const SPLIT: &str = "arm and trunk are one there on the surface and were split";

/// Even error of a surface along its normal, as a share of its mean edge: cells bound what it shows.
const EVEN: f64 = 0.1;

impl Stage for Measure {
    const NAME: &'static str = "measure.girths";
    const VERSION: u32 = 17;
    const ABOUT: &'static str = "Measures girths at landmarks: along the skin, as a tape, and as the paper's closed spline (eq. 8).";
    type Params = GirthParams;
    type Input = GirthInput;
    type Output = Girths;

    fn run(p: &GirthParams, input: GirthInput, ctx: &Ctx<'_>) -> Result<Girths, Stop> {
        let (mesh, landmarks) = (&input.mesh, &input.landmarks);
        let ground = input.cameras.as_ref().map_or(0.0, |c| c.ground_mm);
        let body = body(mesh, ground);
        let mut girths = Girths {
            missing: landmarks.missing.clone(),
            ..Girths::default()
        };
        let steps = ctx.steps("girths", 2 * landmarks.found.len());
        let seen = input.cameras.as_deref().zip(input.masks.as_deref());
        let mut all: Vec<(&Landmark, Taken, Seen)> = Vec::new();
        for landmark in &landmarks.found {
            match taken(mesh, body.as_ref(), landmark) {
                Ok(here) => {
                    let seen = match body.as_ref().zip(seen) {
                        Some((body, (cameras, masks))) => Seen {
                            support: by_silhouettes(body, landmark, &here, cameras, masks),
                            open_mm: open_mm(body, landmark, &here, cameras),
                        },
                        None => Seen::default(),
                    };
                    all.push((landmark, here, seen));
                }
                Err(why) => {
                    ctx.warn(format!("{}: {why}", landmark.name));
                    girths.missing.push(Missing {
                        name: landmark.name.clone(),
                        why: why.into(),
                    });
                }
            }
            steps.tick()?;
        }
        // How far the surface stands off the silhouettes' girths, as an even error along its normal.
        let off: Vec<f64> = all
            .iter()
            .filter_map(|(_, here, s)| Some((here.tape_mm - s.support?.girth) / TAU))
            .collect();
        let square = off.iter().map(|o| o * o).sum::<f64>() / off.len().max(1) as f64;
        let sure = Sure {
            surface_mm: p.surface_mm.hypot(EVEN * mesh.mean_edge()),
            off_mm: square.sqrt(),
            cameras: input.cameras.as_deref(),
        };
        if let Some(warning) = unconfirmed(&all) {
            ctx.warn(warning);
        }
        for (landmark, here, seen) in all {
            let level = body
                .as_ref()
                .map_or(0.0, |b| level_spread(mesh, b, landmark, &here));
            girths
                .girths
                .push(girth(&sure, landmark, here, seen, level));
            steps.tick()?;
        }
        let split = girths
            .girths
            .iter()
            .filter(|g| g.definition.contains(SPLIT));
        let split: Vec<&str> = split.map(|g| g.name.as_str()).collect();
        if !split.is_empty() {
            ctx.warn(format!(
                "{}: arm and trunk are one on the surface there and were split: intervals are wider; hold the arms farther away",
                split.join(", ")
            ));
        }
        for girth in &girths.girths {
            if has_left(girth.spline_mm, girth.tape_mm, girth.contour_mm) {
                ctx.warn(format!(
                    "{}: the paper's spline (eq. 8) is {:+.0} % off the exact curve: the surface is too coarse there, so that its \
                     points leave the ring; take the tape or the exact curve",
                    girth.name,
                    100.0 * (girth.spline_mm / girth.contour_mm - 1.0)
                ));
            }
        }
        if !p.points.is_empty() {
            let mut girth = picked(mesh, &p.points)?;
            sure.widen(&mut girth);
            girths.girths.push(girth);
        }
        if let Some(waist) = girths.get("WC")
            && waist.contour_mm > WAIST_FOLDS * waist.tape_mm
        {
            ctx.warn(format!(
                "WC: the skin around the waist is {:.0} % longer than a tape, which points to a hole in the surface or to \
                 an arm that touches it: look at the section",
                100.0 * (waist.contour_mm / waist.tape_mm - 1.0)
            ));
        }
        let rig = input
            .photos
            .as_ref()
            .map(|photos| photos.rig.clone())
            .unwrap_or_default();
        let (stature, kg) = (rig.stature_mm, rig.weight_kg);
        derive(&mut girths, mesh, landmarks.stature_mm, stature, kg);
        if let Some(warning) = no_density(&girths) {
            ctx.warn(warning);
        }
        if let Some(body) = &body {
            girths.profile = profile(body, &girths);
        }
        Ok(girths)
    }
}

/// What outlines tell of a section.
#[derive(Default)]
struct Seen {
    support: Option<Support>,
    open_mm: f64,
}

/// From this share of a tape on it is told that no outline confirms it.
const OPEN: f64 = 0.012;

/// What is said of sections of which no outline confirms enough.
fn unconfirmed(all: &[(&Landmark, Taken, Seen)]) -> Option<String> {
    let open = all
        .iter()
        .filter(|(_, here, seen)| seen.open_mm > OPEN * here.tape_mm);
    let names: Vec<&str> = open.clone().map(|(l, ..)| l.name.as_str()).collect();
    let most = open.map(|(_, _, seen)| seen.open_mm).reduce(f64::max)?;
    Some(format!(
        "{}: for a stretch no photo shows the body's outline there, for hands are before it or photos are few, and the surface runs \
         out to a corner: {:.1} cm or so may not be body; take more photos, or hold the hands farther away",
        names.join(", "),
        most / 10.0
    ))
}

/// What is known of the surface's error.
struct Sure<'a> {
    surface_mm: f64,
    off_mm: f64,
    cameras: Option<&'a Cameras>,
}

impl Sure<'_> {
    /// The surface along its normal around a place, where no silhouette tells its girth. \[mm\]
    fn unseen(&self, at: Point3<f64>) -> f64 {
        let by_cameras = self.cameras.and_then(|c| surface_by_cameras(c, at));
        let surface = self.surface_mm.hypot(by_cameras.unwrap_or(0.0));
        surface.hypot(self.off_mm)
    }

    /// Adds to an interval what surface and scale leave open.
    fn widen(&self, girth: &mut Girth) {
        let own = (girth.interval_mm[1] - girth.tape_mm) / NINE_IN_TEN;
        let scale = self.cameras.map_or(0.0, |c| c.scale_sigma) * girth.tape_mm;
        let surface = TAU * self.unseen(Point3::from(girth.plane.point_mm));
        let reach = NINE_IN_TEN * own.hypot(surface).hypot(scale);
        girth.interval_mm = [girth.tape_mm - reach, girth.tape_mm + reach];
    }
}

fn girth(sure: &Sure<'_>, landmark: &Landmark, here: Taken, seen: Seen, level: f64) -> Girth {
    let support = seen.support;
    let at = Point3::from(landmark.plane.point_mm);
    // Where silhouettes say nothing of this girth, what they say of others widens it.
    let surface = match support {
        Some(_) => {
            let by_cameras = sure.cameras.and_then(|c| surface_by_cameras(c, at));
            sure.surface_mm.hypot(by_cameras.unwrap_or(0.0))
        }
        None => sure.unseen(at),
    };
    let outline = support.as_ref().map(|s| {
        let shared = sure.cameras.map_or(0.0, |c| shared_border(c, at));
        (s.girth, s.sigma.hypot(shared))
    });
    let (tape, width) = together((here.tape_mm, TAU * surface), outline);
    let spread = Spread {
        level,
        surface: width,
        carried: here.doubt_mm,
        scale: sure.cameras.map_or(0.0, |c| c.scale_sigma) * here.tape_mm,
    };
    let reach = NINE_IN_TEN * spread.total();
    // Where outlines tell the girth, they tell of corners, too.
    let open_mm = match support {
        Some(_) => 0.0,
        None => seen.open_mm,
    };
    let note = match here.carried > 0.0 {
        true => format!(
            "; {SPLIT}: {:.0} % of the way around is told by the outline beside it or by a clear section",
            100.0 * here.carried
        ),
        false => String::new(),
    };
    Girth {
        name: landmark.name.clone(),
        label: landmark.label.clone(),
        definition: format!("{}{note}", landmark.definition),
        contour_mm: here.contour_mm,
        tape_mm: here.tape_mm,
        spline_mm: here.spline_mm,
        silhouette_mm: support.map(|s| s.girth),
        interval_mm: interval(here.tape_mm, tape, reach, open_mm),
        plane: landmark.plane,
        contour: here
            .contour
            .iter()
            .map(|p| [p.x as f32, p.y as f32, p.z as f32])
            .collect(),
    }
}
