//! The stage that lays out a marker mat for a disk.

use crate::mat::layout::{mat_for, mat_marks, mat_toml};
use crate::mat::pages::{Paper, to_pdf, to_svg};
use crate::mat::rim_layout::{rim_for, rim_pieces, rim_toml};
use shape::Document;
use stage::{Ctx, Stage, Stop};

stage::choice! {
    /// What the mat is written as.
    pub enum Print {
        /// Pages at true scale.
        Pdf = "pdf",
        /// One drawing at true scale.
        Svg = "svg",
    }
}

stage::choice! {
    /// The paper it is printed on.
    pub enum Sheet {
        /// 210 × 297 mm.
        A4 = "a4",
        /// 297 × 420 mm.
        A3 = "a3",
        /// 215.9 × 279.4 mm.
        Letter = "letter",
        /// One page as large as the mat, for a print shop.
        Whole = "whole",
    }
}

stage::params! {
    /// The disk, the tags, the paper.
    pub struct MatParams {
        /// The disk's diameter.
        #[range(100.0..=3000.0)]
        #[source(structural)]
        diameter_mm: f64 = 700.0,
        /// Edge length of a tag's black square; 0 for one that suits the disk.
        #[range(0.0..=500.0)]
        #[source(structural)]
        tag_mm: f64 = 0.0,
        /// How many tags; 0 for as many as fit.
        #[range(0..=200)]
        #[source(structural)]
        count: u32 = 0,
        /// The first tag's number.
        #[range(0..=586)]
        #[source(structural)]
        first_id: u32 = 0,
        /// Whether dots between the tags give photos more to hold on to.
        dots: bool = true,
        /// How thick the disk is, where its rim is to have tags, too; 0 for none.
        #[range(0.0..=1000.0)]
        #[source(structural)]
        rim_mm: f64 = 0.0,
        /// Edge length of a rim tag's black square; 0 for as tall as the rim allows.
        #[range(0.0..=500.0)]
        #[source(structural)]
        rim_tag_mm: f64 = 0.0,
        /// How many tags go around the rim; 0 for as many as fit, at most 48.
        #[range(0..=500)]
        #[source(structural)]
        rim_count: u32 = 0,
        /// What it is written as.
        print: Print = Print::Pdf,
        /// The paper it is printed on.
        sheet: Sheet = Sheet::A4,
    }
}

stage::inputs! {
    /// A mat needs no inputs.
    pub struct MatInput {}
}

/// `pose.mat`: nothing → a document.
pub struct PrintMat;

impl Stage for PrintMat {
    const NAME: &'static str = "pose.mat";
    const VERSION: u32 = 5;
    const ABOUT: &'static str = "Lays out a marker mat (AprilTag 36h11) for a disk, and a strip for its rim, to be printed at true scale.";
    type Params = MatParams;
    type Input = MatInput;
    type Output = Document;
    const METRICS: &'static [&'static str] = &[
        "tags",
        "tag size",
        "ring radius",
        "tags on the rim",
        "their size",
    ];

    fn run(p: &MatParams, _: MatInput, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        let mat = mat_for(p.diameter_mm, p.tag_mm, p.count, p.first_id)?;
        let marks = mat_marks(&mat, p.diameter_mm, p.dots);
        let mut note = mat_toml(&mat, p.diameter_mm);
        let rim = match p.rim_mm > 0.0 {
            true => Some(rim_for(
                p.diameter_mm,
                p.rim_mm,
                p.rim_tag_mm,
                p.rim_count,
                mat.first_id + mat.count,
            )?),
            false => None,
        };
        if let Some(rim) = &rim {
            note.push_str(&rim_toml(rim));
            ctx.metric("tags on the rim", f64::from(rim.count), "");
            ctx.metric("their size", rim.tag_mm, "mm");
        }
        let pieces = |widest_mm: f64| {
            let of = |rim| rim_pieces(rim, p.rim_mm, widest_mm);
            rim.as_ref().map(of).unwrap_or_default()
        };
        ctx.metric("tags", f64::from(mat.count), "");
        ctx.metric("tag size", mat.tag_mm, "mm");
        ctx.metric("ring radius", mat.ring_mm, "mm");
        let paper = |w: f64, h: f64| Paper {
            size_mm: [w, h],
            margin_mm: 10.0,
        };
        let whole = p.diameter_mm + 40.0;
        let (media, bytes) = match p.print {
            Print::Svg => (
                "image/svg+xml",
                to_svg(&marks, p.diameter_mm, &note, &pieces(p.diameter_mm)).into_bytes(),
            ),
            Print::Pdf => {
                let paper = match p.sheet {
                    Sheet::A4 => paper(210.0, 297.0),
                    Sheet::A3 => paper(297.0, 420.0),
                    Sheet::Letter => paper(215.9, 279.4),
                    Sheet::Whole => paper(whole, whole + 20.0),
                };
                (
                    "application/pdf",
                    to_pdf(
                        &marks,
                        p.diameter_mm,
                        &paper,
                        &note,
                        &pieces(paper.size_mm[0] - 2.0 * paper.margin_mm),
                    ),
                )
            }
        };
        Ok(Document {
            media: media.into(),
            bytes,
        })
    }
}
