//! A mat that is printed is found again where it was printed.

use pose::{
    FindTags, LayoutError, Mark, Paper, Piece, TagsInput, TagsParams, mat_corners, mat_for,
    mat_marks, rim_for, rim_pieces, tiles, to_pdf, to_svg,
};
use shape::{Gray, Photo, PhotoId, Photos, gray_to_png};
use stage::{Ctx, Stage};
use std::sync::Arc;

/// Whether a point lies in a convex polygon.
fn within(corners: &[[f64; 2]], x: f64, y: f64) -> bool {
    let side = |i: usize| {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
    };
    (0..corners.len()).all(|i| side(i) >= 0.0) || (0..corners.len()).all(|i| side(i) <= 0.0)
}

#[test]
fn tags_are_found_where_they_were_printed() {
    let mat = mat_for(450.0, 0.0, 0, 20).unwrap();
    let fills: Vec<(Vec<[f64; 2]>, [f64; 4])> = mat_marks(&mat, 450.0, false)
        .into_iter()
        .filter_map(|mark| match mark {
            Mark::Fill(corners, _) => {
                let (x, y): (Vec<f64>, Vec<f64>) = corners.iter().map(|c| (c[0], c[1])).unzip();
                let most = |v: &[f64]| v.iter().copied().fold(f64::MIN, f64::max);
                let least = |v: &[f64]| v.iter().copied().fold(f64::MAX, f64::min);
                Some((corners, [least(&x), most(&x), least(&y), most(&y)]))
            }
            _ => None,
        })
        .collect();
    // From above: 2 pixels a millimetre, y down.
    let (size, scale) = (940, 2.0);
    let mut light = Gray::filled(size, size, 235.0);
    for (corners, [x0, x1, y0, y1]) in &fills {
        let px = |v: f64| (v * scale + size as f64 / 2.0) as usize;
        for row in px(-y1) - 1..=px(-y0) + 1 {
            for column in px(*x0) - 1..=px(*x1) + 1 {
                let hits = (0..16).filter(|s| {
                    let x = (column as f64 + f64::from(s % 4) / 4.0 - 0.375 - size as f64 / 2.0)
                        / scale;
                    let y =
                        (row as f64 + f64::from(s / 4) / 4.0 - 0.375 - size as f64 / 2.0) / scale;
                    within(corners, x, -y)
                });
                *light.at_mut(column, row) -= 215.0 * hits.count() as f32 / 16.0;
            }
        }
    }
    let bytes = gray_to_png(&light.map(|v| v.round().clamp(0.0, 255.0) as u8));
    let photo = Photo {
        name: "above.png".into(),
        width: size as u32,
        height: size as u32,
        orientation: 1,
        focal_35mm: None,
        device: String::new(),
        time_s: None,
        file: bytes.into(),
    };
    let mut photos = Photos {
        photos: vec![photo],
        ..Photos::default()
    };
    photos.rig.mat = Some(mat);
    let input = TagsInput {
        photos: Arc::new(photos),
    };
    let found = FindTags::run(&TagsParams::default(), input, &Ctx::alone()).unwrap();
    let tags = found.views.get(PhotoId(0)).unwrap();
    assert_eq!(tags.len(), mat.count as usize);
    for tag in tags {
        for (want, got) in mat_corners(&mat, tag.id).unwrap().iter().zip(tag.corners) {
            let at = [want.x, -want.y].map(|v| v * scale + size as f64 / 2.0);
            let off = (at[0] - got[0]).hypot(at[1] - got[1]);
            assert!(off < 0.7, "tag {}: {off} px", tag.id);
        }
    }
}

#[test]
fn the_mats_of_usual_disks_fit_and_impossible_ones_say_so() {
    for disk in [300.0, 450.0, 700.0, 1000.0] {
        let mat = mat_for(disk, 0.0, 0, 0).unwrap();
        assert!(mat.count >= 12, "{disk}: {mat:?}");
        for id in 0..mat.count {
            for corner in mat_corners(&mat, id).unwrap() {
                assert!(corner.x.hypot(corner.y) < disk / 2.0);
            }
        }
    }
    let crowded = mat_for(300.0, 100.0, 16, 0).unwrap_err();
    assert!(matches!(crowded, LayoutError::Crowded { count: 16, .. }));
    assert_eq!(mat_for(700.0, 60.0, 12, 580), Err(LayoutError::Beyond(591)));
}

