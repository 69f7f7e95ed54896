//! The page itself, out of its parts.

use crate::answer::Answer;
use crate::lengths::Lengths;
use crate::{derived, profile, scene, sides, tables};
use rayon::prelude::*;
use shape::{
    Cameras, Girths, Landmarks, Length, Mesh, Photos, Scale, Textured, Unit, cameras_to_svg,
};

/// A surface that the viewer can show.
pub(crate) enum Surface {
    /// Without an atlas: its name, and it.
    Plain(String, Mesh),
    /// With its atlas: name, it, longest side of the atlas.
    Textured(&'static str, Textured, usize),
}

/// What the page is made of.
pub(crate) struct Content<'a> {
    /// Photos, for names and what the user knew, and their cameras; a scan has none.
    pub(crate) turn: Option<(&'a Photos, &'a Cameras)>,
    /// The tables.
    pub(crate) girths: &'a Girths,
    /// Which way the subject faces.
    pub(crate) landmarks: Option<&'a Landmarks>,
    /// The surface that was measured.
    pub(crate) body: &'a Mesh,
    /// What to switch between, the first at first.
    pub(crate) surfaces: Vec<Surface>,
    /// The photos, as HTML.
    pub(crate) figures: String,
    /// Whether the user wanted no photos.
    pub(crate) without_photos: bool,
    /// Which answer it shows.
    pub(crate) answer: Answer,
    /// What lengths are in.
    pub(crate) lengths: Lengths,
}

const SCRIPT: [&str; 8] = [
    include_str!("viewer/unpack.js"),
    include_str!("viewer/draw.js"),
    include_str!("viewer/look.js"),
    include_str!("viewer/hands.js"),
    include_str!("viewer/plane_curve.js"),
    include_str!("viewer/girth.js"),
    include_str!("viewer/pick.js"),
    include_str!("viewer/photos.js"),
];

/// What a page is called whose capture has no name of its own.
const UNNAMED: &str = "one turn";

/// A page whose capture has no name of its own, called so; any other as it is.
pub fn titled(page: &str, name: &str) -> String {
    let name = tables::escaped(name);
    let title = |name: &str| format!("<title>tailor: {name}</title>");
    let head = |name: &str| format!("<h1>{name}</h1>");
    page.replacen(&title(UNNAMED), &title(&name), 1)
        .replacen(&head(UNNAMED), &head(&name), 1)
}

/// The page.
pub(crate) fn page(content: &Content<'_>) -> String {
    let (girths, turn) = (content.girths, content.turn);
    let lengths = content.lengths;
    let (at, faces) = measured(content);
    let whole = faces == content.body.faces.len();
    let packed = |(i, surface): (usize, &Surface)| {
        let exact = whole && i == at;
        match surface {
            Surface::Plain(label, mesh) => scene::mesh(label, mesh, exact),
            Surface::Textured(label, body, atlas_px) => {
                scene::textured(label, body, *atlas_px, exact)
            }
        }
    };
    let of_photos = turn.into_iter().flat_map(|(photos, cameras)| {
        let camera = |(id, _)| cameras.views.get(id).map(|v| &v.camera);
        photos.iter().map(camera)
    });
    let front = content
        .landmarks
        .and_then(|l| l.points.iter().find(|(name, _)| name == "front"))
        .map_or([0.0, -1.0, 0.0], |(_, front)| *front);
    // The soles', where landmarks have found them.
    let ground = content.landmarks.and_then(|l| l.ground_mm);
    let lowest = || content.body.bounds().map_or(0.0, |(low, _)| low.z);
    let ground = ground.unwrap_or_else(|| turn.map_or_else(lowest, |(_, c)| c.ground_mm));
    let surfaces = content.surfaces.par_iter().enumerate();
    let (meshes, sides) = rayon::join(
        || surfaces.map(packed).collect::<Vec<_>>(),
        || sides::figure(content.body, girths, front, lengths),
    );
    let scene = serde_json::json!({
        "meshes": meshes, "tapes": scene::tapes(girths, lengths), "front": front,
        "views": scene::views(of_photos), "measured": whole.then_some(at), "lengths": scene::written(girths, lengths),
    });
    let unnamed = if turn.is_some() { UNNAMED } else { "a scan" };
    let name = girths.capture.as_deref().unwrap_or(unnamed);
    let relative = turn.is_none() && girths.unit == Unit::Relative;
    filled(
        include_str!("page.html"),
        &[
            ("title", tables::escaped(name)),
            ("about", about(turn)),
            ("style", include_str!("page.css").into()),
            (
                "warnings",
                content.answer.first()
                    + &turn.map_or_else(String::new, warnings)
                    + if relative { RELATIVE } else { "" },
            ),
            ("girths", tables::girths(girths, lengths)),
            ("unit", tables::unit(girths, lengths)),
            ("derived", derived::derived(girths, lengths)),
            ("sides", sides),
            ("coarse", coarser(faces, content.body.faces.len())),
            ("profile", profile::svg(girths, ground, lengths)),
            (
                "turn",
                turn.map_or_else(String::new, |turn| sections(turn, content)),
            ),
            ("scene", scene.to_string().replace('<', "\\u003c")),
            ("viewer", format!("(() => {{\n{}}})();", SCRIPT.concat())),
        ],
    )
}

