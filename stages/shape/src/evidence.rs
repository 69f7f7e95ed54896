//! What speaks for body or background at each pixel, before photos are asked together: all in nats.

use crate::aligned::picture;
use crate::runs::{pixels, repeated, repeats, runs};
use crate::{ByPhoto, PhotoId, Rgb};
use stage::{Artifact, Corrupt, Hash, Packer, Unpacker};

/// What is known of a pixel before it is labelled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// It may be either.
    Unknown,
    /// It cannot be body.
    Background,
    /// It cannot be background.
    Body,
}

impl Known {
    /// As they are stored.
    pub(crate) fn bytes(known: &[Known]) -> Vec<u8> {
        runs(&known.iter().map(|k| *k as u8).collect::<Vec<u8>>())
    }

    /// From what is stored of so many pixels.
    pub(crate) fn from_bytes(runs: &[u8], count: usize) -> Result<Vec<Known>, Corrupt> {
        let known = |k: u8| match k {
            0 => Ok(Known::Unknown),
            1 => Ok(Known::Background),
            2 => Ok(Known::Body),
            _ => Err(Corrupt("neither body nor background nor unknown".into())),
        };
        pixels(runs, count)?.into_iter().map(known).collect()
    }
}

/// The evidence of one photo, reduced, where all photos are aligned: pixels row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct PhotoEvidence {
    /// How many pixels of the photo along a side became one.
    pub factor: u32,
    /// The reduced photo.
    pub photo: Rgb,
    /// -ln p(pixel | background), up to a constant that is the same for all pixels. \[nats\]
    pub background: Vec<f32>,
    /// Log-odds of the body by a learned sense of a person; empty where the photos show none, or nobody asked. \[nats\]
    pub person: Vec<f32>,
    /// Light that the disk gains by what it mirrors of the body, three channels a pixel; empty where it mirrors nothing that
    /// shows, or nobody asked. \[1 is white\]
    pub mirrored: Vec<f32>,
    /// How many times as bright each pixel is as the scene there; empty where they are alike, or nobody asked.
    pub light: Vec<f32>,
    /// What is certain.
    pub known: Vec<Known>,
    /// How far the photo and what was expected of it differ without a reason. \[levels\]
    pub noise_levels: f32,
}

impl PhotoEvidence {
    /// Hash of all of it: for [`stage::Ctx::part`].
    pub fn content(&self) -> Hash {
        let known: Vec<u8> = self.known.iter().map(|k| *k as u8).collect();
        let costs = [&self.background, &self.person, &self.mirrored, &self.light];
        let mut bytes = format!("{} {}", self.factor, self.noise_levels).into_bytes();
        let mut add = |part: &[u8]| bytes.extend_from_slice(stage::hash(part).as_bytes());
        add(self.photo.data.as_flattened());
        add(&known);
        costs
            .iter()
            .for_each(|cost| add(bytemuck::cast_slice(cost)));
        stage::hash(&bytes)
    }

    /// log p(background) - log p(body) of each pixel, while nothing is known of the body's colours: `any_body` is
    /// -ln p(pixel | some body). Infinite where a pixel is certain. \[nats\]
    pub fn log_odds(&self, any_body: f32) -> impl Iterator<Item = f32> {
        let all = self.background.iter().zip(&self.known);
        all.map(move |(cost, known)| match known {
            Known::Unknown => any_body - cost,
            Known::Background => f32::INFINITY,
            Known::Body => f32::NEG_INFINITY,
        })
    }
}

/// The evidence of each photo.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Evidence {
    /// The photos that have some.
    pub views: ByPhoto<PhotoEvidence>,
}

/// Photo, size, factor, noise.
type Row = (u32, [u32; 2], u32, f32);

/// The sections of a photo's costs, and of its light.
const COSTS: [&str; 4] = ["background", "person", "mirrored", "light"];

impl Artifact for Evidence {
    const KIND: &'static str = "evidence";
    const FORMAT: u32 = 7;