#[test]
fn pages_cover_the_mat_at_true_scale() {
    let paper = Paper {
        size_mm: [210.0, 297.0],
        margin_mm: 10.0,
    };
    let (corners, room) = tiles(700.0, &paper);
    for k in 0..360 {
        let (sin, cos) = (f64::from(k) * 0.01745).sin_cos();
        let covers = |c: &[f64; 2]| {
            let (x, y) = (350.0 * cos - c[0], 350.0 * sin - c[1]);
            x > 0.0 && y > 0.0 && x < room[0] && y < room[1]
        };
        assert!(corners.iter().any(covers));
    }
    let mat = mat_for(700.0, 0.0, 0, 0).unwrap();
    let marks = mat_marks(&mat, 700.0, true);
    let pdf = String::from_utf8(to_pdf(&marks, 700.0, &paper, "note", &[])).unwrap();
    assert!(pdf.starts_with("%PDF-1.4") && pdf.ends_with("%%EOF\n"));
    assert_eq!(pdf.matches("/Type /Page ").count(), corners.len());
    let table: usize = pdf
        .rsplit("startxref\n")
        .next()
        .unwrap()
        .lines()
        .next()
        .unwrap()
        .parse()
        .unwrap();
    assert!(pdf[table..].starts_with("xref"));
    let svg = to_svg(&marks, 700.0, "note\n", &[]);
    assert!(svg.contains("width=\"704mm\"") && svg.contains("viewBox=\"-352 -352 704 704\""));
}

#[test]
fn a_strip_goes_once_around_the_rim_in_pieces_that_fit_a_page() {
    let rim = rim_for(450.0, 40.0, 0.0, 0, 12).unwrap();
    assert_eq!((rim.tag_mm, rim.first_id, rim.radius_mm), (32.0, 12, 225.0));
    let pieces = rim_pieces(&rim, 40.0, 190.0);
    let (mut around, mut black) = (0.0, 0);
    for piece in &pieces {
        assert!(piece.size_mm[0] <= 190.0);
        let mut right = 0.0f64;
        for mark in &piece.marks {
            match mark {
                Mark::Line(at) if at.len() == 2 => around += at[0][0],
                Mark::Fill(corners, _) => {
                    black += 1;
                    for [x, y] in corners {
                        right = right.max(*x);
                        assert!((4.0 - 1e-9..=36.0 + 1e-9).contains(y), "{y}");
                    }
                }
                _ => {}
            }
        }
        // A module and more of white on both sides.
        assert!(right < piece.size_mm[0] - 8.0 - 4.0);
    }
    assert!(
        (around - 450.0 * std::f64::consts::PI).abs() < 1e-6,
        "{around}"
    );
    assert!(black > 8 * rim.count as usize);
    let paper = Paper {
        size_mm: [210.0, 297.0],
        margin_mm: 10.0,
    };
    let mat = mat_for(450.0, 0.0, 12, 0).unwrap();
    let marks = mat_marks(&mat, 450.0, false);
    let pages = |pieces: &[Piece]| {
        let pdf = String::from_utf8(to_pdf(&marks, 450.0, &paper, "note", pieces)).unwrap();
        pdf.matches("/Type /Page ").count()
    };
    let a_page = (297.0f64 - 20.0 - 14.0 + 6.0) / (pieces[0].size_mm[1] + 6.0);
    assert_eq!(
        pages(&pieces) - pages(&[]),
        pieces.len().div_ceil(a_page as usize)
    );
}

#[test]
fn a_strip_that_cannot_be_says_so() {
    let thin = rim_for(450.0, 20.0, 18.0, 0, 12).unwrap_err();
    assert!(matches!(thin, LayoutError::Thin { .. }), "{thin}");
    let many = rim_for(450.0, 40.0, 32.0, 80, 12).unwrap_err();
    assert!(
        matches!(many, LayoutError::CrowdedRim { most: 35, .. }),
        "{many}"
    );
    assert_eq!(
        rim_for(450.0, 40.0, 20.0, 40, 560),
        Err(LayoutError::Beyond(599))
    );
}

/// A mat's tags as a camera sees them on some photos of a turn, corners off by a little noise.
fn seen(mat: &shape::Mat, noise_px: f64) -> shape::Tags {
    use nalgebra::{Rotation3, Vector3};
    let mut dice = proof::Dice(5);
    let view = |i: u32, dice: &mut proof::Dice| {
        let camera = shape::Camera {
            lens: shape::Intrinsics::simple(1600, 2400, 3300.0),
            pose: shape::Pose {
                rotation: Rotation3::from_euler_angles(1.85, 0.01, 0.0)
                    * Rotation3::from_euler_angles(0.0, 0.0, 0.35 * f64::from(i)),
                translation: Vector3::new(5.0, 340.0, 1770.0),
            },
        };
        let tag = |id: u32| {
            let corners = mat_corners(mat, id)?;
            // Behind the body no tag is seen.
            let middle = camera.pose.apply(&corners[0]);
            (middle.z < 1790.0).then_some(())?;
            let corners = corners.map(|c| {
                let at = camera.project(&c).unwrap();
                let mut off = || dice.within(-noise_px, noise_px);
                [at.x + off(), at.y + off()]
            });
            Some(shape::Tag { id, corners })
        };
        let ids = mat.first_id..mat.first_id + mat.count;
        (PhotoId(i), ids.filter_map(tag).collect())
    };
    shape::Tags {
        views: (0..18).map(|i| view(i, &mut dice)).collect(),
    }
}

