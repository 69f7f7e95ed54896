//! A mask as its runs of equal pixels: how masks are kept and stored.

use crate::Image;
use crate::runs::{checked, pixels, run_length, runs};
use stage::{Corrupt, Hash};

/// A mask as its runs of equal pixels, row by row: some hundred kilobytes where its pixels are megabytes.
#[derive(Debug, Clone, PartialEq)]
pub struct MaskRuns {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// As they are stored; of as many pixels as width and height are.
    runs: Vec<u8>,
}

impl From<&Image<u8>> for MaskRuns {
    fn from(mask: &Image<u8>) -> MaskRuns {
        MaskRuns {
            width: mask.width,
            height: mask.height,
            runs: runs(&mask.data),
        }
    }
}

impl From<Image<u8>> for MaskRuns {
    fn from(mask: Image<u8>) -> MaskRuns {
        (&mask).into()
    }
}

impl MaskRuns {
    /// Of runs as they are stored.
    ///
    /// # Errors
    ///
    /// They are not as many pixels as the mask has.
    pub(crate) fn stored([width, height]: [usize; 2], runs: Vec<u8>) -> Result<Self, Corrupt> {
        checked(&runs, width.saturating_mul(height))?;
        Ok(MaskRuns {
            width,
            height,
            runs,
        })
    }

    /// As they are stored.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.runs
    }

    /// Of its pixels.
    pub fn content(&self) -> Hash {
        stage::hash(&self.runs)
    }

    /// How many pixels the mask has.
    pub fn count(&self) -> usize {
        self.width * self.height
    }

    /// The mask, pixel by pixel.
    pub fn pixels(&self) -> Image<u8> {
        Image {
            width: self.width,
            height: self.height,
            data: pixels(&self.runs, self.count()).expect("bug: runs of another size"),
        }
    }

    /// The share of the pixels that is body.
    pub fn share(&self) -> f64 {
        let (runs, _) = self.runs.as_chunks::<4>();
        let body = runs.iter().filter(|run| run[0] > 127);
        let area: usize = body.map(run_length).sum();
        area as f64 / self.count().max(1) as f64
    }
}
