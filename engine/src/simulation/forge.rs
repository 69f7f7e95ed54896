//! A stranger in the shared store.

use super::application::application;
use super::oracle_there;
use super::process::Process;
use super::story::NUMBERS;
use super::world::World;
use crate::store::remote::{drain, working_beside};
use crate::store::{self, Store};

/// Puts another result into the shared store than the pipeline makes, signed by a stranger or by nobody.
pub(super) fn forge(
    world: &World,
    machine: usize,
    (capture, n, node): (usize, usize, usize),
    signed: bool,
) -> Option<()> {
    oracle_there::used(world);
    world.wanted.set((capture, n));
    let process = Process::sound(machine);
    let application = application();
    let files = world.machines[machine].files(capture);
    let (made, other) = (
        application.expected(n, &files),
        application.expected((n + 1) % NUMBERS, &files),
    );
    let node = node % made.len();
    let graph = application.graph(n);
    let content = |source: &Option<crate::graph::Source>| match source.as_ref()? {
        crate::graph::Source::Input(_) => Some(stage::content(&files)),
        crate::graph::Source::Node(j) => Some(blake3::hash(&made[*j])),
    };
    let inputs: Vec<_> = graph.nodes[node].from.iter().map(content).collect();
    let provenance = crate::key::provenance(&graph.nodes[node], &inputs);
    let key = provenance.key();
    let bytes = &other[1];
    let record = store::Record {
        provenance: provenance.0,
        content: blake3::hash(bytes),
        bytes: bytes.len() as u64,
        seconds: 1.0,
        metrics: vec![],
        warnings: vec![],
    };
    let place = tempfile::tempdir_in(world.place.path()).ok()?;
    let link = world.strangers_link(place.path(), &process, signed)?;
    let store = Store::simulated(place.path(), Box::new(store::Real), Some(link.clone())).ok()?;
    store.keep(bytes, 1.0).ok()?;
    let hex = key.to_hex();
    let object = format!("ac/{}/{hex}", &hex[..2]);
    world.server.objects.lock().ok()?.remove(&object);
    store.create_record(key, &record).ok()?;
    working_beside(|| drain(&store, &link));
    world.forged.set(world.forged.get() + 1);
    Some(())
}
