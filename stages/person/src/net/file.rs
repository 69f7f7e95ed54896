//! A network's flat file, read and checked: `models/person/README.md` tells the format.

use super::convolve::{Convolution, LANES, Window};
use super::depthwise::Depthwise;
use super::half::single;
use super::network::{Network, Op, Step};

/// What is wrong with a network's file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unreadable(pub &'static str);

impl std::fmt::Display for Unreadable {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "no network: {}", self.0)
    }
}

impl std::error::Error for Unreadable {}

/// How a file begins (structural: the file's form).
const MAGIC: &[u8] = b"TAILNET1";
/// Numbers of an operator in the file (structural: the file's form).
const WORDS: usize = 14;
/// Where an operator has no second input or no weights (structural: the file's form).
const NONE: u32 = u32::MAX;
/// What an activation, a kernel, a number of operators stays below: nothing here comes near it.
/// It is structural: a limit of memory.
const MOST: usize = 1 << 24;

/// The numbers of a file, one after the other.
struct Words<'a>(&'a [u8]);

impl<'a> Words<'a> {
    fn bytes(&mut self, count: usize) -> Result<&'a [u8], Unreadable> {
        let cut = Unreadable("it is cut short");
        let (taken, rest) = self.0.split_at_checked(count).ok_or(cut)?;
        self.0 = rest;
        Ok(taken)
    }

    fn word(&mut self) -> Result<u32, Unreadable> {
        let bytes = self.bytes(4)?;
        Ok(u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
    }

    fn size(&mut self) -> Result<usize, Unreadable> {
        let size = self.word()? as usize;
        (size < MOST)
            .then_some(size)
            .ok_or(Unreadable("a number is too large"))
    }
}

impl Network {
    /// From its flat file.
    ///
    /// # Errors
    ///
    /// The file is none, or is cut short.
    pub fn read(file: &[u8]) -> Result<Network, Unreadable> {
        read(file)
    }
}

fn read(file: &[u8]) -> Result<Network, Unreadable> {
    let mut words = Words(file);
    if words.bytes(MAGIC.len())? != MAGIC {
        return Err(Unreadable("it begins otherwise"));
    }
    let input = [words.size()?, words.size()?, words.size()?];
    let (ops, ends, count, sparse) = (words.size()?, words.size()?, words.size()?, words.size()?);
    let ends = (0..ends)
        .map(|_| words.size())
        .collect::<Result<Vec<_>, _>>()?;
    let rows: Vec<Vec<u32>> = (0..ops)
        .map(|_| (0..WORDS).map(|_| words.word()).collect())
        .collect::<Result<_, _>>()?;
    let values = values(&mut words, count, sparse != 0)?;
    if !words.0.is_empty() {
        return Err(Unreadable("it is too long"));
    }
    let mut shapes = vec![input];
    let mut steps = Vec::new();
    for row in &rows {
        let (step, shape) = step(row, &shapes, &values)?;
        if shape.iter().product::<usize>() >= MOST {
            return Err(Unreadable("an image is too large"));
        }
        steps.push(step);
        shapes.push(shape);
    }
    if ends.is_empty() || ends.iter().any(|end| *end == 0 || *end >= shapes.len()) {
        return Err(Unreadable("an output that nothing makes"));
    }
    Ok(Network::new(input, steps, ends))
}

/// The weights; where zeros are left out, a bit each marks which are there.
fn values(words: &mut Words<'_>, count: usize, sparse: bool) -> Result<Vec<f32>, Unreadable> {
    let half = |pair: &[u8]| single(u16::from_le_bytes([pair[0], pair[1]]));
    if !sparse {
        return Ok(words.bytes(2 * count)?.chunks_exact(2).map(half).collect());
    }
    let bits = words.bytes(count.div_ceil(8))?;
    let mut values = Vec::with_capacity(count);
    for i in 0..count {
        values.push(match bits[i / 8] >> (i % 8) & 1 {
            0 => 0.0,
            _ => half(words.bytes(2)?),
        });
    }
    Ok(values)
}

/// An operator of a row, and the height, width and channels of what it makes.
fn step(
    row: &[u32],
    shapes: &[[usize; 3]],
    values: &[f32],
) -> Result<(Step, [usize; 3]), Unreadable> {
    let number = |i: usize| row[i] as usize;
    let shape = |i: usize| {
        let unknown = Unreadable("an input that comes later");
        shapes.get(number(i)).copied().ok_or(unknown)
    };
    let a @ [height, width, channels] = shape(1)?;
    let relu6 = row[3] != 0;
    let window = Window {
        size: [number(5), number(6)],
        stride: number(4),
        pads: [number(7), number(8), number(9), number(10)],
    };
    let out = number(11);
    let small = window.size.iter().chain(&window.pads).all(|n| *n <= 16);
    if !small || window.size.contains(&0) || window.stride == 0 || out == 0 || out >= MOST {
        return Err(Unreadable("an operator that is none"));
    }
    let weights = |count: usize| part(values, row[12], count);
    let bias = || part(values, row[13], out);
    let taps = window.size[0] * window.size[1];
    let larger = Unreadable("a window larger than its image");
    let wrong = Unreadable("channels that do not fit");
    let (op, [height, width]) = match row[0] {
        0 => {
            let one = Convolution::new(window, weights(taps * channels * out)?, bias()?, relu6);
            let size = window.out(height, width).ok_or(larger)?;
            (Op::Convolve(one), size)
        }
        1 if out == channels && out.is_multiple_of(LANES) => {
            let one = Depthwise {
                window,
                weights: weights(taps * channels)?.to_vec(),
                bias: bias()?.to_vec(),
                relu6,
            };
            let size = window.out(height, width).ok_or(larger)?;
            (Op::Depthwise(one), size)
        }
        2 if row[2] != NONE && shape(2)? == a && out == channels => {
            let add = Op::Add {
                other: number(2),
                relu6,
            };
            (add, [height, width])
        }
        3 if out == channels => (Op::MaxPool, [height / 2, width / 2]),
        4 if out == channels => (Op::Double, [2 * height, 2 * width]),
        5 if 4 * out == channels => (Op::ToSpace, [2 * height, 2 * width]),
        1..6 => return Err(wrong),
        _ => return Err(Unreadable("an operator that is not known")),
    };
    let step = Step {
        from: number(1),
        op,
    };
    Ok((step, [height, width, out]))
}

fn part(values: &[f32], at: u32, count: usize) -> Result<&[f32], Unreadable> {
    let from = values.get(at as usize..).and_then(|v| v.get(..count));
    from.ok_or(Unreadable("weights beyond its end"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One pixel of one channel, times 2, plus 1.
    fn tiny() -> Vec<u8> {
        let mut file = MAGIC.to_vec();
        let head = [1, 1, 1, 1, 1, 2, 0];
        let op = [0, 0, NONE, 0, 1, 1, 1, 0, 0, 0, 0, 1, 0, 1];
        for word in head.into_iter().chain([1]).chain(op) {
            file.extend(u32::to_le_bytes(word));
        }
        file.extend([0x00, 0x40, 0x00, 0x3c]);
        file
    }

    #[test]
    fn a_file_is_a_network_or_its_fault_is_named() {
        let network = read(&tiny()).unwrap();
        assert_eq!(network.run(&[3.0])[0].data, [7.0]);
        for end in 0..tiny().len() {
            assert!(read(&tiny()[..end]).is_err(), "{end}");
        }
        for at in 0..tiny().len() - 4 {
            for value in [0, 1, 2, 5, 0x7f, 0xff] {
                let mut file = tiny();
                file[at] = value;
                let _ = read(&file);
            }
        }
    }
}