#[test]
fn a_mat_of_ours_is_recognised_from_the_size_of_its_tags_and_another_is_not() {
    for (disk, tag, count, first) in [
        (450.0, 0.0, 0, 0),
        (700.0, 60.0, 16, 20),
        (500.0, 42.0, 12, 3),
    ] {
        let printed = mat_for(disk, tag, count, first).unwrap();
        // A printer that shrinks by 0.7 %.
        let mat = shape::Mat {
            tag_mm: printed.tag_mm * 0.993,
            ring_mm: printed.ring_mm * 0.993,
            ..printed
        };
        let tags = seen(&mat, 0.1);
        let found = pose::recognised(&tags, mat.tag_mm, Some(disk), |_| {}).unwrap();
        assert_eq!(
            (found.first_id, found.count),
            (first, printed.count),
            "{disk}"
        );
        proof::near(found.ring_mm, mat.ring_mm, 1e-9);
        // Without the disk the ring is told to whole millimetres, and that is said.
        let told = std::cell::RefCell::new(String::new());
        let found = pose::recognised(&tags, mat.tag_mm, None, |w| *told.borrow_mut() = w.into());
        proof::near(found.unwrap().ring_mm, mat.ring_mm, 1.01);
        assert_eq!(
            told.borrow().contains("to within 1 mm"),
            printed.ring_mm > 200.0,
            "{}",
            told.borrow()
        );
    }
    let odd = shape::Mat {
        tag_mm: 60.0,
        first_id: 0,
        count: 12,
        ring_mm: 150.5,
    };
    let told = std::cell::RefCell::new(String::new());
    // Half a millimetre is 3.3 ‰ of this ring.
    assert_eq!(
        pose::recognised(&seen(&odd, 0.02), 60.0, None, |w| *told.borrow_mut() =
            w.into()),
        None
    );
    assert!(
        told.borrow().contains("with a radius of 150."),
        "{}",
        told.borrow()
    );
}

/// The sample's tags, though nobody tells of them.
fn sample() -> (shape::Tags, Vec<String>) {
    let folder =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/mannequin/images");
    let photo = |i: usize| {
        let name = format!("{i:04}.jpg");
        let file = std::fs::read(folder.join(&name)).unwrap();
        Photo {
            name,
            width: 800,
            height: 1200,
            orientation: 1,
            focal_35mm: None,
            device: String::new(),
            time_s: None,
            file: file.into(),
        }
    };
    let photos = Photos {
        photos: (0..18).step_by(2).map(photo).collect(),
        ..Photos::default()
    };
    let input = TagsInput {
        photos: Arc::new(photos),
    };
    let heard = Heard::default();
    let nothing = stage::hash(b"");
    let tags = FindTags::run(
        &TagsParams::default(),
        input,
        &Ctx::new(&heard, nothing, nothing),
    );
    (tags.unwrap(), heard.0.into_inner().unwrap())
}

#[derive(Default)]
struct Heard(std::sync::Mutex<Vec<String>>);

impl stage::Host for Heard {
    fn warn(&self, text: &str) {
        self.0.lock().unwrap().push(text.into());
    }
}

#[test]
fn tags_that_nobody_told_of_are_told_and_their_layout_follows_from_one_size() {
    let (tags, told) = sample();
    assert_eq!(told.len(), 1, "{told:?}");
    for says in [
        "numbers 0 to 11",
        "9 of 9 photos that were searched",
        "12 tags on a ring of 3.1",
        "--mat-tag",
    ] {
        assert!(told[0].contains(says), "{says}: {told:?}");
    }
    let ring = pose::ringed(&tags).unwrap();
    proof::near(ring.ring, 187.0 / 60.0, 0.0025 * ring.ring);
    let mat = pose::recognised(&tags, 60.0, None, |_| {}).unwrap();
    assert_eq!((mat.first_id, mat.count, mat.ring_mm), (0, 12, 187.0));
}
