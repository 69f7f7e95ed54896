//! What other programs found on photos: it comes back as it was written, and what is impossible is refused with its place.

use pose::{ImportTags, ImportTracks, TagsFileInput, TracksFileInput};
use shape::{Observation, Photo, PhotoId, Photos, Tag, Tags, Tracks};
use stage::{AnyArtifact, Ctx, FileEntry, Files, Stage, Stop};
use std::sync::Arc;

fn photos() -> Arc<Photos> {
    let photo = |i| Photo::of(format!("{i:04}.jpg"), [400, 600], vec![i]);
    Arc::new(Photos {
        photos: (0..3).map(photo).collect(),
        ..Photos::default()
    })
}

/// Runs a stage on one file.
fn taken<T>(
    texts: &[&[u8]],
    run: impl FnOnce(Arc<Files>, Arc<Photos>) -> Result<T, Stop>,
) -> Result<T, String> {
    let place = tempfile::tempdir().unwrap();
    let entry = |(i, text): (usize, &&[u8])| {
        let name = format!("{i}.json");
        std::fs::write(place.path().join(&name), text).unwrap();
        let (content, size) = (stage::hash(text), text.len() as u64);
        FileEntry {
            name,
            content,
            size,
        }
    };
    let entries = texts.iter().enumerate().map(entry).collect();
    let root = place.path().to_owned();
    run(Arc::new(Files { root, entries }), photos()).map_err(|stop| match stop {
        Stop::Failed(why) => why.to_string(),
        Stop::Cancelled => unreachable!("nobody stops it"),
    })
}

fn tags(texts: &[&[u8]]) -> Result<Tags, String> {
    taken(texts, |files, photos| {
        ImportTags::run(&(), TagsFileInput { files, photos }, &Ctx::alone())
    })
}

fn tracks(texts: &[&[u8]]) -> Result<Tracks, String> {
    taken(texts, |files, photos| {
        ImportTracks::run(&(), TracksFileInput { files, photos }, &Ctx::alone())
    })
}

/// An artifact's usual or named format, one file.
fn written(artifact: AnyArtifact, format: &str) -> Vec<u8> {
    io::files(artifact, format, None).unwrap().remove(0).1
}

#[test]
fn tags_and_tracks_come_back_as_they_were_written() {
    let tag = |id: u32| Tag {
        id,
        corners: [1.0, 2.5, 3.125, 4.0].map(|x| [x, 0.1 + f64::from(id)]),
    };
    let views = [(0, vec![tag(3), tag(7)]), (2, vec![tag(3)])];
    let own = Tags {
        views: views.into_iter().map(|(i, t)| (PhotoId(i), t)).collect(),
    };
    let file = written(AnyArtifact::new(own.clone()), "json");
    assert_eq!(tags(&[&file]).unwrap(), own);
    let seen = |photo, x| Observation {
        photo: PhotoId(photo),
        at_px: [x, 0.1],
        scale_px: 3.3,
    };
    let own = Tracks {
        points: vec![
            vec![seen(0, 5.7), seen(2, 6.1)],
            vec![seen(1, 9.0), seen(2, 8.0)],
        ],
    };
    let file = written(AnyArtifact::new(own.clone()), "json");
    assert_eq!(tracks(&[&file]).unwrap(), own);
}

#[test]
fn photos_are_named_and_a_tag_seen_twice_is_nobodys() {
    let square = "[[1,1],[9,1],[9,9],[1,9]]";
    let text = format!(
        r#"[{{"photo":"0001.jpg","tags":[{{"id":9,"corners":{square}}},{{"id":4,"corners":{square}}},
           {{"id":9,"corners":{square}}}]}}]"#
    );
    let found = tags(&[text.as_bytes()]).unwrap();
    let ids: Vec<u32> = found
        .views
        .get(PhotoId(1))
        .unwrap()
        .iter()
        .map(|t| t.id)
        .collect();
    assert_eq!(ids, [4]);
}

#[test]
fn what_is_impossible_is_refused_with_its_place() {
    let one = |text: &str| tags(&[text.as_bytes()]).unwrap_err();
    assert!(tags(&[]).unwrap_err().contains("0 files are there"));
    assert!(
        tags(&[b"[]", b"[]"])
            .unwrap_err()
            .contains("2 files are there")
    );
    assert!(one("[").contains("0.json is not JSON"));
    assert!(one("{}").contains("$: a list with an entry for each photo is wanted, not {}"));
    assert!(one(r#"[{"photo":"9.jpg","tags":[]}]"#).contains(r#"$[0].photo: a photo's place"#));
    assert!(one(r#"[{"photo":3,"tags":[]}]"#).contains("not 3"));
    assert!(one(r#"[{"photo":0}]"#).contains("$[0].tags: a list of tags is wanted, not null"));
    let far = r#"[{"photo":0,"tags":[{"id":1,"corners":[[1,1],[9,1],[9,1e9],[1,9]]}]}]"#;
    assert!(one(far).contains("$[0].tags[0].corners[2]: [x, y] on the photo"));
    assert!(one(r#"[{"photo":0,"tags":[{"id":-1,"corners":[]}]}]"#).contains("a tag's number"));
    assert!(one(r#"[{"photo":0,"tags":[{"id":1,"corners":[[1,1]]}]}]"#).contains("four corners"));
    assert!(one(r#"[{"photo":0,"tags":[]},{"photo":"0000.jpg","tags":[]}]"#).contains("one entry"));
    let one = |text: &str| tracks(&[text.as_bytes()]).unwrap_err();
    let seen =
        |photo: u32, scale: f64| format!(r#"{{"photo":{photo},"at_px":[1,2],"scale_px":{scale}}}"#);
    assert!(one(&format!("[[{}]]", seen(0, 1.0))).contains("$[0]: observations on two photos"));
    let twice = format!("[[{},{}]]", seen(1, 1.0), seen(1, 1.0));
    assert!(one(&twice).contains("one on each"));
    let flat = format!("[[{},{}]]", seen(1, 1.0), seen(0, 0.0));
    assert!(one(&flat).contains("$[0][1].scale_px: a size"));
}
