//! A mat on paper: SVG in one piece, PDF over pages with cut marks and a ruler to check by.

use crate::mat_layout::Mark;
use std::fmt::Write;

/// A sheet of paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paper {
    /// Width and height. \[mm\]
    pub size_mm: [f64; 2],
    /// What a printer leaves white at each side. \[mm\]
    pub margin_mm: f64,
}

/// PDF's unit: 1/72 inch.
const POINT: f64 = 72.0 / 25.4;
/// What neighbouring pages print of each other. \[mm\]
const OVERLAP: f64 = 8.0;
/// Room below the picture for ruler and words. \[mm\]
const FOOT: f64 = 14.0;

/// SVG at true scale: one user unit is a millimetre.
pub fn to_svg(marks: &[Mark], across_mm: f64, note: &str) -> String {
    let half = across_mm / 2.0 + 2.0;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{w}mm\" viewBox=\"{} {} {w} {w}\">\n<!--\n{note}-->\n",
        -half,
        -half,
        w = 2.0 * half
    );
    let level = |grey: f64| (grey.clamp(0.0, 1.0) * 255.0).round() as u8;
    for mark in marks {
        let _ = match mark {
            Mark::Fill(corners, grey) => {
                let path: Vec<String> = corners
                    .iter()
                    .map(|[x, y]| format!("{x:.4},{:.4}", -y))
                    .collect();
                let v = level(*grey);
                writeln!(
                    svg,
                    "<polygon points=\"{}\" fill=\"rgb({v},{v},{v})\"/>",
                    path.join(" ")
                )
            }
            Mark::Dot([x, y], r, grey) => {
                let v = level(*grey);
                writeln!(
                    svg,
                    "<circle cx=\"{x:.4}\" cy=\"{:.4}\" r=\"{r:.4}\" fill=\"rgb({v},{v},{v})\"/>",
                    -y
                )
            }
            Mark::Circle(r) => {
                writeln!(
                    svg,
                    "<circle r=\"{r:.4}\" fill=\"none\" stroke=\"#888\" stroke-width=\"0.2\"/>"
                )
            }
            Mark::Words([x, y], h, words) => {
                writeln!(
                    svg,
                    "<text x=\"{x:.3}\" y=\"{:.3}\" font-size=\"{h}\">{words}</text>",
                    -y
                )
            }
        };
    }
    svg.push_str("</svg>\n");
    svg
}

/// One mark in PDF's words; in millimetres, y up.
fn drawn(to: &mut String, mark: &Mark) {
    let _ = match mark {
        Mark::Fill(corners, grey) => {
            let mut path = String::new();
            for (i, [x, y]) in corners.iter().enumerate() {
                let _ = write!(path, "{x:.4} {y:.4} {} ", if i == 0 { "m" } else { "l" });
            }
            writeln!(to, "{grey:.3} g {path}h f")
        }
        Mark::Dot([x, y], r, grey) => writeln!(to, "{grey:.3} g {}f", round([*x, *y], *r)),
        Mark::Circle(r) => writeln!(to, "0.5 G 0.2 w {}S", round([0.0; 2], *r)),
        Mark::Words([x, y], h, words) => {
            let safe: String = words
                .chars()
                .filter(|c| c.is_ascii() && !"()\\".contains(*c))
                .collect();
            writeln!(to, "0 g BT /F {h:.2} Tf {x:.3} {y:.3} Td ({safe}) Tj ET")
        }
    };
}

/// A circle's path, four Bézier arcs.
fn round([x, y]: [f64; 2], r: f64) -> String {
    let k = r * 0.552_284_75;
    let mut path = format!("{:.4} {y:.4} m ", x + r);
    for [a, b, c, d, e, f] in [
        [r, k, k, r, 0.0, r],
        [-k, r, -r, k, -r, 0.0],
        [-r, -k, -k, -r, 0.0, -r],
        [k, -r, r, -k, r, 0.0],
    ] {
        let _ = write!(
            path,
            "{:.4} {:.4} {:.4} {:.4} {:.4} {:.4} c ",
            x + a,
            y + b,
            x + c,
            y + d,
            x + e,
            y + f
        );
    }
    path
}

/// The pages' corners: lower left of what each shows of the mat, and the size of that. \[mm\]
pub fn tiles(across_mm: f64, paper: &Paper) -> (Vec<[f64; 2]>, [f64; 2]) {
    let m = paper.margin_mm;
    let room = [
        paper.size_mm[0] - 2.0 * m,
        paper.size_mm[1] - 2.0 * m - FOOT,
    ];
    let whole = across_mm + 2.0;
    let count = room.map(|r| (((whole - OVERLAP) / (r - OVERLAP)).ceil() as usize).max(1));
    let start = [0, 1].map(|i| -(count[i] as f64 * (room[i] - OVERLAP) + OVERLAP) / 2.0);
    let mut corners = Vec::new();
    for row in (0..count[1]).rev() {
        for column in 0..count[0] {
            corners.push([
                start[0] + column as f64 * (room[0] - OVERLAP),
                start[1] + row as f64 * (room[1] - OVERLAP),
            ]);
        }
    }
    (corners, room)
}

