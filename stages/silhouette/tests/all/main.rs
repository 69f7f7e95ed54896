//! All tests of `silhouette` in one program: each takes long to link.

mod boxed;
mod exposure;
mod import;
mod maxflow;
mod noise;
mod pocket;
mod recur;
mod walk;
