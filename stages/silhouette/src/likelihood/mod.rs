//! What each pixel costs as background and as body. \[nats\]

pub(crate) mod background;
pub(crate) mod behind;
pub(crate) mod body;
pub(crate) mod cast;
pub(crate) mod colors_beside;
pub(crate) mod disk_colors;
pub(crate) mod floor;
pub(crate) mod gmm;
pub(crate) mod grain;
pub(crate) mod grounds;
pub(crate) mod local_light;
pub(crate) mod mirror;
pub(crate) mod neighbourhoods;
pub(crate) mod noise;
pub(crate) mod person;
pub(crate) mod prepared;
pub(crate) mod stage;
