//! A network: operators one after the other.

use super::convolve::Convolution;
use super::depthwise::Depthwise;
use super::pixelwise::{add, doubled, max_pool, to_space};
use super::tensor::Tensor;
use stage::machine::widest;

/// What is done to an image.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Op {
    Convolve(Convolution),
    Depthwise(Depthwise),
    Add { other: usize, relu6: bool },
    MaxPool,
    Double,
    ToSpace,
}

/// An operator and the image that it reads: 0 is the input, n what the n-th operator made.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Step {
    pub(super) from: usize,
    pub(super) op: Op,
}

/// A network that is ready to run. Runs on one thread; each sum in a fixed order.
#[derive(Debug, Clone, PartialEq)]
pub struct Network {
    input: [usize; 3],
    steps: Vec<Step>,
    ends: Vec<usize>,
    /// The last step that reads each image.
    last: Vec<usize>,
}

impl Network {
    pub(super) fn new(input: [usize; 3], steps: Vec<Step>, ends: Vec<usize>) -> Network {
        let mut last = vec![0; steps.len() + 1];
        for (i, step) in steps.iter().enumerate() {
            last[step.from] = i;
            if let Op::Add { other, .. } = step.op {
                last[other] = i;
            }
        }
        // What is wanted is kept.
        for end in &ends {
            last[*end] = usize::MAX;
        }
        Network {
            input,
            steps,
            ends,
            last,
        }
    }

    /// Height, width and channels of its input.
    pub fn input(&self) -> [usize; 3] {
        self.input
    }

    /// What comes out for an input of its size, row-major, channels side by side.
    ///
    /// # Panics
    ///
    /// The input is of another size.
    pub fn run(&self, input: &[f32]) -> Vec<Tensor> {
        let [height, width, channels] = self.input;
        assert_eq!(input.len(), height * width * channels, "size of the input");
        let first = Tensor {
            height,
            width,
            channels,
            data: input.to_vec(),
        };
        let mut made: Vec<Option<Tensor>> = vec![Some(first)];
        for (i, step) in self.steps.iter().enumerate() {
            let image = |n: usize| made[n].as_ref().expect("bug: an image let go too early");
            let from = image(step.from);
            let next = widest(
                #[inline(always)]
                || match &step.op {
                    Op::Convolve(one) => one.of(from),
                    Op::Depthwise(one) => one.of(from),
                    Op::Add { other, relu6 } => add(from, image(*other), *relu6),
                    Op::MaxPool => max_pool(from),
                    Op::Double => doubled(from),
                    Op::ToSpace => to_space(from),
                },
            );
            made.push(Some(next));
            for n in 0..=i {
                if self.last[n] == i {
                    made[n] = None;
                }
            }
        }
        let out = |end: &usize| made[*end].clone().expect("bug: an output let go");
        self.ends.iter().map(out).collect()
    }
}
