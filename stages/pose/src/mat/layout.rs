//! What is printed on a marker mat: tags in a ring, dots within, and how to describe it to `tailor`.

use crate::mat::corners::mat_corners;
use nalgebra::Vector2;
use shape::Mat;
use shape::tag36h11::{TAGS, modules};

/// A shape on the mat; x to the right, y up, the mat's centre at (0, 0). \[mm\]
#[derive(Debug, Clone, PartialEq)]
pub enum Mark {
    /// A filled polygon; grey from 0, black, to 1.
    Fill(Vec<[f64; 2]>, f64),
    /// A filled disk: centre, radius, grey.
    Dot([f64; 2], f64, f64),
    /// A circle's line: radius.
    Circle(f64),
    /// A thin line through places.
    Line(Vec<[f64; 2]>),
    /// Words: where they begin, their height, the words.
    Words([f64; 2], f64, String),
}

stage::failures! {
    /// A mat that cannot be laid out.
    pub enum LayoutError {
        /// Tags do not fit.
        Crowded {
            /// How many.
            count: u32,
            /// How large. \[mm\]
            tag_mm: f64,
            /// On what. \[mm\]
            disk_mm: f64,
            /// How many would fit.
            most: u32,
        } = "fail-mat-crowded": "{count} tags of {tag_mm} mm do not fit on a disk of {disk_mm} mm: at most {most} do; take fewer or smaller ones",
        /// Tags are too tall for the rim, or too small to be seen.
        Thin {
            /// How large. \[mm\]
            tag_mm: f64,
            /// On what. \[mm\]
            thick_mm: f64,
        } = "fail-mat-thin": "tags of {tag_mm} mm do not fit on a rim of {thick_mm} mm: they need a white margin of an eighth of their size all around, at least 5 mm, and may span a third of the disk's radius at most",
        /// Tags do not go around the rim.
        CrowdedRim {
            /// How many.
            count: u32,
            /// How many would.
            most: u32,
        } = "fail-mat-rim": "{count} tags do not go around the rim: at least 3 and at most {most} do",
        /// The family ends.
        Beyond(id: u32) = "fail-mat-beyond": "the family 36h11 has tags 0 to 586: {id} is beyond",
    }
}

/// The mat for a disk: tags as large as leaves a dozen or more on a ring near the disk's edge. A
/// tag size or count of 0 is chosen.
///
/// # Errors
///
/// Fewer than three tags, more than fit on the disk, or numbers beyond the family.
pub fn mat_for(disk_mm: f64, tag_mm: f64, count: u32, first_id: u32) -> Result<Mat, LayoutError> {
    let tag_mm = if tag_mm > 0.0 {
        tag_mm
    } else {
        (disk_mm * 0.085 / 5.0).round().max(2.0) * 5.0
    };
    let module = tag_mm / 8.0;
    let reach = tag_mm / 2.0 + module;
    let ring_mm = (((disk_mm / 2.0 - 2.0).powi(2) - reach * reach)
        .max(0.0)
        .sqrt()
        - reach)
        .floor();
    // Neighbours touch first at their inner corners.
    let inner = ring_mm - reach;
    let most = if inner > reach {
        (std::f64::consts::PI / libm::atan(reach / inner)).floor() as u32
    } else {
        0
    };
    let chosen = if count > 0 {
        count
    } else {
        (most & !1).min(24)
    };
    if chosen < 3 || chosen > most {
        return Err(LayoutError::Crowded {
            count: chosen,
            tag_mm,
            disk_mm,
            most,
        });
    }
    if first_id + chosen > TAGS {
        return Err(LayoutError::Beyond(first_id + chosen - 1));
    }
    Ok(Mat {
        tag_mm,
        first_id,
        count: chosen,
        ring_mm,
    })
}

/// `capture.toml` on a mat and of the disk that it is for.
pub fn mat_toml(mat: &Mat, disk_mm: f64) -> String {
    let (tag, ring) = (mat.tag_mm, mat.ring_mm);
    let (last, disk_cm) = (mat.first_id + mat.count - 1, disk_mm / 10.0);
    format!(
        "[mat]\nfamily = \"tag36h11\"\ntag_size_mm = {tag:?}\nids = [{}, {last}]\ncount = {}\nring_radius_mm = {ring:?}\n\
         [disk]\ndiameter_cm = {disk_cm:?}\n",
        mat.first_id, mat.count
    )
}

/// One tag's black modules; each run of a row is one rectangle.
fn tag(mat: &Mat, id: u32) -> Option<Vec<Mark>> {
    let corners = mat_corners(mat, id)?.map(|c| Vector2::new(c.x, c.y));
    let [left, right, _, below] = corners;
    let (x, y) = ((right - left) / 8.0, (below - left) / 8.0);
    let corner = |[c, r]: [usize; 2]| (left + x * c as f64 + y * r as f64).into();
    let fill = |around: [[usize; 2]; 4]| Mark::Fill(around.map(corner).into(), 0.0);
    Some(black(id)?.into_iter().map(fill).collect())
}

/// A tag's black rectangles, one for each run of a row: corners in modules, column and row.
pub(crate) fn black(id: u32) -> Option<Vec<[[usize; 2]; 4]>> {
    let mut all = Vec::new();
    for (r, row) in modules(id)?.iter().enumerate() {
        let mut at = 0;
        while at < 8 {
            if row[at] {
                at += 1;
                continue;
            }
            let end = (at..8).find(|c| row[*c]).unwrap_or(8);
            all.push([[at, r], [end, r], [end, r + 1], [at, r + 1]]);
            at = end;
        }
    }
    Some(all)
}

/// All that is printed. `dots` a tenth of the inner area's worth of features, the same for the same
/// mat, so that photos have more to hold on to.
pub fn mat_marks(mat: &Mat, disk_mm: f64, dots: bool) -> Vec<Mark> {
    let mut marks = vec![Mark::Circle(disk_mm / 2.0)];
    for id in mat.first_id..mat.first_id + mat.count {
        marks.extend(tag(mat, id).unwrap_or_default());
    }
    let inner = mat.ring_mm - mat.tag_mm * 0.75;
    if dots && inner > 30.0 {
        let mut state = 0x2545_F491_4F6C_DD1D_u64;
        let mut unit = || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let count = ((inner / 9.0).powi(2) as usize).min(2500);
        for _ in 0..count {
            let (radius, angle) = (inner * unit().sqrt(), unit() * std::f64::consts::TAU);
            let (size, grey) = (1.5 + 3.0 * unit(), 0.7 * unit());
            if radius + size < inner && radius > 8.0 {
                let (sin, cos) = libm::sincos(angle);
                marks.push(Mark::Dot([radius * cos, radius * sin], size, grey));
            }
        }
    }
    // The centre, and the first tag's direction.
    for (x, y) in [(5.0, 0.3), (0.3, 5.0)] {
        marks.push(Mark::Fill(vec![[-x, -y], [x, -y], [x, y], [-x, y]], 0.0));
    }
    marks
}
