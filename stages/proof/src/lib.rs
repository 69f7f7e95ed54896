//! How a claim about numbers is proved in a test. A dev-dependency only.

mod memory;

pub use memory::in_memory;

use nalgebra::{SMatrix, SVector};

/// Holds an analytic Jacobian against central differences of the function beside it.
///
/// `f` returns the value and the Jacobian (`M` × `N`, row per output). Entries must agree to
/// 1e-6 of the largest entry, or to what rounding lets a difference of this `step` see.
///
/// # Panics
/// Where they do not agree, naming the entry.
#[track_caller]
pub fn jacobian<const M: usize, const N: usize>(
    at: SVector<f64, N>,
    step: f64,
    f: impl Fn(SVector<f64, N>) -> (SVector<f64, M>, SMatrix<f64, M, N>),
) {
    let (value, analytic) = f(at);
    let noise = 1e-13 * value.amax().max(1.0) / step;
    let bar = 1e-6 * analytic.amax().max(1e-12) + 10.0 * noise;
    for j in 0..N {
        let mut shifted = [at, at];
        shifted[0][j] -= step;
        shifted[1][j] += step;
        let difference = (f(shifted[1]).0 - f(shifted[0]).0) / (2.0 * step);
        for i in 0..M {
            let (a, d) = (analytic[(i, j)], difference[i]);
            assert!(
                (a - d).abs() <= bar,
                "d f[{i}] / d x[{j}]: analytic {a}, difference {d}"
            );
        }
    }
}

/// A closed box of twelve triangles with a corner at the origin: places of its corners and its faces, seen from
/// outside counter-clockwise.
pub fn block(size: [f32; 3]) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let corner = |i: u32| [0, 1, 2].map(|k| if i >> k & 1 == 1 { size[k] } else { 0.0 });
    let faces = vec![
        [0, 2, 1],
        [1, 2, 3],
        [4, 5, 6],
        [5, 7, 6],
        [0, 1, 4],
        [1, 5, 4],
        [2, 6, 3],
        [3, 6, 7],
        [0, 4, 2],
        [2, 4, 6],
        [1, 3, 5],
        [3, 7, 5],
    ];
    ((0..8).map(corner).collect(), faces)
}

/// Asserts that `got` is within `tolerance` of `want`.
///
/// # Panics
/// Where it is not, or is no number.
#[track_caller]
pub fn near(got: f64, want: f64, tolerance: f64) {
    assert!(
        (got - want).abs() <= tolerance,
        "got {got}, want {want} within {tolerance}"
    );
}

/// A small generator of equidistributed numbers for tests (SplitMix64, Steele 2014).
pub struct Dice(pub u64);

impl Dice {
    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number from 0 to below 1.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A number from `lo` to below `hi`.
    pub fn within(&mut self, lo: f64, hi: f64) -> f64 {
        lo + (hi - lo) * self.unit()
    }

    /// A normally distributed number (Box and Muller 1958).
    pub fn normal(&mut self) -> f64 {
        let r = (-2.0 * libm::log(1.0 - self.unit())).sqrt();
        r * libm::cos(std::f64::consts::TAU * self.unit())
    }
}

/// Whether a foreign program that a test needs is installed; reported where it is not. Where all must be there
/// (`TAILOR_ALL_PROGRAMS` is set, as it is by `.ci/run`), a missing one fails the test.
///
/// # Panics
/// It is missing, and all must be there.
#[track_caller]
pub fn program(name: &str, package: &str) -> bool {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let there = std::env::split_paths(&folders).any(|folder| folder.join(name).is_file());
    if !there {
        passed_over(&format!(
            "no {name} is installed (apt-get install {package})"
        ));
    }
    there
}

/// Reports what a test lacks and is passed over for; where nothing may be, that fails it, as [`program`] does.
///
/// # Panics
/// Nothing may be passed over.
#[track_caller]
pub fn passed_over(missing: &str) {
    let all = std::env::var_os("TAILOR_ALL_PROGRAMS").is_some();
    assert!(!all, "{missing}");
    eprintln!("SKIPPED: {missing}");
}