/// PDF at true scale, one page a tile, with cut marks where pages meet and a ruler of 100 mm.
pub fn to_pdf(marks: &[Mark], across_mm: f64, paper: &Paper, note: &str) -> Vec<u8> {
    let (corners, room) = tiles(across_mm, paper);
    let m = paper.margin_mm;
    let pages: Vec<String> = corners
        .iter()
        .enumerate()
        .map(|(i, [x, y])| {
            let (left, low) = (m, m + FOOT);
            let mut page = format!(
                "{POINT:.8} 0 0 {POINT:.8} 0 0 cm\nq {left} {low} {} {} re W n\n",
                room[0], room[1]
            );
            let _ = writeln!(page, "1 0 0 1 {:.4} {:.4} cm", left - x, low - y);
            marks.iter().for_each(|mark| drawn(&mut page, mark));
            page.push_str("Q\n0 G 0.15 w\n");
            // Where neighbours meet: the middle of the overlap, marked at the picture's edges.
            for cut in [left + OVERLAP / 2.0, left + room[0] - OVERLAP / 2.0] {
                let _ = writeln!(page, "{cut:.3} {} m {cut:.3} {} l S", low - 4.0, low);
                let _ = writeln!(
                    page,
                    "{cut:.3} {} m {cut:.3} {} l S",
                    low + room[1],
                    low + room[1] + 4.0
                );
            }
            for cut in [low + OVERLAP / 2.0, low + room[1] - OVERLAP / 2.0] {
                let _ = writeln!(page, "{} {cut:.3} m {left} {cut:.3} l S", left - 4.0);
                let _ = writeln!(
                    page,
                    "{} {cut:.3} m {} {cut:.3} l S",
                    left + room[0],
                    left + room[0] + 4.0
                );
            }
            let _ = writeln!(page, "0.3 w {left} {m} m {} {m} l S", left + 100.0);
            for tick in 0..=10 {
                let at = left + f64::from(tick) * 10.0;
                let _ = writeln!(
                    page,
                    "{at} {m} m {at} {} l S",
                    m + if tick % 5 == 0 { 3.0 } else { 2.0 }
                );
            }
            let words = format!(
                "page {} of {} - print at 100 %; this line is 100 mm; {}",
                i + 1,
                corners.len(),
                note.replace('\n', " ")
            );
            drawn(&mut page, &Mark::Words([left, m + 5.0], 2.2, words));
            page
        })
        .collect();
    assembled(&pages, paper.size_mm)
}

/// A PDF file of pages (ISO 32000-1, §7.5).
fn assembled(pages: &[String], [width, height]: [f64; 2]) -> Vec<u8> {
    let mut objects = vec!["<< /Type /Catalog /Pages 2 0 R >>".to_owned()];
    let kids: Vec<String> = (0..pages.len())
        .map(|i| format!("{} 0 R", 4 + 2 * i))
        .collect();
    objects.push(format!(
        "<< /Type /Pages /Kids [{}] /Count {} >>",
        kids.join(" "),
        pages.len()
    ));
    objects.push("<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>".to_owned());
    for (i, page) in pages.iter().enumerate() {
        objects.push(format!(
            "<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.3} {:.3}] /Resources << /Font << /F 3 0 R >> >> /Contents {} 0 R >>",
            width * POINT,
            height * POINT,
            5 + 2 * i
        ));
        objects.push(format!(
            "<< /Length {} >>\nstream\n{page}\nendstream",
            page.len() + 1
        ));
    }
    let mut file = String::from("%PDF-1.4\n");
    let mut places = Vec::new();
    for (i, object) in objects.iter().enumerate() {
        places.push(file.len());
        let _ = write!(file, "{} 0 obj\n{object}\nendobj\n", i + 1);
    }
    let table = file.len();
    let _ = write!(file, "xref\n0 {}\n0000000000 65535 f \n", objects.len() + 1);
    for place in places {
        let _ = writeln!(file, "{place:010} 00000 n ");
    }
    let _ = write!(
        file,
        "trailer\n<< /Size {} /Root 1 0 R >>\nstartxref\n{table}\n%%EOF\n",
        objects.len() + 1
    );
    file.into_bytes()
}
