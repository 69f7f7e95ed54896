//! What holds a camera, and how adjustments go.

use crate::adjust::belief::Beliefs;
use crate::adjust::bundle::Settings;

/// How cameras grow.
#[derive(Debug, Clone)]
pub(crate) struct Growth {
    /// Points further from where they were seen are left out. \[px\]
    pub(crate) near_px: f64,
    /// Whether the photo comes next whose points are best spread over it, not the one that has most: of a turn it is the
    /// background that fills photos.
    pub(crate) spread: bool,
    /// Fewest points that hold a camera.
    pub(crate) least: usize,
    /// Least share of the points a photo shows that must agree with its camera.
    pub(crate) share: f64,
    /// Most samples of a photo's RANSAC.
    pub(crate) rounds: usize,
    /// Seed.
    pub(crate) seed: u64,
    /// Most points of an adjustment while cameras grow.
    pub(crate) most: usize,
    /// Least standard deviation of an observation. \[px\]
    pub(crate) sigma_px: f64,
    /// What is believed of lenses.
    pub(crate) beliefs: Beliefs,
    /// How the last adjustments go; those before take fewer steps.
    pub(crate) how: Settings,
}
