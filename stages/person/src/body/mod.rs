//! People on a photo by two networks: one finds them, one locates body and joints.
//!
//! Bazarevsky et al., "BlazePose: On-device Real-time Body Pose tracking", CV4ARVR 2020. What is done before and after
//! the networks is MediaPipe's (0.10.9); its numbers are where they are used.

mod detect;
mod networks;
mod place;
mod pose;
mod sample;

pub use networks::Networks;
