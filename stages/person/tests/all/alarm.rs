//! Masks that lose a part of the body are named by photo and region; those that agree are passed over in silence.

use person::{Alarm, AlarmInput, AlarmParams, FindPeople, FindPeopleInput, FindPeopleParams};
use shape::{BodyPart, LostParts, Mask, Masks, Photo, PhotoId, Photos};
use stage::{Ctx, Host, Stage};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

#[derive(Default)]
struct Heard(Mutex<Vec<String>>);

impl Host for Heard {
    fn warn(&self, text: &stage::Message) {
        self.0.lock().unwrap().push(text.to_string());
    }
}

fn sample() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/mannequin")
}

/// One photo's mask, painted over.
fn painted(masks: &mut Masks, photo: u32, paint: impl FnOnce(&mut Mask)) {
    let kept = masks.views.get_mut(PhotoId(photo)).unwrap();
    let mut mask = kept.pixels();
    paint(&mut mask);
    *kept = mask.into();
}

/// Four photos of the sample.
fn turn() -> Photos {
    let stems = ["0000", "0004", "0009", "0013"];
    let photo = |stem: &str| {
        Photo::of(
            format!("{stem}.jpg"),
            [800, 1200],
            std::fs::read(sample().join(format!("images/{stem}.jpg"))).unwrap(),
        )
    };
    Photos {
        photos: stems.map(photo).to_vec(),
        ..Photos::default()
    }
}

#[test]
fn masks_without_legs_or_head_are_named_by_photo() {
    let photos = Arc::new(turn());
    let input = FindPeopleInput {
        photos: photos.clone(),
    };
    let people = FindPeople::run(&FindPeopleParams {}, input, &Ctx::alone()).unwrap();
    let people = Arc::new(people);
    let own = |id| (id, people.subject(id).unwrap().mask(800, 1200));
    let masks: Masks = (0..4).map(PhotoId).map(own).collect();
    let reported = |masks: &Masks| {
        let heard = Heard::default();
        let nothing = stage::hash(b"");
        let input = AlarmInput {
            masks: Arc::new(masks.clone()),
            people: people.clone(),
            photos: photos.clone(),
        };
        let ctx = Ctx::new(&heard, nothing, nothing);
        let parts = Alarm::run(&AlarmParams::default(), input, &ctx).unwrap();
        (parts, heard.0.into_inner().unwrap())
    };
    let nothing = LostParts {
        photos: 4,
        ..LostParts::default()
    };
    assert_eq!(reported(&masks), (nothing, vec![]));
    // Holes amid the trunk, of four and of twelve pixels of the network.
    let holed = |wide: f32| {
        let mut masks = masks.clone();
        let found = people.subject(PhotoId(2)).unwrap();
        let middle = [0, 1].map(|k| {
            let trunk = [11, 12, 23, 24].map(|joint| found.joints[joint].at_px[k]);
            trunk.iter().sum::<f32>() / 4.0
        });
        let reach = wide * found.pixel_px() / 2.0;
        let [columns, rows] = middle.map(|v| (v - reach) as usize..(v + reach) as usize);
        painted(&mut masks, 2, |mask| {
            rows.for_each(|y| mask.data[y * 800..][columns.clone()].fill(0));
        });
        reported(&masks).0
    };
    assert_eq!(holed(4.0), reported(&masks).0);
    assert_eq!(holed(12.0).of(BodyPart::Trunk), [PhotoId(2)]);
    // Nothing below the hips on one; the upper half on another.
    let mut broken = masks.clone();
    painted(&mut broken, 1, |legs| legs.data[700 * 800..].fill(0));
    painted(&mut broken, 3, |upper| upper.data[..330 * 800].fill(0));
    let (parts, reported) = reported(&broken);
    assert_eq!(parts.of(BodyPart::Legs), [PhotoId(1)]);
    assert_eq!(parts.of(BodyPart::Head), [PhotoId(3)]);
    let is_reported = |what: &str| reported.iter().any(|t| t.contains(what));
    assert!(
        is_reported("a leg or a part of it on 0004.jpg,"),
        "{reported:?}"
    );
    assert!(
        is_reported("the head or a part of it on 0013.jpg,"),
        "{reported:?}"
    );
    assert!(
        !is_reported("0000.jpg") && !is_reported("0009.jpg"),
        "{reported:?}"
    );
}
