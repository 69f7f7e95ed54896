//! The steps between photos and masks as pictures to look at: alignment, empty scene, evidence, labels.

use shape::{
    Aligned, Evidence, Image, Known, Labels, PhotoError, PhotoId, Photos, Rgb, Scene, Seen,
    gray_to_png, rgb_to_jpeg, rgb_to_png,
};
use std::path::Path;

/// Where nothing is known of the scene (structural: a colour). \[sRGB\]
const UNKNOWN: [u8; 3] = [255, 0, 255];
/// -ln p(pixel | some body): the evidence of a colour that the body has not (derived: 3 ln 256 + 1.2, as in
/// `silhouette`). \[nats\]
const ANY_BODY_NATS: f32 = 17.8;
/// Evidence from which on a pixel's shade is full (structural: a scale of shades). \[nats\]
const FULL: f32 = 12.0;

/// Files: names and bytes.
type NamedFiles = Vec<(String, Vec<u8>)>;

/// The file of a photo, by its name.
fn named(photos: &Photos, id: PhotoId, extension: &str) -> String {
    let name = photos
        .get(id)
        .map(|p| Path::new(&p.name).with_extension(extension));
    let name = name.and_then(|p| p.to_str().map(str::to_owned));
    name.unwrap_or_else(|| format!("{:04}.{extension}", id.0))
}

/// The photos as JPEG where they are aligned, at one exposure.
///
/// # Errors
///
/// A photo cannot be decoded.
pub fn aligned_to_jpeg(aligned: &Aligned, photos: &Photos) -> Result<NamedFiles, PhotoError> {
    let one = |(id, photo): (PhotoId, &shape::Photo)| {
        let there = aligned.of(id).brought(photo.decode()?);
        Ok((named(photos, id, "jpg"), rgb_to_jpeg(&there, 92)))
    };
    aligned.photos(photos).iter().map(one).collect()
}

/// The scene without the body, and the map of the disk where there is one; what is unknown is magenta.
pub fn scene_to_png(scene: &Scene) -> NamedFiles {
    let picture = |seen: &Seen| {
        let all = seen.image.data.iter().zip(&seen.shown_by.data);
        let data = all.map(|(c, by)| if *by == 0 { UNKNOWN } else { *c });
        rgb_to_png(&Image {
            width: seen.image.width.max(1),
            height: seen.image.height.max(1),
            data: match seen.image.data.is_empty() {
                true => vec![UNKNOWN],
                false => data.collect(),
            },
        })
    };
    let mut files = vec![("scene.png".to_owned(), picture(&scene.still))];
    let disk = scene.disk.as_ref().map(picture);
    files.extend(disk.map(|disk| ("disk.png".to_owned(), disk)));
    files
}

/// Each reduced photo in gray: blue as far as the background explains a pixel better than some body does, red as far
/// as it does not, dark blue where it cannot be body.
pub fn evidence_to_png(evidence: &Evidence, photos: &Photos) -> NamedFiles {
    let views = evidence.views.iter();
    let one = |(id, e): (PhotoId, &shape::PhotoEvidence)| {
        let pixel = |(odds, color): (f32, &[u8; 3])| {
            let gray = color.iter().map(|c| u16::from(*c)).sum::<u16>() / 6;
            let share = (odds.abs() / FULL).min(1.0);
            let strong = (share * 127.0) as u8;
            match odds {
                o if o.is_infinite() && o > 0.0 => [0, 0, 80],
                o if o > 0.0 => [gray as u8, gray as u8, gray as u8 + strong],
                _ => [gray as u8 + strong, gray as u8, gray as u8],
            }
        };
        let picture = Rgb {
            width: e.photo.width,
            height: e.photo.height,
            data: e
                .log_odds(ANY_BODY_NATS)
                .zip(&e.photo.data)
                .map(pixel)
                .collect(),
        };
        (named(photos, id, "png"), rgb_to_png(&picture))
    };
    views.map(one).collect()
}

/// Each reduced photo in four shades: black and white what is certain before any cut, dark and light gray what
/// the cut decided.
pub fn labels_to_png(labels: &Labels, photos: &Photos) -> NamedFiles {
    let one = |(id, label): (PhotoId, &shape::Label)| {
        let shade = |(body, known): (&bool, &Known)| match (body, known) {
            (true, Known::Unknown) => 192,
            (true, _) => 255,
            (false, Known::Unknown) => 64,
            (false, _) => 0,
        };
        let picture = Image {
            width: label.body.width,
            height: label.body.height,
            data: label
                .body
                .data
                .iter()
                .zip(&label.known)
                .map(shade)
                .collect(),
        };
        (named(photos, id, "png"), gray_to_png(&picture))
    };
    labels.views.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use shape::{Label, PhotoEvidence};

    fn colors(png: &[u8]) -> Vec<[u8; 3]> {
        let photo = shape::Photo::of(String::new(), [2, 1], png.to_vec());
        photo.decode().unwrap().data
    }

    #[test]
    fn what_is_unknown_shows_and_evidence_has_two_colours() {
        let mut still = Seen::whole(Rgb::filled(2, 1, [9; 3]));
        still.shown_by.data[1] = 0;
        let scene = Scene {
            still,
            ..Scene::unknown()
        };
        let files = scene_to_png(&scene);
        assert_eq!(colors(&files[0].1), [[9; 3], UNKNOWN]);
        assert_eq!(scene_to_png(&Scene::unknown()).len(), 1);
        let evidence = PhotoEvidence {
            factor: 1,
            photo: Rgb::filled(2, 1, [60; 3]),
            background: vec![4.5, 28.5],
            mirrored: vec![],
            light: vec![],
            person: vec![],
            known: vec![Known::Unknown; 2],
            noise_levels: 1.0,
        };
        let evidence = Evidence {
            views: [(PhotoId(0), evidence)].into_iter().collect(),
        };
        let files = evidence_to_png(&evidence, &Photos::default());
        let [wall, body] = colors(&files[0].1)[..] else {
            panic!("two pixels")
        };
        assert!(wall[2] > wall[0] && body[0] > body[2], "{wall:?} {body:?}");
    }

    #[test]
    fn labels_have_four_shades() {
        let label = Label {
            body: Image {
                width: 4,
                height: 1,
                data: vec![true, true, false, false],
            },
            known: vec![
                Known::Body,
                Known::Unknown,
                Known::Unknown,
                Known::Background,
            ],
            body_colors: vec![],
            background_colors: vec![],
        };
        let labels = Labels {
            views: [(PhotoId(3), label)].into_iter().collect(),
        };
        let files = labels_to_png(&labels, &Photos::default());
        assert_eq!(files[0].0, "0003.png");
        let shades = shape::gray_from_file(&files[0].1).unwrap();
        assert_eq!(shades.data, [255, 192, 64, 0]);
    }
}
