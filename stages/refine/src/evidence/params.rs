//! Params of every stage that compares patches.

use crate::evidence::patch::Window;

stage::params! {
    /// Which patches of the surface are compared.
    pub struct PatchParams {
        /// Points of a patch from its middle to its side.
        #[range(1..=5)]
        patch: u32 = 4,
        /// Whether a linear change of brightness across a patch is taken out, as shade is.
        level_patch: bool = true,
        /// Greatest angle between the surface's normal and a line of sight.
        #[range(10.0..=85.0)]
        tilt_deg: f64 = 65.0,
    }
}

impl PatchParams {
    /// The patch's points.
    pub(crate) fn window(&self) -> Window {
        Window::new(self.patch as usize, self.level_patch)
    }
}
