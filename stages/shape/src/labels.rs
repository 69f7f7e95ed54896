//! Body or background of each pixel of the reduced photos, and what the labelling learned for their borders.

use crate::aligned::picture;
use crate::runs::{from_sides, sides};
use crate::{ByPhoto, Image, Known, PhotoId};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// A normal distribution of colours in a mixture: mean, inverse covariance column by column, and ln(weight) - ln(norm).
/// \[levels, 1/levels², nats\]
pub type MixtureRow = [f64; 13];

/// The labels of one reduced photo.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// True is body.
    pub body: Image<bool>,
    /// What was certain when it was labelled.
    pub known: Vec<Known>,
    /// The mixture of the body's colours.
    pub body_colors: Vec<MixtureRow>,
    /// That of the background's, where no scene is known; empty where one is.
    pub background_colors: Vec<MixtureRow>,
}

/// The labels of each photo.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Labels {
    /// The photos that are labelled.
    pub views: ByPhoto<Label>,
}

impl Artifact for Labels {
    const KIND: &'static str = "labels";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        let size = |(id, l): (PhotoId, &Label)| (id.0, l.body.width as u32, l.body.height as u32);
        to.meta(&self.views.iter().map(size).collect::<Vec<_>>());
        for (PhotoId(id), label) in self.views.iter() {
            to.section(format!("body {id}"), &sides(&label.body.data));
            to.section(format!("known {id}"), &Known::bytes(&label.known));
            let (body, background) = (&label.body_colors, &label.background_colors);
            to.section(format!("body colors {id}"), body.as_flattened());
            to.section(format!("background colors {id}"), background.as_flattened());
        }
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let sizes: Vec<(u32, u32, u32)> = from.meta()?;
        let one = |(id, width, height): (u32, u32, u32)| {
            let count = (width as usize).saturating_mul(height as usize);
            let body = from_sides(&from.section(&format!("body {id}"))?, count)?;
            let mixture = |name: &str| -> Result<Vec<MixtureRow>, Corrupt> {
                let numbers: Vec<f64> = from.section(&format!("{name} colors {id}"))?;
                match numbers.as_chunks() {
                    (rows, []) => Ok(rows.to_vec()),
                    _ => Err(Corrupt("half a distribution of colours".into())),
                }
            };
            let label = Label {
                body: picture([width, height], body, "a label")?,
                known: Known::from_bytes(&from.section(&format!("known {id}"))?, count)?,
                body_colors: mixture("body")?,
                background_colors: mixture("background")?,
            };
            Ok((PhotoId(id), label))
        };
        Ok(Labels {
            views: sizes.into_iter().map(one).collect::<Result<_, Corrupt>>()?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_come_back_with_their_colours() {
        let label = Label {
            body: Image {
                width: 2,
                height: 2,
                data: vec![true, false, false, true],
            },
            known: vec![
                Known::Body,
                Known::Background,
                Known::Unknown,
                Known::Unknown,
            ],
            body_colors: vec![[0.1; 13], [-2.0; 13]],
            background_colors: vec![],
        };
        let labels = Labels {
            views: [(PhotoId(7), label)].into_iter().collect(),
        };
        let bytes = stage::to_bytes(&labels);
        assert_eq!(stage::from_bytes::<Labels>(&bytes).unwrap(), labels);
    }
}
