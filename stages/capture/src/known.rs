//! The numbers that may be given of a capture, each in one place: its key in `capture.toml`, its flag, its field on a page,
//! and what is believed. A slip of the keyboard is refused wherever it is made.

/// A number that may be given of a capture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    /// Its key: `subject.height_cm`.
    pub key: &'static str,
    /// Its flag, without dashes: `stature`.
    pub flag: &'static str,
    /// Its name on a page and in the page's API, where it has one: `stature_cm`.
    pub field: Option<&'static str>,
    /// What it is a number of.
    pub of: Quantity,
    /// The least that is believed, in the key's unit.
    pub least: f64,
    /// The most that is believed, in the key's unit.
    pub most: f64,
    /// What the flag's value is called.
    pub value: &'static str,
    /// A sentence for people who give it.
    pub about: &'static str,
    /// How they may write it on a command line; first a bare number.
    pub like: &'static str,
}

/// What a number is of, and the unit of its key, which a bare number has, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// A length in `cm` or `mm`.
    Length(&'static str),
    /// In kilograms.
    Weight,
    /// In years.
    Age,
    /// Any other, in this unit.
    Number(&'static str),
    /// A whole number.
    Count,
}

impl Quantity {
    /// The unit; empty where there is none.
    pub fn unit(self) -> &'static str {
        match self {
            Quantity::Length(unit) | Quantity::Number(unit) => unit,
            Quantity::Weight => "kg",
            Quantity::Age => "years",
            Quantity::Count => "",
        }
    }
}

/// A known number without a field.
const fn known(
    key: &'static str,
    flag: &'static str,
    of: Quantity,
    [least, most]: [f64; 2],
    [value, about, like]: [&'static str; 3],
) -> Known {
    Known {
        key,
        flag,
        field: None,
        of,
        least,
        most,
        value,
        about,
        like,
    }
}

impl Known {
    /// That of a key, if it is one.
    pub fn of(key: &str) -> Option<&'static Known> {
        KNOWN.iter().find(|known| known.key == key)
    }

    /// A number that it may be.
    pub fn example(&self) -> f64 {
        let bare = self
            .like
            .split(' ')
            .next()
            .and_then(|bare| bare.parse().ok());
        bare.expect("bug: an example that is no number")
    }

    /// The sentence with how it may be written.
    pub fn help(&self) -> String {
        format!("{}: {}", self.about, self.like)
    }

    /// The sentence with what is believed, and the flag.
    pub fn comment(&self) -> String {
        let Known {
            about,
            least,
            most,
            flag,
            ..
        } = self;
        let unit = self.of.unit();
        format!("{about}; {least} to {most} {unit}")
            .trim_end()
            .to_owned()
            + &format!("; --{flag}")
    }

    /// The same with a field on the page.
    const fn on_page(self, name: &'static str) -> Known {
        Known {
            field: Some(name),
            ..self
        }
    }
}

use Quantity::{Age, Count, Length, Number, Weight};

/// All of them.
pub const KNOWN: [Known; 12] = [
    known("subject.height_cm", "stature", Length("cm"), [10.0, 300.0], ["LENGTH", "The subject's stature", "178 (cm), 1.78m, 70in, 5ft10in"]).on_page("stature_cm"),
    known("subject.weight_kg", "weight", Weight, [0.5, 500.0], ["WEIGHT", "The subject's weight", "80 (kg), 176lb"]).on_page("weight_kg"),
    known("subject.age_years", "age", Age, [0.0, 130.0], ["AGE", "The subject's age on the day of the capture, for growth references", "9.5 (years), 9y6mo, 114mo"]).on_page("age_years"),
    known("mat.tag_size_mm", "mat-tag", Length("mm"), [1.0, 1000.0], ["LENGTH", "Edge length of a mat tag's black square as measured on the print; given alone, the rest of a mat of `tailor mat` is found in the photos", "60 (mm)"]).on_page("mat_tag_mm"),
    known("mat.ring_radius_mm", "mat-ring", Length("mm"), [1.0, 10_000.0], ["LENGTH", "Radius of the circle through the mat tags' centres", "187 (mm)"]),
    known("rim.tag_size_mm", "rim-tag", Length("mm"), [1.0, 1000.0], ["LENGTH", "Edge length of a tag's black square on the disk's rim", "24 (mm)"]),
    known("rim.radius_mm", "rim-radius", Length("mm"), [10.0, 5000.0], ["LENGTH", "Radius of the rim's printed face", "225 (mm)"]),
    known("disk.diameter_cm", "disk-diameter", Length("cm"), [1.0, 1000.0], ["LENGTH", "The disk's diameter", "70 (cm), 700mm, 28in"]).on_page("disk_diameter_cm"),
    known("camera.focal_35mm", "focal", Number("mm"), [5.0, 2000.0], ["MM", "Focal length as if on 36 × 24 mm film, by the diagonal, where photos do not have it", "26 (mm)"]).on_page("focal_mm"),
    known("camera.focal_px", "focal-px", Number("px"), [50.0, 1e6], ["PX", "Focal length as a calibration of this lens gave it, in pixels of the photo at full size", "2400 (px)"]),
    known("step_deg", "step", Number("°"), [-360.0, 360.0], ["DEGREES", "Even turn between photos in degrees; positive if the subject turns counter-clockwise seen from above", "20 (°)"]),
    known("views", "views", Count, [0.0, 10_000.0], ["COUNT", "How many photos there should be", "18"]),
];

/// What is believed of a key.
pub(crate) fn believed(key: &str) -> [f64; 2] {
    let known = Known::of(key).expect("bug: a key of no known number");
    [known.least, known.most]
}
