//! `tailor serve` as programs and browsers meet it.
#![cfg(feature = "serve")]

mod api;
mod calls;
mod documented;
#[cfg(chromium)]
mod flows;
#[cfg(chromium)]
mod kinds;
#[cfg(chromium)]
mod live;
mod measuring;
mod security;
mod server;
#[cfg(chromium)]
mod strokes;
#[cfg(chromium)]
mod whole;
mod windows;

#[cfg(chromium)]
use super::chromium;
