//! What flows between two operators.

/// An image of several channels: rows of pixels, the channels of a pixel side by side.
#[derive(Debug, Clone, PartialEq)]
pub struct Tensor {
    /// Rows.
    pub height: usize,
    /// Pixels of a row.
    pub width: usize,
    /// Numbers of a pixel.
    pub channels: usize,
    /// `height * width * channels` numbers.
    pub data: Vec<f32>,
}

impl Tensor {
    /// All zero.
    pub fn zeros(height: usize, width: usize, channels: usize) -> Tensor {
        Tensor {
            height,
            width,
            channels,
            data: vec![0.0; height * width * channels],
        }
    }

    /// The channels of a pixel.
    #[inline]
    pub fn pixel(&self, x: usize, y: usize) -> &[f32] {
        let at = (y * self.width + x) * self.channels;
        &self.data[at..at + self.channels]
    }

    /// The channels of a pixel, to be changed.
    #[inline]
    pub fn pixel_mut(&mut self, x: usize, y: usize) -> &mut [f32] {
        let at = (y * self.width + x) * self.channels;
        &mut self.data[at..at + self.channels]
    }
}
