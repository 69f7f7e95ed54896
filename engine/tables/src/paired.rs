//! Whether two methods differ: the same points by both, replicate by replicate.

use super::chance::{deviation, interval, mean, sign_test};
use super::reported::{Reported, metrics};
use serde_json::{Value, json};

/// Up to here a difference is reported as not by chance, one time in twenty wrongly.
const SURE: f64 = 0.05;

/// A metric of two sides over their common replicates.
#[derive(Debug, Clone, PartialEq)]
pub struct Pairs {
    /// What both have in common.
    pub params: Vec<(String, String)>,
    /// The metric.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// How many pairs have it on both sides.
    pub n: usize,
    /// How many have it only on the first, only on the second, on neither side: refused or failed there.
    pub alone: [usize; 3],
    /// Means of both over the pairs.
    pub means: Option<[f64; 2]>,
    /// Mean of the differences, second less first, and what holds it nineteen times in twenty (Student).
    pub effect: Option<(f64, Option<[f64; 2]>)>,
    /// The effect in standard deviations of the differences (Cohen's d of pairs).
    pub size: Option<f64>,
    /// How likely as large an effect is by chance alone: a test of signs.
    pub p: Option<f64>,
    /// Whether all signs were tried; else as many as 65536 draws, always the same.
    pub exact: bool,
}

impl Pairs {
    /// Whether they differ by more than chance gives one time in twenty; `None` of fewer pairs than can show it.
    pub fn differ(&self) -> Option<bool> {
        // Of five pairs the least that a test of all signs can give is 2 / 32.
        let enough = 2.0 / libm::exp2(self.n.min(60) as f64) <= SURE;
        self.p.filter(|_| enough).map(|p| p <= SURE)
    }

    /// For other programs.
    pub fn json(&self) -> Value {
        let params = self
            .params
            .iter()
            .map(|(k, v)| (k.clone(), Value::from(v.clone())));
        json!({
            "params": params.collect::<serde_json::Map<_, _>>(), "name": self.name, "unit": self.unit,
            "n": self.n, "only_first": self.alone[0], "only_second": self.alone[1], "neither": self.alone[2],
            "means": self.means, "effect": self.effect.map(|e| e.0), "interval": self.effect.and_then(|e| e.1),
            "size": self.size, "p": self.p, "exact": self.exact, "differ": self.differ(),
        })
    }
}

/// Params, and the points of both sides that have them.
type Matched<'a> = (&'a [(String, String)], Vec<(&'a Reported, &'a Reported)>);

/// The second side against the first: of each set of params with replicates one entry a metric; where no point has a
/// replicate, all points that both have are the pairs.
pub fn paired(first: &[Reported], second: &[Reported]) -> Vec<Pairs> {
    let repeated = first.iter().chain(second).any(|t| t.replicate.is_some());
    let mut groups: Vec<Matched<'_>> = Vec::new();
    for a in first {
        let same = |b: &&Reported| b.params == a.params && b.replicate == a.replicate;
        let Some(b) = second.iter().find(same) else {
            continue;
        };
        let of: &[(String, String)] = if repeated { &a.params } else { &[] };
        match groups.iter_mut().find(|(params, _)| *params == of) {
            Some((_, pairs)) => pairs.push((a, b)),
            None => groups.push((of, vec![(a, b)])),
        }
    }
    let metrics = metrics(first.iter().chain(second));
    let group = |(params, pairs): &Matched<'_>| -> Vec<Pairs> {
        metrics.iter().map(|m| one(params, m, pairs)).collect()
    };
    groups.iter().flat_map(group).collect()
}

fn one(
    params: &[(String, String)],
    (name, unit): &(String, String),
    pairs: &[(&Reported, &Reported)],
) -> Pairs {
    let (mut both, mut alone) = (Vec::new(), [0; 3]);
    for (a, b) in pairs {
        match (a.value(name), b.value(name)) {
            (Some(a), Some(b)) => both.push([a, b]),
            (Some(_), None) => alone[0] += 1,
            (None, Some(_)) => alone[1] += 1,
            (None, None) => alone[2] += 1,
        }
    }
    let side = |k: usize| mean(&both.iter().map(|p| p[k]).collect::<Vec<_>>());
    let off: Vec<f64> = both.iter().map(|[a, b]| b - a).collect();
    let some = !off.is_empty();
    let test = some.then(|| sign_test(&off));
    let scatter = deviation(&off).filter(|sd| *sd > 0.0);
    Pairs {
        params: params.to_vec(),
        name: name.clone(),
        unit: unit.clone(),
        n: off.len(),
        alone,
        means: some.then(|| [side(0), side(1)]),
        effect: some.then(|| (mean(&off), interval(&off))),
        size: scatter.map(|sd| mean(&off) / sd),
        p: test.map(|(p, _)| p),
        exact: test.is_some_and(|(_, exact)| exact),
    }
}

/// The variants of a sweep against its first: the names of both, and what came of it.
pub fn of_variants(all: &[Reported]) -> Vec<([String; 2], Vec<Pairs>)> {
    let mut variants: Vec<&String> = Vec::new();
    for variant in all.iter().filter_map(|t| t.variant.as_ref()) {
        if !variants.contains(&variant) {
            variants.push(variant);
        }
    }
    let of = |variant: &String| -> Vec<Reported> {
        let own = all.iter().filter(|t| t.variant.as_ref() == Some(variant));
        own.cloned().collect()
    };
    let Some((first, rest)) = variants.split_first() else {
        return vec![];
    };
    let base = of(first);
    let against = |other: &&String| {
        let names = [(*first).clone(), (*other).clone()];
        (names, paired(&base, &of(other)))
    };
    rest.iter().map(against).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reported(replicate: u32, value: Option<f64>) -> Reported {
        Reported {
            variant: None,
            params: vec![("sway.sway_mm".into(), "8".into())],
            replicate: Some(replicate),
            done: true,
            metrics: vec![("score.error".into(), "mm".into(), value)],
            within: vec![],
        }
    }

    #[test]
    fn pairs_are_of_equal_replicates_and_what_was_refused_is_counted() {
        let first = [
            Some(1.0),
            Some(2.0),
            Some(4.0),
            None,
            Some(5.0),
            Some(3.0),
            Some(6.0),
            None,
        ];
        let second = [
            Some(0.5),
            Some(1.8),
            Some(3.1),
            Some(9.0),
            None,
            Some(2.9),
            Some(5.4),
            None,
        ];
        let side = |values: &[Option<f64>]| -> Vec<Reported> {
            let all = values.iter().zip(1..);
            all.map(|(v, n)| reported(n, *v)).collect()
        };
        let mut shuffled = side(&second);
        shuffled.reverse();
        let pairs = paired(&side(&first), &shuffled);
        assert_eq!(pairs.len(), 1);
        let p = &pairs[0];
        assert_eq!((p.n, p.alone), (5, [1, 1, 1]));
        // All five fall: 2 of 32 signs are as far, which cannot be distinguished from chance.
        assert_eq!((p.p, p.exact, p.differ()), (Some(0.0625), true, None));
        proof::near(p.effect.unwrap().0, -0.46, 1e-12);
    }
}
