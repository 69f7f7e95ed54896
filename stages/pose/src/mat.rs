//! The stage that lays out a marker mat for a disk.

use crate::mat_layout::{mat_for, mat_marks, mat_toml};
use crate::mat_print::{Paper, to_pdf, to_svg};
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
        diameter_mm: f64 = 700.0,
        /// Edge length of a tag's black square; 0 for one that suits the disk.
        #[range(0.0..=500.0)]
        tag_mm: f64 = 0.0,
        /// How many tags; 0 for as many as fit.
        #[range(0..=200)]
        count: u32 = 0,
        /// The first tag's number.
        #[range(0..=586)]
        first_id: u32 = 0,
        /// Whether dots between the tags give photos more to hold on to.
        dots: bool = true,
        /// What it is written as.
        print: Print = Print::Pdf,
        /// The paper it is printed on.
        sheet: Sheet = Sheet::A4,
    }
}

stage::inputs! {
    /// Nothing.
    pub struct MatInput {}
}

/// `pose.mat`: nothing → a document.
pub struct PrintMat;

impl Stage for PrintMat {
    const NAME: &'static str = "pose.mat";
    const VERSION: u32 = 1;
    const ABOUT: &'static str =
        "Lays out a marker mat (AprilTag 36h11) for a disk, to be printed at true scale.";
    type Params = MatParams;
    type Input = MatInput;
    type Output = Document;

    fn run(p: &MatParams, _: MatInput, ctx: &Ctx<'_>) -> Result<Document, Stop> {
        let mat = mat_for(p.diameter_mm, p.tag_mm, p.count, p.first_id)?;
        let marks = mat_marks(&mat, p.diameter_mm, p.dots);
        let note = mat_toml(&mat);
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
                to_svg(&marks, p.diameter_mm, &note).into_bytes(),
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
                    to_pdf(&marks, p.diameter_mm, &paper, &note),
                )
            }
        };
        Ok(Document {
            media: media.into(),
            bytes,
        })
    }
}
