//! A story from its beginning to its end.

use super::acts;
use super::oracle;
use super::process::hush;
use super::seam;
use super::story::Story;
use super::world::World;
use std::rc::Rc;
use system::clock::simulated;

/// Plays a story: what happened, and what did not hold.
pub(super) fn played(story: &Story) -> (Vec<String>, Option<String>) {
    hush();
    let world = Rc::new(World::new(story, acts::act));
    seam::set(Some(world.clone()));
    for act in &story.acts {
        world.perform(act, 0);
        if world.is_broken() {
            break;
        }
    }
    if !world.is_broken() {
        oracle::end(&world);
    }
    seam::set(None);
    simulated::set(None);
    world.ended()
}