    fn pack(&self, to: &mut Packer) {
        let row = |(id, e): (PhotoId, &PhotoEvidence)| -> Row {
            let size = [e.photo.width as u32, e.photo.height as u32];
            (id.0, size, e.factor, e.noise_levels)
        };
        to.meta(&self.views.iter().map(row).collect::<Vec<Row>>());
        for (PhotoId(id), e) in self.views.iter() {
            to.section(format!("photo {id}"), &e.photo.data);
            to.section(format!("known {id}"), &Known::bytes(&e.known));
            let costs = [&e.background, &e.person, &e.mirrored, &e.light];
            for (name, cost) in COSTS.iter().zip(costs) {
                let (lengths, kept) = repeats(cost);
                to.section(format!("{name} {id} lengths"), &lengths);
                to.section(format!("{name} {id}"), &kept);
            }
        }
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let rows: Vec<Row> = from.meta()?;
        let one = |(id, size, factor, noise_levels): Row| {
            let photo = picture(size, from.section(&format!("photo {id}"))?, "a photo")?;
            let count = photo.data.len();
            let cost = |name: &str, count: usize| {
                let lengths: Vec<u32> = from.section(&format!("{name} {id} lengths"))?;
                repeated(&lengths, &from.section(&format!("{name} {id}"))?, count)
            };
            let background = cost(COSTS[0], count)?;
            // Where nobody asked there is none.
            let if_asked = |name: &str, count: usize| -> Result<Vec<f32>, Corrupt> {
                let asked: Vec<u32> = from.section(&format!("{name} {id} lengths"))?;
                let asked = asked.iter().any(|length| *length > 0);
                cost(name, if asked { count } else { 0 })
            };
            if factor == 0 {
                return Err(Corrupt("a photo reduced by 0".into()));
            }
            let evidence = PhotoEvidence {
                factor,
                background,
                person: if_asked(COSTS[1], count)?,
                mirrored: if_asked(COSTS[2], 3 * count)?,
                light: if_asked(COSTS[3], count)?,
                known: Known::from_bytes(&from.section(&format!("known {id}"))?, count)?,
                photo,
                noise_levels,
            };
            Ok((PhotoId(id), evidence))
        };
        Ok(Evidence {
            views: rows.into_iter().map(one).collect::<Result<_, Corrupt>>()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn evidence() -> Evidence {
        let one = |person: &[f32]| PhotoEvidence {
            factor: 3,
            photo: Rgb::filled(3, 2, [4, 5, 6]),
            background: vec![4.5, 4.5, 4.5, 4.5, 4.5, 28.5],
            person: person.to_vec(),
            mirrored: person.repeat(3),
            light: person.to_vec(),
            known: vec![
                Known::Unknown,
                Known::Unknown,
                Known::Background,
                Known::Body,
                Known::Unknown,
                Known::Unknown,
            ],
            noise_levels: 1.5,
        };
        let views = [one(&[]), one(&[-1.5, 0.0, 0.0, 2.5, 2.5, 2.5])];
        Evidence {
            views: (0..).map(PhotoId).zip(views).collect(),
        }
    }

    #[test]
    fn evidence_comes_back_bit_by_bit_and_gives_odds() {
        let evidence = evidence();
        let bytes = stage::to_bytes(&evidence);
        assert_eq!(stage::from_bytes::<Evidence>(&bytes).unwrap(), evidence);
        let one = evidence.views.get(PhotoId(0)).unwrap();
        let odds: Vec<f32> = one.log_odds(17.5).collect();
        let all = f32::INFINITY;
        assert_eq!(odds, [13.0, 13.0, all, -all, 13.0, -11.0]);
    }

    #[test]
    fn what_does_not_fill_its_photo_is_refused() {
        let mut short = evidence();
        short.views.get_mut(PhotoId(0)).unwrap().background.pop();
        assert!(stage::from_bytes::<Evidence>(&stage::to_bytes(&short)).is_err());
    }
}
