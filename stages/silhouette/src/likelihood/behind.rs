//! What a photo would show without the subject, by the scene.

use crate::likelihood::floor::{Floor, Soles, floor};
use crate::plate::expected::expected;
use crate::scene::backdrop::Backdrop;
use crate::scene::still_and_disk::Scene as Laid;
use shape::{Aligned, People, PhotoId, Rgb, Scene, Seen, toned};

/// The scene, ready to be shown as each photo would see it.
pub(crate) struct Behind<'a> {
    scene: &'a Scene,
    aligned: &'a Aligned,
    /// Where the floor is, if no disk is known.
    soles: Option<Soles>,
    /// The scene laid out, where its disk is a map.
    laid: Option<Laid>,
}

impl<'a> Behind<'a> {
    /// Of a scene that is known, and the people before it.
    pub(crate) fn of(scene: &'a Scene, aligned: &'a Aligned, people: Option<&People>) -> Self {
        let backdrop = |seen: &Seen| Backdrop {
            image: seen.image.clone(),
            seen: seen.shown_by.map(|photos| *photos > 0),
        };
        // A plate shows its disk.
        let laid = (!scene.bodies.is_empty()).then(|| Laid {
            still: backdrop(&scene.still),
            disk: scene.disk.as_ref().map_or_else(Backdrop::nowhere, backdrop),
            radius: scene
                .disk
                .as_ref()
                .and(aligned.disk_radius_mm())
                .unwrap_or(0.0),
        });
        Behind {
            scene,
            aligned,
            soles: Soles::below(people, aligned),
            laid,
        }
    }

    /// The photos that can be cut.
    pub(crate) fn photos(&self) -> impl Iterator<Item = PhotoId> {
        self.scene.views.iter().map(|(id, _)| id)
    }

    /// The floor before the camera, where photos are aligned.
    pub(crate) fn floor(&self, id: PhotoId) -> Option<Floor> {
        floor(self.aligned, self.soles, id)
    }

    /// What a photo, where photos are aligned, would show without the subject.
    pub(crate) fn of_photo(&self, id: PhotoId, pixels: &Rgb) -> Backdrop {
        if let Some(laid) = &self.laid {
            return match self.aligned.camera(id) {
                Some(camera) => laid.behind(pixels, &camera),
                None => laid.still.clone(),
            };
        }
        let view = self.scene.views.get(id).cloned().unwrap_or_default();
        let plate = &self.scene.still.image;
        let lit = view.tones.as_ref().map(|tones| toned(plate, tones));
        // Where no disk is known the plate's was not turned.
        let disk = self.floor(id).zip(view.disk_turn);
        let turned = disk
            .as_ref()
            .map(|(top, turn)| (&top.camera, top.touched, *turn));
        Backdrop::whole(expected(lit.as_ref().unwrap_or(plate), turned))
    }
}
