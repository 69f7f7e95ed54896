//! The report of a small made-up body: whole, self-contained, and without photos or faces when asked.

use crate::tube;

use report::{Answer, Html, HtmlInput, HtmlParams};
use shape::{
    GirthId, Landmarks, Mask, Mesh, Missing, Part, PhotoId, Refusal, Rgb, Textured, rgb_to_jpeg,
};
use stage::{Ctx, Stage};
use std::sync::Arc;
use tube::input;

fn page_of(params: &HtmlParams, input: HtmlInput) -> String {
    String::from_utf8(Html::run(params, input, &Ctx::alone()).unwrap().bytes).unwrap()
}

fn page(params: &HtmlParams) -> String {
    page_of(params, input())
}

fn blurred() -> HtmlParams {
    HtmlParams {
        blur_face: true,
        ..HtmlParams::default()
    }
}

/// The pictures in a page, as files, but for the body's drawn sides, in which nothing of a photo is.
fn pictures(page: &str) -> Vec<Vec<u8>> {
    let (before, sides) = page.split_once("<svg class=\"sides\"").unwrap();
    let page = before.to_owned() + sides.split_once("</svg>").unwrap().1;
    let value = |c: u8| match c {
        b'A'..=b'Z' => c - b'A',
        b'a'..=b'z' => c - b'a' + 26,
        b'0'..=b'9' => c - b'0' + 52,
        b'+' => 62,
        _ => 63,
    };
    let decoded = |text: &str| {
        let digits: Vec<u8> = text.bytes().filter(|c| *c != b'=').map(value).collect();
        let four = |d: &[u8]| {
            let bits = d.iter().fold(0u32, |b, d| b << 6 | u32::from(*d)) << (6 * (4 - d.len()));
            bits.to_be_bytes()[1..d.len()].to_vec()
        };
        digits.chunks(4).flat_map(four).collect()
    };
    let mark = "data:image/jpeg;base64,";
    let texts = page.split(mark).skip(1);
    texts
        .map(|t| decoded(t.split('"').next().unwrap()))
        .collect()
}

#[test]
fn a_first_answer_is_marked_as_one() {
    let of = |answer| {
        page(&HtmlParams {
            answer,
            ..HtmlParams::default()
        })
    };
    let banner = "First answer from the coarse surface";
    assert!(!of(Answer::Full).contains(banner));
    assert!(of(Answer::First).contains(banner));
    assert!(of(Answer::Followed).contains("the full one follows"));
    assert!(of(Answer::Unfinished).contains("the full one failed or was stopped"));
}

#[test]
fn the_page_is_whole_and_asks_for_nothing_from_outside() {
    let page = page(&HtmlParams::default());
    if let Ok(path) = std::env::var("TAILOR_KEEP_PAGE") {
        std::fs::write(path, &page).unwrap();
    }
    for wanted in [
        "50.2",
        "50.0 – 50.5",
        "there is no neck",
        "waist &lt;natural&gt;",
        "0002.jpg",
        "the marker mat on the disk",
        "<!--provenance-->",
        "<!--warnings-->",
    ] {
        assert!(page.contains(wanted), "{wanted}");
    }
    assert!(!page.contains("{{"), "a slot was left open");
    let own = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!own.contains("http:") && !own.contains("https:") && !own.contains("src=\"/"));
}

#[test]
fn without_photos_no_pixel_of_them_is_in_it_but_the_outlines_are() {
    let mut input = input();
    input.textured = Some(Arc::new(painted_body()));
    let params = HtmlParams {
        photos: false,
        ..HtmlParams::default()
    };
    let page = page_of(&params, input);
    assert!(pictures(&page).is_empty() && page.contains("The photos were left out"));
    assert_eq!(page.matches("class=\"outline\"").count(), 3);
}

#[test]
fn no_metadata_of_a_photo_is_in_it() {
    let mut input = input();
    let mut photos = (**input.photos.as_ref().unwrap()).clone();
    for photo in &mut photos.photos {
        // An APP1 segment after the start of the image, as cameras write it.
        let secret = b"Exif\0\0GPS 52.5163N 13.3777E";
        let mut file = photo.file[..2].to_vec();
        file.extend([0xff, 0xe1, 0, secret.len() as u8 + 2]);
        file.extend(secret);
        file.extend(&photo.file[2..]);
        photo.file = file.into();
    }
    photos.photos[0].decode().unwrap();
    input.photos = Some(Arc::new(photos));
    let pictures = pictures(&page_of(&HtmlParams::default(), input));
    assert_eq!(pictures.len(), 3);
    for file in pictures {
        assert_eq!(file[..2], [0xff, 0xd8], "a JPEG");
        assert!(!file.windows(4).any(|w| w == b"Exif" || w == b"GPS "));
    }
}

#[test]
fn a_face_is_blurred_where_the_head_is_and_nowhere_else() {
    let mut input = input();
    // Stripes one pixel wide, of which no block is left.
    let mut stripes = Rgb::filled(120, 180, [0; 3]);
    for (y, x) in (0..180).flat_map(|y| (0..120).map(move |x| (y, x))) {
        *stripes.at_mut(x, y) = [if x / 4 % 2 == 0 { 0 } else { 255 }; 3];
    }
    let mut photos = (**input.photos.as_ref().unwrap()).clone();
    for photo in &mut photos.photos {
        photo.file = rgb_to_jpeg(&stripes, 95).into();
    }
    input.photos = Some(Arc::new(photos));
    let part = |p: &[f32; 3]| if p[2] > 320.0 { Part::Head } else { Part::Trunk } as u8;
    input.landmarks = Some(Arc::new(Landmarks {
        parts: input.body.positions.iter().map(part).collect(),
        ..Landmarks::default()
    }));
    let camera = input
        .cameras
        .as_ref()
        .unwrap()
        .views
        .get(PhotoId(0))
        .unwrap()
        .camera;
    let at = |z: f64| camera.project(&nalgebra::Point3::new(0.0, 0.0, z)).unwrap();
    let (head, waist) = (at(360.0), at(150.0));
    let contrast = |gray: &Mask, at: nalgebra::Point2<f64>| {
        let row = &gray.row(at.y as usize)[at.x as usize - 5..at.x as usize + 5];
        row.iter().max().unwrap() - row.iter().min().unwrap()
    };
    for file in pictures(&page_of(&blurred(), input)) {
        let gray = shape::gray_from_file(&file).unwrap();
        assert!(contrast(&gray, head) < 90, "{}", contrast(&gray, head));
        assert!(contrast(&gray, waist) > 200);
    }
}

