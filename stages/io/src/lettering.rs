//! Words on pictures: capitals and digits of three by five dots.

use shape::Rgb;

/// Rows of the dots from above, three bits each as an octal digit.
const GLYPHS: &[(char, &str)] = &[
    ('0', "75557"),
    ('1', "26227"),
    ('2', "71747"),
    ('3', "71717"),
    ('4', "55711"),
    ('5', "74717"),
    ('6', "74757"),
    ('7', "71122"),
    ('8', "75757"),
    ('9', "75717"),
    ('A', "25755"),
    ('B', "65656"),
    ('C', "34443"),
    ('D', "65556"),
    ('E', "74647"),
    ('F', "74644"),
    ('G', "34553"),
    ('H', "55755"),
    ('I', "72227"),
    ('J', "11152"),
    ('K', "55655"),
    ('L', "44447"),
    ('M', "57755"),
    ('N', "65555"),
    ('O', "25552"),
    ('P', "65644"),
    ('Q', "25563"),
    ('R', "65655"),
    ('S', "34216"),
    ('T', "72222"),
    ('U', "55557"),
    ('V', "55552"),
    ('W', "55775"),
    ('X', "55255"),
    ('Y', "55222"),
    ('Z', "71247"),
    ('.', "00002"),
    (',', "00024"),
    ('-', "00700"),
    ('+', "02720"),
    ('_', "00007"),
    ('%', "51245"),
    (':', "02020"),
    ('/', "11244"),
];

/// Width and height of a text whose dots are squares of `dot` pixels, with a dot around it. \[px\]
pub(crate) fn text_size(text: &str, dot: usize) -> (usize, usize) {
    ((text.chars().count() * 4 + 1) * dot, 7 * dot)
}

/// Writes a text on a dark ground, its top-left corner at (x, y); what is outside is left out, what
/// has no letter is a gap.
pub(crate) fn write_on(
    picture: &mut Rgb,
    (left, top): (usize, usize),
    dot: usize,
    color: [u8; 3],
    text: &str,
) {
    let (width, height) = text_size(text, dot);
    let rows: Vec<&str> = text
        .chars()
        .map(|c| {
            let c = c.to_ascii_uppercase();
            GLYPHS.iter().find(|g| g.0 == c).map_or("00000", |g| g.1)
        })
        .collect();
    for y in top..(top + height).min(picture.height) {
        for x in left..(left + width).min(picture.width) {
            let (u, v) = ((x - left) / dot, (y - top) / dot);
            let lit = u > 0 && (u - 1) % 4 < 3 && (1..6).contains(&v) && {
                let row = rows[(u - 1) / 4].as_bytes()[v - 1] - b'0';
                row >> (2 - (u - 1) % 4) & 1 == 1
            };
            *picture.at_mut(x, y) = if lit { color } else { [24; 3] };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_l_is_an_l_and_nothing_is_written_outside() {
        let mut picture = Rgb::filled(12, 16, [90; 3]);
        write_on(&mut picture, (2, 1), 2, [255; 3], "l");
        let dots: Vec<String> = (0..5)
            .map(|v| {
                (0..3)
                    .map(|u| {
                        if picture.at(4 + 2 * u, 3 + 2 * v)[0] == 255 {
                            '#'
                        } else {
                            '.'
                        }
                    })
                    .collect()
            })
            .collect();
        assert_eq!(dots, ["#..", "#..", "#..", "#..", "###"]);
        assert_eq!(picture.at(1, 5), [90; 3]);
        write_on(&mut picture, (8, 12), 2, [255; 3], "WIDE");
        assert_eq!(picture.at(1, 15), [90; 3]);
    }

    #[test]
    fn letters_differ() {
        for (i, a) in GLYPHS.iter().enumerate() {
            assert!(
                GLYPHS[..i].iter().all(|b| b.0 != a.0 && b.1 != a.1),
                "{}",
                a.0
            );
        }
    }
}
