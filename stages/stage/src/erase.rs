//! Every cast of the house: typed stages on the one side, what the engine sees on the other.

use crate::{
    AnyArtifact, Artifact, Corrupt, Ctx, Input, Mistake, ParamSpec, Params, PortSpec, Recognise,
    Stage, Stop, Value, from_bytes, to_bytes,
};
use std::any::Any;
use std::collections::BTreeMap;
use std::marker::PhantomData;
use std::sync::Arc;

/// Params that were read and found good.
#[derive(Clone)]
pub struct Checked {
    /// All values after defaults, in the order of the reference.
    pub values: Vec<(&'static str, Value)>,
    typed: Arc<dyn Any + Send + Sync>,
}

impl Checked {
    /// Params that somebody else has read: values as they enter the key, and what the stage works with.
    pub fn of(values: Vec<(&'static str, Value)>, typed: Arc<dyn Any + Send + Sync>) -> Checked {
        Checked { values, typed }
    }

    /// What the stage works with, if it is of this type.
    pub fn typed<T: 'static>(&self) -> Option<&T> {
        self.typed.downcast_ref()
    }
}

/// What a stage made: to be handed on, and as the bytes to be stored.
pub struct Made {
    /// To be handed on.
    pub artifact: AnyArtifact,
    /// To be stored.
    pub bytes: Vec<u8>,
}

/// A stage as the engine sees it.
pub trait AnyStage: Sync {
    /// `crate.verb`.
    fn name(&self) -> &'static str;
    /// See [`Stage::VERSION`].
    fn version(&self) -> u32;
    /// One sentence.
    fn about(&self) -> &'static str;
    /// The kind of artifact that flows out.
    fn yields(&self) -> &'static str;
    /// The format of that kind.
    fn format(&self) -> u32;
    /// What flows in.
    fn ports(&self) -> Vec<PortSpec>;
    /// See [`Stage::METRICS`].
    fn metrics(&self) -> &'static [&'static str];
    /// See [`Stage::programs`].
    fn programs(&self) -> Vec<(&'static str, String)>;
    /// What may be tuned.
    fn params(&self) -> Vec<ParamSpec>;
    /// Reads params; all mistakes at once.
    ///
    /// # Errors
    ///
    /// Every param that is unknown, or does not fit its type or range, or the other params.
    fn check(&self, given: &BTreeMap<String, Value>) -> Result<Checked, Vec<Mistake>>;
    /// See [`Stage::memory`]; nothing where the inputs are wrong, which [`AnyStage::run`] reports.
    /// \[bytes\]
    fn memory(&self, params: &Checked, inputs: &[Option<AnyArtifact>]) -> u64;
    /// Runs: one input a port, in order.
    ///
    /// # Errors
    ///
    /// The stage stopped or failed, or an input is of another kind than its port.
    fn run(
        &self,
        params: &Checked,
        inputs: Vec<Option<AnyArtifact>>,
        ctx: &Ctx<'_>,
    ) -> Result<Made, Stop>;
    /// Reads back what [`AnyStage::run`] made.
    ///
    /// # Errors
    ///
    /// The bytes are not those of the stage's output.
    fn read(&self, bytes: &[u8]) -> Result<AnyArtifact, Corrupt>;
}

/// A typed stage behind the engine's view of it. Made by [`erase`].
pub struct Erased<S>(PhantomData<fn() -> S>, &'static [Recognise]);

/// The engine's view of a stage, for a crate's list: `&erase::<Carve>()`.
pub const fn erase<S: Stage>() -> Erased<S> {
    Erased(PhantomData, &[])
}

impl<S> Erased<S> {
    /// The same of a crate whose errors have codes: each is handed on as its message.
    pub const fn failing(self, coded: &'static [Recognise]) -> Erased<S> {
        Erased(PhantomData, coded)
    }

    /// Why it stopped, as a message where that is known.
    fn coded(&self, stop: Stop) -> Stop {
        let Stop::Failed(error) = stop else {
            return stop;
        };
        let message = self.1.iter().find_map(|recognise| recognise(&*error));
        Stop::Failed(message.map_or(error, |message| Box::new(message)))
    }
}

impl<S: Stage> AnyStage for Erased<S> {
    fn name(&self) -> &'static str {
        S::NAME
    }
    fn version(&self) -> u32 {
        S::VERSION
    }
    fn about(&self) -> &'static str {
        S::ABOUT
    }
    fn yields(&self) -> &'static str {
        S::Output::KIND
    }
    fn format(&self) -> u32 {
        S::Output::FORMAT
    }
    fn ports(&self) -> Vec<PortSpec> {
        S::Input::ports()
    }
    fn metrics(&self) -> &'static [&'static str] {
        S::METRICS
    }
    fn programs(&self) -> Vec<(&'static str, String)> {
        S::programs()
    }
    fn params(&self) -> Vec<ParamSpec> {
        S::Params::specs()
    }

    fn check(&self, given: &BTreeMap<String, Value>) -> Result<Checked, Vec<Mistake>> {
        let params = S::Params::read(given)?;
        let mistakes = S::check(&params);
        if !mistakes.is_empty() {
            return Err(mistakes);
        }
        Ok(Checked {
            values: params.values(),
            typed: Arc::new(params),
        })
    }

    fn memory(&self, params: &Checked, inputs: &[Option<AnyArtifact>]) -> u64 {
        match (params.typed.downcast_ref(), S::Input::take(inputs.to_vec())) {
            (Some(params), Ok(input)) => S::memory(params, &input),
            _ => 0,
        }
    }

    fn run(
        &self,
        params: &Checked,
        inputs: Vec<Option<AnyArtifact>>,
        ctx: &Ctx<'_>,
    ) -> Result<Made, Stop> {
        let params = params
            .typed
            .downcast_ref()
            .expect("bug: params of another stage");
        // What came out is whole, so it is kept even if the user asked to stop meanwhile.
        let output =
            S::run(params, S::Input::take(inputs)?, ctx).map_err(|stop| self.coded(stop))?;
        let bytes = to_bytes(&output);
        Ok(Made {
            artifact: AnyArtifact::new(output),
            bytes,
        })
    }

    fn read(&self, bytes: &[u8]) -> Result<AnyArtifact, Corrupt> {
        from_bytes::<S::Output>(bytes).map(AnyArtifact::new)
    }
}

/// Params for a stage that has nothing to tune.
impl Params for () {
    fn names(_: &mut Vec<&'static str>) {}
    fn specs_to(&self, _: &mut Vec<ParamSpec>) {}
    fn read_onto(self, _: &BTreeMap<String, Value>, _: &mut Vec<Mistake>) -> Self {}
    fn values_to(&self, _: &mut Vec<(&'static str, Value)>) {}
}

/// Inputs for a stage that reads nothing.
impl Input for () {
    fn ports() -> Vec<PortSpec> {
        vec![]
    }
    fn take(_: Vec<Option<AnyArtifact>>) -> Result<Self, crate::Wrong> {
        Ok(())
    }
}
