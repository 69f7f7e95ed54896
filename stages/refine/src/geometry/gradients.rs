//! Large symmetric systems, by conjugate gradients (Hestenes and Stiefel 1952).

/// Preconditioned conjugate gradients from zero. Sums run in order: equal bytes every time.
pub fn conjugate_gradients(
    matrix: impl Fn(&[f64]) -> Vec<f64>,
    inverse_diagonal: &[f64],
    mut r: Vec<f64>,
    rounds: usize,
) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let scaled =
        |r: &[f64]| -> Vec<f64> { r.iter().zip(inverse_diagonal).map(|(r, m)| r * m).collect() };
    let mut x = vec![0.0; r.len()];
    let mut z = scaled(&r);
    let mut p = z.clone();
    let mut rz = dot(&r, &z);
    let goal = rz * 1e-6;
    for _ in 0..rounds {
        if rz <= goal || rz <= 0.0 {
            break;
        }
        let ap = matrix(&p);
        let curve = dot(&p, &ap);
        if curve <= 0.0 {
            break;
        }
        let step = rz / curve;
        x.iter_mut().zip(&p).for_each(|(x, p)| *x += step * p);
        r.iter_mut().zip(&ap).for_each(|(r, a)| *r -= step * a);
        z = scaled(&r);
        let next = dot(&r, &z);
        let keep = next / rz;
        p.iter_mut().zip(&z).for_each(|(p, z)| *p = z + keep * *p);
        rz = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conjugate_gradients_solve_a_small_system() {
        let a = [[4.0, 1.0, 0.0], [1.0, 3.0, -1.0], [0.0, -1.0, 2.0]];
        let row = |r: &[f64; 3], x: &[f64]| r.iter().zip(x).map(|(a, x)| a * x).sum();
        let times = |x: &[f64]| -> Vec<f64> { a.iter().map(|r| row(r, x)).collect() };
        let b = vec![1.0, 2.0, 3.0];
        let x = conjugate_gradients(times, &[0.25, 1.0 / 3.0, 0.5], b.clone(), 9);
        for (got, want) in times(&x).iter().zip(b) {
            proof::near(*got, want, 1e-9);
        }
    }
}
