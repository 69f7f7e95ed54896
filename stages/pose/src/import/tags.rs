//! The stage that takes marker tags that another detector found.

use crate::import::found::{At, FoundError, json};
use shape::{PhotoId, Photos, Tag, Tags};
use stage::{Ctx, Files, Stage, Stop};
use std::collections::BTreeMap;
use std::sync::Arc;

stage::inputs! {
    /// Somebody's tags.
    pub struct TagsFileInput {
        /// One `tags.json`: a list of `{"photo": P, "tags": [{"id": N, "corners": [[x, y], …]}]}`; `P` is a
        /// photo's place in the turn, from 0, or its file's name; corners as printed: top left, top right,
        /// bottom right, bottom left, in pixels.
        files: Arc<Files>,
        /// The photos they are on.
        photos: Arc<Photos>,
    }
}

/// `pose.import_tags`: files, photos → tags.
pub struct ImportTags;

impl Stage for ImportTags {
    const NAME: &'static str = "pose.import_tags";
    const VERSION: u32 = 1;
    const ABOUT: &'static str = "Takes marker tags from a tags.json.";
    type Params = ();
    type Input = TagsFileInput;
    type Output = Tags;
    const METRICS: &'static [&'static str] = &["tags a photo"];

    fn run(_: &(), input: TagsFileInput, ctx: &Ctx<'_>) -> Result<Tags, Stop> {
        let (file, value) = json(&input.files, "tags.json")?;
        let tags = read(At::top(&file, &value), &input.photos)?;
        let count: usize = tags.views.values().map(Vec::len).sum();
        let views = tags.views.len().max(1);
        ctx.metric("tags a photo", count as f64 / views as f64, "");
        Ok(tags)
    }
}

/// Tags by photo, sorted by number; a number that one photo shows twice is nobody's.
fn read(top: At<'_>, photos: &Photos) -> Result<Tags, FoundError> {
    let mut views: BTreeMap<PhotoId, Vec<Tag>> = BTreeMap::new();
    top.each("a list with an entry for each photo", |view| {
        let (id, photo) = view.key("photo", |at| at.photo(photos))?;
        let tags = view.key("tags", |list| {
            list.each("a list of tags", |tag| {
                let number = tag.key("id", |at| {
                    let number = at.value.as_u64().and_then(|n| u32::try_from(n).ok());
                    number.ok_or_else(|| at.wrong("a tag's number"))
                })?;
                let corners = tag.key("corners", |at| {
                    let corners = at.each("four corners", |at| at.place(photo))?;
                    corners.try_into().map_err(|_| at.wrong("four corners"))
                })?;
                Ok(Tag {
                    id: number,
                    corners,
                })
            })
        })?;
        match views.insert(id, tags) {
            Some(_) => Err(view.wrong("one entry for each photo")),
            None => Ok(()),
        }
    })?;
    for tags in views.values_mut() {
        tags.sort_by_key(|tag| tag.id);
        let ids: Vec<u32> = tags.iter().map(|tag| tag.id).collect();
        tags.retain(|tag| ids.iter().filter(|id| **id == tag.id).count() == 1);
    }
    let views = views.into_iter().collect();
    Ok(Tags { views })
}
