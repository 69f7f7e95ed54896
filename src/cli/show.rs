//! `tailor show`: one artifact out of the cache as a file.

use super::run::open;
use super::{Change, Fault, House, Wanted};
use crate::store::Store;
use crate::{engine, out};
use clap::Args;
use shape::Photos;
use stage::Hash;
use std::path::PathBuf;

/// Arguments of `tailor show`.
#[derive(Args)]
pub(crate) struct Show {
    /// The node
    node: String,
    /// The pipeline file that it belongs to
    #[arg(long, default_value = "pipelines/body.toml")]
    pipeline: PathBuf,
    #[command(flatten)]
    change: Change,
    /// The format; the kind's usual one if not said
    #[arg(long = "as")]
    format: Option<String>,
    /// The file, or the folder where there are several
    #[arg(short)]
    o: PathBuf,
}

/// Does it: the newest run of a node of that name whose result is still there.
pub(crate) fn show(show: &Show, house: &House) -> Result<(), Fault> {
    let wanted = Wanted {
        pipeline: show.pipeline.clone(),
        nodes: vec![show.node.clone()],
        change: show.change.clone(),
    };
    let (graph, nodes) = open(&wanted, house)?;
    let store = Store::open(&house.cache).map_err(Fault::input)?;
    let read = |name: &str| {
        let at = graph.node(name)?;
        let stage = graph.nodes[at].stage;
        engine::runs(store.root()).into_iter().find_map(|(_, run)| {
            let node = run["nodes"]
                .as_array()?
                .iter()
                .find(|n| n["node"] == name)?
                .clone();
            if node["stage"] != stage.name() {
                return None;
            }
            let blob = store.blob(Hash::from_hex(node["content"].as_str()?).ok()?)?;
            stage.read(&blob).ok()
        })
    };
    let name = &graph.nodes[nodes[0]].name;
    let artifact = read(name).ok_or_else(|| {
        Fault::input(format!(
            "the cache holds no result of `{name}`; run the pipeline first"
        ))
    })?;
    let photos = graph.nodes.iter().find(|n| n.stage.yields() == "photos");
    let photos = photos
        .and_then(|n| read(&n.name))
        .and_then(|a| a.downcast::<Photos>());
    let photos = photos.map_or_else(Photos::default, |p| (*p).clone());
    let files = out::files(artifact, &photos, show.format.as_deref()).map_err(Fault::input)?;
    out::write(&show.o, &files).map_err(Fault::stage)
}
