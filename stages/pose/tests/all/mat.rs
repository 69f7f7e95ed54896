//! A mat that is printed is found again where it was printed.

use pose::{
    FindTags, LayoutError, Mark, Paper, Piece, TagsInput, TagsParams, mat_corners, mat_for,
    mat_marks, rim_for, rim_pieces, tiles, to_pdf, to_svg,
};
use shape::{Gray, Photo, PhotoId, Photos, gray_to_png};
use stage::{Ctx, Stage};
use std::sync::Arc;

/// Whether a point is in a convex polygon.
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
    let photo = Photo::of("above.png", [size as u32, size as u32], bytes);
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
            let off = libm::hypot(at[0] - got[0], at[1] - got[1]);
            assert!(off < 0.7, "tag {}: {off} px", tag.id);
        }
    }
}

#[test]
fn the_mats_of_usual_disks_fit_and_impossible_ones_are_refused() {
    for disk in [300.0, 450.0, 700.0, 1000.0] {
        let mat = mat_for(disk, 0.0, 0, 0).unwrap();
        assert!(mat.count >= 12, "{disk}: {mat:?}");
        for id in 0..mat.count {
            for corner in mat_corners(&mat, id).unwrap() {
                assert!(libm::hypot(corner.x, corner.y) < disk / 2.0);
            }
        }
    }
    let crowded = mat_for(300.0, 100.0, 16, 0).unwrap_err();
    assert!(matches!(crowded, LayoutError::Crowded { count: 16, .. }));
    let beyond = mat_for(700.0, 60.0, 12, 580).unwrap_err();
    assert!(matches!(beyond, LayoutError::Beyond(591)));
}

#[test]
fn pages_cover_the_mat_at_true_scale() {
    let paper = Paper {
        size_mm: [210.0, 297.0],
        margin_mm: 10.0,
    };
    let (corners, area) = tiles(700.0, &paper);
    for k in 0..360 {
        let (sin, cos) = libm::sincos(f64::from(k) * 0.01745);
        let covers = |c: &[f64; 2]| {
            let (x, y) = (350.0 * cos - c[0], 350.0 * sin - c[1]);
            x > 0.0 && y > 0.0 && x < area[0] && y < area[1]
        };
        assert!(corners.iter().any(covers));
    }
    let mat = mat_for(700.0, 0.0, 0, 0).unwrap();
    let marks = mat_marks(&mat, 700.0, true);
    let pdf = to_pdf(&marks, 700.0, &paper, "[mat]\nids = [0, 11]\n", &[]);
    let pdf = String::from_utf8_lossy(&pdf);
    assert!(pdf.starts_with("%PDF-1.") && pdf.trim_end().ends_with("%%EOF"));
    assert_eq!(pdf.matches("/Type /Page\n").count(), corners.len());
    assert!(pdf.contains("/EmbeddedFile") && pdf.contains("stream\n[mat]\nids = [0, 11]\n"));
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
        let pdf = to_pdf(&marks, 450.0, &paper, "note", pieces);
        String::from_utf8_lossy(&pdf)
            .matches("/Type /Page\n")
            .count()
    };
    let a_page = (297.0f64 - 20.0 - 14.0 + 6.0) / (pieces[0].size_mm[1] + 6.0);
    assert_eq!(
        pages(&pieces) - pages(&[]),
        pieces.len().div_ceil(a_page as usize)
    );
}

#[test]
fn an_impossible_strip_is_refused() {
    let thin = rim_for(450.0, 20.0, 18.0, 0, 12).unwrap_err();
    assert!(matches!(thin, LayoutError::Thin { .. }), "{thin}");
    let many = rim_for(450.0, 40.0, 32.0, 80, 12).unwrap_err();
    assert!(
        matches!(many, LayoutError::CrowdedRim { most: 35, .. }),
        "{many}"
    );
    let beyond = rim_for(450.0, 40.0, 20.0, 40, 560).unwrap_err();
    assert!(matches!(beyond, LayoutError::Beyond(599)));
}
