//! Small convolutional networks, as `models/person/convert.py` writes them: sums in a fixed order, the same bytes on
//! every machine. Knows no stage and no person.

mod convolve;
mod depthwise;
mod file;
mod half;
mod network;
mod pixelwise;
mod tensor;

pub use file::Unreadable;
pub use network::Network;
pub use tensor::Tensor;
