//! Photos that are looked at with fewer pixels than they have, and cameras and people on them.

use crate::{Cameras, Found, Joint, People, PhotoId, Photos, View};

impl Cameras {
    /// The same cameras of photos that are looked at smaller, or larger again.
    pub fn of_photos(&self, photos: &Photos) -> Cameras {
        let view = |(id, view): (PhotoId, &View)| {
            let lens = &view.camera.lens;
            let size = photos.get(id).map(|photo| [photo.width, photo.height]);
            let camera = match size {
                Some([width, height]) if [lens.width, lens.height] != [width, height] => {
                    view.camera.resized(width, height)
                }
                _ => view.camera,
            };
            let view = View {
                camera,
                ..view.clone()
            };
            (id, view)
        };
        Cameras {
            views: self.views.iter().map(view).collect(),
            ..self.clone()
        }
    }
}

impl People {
    /// The same people on the same photos looked at smaller, or larger again.
    pub fn of_photos(&self, photos: &Photos, smaller: &Photos) -> People {
        let width = |photos: &Photos, id| photos.get(id).map_or(1.0, |p| p.width as f32);
        let one = |(id, found): (PhotoId, &Vec<Found>)| {
            let scale = width(smaller, id) / width(photos, id);
            match scale == 1.0 {
                true => (id, found.clone()),
                false => (id, found.iter().map(|one| one.scaled(scale)).collect()),
            }
        };
        People {
            views: self.views.iter().map(one).collect(),
            person: self.person,
        }
    }
}

impl Found {
    /// The same on a photo that is larger by a factor.
    fn scaled(&self, by: f32) -> Found {
        let at = |px: f32| (px + 0.5) * by - 0.5;
        let joint = |joint: &Joint| Joint {
            at_px: joint.at_px.map(at),
            ..*joint
        };
        Found {
            head_px: self.head_px.map(at),
            crop: self.crop.scaled(by),
            joints: self.joints.iter().map(joint).collect(),
            ..self.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Camera, Crop, Intrinsics, Photo, Scale};
    use nalgebra::Point3;

    /// A turn of one photo without a file.
    fn photos(width: u32, height: u32) -> Photos {
        Photos {
            photos: vec![Photo::of("a.png", [width, height], vec![])],
            ..Photos::default()
        }
    }

    #[test]
    fn people_and_cameras_are_where_they_were_on_a_smaller_photo_and_back() {
        let (large, small) = (photos(3000, 2000), photos(1500, 1000));
        let joint = Joint {
            at_px: [-0.5, 1999.5],
            ..Joint::default()
        };
        let found = Found {
            crop: Crop {
                centre_px: [800.5, 20.5],
                side_px: 600.0,
                angle: 0.3,
            },
            joints: vec![joint],
            ..Found::default()
        };
        let people = People {
            views: [(PhotoId(0), vec![found])].into_iter().collect(),
            person: true,
        };
        let fewer = people.of_photos(&large, &small);
        let one = fewer.subject(PhotoId(0)).unwrap();
        assert_eq!(one.joints[0].at_px, [-0.5, 999.5]);
        assert_eq!(
            (one.crop.centre_px, one.crop.side_px),
            ([400.0, 10.0], 300.0)
        );
        assert_eq!(fewer.of_photos(&small, &large), people);
        let lens = Intrinsics {
            width: 3000,
            height: 2000,
            focal: [2500.0; 2],
            centre: [1400.5, 1000.5],
            radial: [0.0; 2],
        };
        let camera = Camera::looking(lens, Point3::new(0.0, -900.0, 10.0), Point3::origin());
        let views = [(PhotoId(0), View::of("a.png", camera))];
        let cameras = Cameras::of(views, Scale::Nothing);
        let fewer = cameras.of_photos(&small);
        let lens = fewer.views.get(PhotoId(0)).unwrap().camera.lens;
        assert_eq!((lens.centre, lens.focal), ([700.0, 500.0], [1250.0; 2]));
        assert_eq!(fewer.of_photos(&large), cameras);
    }
}
