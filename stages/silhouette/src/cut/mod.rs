//! Least cuts: the solver of every labelling.

pub(crate) mod least_cut;
pub(crate) mod maxflow;
