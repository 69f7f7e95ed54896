//! A mat on paper: SVG in one piece, PDF over pages with cut marks and a ruler to check by.

use crate::mat::layout::Mark;
use crate::mat::rim_layout::Piece;
use pdf_writer::{Finish, Name, Pdf, Rect, Ref, Str};
use std::fmt::Write;

/// A sheet of paper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paper {
    /// Width and height. \[mm\]
    pub size_mm: [f64; 2],
    /// What a printer leaves white at each side. \[mm\]
    pub margin_mm: f64,
}

/// PDF's unit: 1/72 inch (derived: 72 a 25.4 mm).
const POINT: f64 = 72.0 / 25.4;
/// What neighbouring pages print of each other (structural: the print's layout). \[mm\]
const OVERLAP: f64 = 8.0;
/// Space below the picture for ruler and words (structural: the print's layout). \[mm\]
const FOOT: f64 = 14.0;
/// Space between pieces of the rim's strip (structural: the print's layout). \[mm\]
const GAP: f64 = 6.0;

/// SVG at true scale: one user unit is a millimetre. The rim's pieces are below the mat.
pub fn to_svg(marks: &[Mark], across_mm: f64, note: &str, pieces: &[Piece]) -> String {
    let half = across_mm / 2.0 + 2.0;
    let rows = |p: &Piece| p.size_mm[1] + GAP;
    let below: f64 = pieces.iter().map(rows).sum();
    let widest = pieces.iter().map(|p| p.size_mm[0] + 2.0);
    let (w, h) = (widest.fold(2.0 * half, f64::max), 2.0 * half + below);
    let left = -half;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}mm\" height=\"{h}mm\" viewBox=\"{left} {left} {w} {h}\">\n<!--\n{note}-->\n"
    );
    marks.iter().for_each(|mark| in_svg(&mut svg, mark));
    let mut low = half;
    for piece in pieces {
        low += rows(piece);
        let _ = writeln!(svg, "<g transform=\"translate({} {low:.4})\">", left + 1.0);
        piece.marks.iter().for_each(|mark| in_svg(&mut svg, mark));
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

/// One mark in SVG's words.
fn in_svg(svg: &mut String, mark: &Mark) {
    let level = |grey: f64| (grey.clamp(0.0, 1.0) * 255.0).round() as u8;
    let path = |corners: &[[f64; 2]]| {
        let one = |[x, y]: &[f64; 2]| format!("{x:.4},{:.4}", -y);
        corners.iter().map(one).collect::<Vec<_>>().join(" ")
    };
    let line = "fill=\"none\" stroke=\"#888\" stroke-width=\"0.2\"";
    let _ = match mark {
        Mark::Fill(corners, grey) => {
            let (v, path) = (level(*grey), path(corners));
            writeln!(
                svg,
                "<polygon points=\"{path}\" fill=\"rgb({v},{v},{v})\"/>"
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
        Mark::Circle(r) => writeln!(svg, "<circle r=\"{r:.4}\" {line}/>"),
        Mark::Line(at) => writeln!(svg, "<polyline points=\"{}\" {line}/>", path(at)),
        Mark::Words([x, y], h, words) => {
            writeln!(
                svg,
                "<text x=\"{x:.3}\" y=\"{:.3}\" font-size=\"{h}\">{words}</text>",
                -y
            )
        }
    };
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
        Mark::Line(at) => {
            let mut path = String::new();
            for (i, [x, y]) in at.iter().enumerate() {
                let _ = write!(path, "{x:.4} {y:.4} {} ", if i == 0 { "m" } else { "l" });
            }
            writeln!(to, "0.5 G 0.2 w {path}S")
        }
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
    let area = [
        paper.size_mm[0] - 2.0 * m,
        paper.size_mm[1] - 2.0 * m - FOOT,
    ];
    let whole = across_mm + 2.0;
    let count = area.map(|r| (((whole - OVERLAP) / (r - OVERLAP)).ceil() as usize).max(1));
    let start = [0, 1].map(|i| -(count[i] as f64 * (area[i] - OVERLAP) + OVERLAP) / 2.0);
    let mut corners = Vec::new();
    for row in (0..count[1]).rev() {
        for column in 0..count[0] {
            corners.push([
                start[0] + column as f64 * (area[0] - OVERLAP),
                start[1] + row as f64 * (area[1] - OVERLAP),
            ]);
        }
    }
    (corners, area)
}

/// PDF at true scale: the mat, one page a tile, with cut marks where pages meet; then the rim's
/// pieces, cut along their outlines. A ruler of 100 mm on each.
pub fn to_pdf(
    marks: &[Mark],
    across_mm: f64,
    paper: &Paper,
    note: &str,
    pieces: &[Piece],
) -> Vec<u8> {
    let (corners, area) = tiles(across_mm, paper);
    let stacks = stacks(pieces, area[1]);
    let (m, of) = (paper.margin_mm, corners.len() + stacks.len());
    let tile = |(i, [x, y]): (usize, &[f64; 2])| {
        let (left, low) = (m, m + FOOT);
        let mut page = format!(
            "{POINT:.8} 0 0 {POINT:.8} 0 0 cm\nq {left} {low} {} {} re W n\n",
            area[0], area[1]
        );
        let _ = writeln!(page, "1 0 0 1 {:.4} {:.4} cm", left - x, low - y);
        marks.iter().for_each(|mark| drawn(&mut page, mark));
        page.push_str("Q\n0 G 0.15 w\n");
        // Where neighbours meet: the middle of the overlap, marked at the picture's edges.
        let (right, high) = (left + area[0], low + area[1]);
        let mut line = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
            let _ = writeln!(page, "{a:.3} {b:.3} m {c:.3} {d:.3} l S");
        };
        for cut in [left + OVERLAP / 2.0, right - OVERLAP / 2.0] {
            line([cut, low - 4.0], [cut, low]);
            line([cut, high], [cut, high + 4.0]);
        }
        for cut in [low + OVERLAP / 2.0, high - OVERLAP / 2.0] {
            line([left - 4.0, cut], [left, cut]);
            line([right, cut], [right + 4.0, cut]);
        }
        foot(&mut page, m, i, of, note);
        page
    };
    let stack = |(i, pieces): (usize, &&[Piece])| {
        let mut page = format!("{POINT:.8} 0 0 {POINT:.8} 0 0 cm\n");
        let mut low = m + FOOT + area[1];
        for piece in *pieces {
            low -= piece.size_mm[1];
            let _ = writeln!(page, "q 1 0 0 1 {m:.4} {low:.4} cm");
            piece.marks.iter().for_each(|mark| drawn(&mut page, mark));
            page.push_str("Q\n");
            low -= GAP;
        }
        foot(&mut page, m, corners.len() + i, of, note);
        page
    };
    let mut pages: Vec<String> = corners.iter().enumerate().map(tile).collect();
    pages.extend(stacks.iter().enumerate().map(stack));
    assembled(&pages, paper.size_mm, note)
}

/// Pieces that go onto one page each, above each other; at least one.
fn stacks(pieces: &[Piece], height_mm: f64) -> Vec<&[Piece]> {
    let tall = |p: &Piece| p.size_mm[1] + GAP;
    let a_page = pieces
        .first()
        .map_or(1.0, |p| ((height_mm + GAP) / tall(p)).floor());
    pieces.chunks((a_page as usize).max(1)).collect()
}

/// The ruler and the words at a page's foot.
fn foot(page: &mut String, m: f64, i: usize, of: usize, note: &str) {
    let _ = writeln!(page, "0 G 0.3 w {m} {m} m {} {m} l S", m + 100.0);
    for tick in 0..=10 {
        let at = m + f64::from(tick) * 10.0;
        let high = m + if tick % 5 == 0 { 3.0 } else { 2.0 };
        let _ = writeln!(page, "{at} {m} m {at} {high} l S");
    }
    let words = format!(
        "page {} of {of} - print at 100 %; this line is 100 mm; for capture.toml:",
        i + 1
    );
    drawn(page, &Mark::Words([m, m + 9.0], 2.2, words));
    // Line by line, a table a column, so that it is TOML as printed.
    let (mut column, mut row) = (-1.0, 0.0);
    for line in note.lines() {
        if line.starts_with('[') {
            (column, row) = (column + 1.0, 0.0);
        }
        let at = [m + 102.0 + 30.0 * column, m + 10.6 - 1.95 * row];
        drawn(page, &Mark::Words(at, 1.8, line.to_owned()));
        row += 1.0;
    }
}

/// A PDF file of pages, with a note attached as the file `mat.toml` (ISO 32000-1, §7.11.4).
fn assembled(pages: &[String], [width, height]: [f64; 2], note: &str) -> Vec<u8> {
    let [catalog, tree, font, file, attached] = [1, 2, 3, 4, 5].map(Ref::new);
    let ids: Vec<[Ref; 2]> = (6..)
        .step_by(2)
        .take(pages.len())
        .map(|first| [first, first + 1].map(Ref::new))
        .collect();
    let mut pdf = Pdf::new();
    let mut root = pdf.catalog(catalog);
    root.pages(tree);
    let name = Str(b"mat.toml");
    let mut names = root.names();
    names.embedded_files().names().insert(name, attached);
    names.finish();
    root.finish();
    let mut all = pdf.pages(tree);
    all.kids(ids.iter().map(|[page, _]| *page));
    all.count(i32::try_from(pages.len()).expect("bug: so many pages"));
    all.finish();
    pdf.type1_font(font).base_font(Name(b"Helvetica"));
    pdf.embedded_file(file, note.as_bytes());
    let mut attachment = pdf.file_spec(attached);
    attachment.path(name).embedded_file(file);
    attachment.finish();
    let [width, height] = [width, height].map(|mm| (mm * POINT) as f32);
    for ([id, content], text) in ids.iter().zip(pages) {
        let mut page = pdf.page(*id);
        page.media_box(Rect::new(0.0, 0.0, width, height));
        page.parent(tree).contents(*content);
        page.resources().fonts().pair(Name(b"F"), font);
        page.finish();
        pdf.stream(*content, text.as_bytes());
    }
    pdf.finish()
}