/// Which of the surfaces on the page is the measured one at its finest, and of how many faces.
fn measured(content: &Content<'_>) -> (usize, usize) {
    let faces = |surface: &Surface| match surface {
        Surface::Textured(_, t, _) => {
            let same = t.mesh.faces.len() == content.body.faces.len();
            let same = same && t.mesh.positions.len() == content.body.positions.len();
            same.then_some(t.mesh.faces.len())
        }
        Surface::Plain(label, mesh) => {
            let body = label.split(" = ").next() == Some("body");
            body.then_some(mesh.faces.len())
        }
    };
    let all = content.surfaces.iter().map(faces).enumerate();
    let known = all.filter_map(|(at, faces)| Some((at, faces?)));
    // The first of the finest.
    known.fold((0, 0), |best, here| match here.1 > best.1 {
        true => here,
        false => best,
    })
}

/// The note where the page carries less than was measured.
fn coarser(on_page: usize, measured: usize) -> String {
    match on_page < measured {
        true => format!(
            " The page carries the surface with {on_page} of its {measured} faces, so girths through points are given by the command alone (finer pages: --set report.most_faces={measured})."
        ),
        false => String::new(),
    }
}

/// The template with its `{{slots}}` filled, once: what a slot brings in is not looked into.
fn filled(template: &str, slots: &[(&str, String)]) -> String {
    let mut page = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").expect("bug: a slot is not closed");
        let slot = slots.iter().find(|(slot, _)| *slot == name);
        page += before;
        page += &slot.expect("bug: a slot that nobody fills").1;
        rest = after;
    }
    page + rest
}

/// The note of a scan's page whose file names no unit.
const RELATIVE: &str = "<p class=\"warn\"><b>Lengths are relative.</b> So it is in the file; ratios hold. If its unit is known: \
     --unit-of-file.</p>";

/// The parts of the page about cameras and photos.
fn sections((photos, cameras): (&Photos, &Cameras), content: &Content<'_>) -> String {
    let note = match content.without_photos {
        true => "<p class=\"note\">The photos were left out.</p>",
        false => "",
    };
    filled(
        include_str!("turn.html"),
        &[
            (
                "scale",
                tables::scale(cameras, &photos.rig, content.lengths),
            ),
            ("ring", cameras_to_svg(cameras)),
            (
                "photos",
                format!("{note}<div class=\"photos\">{}</div>", content.figures),
            ),
        ],
    )
}

fn about(turn: Option<(&Photos, &Cameras)>) -> String {
    let Some((photos, cameras)) = turn else {
        return "Girths of a surface from elsewhere, taken by tailor.".into();
    };
    let (all, found) = (photos.photos.len(), cameras.views.len());
    let of = match found == all {
        true => format!("{all} photos of one turn"),
        false => format!("{found} of {all} photos of one turn"),
    };
    format!(
        "Girths from {of}, made by tailor; {}.",
        tables::origin(cameras.scale)
    )
}

/// What a reader must know first.
fn warnings((photos, cameras): (&Photos, &Cameras)) -> String {
    let mut html = String::new();
    if cameras.scale == Scale::Nothing {
        html += "<p class=\"warn\"><b>Lengths are relative.</b> Nothing of known length was given, so lengths \
                 here are shares of the camera ring's radius; ratios hold. Give a marker mat, a reference length, the disk's diameter or the stature in capture.toml.</p>";
    }
    if let Scale::Disputed(pair) = cameras.scale {
        let [one, other] = pair.map(Length::word);
        html += &format!(
            "<p class=\"warn\"><b>Lengths are relative.</b> Known lengths contradict each other ({one}, {other}), so lengths here are shares of the camera \
             ring's radius, and what takes stature or weight is left out; ratios of girths hold. Correct one of them, or leave one out.</p>"
        );
    }
    let missing: Vec<_> = photos
        .iter()
        .filter(|(id, _)| cameras.views.get(*id).is_none())
        .map(|(_, photo)| tables::escaped(&photo.name))
        .collect();
    if !missing.is_empty() {
        html += &format!(
            "<p class=\"warn\">Photos without a camera, not used: {}</p>",
            missing.join(", ")
        );
    }
    html
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fills_a_slot_is_not_a_template() {
        let slots = [("a", "{{b}} & {{c".to_owned()), ("b", "x".to_owned())];
        assert_eq!(filled("<{{a}}{{b}}>", &slots), "<{{b}} & {{cx>");
    }
}
