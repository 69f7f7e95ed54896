//! Images: rows of pixels, row-major, the centre of the top-left pixel at (0, 0).

use std::ops::Range;

/// An image.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Image<T> {
    /// Width. \[px\]
    pub width: usize,
    /// Height. \[px\]
    pub height: usize,
    /// `height * width` pixels, row-major.
    pub data: Vec<T>,
}

/// Red, green, blue as the file has them (sRGB), 0..=255.
pub type Rgb = Image<[u8; 3]>;

/// Brightness, as a rule 0..=255.
pub type Gray = Image<f32>;

impl<T: Copy> Image<T> {
    /// An image of one colour.
    pub fn filled(width: usize, height: usize, value: T) -> Self {
        Image {
            width,
            height,
            data: vec![value; width * height],
        }
    }

    /// The pixel at a column and a row.
    #[inline]
    pub fn at(&self, x: usize, y: usize) -> T {
        self.data[y * self.width + x]
    }

    /// The pixel at a column and a row, to be changed.
    #[inline]
    pub fn at_mut(&mut self, x: usize, y: usize) -> &mut T {
        &mut self.data[y * self.width + x]
    }

    /// One row.
    #[inline]
    pub fn row(&self, y: usize) -> &[T] {
        &self.data[y * self.width..(y + 1) * self.width]
    }

    /// The part that is these columns and rows.
    pub fn part(&self, [columns, rows]: [Range<usize>; 2]) -> Self {
        let (width, height) = (columns.len(), rows.len());
        let pixels = rows.flat_map(|y| &self.row(y)[columns.clone()]);
        Image {
            width,
            height,
            data: pixels.copied().collect(),
        }
    }

    /// Another value for each pixel.
    pub fn map<U>(&self, f: impl FnMut(&T) -> U) -> Image<U> {
        let data = self.data.iter().map(f).collect();
        Image {
            width: self.width,
            height: self.height,
            data,
        }
    }
}

impl Rgb {
    /// Reduced by a whole factor, means of blocks.
    pub fn reduced(&self, by: usize) -> Rgb {
        let (width, height) = (self.width / by, self.height / by);
        let mut small = Rgb::filled(width, height, [0; 3]);
        let area = (by * by) as u32;
        for y in 0..height {
            for x in 0..width {
                let mut sum = [area / 2; 3];
                for row in y * by..(y + 1) * by {
                    for p in &self.row(row)[x * by..(x + 1) * by] {
                        (0..3).for_each(|c| sum[c] += u32::from(p[c]));
                    }
                }
                *small.at_mut(x, y) = sum.map(|s| (s / area) as u8);
            }
        }
        small
    }

    /// Brightness by Rec. 601 weights.
    pub fn gray(&self) -> Gray {
        self.map(|&[r, g, b]| 0.299 * f32::from(r) + 0.587 * f32::from(g) + 0.114 * f32::from(b))
    }
}

impl Gray {
    /// Reduced by a whole factor, means of blocks.
    pub fn reduced(&self, by: usize) -> Gray {
        let (width, height) = (self.width / by, self.height / by);
        let mut small = Gray::filled(width, height, 0.0);
        for y in 0..height {
            for x in 0..width {
                let mut sum = 0.0;
                for dy in 0..by {
                    let row = self.row(y * by + dy);
                    sum += row[x * by..(x + 1) * by].iter().sum::<f32>();
                }
                *small.at_mut(x, y) = sum / (by * by) as f32;
            }
        }
        small
    }
}

impl<T: Copy> Image<T>
where
    f32: From<T>,
{
    /// The value between pixels, bilinear; outside, that of the nearest border pixel.
    #[inline]
    pub fn sample(&self, x: f32, y: f32) -> f32 {
        let x = x.clamp(0.0, (self.width - 1) as f32);
        let y = y.clamp(0.0, (self.height - 1) as f32);
        let (x0, y0) = (x as usize, y as usize);
        let (x1, y1) = ((x0 + 1).min(self.width - 1), (y0 + 1).min(self.height - 1));
        // One by one: a map of an array is a call where many pixels are asked.
        let at = |x, y| f32::from(self.at(x, y));
        let four = [at(x0, y0), at(x1, y0), at(x0, y1), at(x1, y1)];
        crate::bilinear(four, [x - x0 as f32, y - y0 as f32])
    }
}
