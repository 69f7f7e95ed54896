//! What the stages of this crate read, and how large they look at it: the same for all.

use crate::pictures::need::Need;
use crate::pictures::picture::Picture;
use crate::pictures::prepare::{
    RefineError, check, footprint, halvings, looked_at, pictures, posed,
};
use shape::{Camera, Cameras, LOOKED_AT_MPX, Masks, Mesh, PhotoError, Photos, View};
use std::sync::Arc;

stage::params! {
    /// How large photos are looked at.
    pub struct PhotoSize {
        /// Level of the Gaussian pyramid: photos are halved so many times, 500 pixels left.
        #[range(0..=6)]
        #[source(structural)]
        level: u32 = 0,
        /// Photos are looked at with so many million pixels at most: means first, then halved.
        #[range(0.1..=100.0)]
        #[source(structural)]
        most_mpx: f64 = LOOKED_AT_MPX,
    }
}

stage::inputs! {
    /// A surface and the photos of one turn.
    pub struct TurnInput {
        /// Closed; a hull will do, but a deformation is kept apart from shape only on an optimized surface.
        mesh: Arc<Mesh>,
        /// Those without a camera are passed over.
        photos: Arc<Photos>,
        /// Where they were taken: as the body saw them, once that is known.
        cameras: Arc<Cameras>,
        /// Silhouettes: what is beyond them is not the body.
        masks: Option<Arc<Masks>>,
    }
}

impl TurnInput {
    /// How much memory so many copies of the pictures take, and a surface with so long edges. \[px, bytes\]
    pub(crate) fn memory(&self, size: &PhotoSize, copies: u32, edge_px: f64) -> u64 {
        let masks = self.masks.as_deref();
        let need = Need::new(
            &self.photos,
            &self.cameras,
            masks,
            size.level,
            size.most_mpx,
        );
        (need.pictures(copies) + need.surface(edge_px, &self.mesh)) as u64
    }

    /// The pictures and what else is made of the surface meanwhile, given what a pixel covers on it \[mm\], which
    /// comes last: neither needs the other, and the surface alone keeps but one thread busy.
    ///
    /// # Errors
    /// As [`Self::pictures`].
    pub(crate) fn ready<E: From<RefineError> + From<PhotoError> + Send, T: Send>(
        &self,
        size: &PhotoSize,
        go_on: impl Fn() -> Result<(), E> + Send + Sync,
        surface: impl FnOnce(f64) -> T + Send,
    ) -> Result<(Vec<Picture>, T, f64), E> {
        check(&self.mesh)?;
        let views = posed(&self.photos, &self.cameras);
        let blank = |view: &View| {
            let lens = looked_at(&view.camera.lens, size.most_mpx);
            let halvings = halvings([lens.width, lens.height], size.level, size.most_mpx);
            let pose = view.camera.pose;
            Picture::blank(&Camera { lens, pose }, halvings)
        };
        let blanks: Vec<Picture> = views.iter().map(|(_, view)| blank(view)).collect();
        let footprint = footprint(&self.mesh, &blanks);
        let (pictures, surface) = rayon::join(|| self.drawn(size, go_on), || surface(footprint));
        Ok((pictures?, surface, footprint))
    }

    /// The photos that have a camera, in turning order; `go_on` fails when the user asked to stop.
    ///
    /// # Errors
    /// A mesh that is not closed or has no face, fewer than two photos with a camera, a photo that
    /// cannot be decoded or is not of its camera's size.
    pub(crate) fn pictures<E: From<RefineError> + From<PhotoError> + Send>(
        &self,
        size: &PhotoSize,
        go_on: impl Fn() -> Result<(), E> + Sync,
    ) -> Result<Vec<Picture>, E> {
        check(&self.mesh)?;
        self.drawn(size, go_on)
    }

    /// The same where the mesh was checked.
    fn drawn<E: From<RefineError> + From<PhotoError> + Send>(
        &self,
        size: &PhotoSize,
        go_on: impl Fn() -> Result<(), E> + Sync,
    ) -> Result<Vec<Picture>, E> {
        let (photos, cameras, masks) = (&self.photos, &self.cameras, self.masks.as_deref());
        pictures(photos, cameras, masks, size.level, size.most_mpx, go_on)
    }
}