#[test]
fn a_photo_whose_face_cannot_be_found_is_left_out_when_faces_are_blurred() {
    let mut input = input();
    let mut cameras = (**input.cameras.as_ref().unwrap()).clone();
    let kept = cameras.views.iter().filter(|(id, _)| id.0 != 1);
    cameras.views = kept.map(|(id, v)| (id, v.clone())).collect();
    input.cameras = Some(Arc::new(cameras));
    let page = page_of(&blurred(), input);
    assert_eq!(pictures(&page).len(), 2);
    assert!(page.contains("Photos without a camera, not used: 0001.jpg"));
}

/// The body with an atlas of one colour.
fn painted_body() -> Textured {
    let mesh = (*input().body).clone();
    let corner = |v: u32| {
        [
            (v % 48) as f32 / 48.0,
            mesh.positions[v as usize][2] / 400.0,
        ]
    };
    Textured {
        corners: mesh.faces.iter().map(|f| f.map(corner)).collect(),
        atlas: Rgb::filled(96, 80, [200, 30, 30]),
        mesh,
    }
}

#[test]
fn a_texture_is_shown_first_and_loses_the_face_when_faces_are_blurred() {
    let with = |params: &HtmlParams| {
        let mut input = input();
        input.textured = Some(Arc::new(painted_body()));
        let page = page_of(params, input);
        assert!(page.find("body in colours") < page.find("\"label\":\"body\""));
        shape::gray_from_file(pictures(&page).last().unwrap()).unwrap()
    };
    let (open, hidden) = (with(&HtmlParams::default()), with(&blurred()));
    assert_eq!((open.width, open.height), (96, 80));
    // The upper 30 % of the tube counts as head where nothing is known of a neck.
    for x in [20, 50, 80] {
        assert!(open.at(x, 75).abs_diff(open.at(x, 10)) < 8);
        assert!(
            hidden.at(x, 75).abs_diff(128) < 8 && hidden.at(x, 10).abs_diff(open.at(x, 10)) < 8
        );
    }
}

#[test]
fn a_body_without_an_atlas_is_painted_by_the_photos_unless_they_stay_out() {
    let unpainted = HtmlParams {
        paint: false,
        ..HtmlParams::default()
    };
    let without = HtmlParams {
        photos: false,
        ..HtmlParams::default()
    };
    let painted = |params: &HtmlParams| page(params).contains("\"colors\":");
    assert!(painted(&HtmlParams::default()) && !painted(&unpainted) && !painted(&without));
    let mut input = input();
    input.textured = Some(Arc::new(painted_body()));
    assert!(!page_of(&HtmlParams::default(), input).contains("\"colors\":"));
}

#[test]
fn surfaces_that_are_equal_share_a_button_and_optional_ones_get_theirs() {
    let mut input = input();
    input.rigid = Some(Arc::new((*input.body).clone()));
    input.weighted_median = Some(Arc::new(Mesh {
        faces: input.body.faces[..900].to_vec(),
        ..(*input.body).clone()
    }));
    let page = page_of(&HtmlParams::default(), input);
    for label in ["body = rigid", "weighted median", "visual hull"] {
        assert!(page.contains(&format!("\"label\":\"{label}\"")), "{label}");
    }
    assert!(!page.contains("\"label\":\"rigid\""));
}

#[test]
fn what_is_missing_for_one_reason_is_named_once() {
    let mut input = input();
    let missing = &mut Arc::make_mut(&mut input.girths).missing;
    let why = missing[0].why.to_string();
    missing.push(Missing::because(GirthId::Chest, Refusal::NoNeck, &why));
    let page = page_of(&HtmlParams::default(), input);
    assert!(page.contains("<li><b>neck, chest</b> (NC, CC): there is no neck</li>"));
}

#[test]
fn a_fine_surface_and_many_photos_stay_light() {
    let mut input = input();
    input.body = Arc::new(tube::tube(80.0, 400.0, 800, 400));
    let mut photos = (**input.photos.as_ref().unwrap()).clone();
    photos.photos = (0..90).map(|i| photos.photos[i % 3].clone()).collect();
    let noise = |i: usize| ((i * 2_654_435_761) >> 7) as u8;
    let pixels = Rgb {
        width: 600,
        height: 900,
        data: (0..600 * 900).map(|i| [noise(i); 3]).collect(),
    };
    for photo in &mut photos.photos {
        (photo.width, photo.height) = (600, 900);
        photo.file = rgb_to_jpeg(&pixels, 80).into();
    }
    input.photos = Some(Arc::new(photos));
    let page = page_of(&HtmlParams::default(), input);
    assert!(page.len() < 15_000_000, "{}", page.len());
    assert_eq!(pictures(&page).len(), 90);
}

#[test]
fn equal_input_gives_equal_bytes() {
    let params = HtmlParams::default();
    assert_eq!(page(&params), page(&params));
}
