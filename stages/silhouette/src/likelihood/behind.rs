//! What a photo would show without the subject, by the scene.

use crate::plate::expected::expected;
use crate::scene::backdrop::Backdrop;
use crate::scene::still_and_disk::Scene as Laid;
use shape::{Aligned, Camera, Image, PhotoId, Rgb, Scene, Seen, toned};

/// The scene, ready to be shown as each photo would see it.
pub(crate) struct Behind<'a> {
    scene: &'a Scene,
    aligned: &'a Aligned,
    /// The scene laid out, where its disk is a map.
    laid: Option<Laid>,
}

impl<'a> Behind<'a> {
    /// Of a scene that is known.
    pub(crate) fn of(scene: &'a Scene, aligned: &'a Aligned) -> Self {
        let backdrop = |seen: &Seen| Backdrop {
            image: seen.image.clone(),
            seen: seen.shown_by.map(|photos| *photos > 0),
        };
        let nowhere = || Backdrop {
            image: Rgb::filled(1, 1, [0; 3]),
            seen: Image::filled(1, 1, false),
        };
        // A plate shows its disk.
        let laid = (!scene.bodies.is_empty()).then(|| Laid {
            room: backdrop(&scene.still),
            disk: scene.disk.as_ref().map_or_else(nowhere, backdrop),
            radius: scene
                .disk
                .as_ref()
                .and(aligned.disk_radius_mm())
                .unwrap_or(0.0),
        });
        Behind {
            scene,
            aligned,
            laid,
        }
    }

    /// The photos that can be cut.
    pub(crate) fn photos(&self) -> impl Iterator<Item = PhotoId> {
        self.scene.views.iter().map(|(id, _)| id)
    }

    /// Camera where photos are aligned, and the disk's radius. \[mm\]
    pub(crate) fn disk(&self, id: PhotoId) -> Option<(Camera, f64)> {
        self.aligned.camera(id).zip(self.aligned.disk_radius_mm())
    }

    /// What a photo, where photos are aligned, would show without the subject.
    pub(crate) fn of_photo(&self, id: PhotoId, pixels: &Rgb) -> Backdrop {
        if let Some(laid) = &self.laid {
            return match self.aligned.camera(id) {
                Some(camera) => laid.behind(pixels, &camera),
                None => laid.room.clone(),
            };
        }
        let view = self.scene.views.get(id).cloned().unwrap_or_default();
        let plate = &self.scene.still.image;
        let lit = view.tones.as_ref().map(|tones| toned(plate, tones));
        let disk = self.disk(id).zip(view.disk_turn);
        let turned = disk
            .as_ref()
            .map(|((camera, radius), turn)| (camera, *radius, *turn));
        Backdrop::whole(expected(lit.as_ref().unwrap_or(plate), turned))
    }
}
