//! What varies: lists, ranges, params side by side, a table of points, a Latin hypercube.

use super::axis::{Axis, AxisError};
use super::csv;
use crate::recipe::{
    Over, OverParam, Sample, Stretch, Sweep, between, parse_value, values, written,
};
use std::path::Path;

/// The axes of a declared sweep; a table of points is in `folder`.
///
/// # Errors
///
/// Params that go side by side take unequally many values, or a table of points cannot be read.
pub fn axes(sweep: &Sweep, folder: &Path) -> Result<Vec<Axis>, AxisError> {
    if let Some(sample) = &sweep.sample {
        if sweep.csv.is_some() || !sweep.zip.is_empty() {
            return Err(AxisError::SampleOfTable);
        }
        return Ok(vec![hypercube(&sweep.over, sample.value)]);
    }
    let mut axes: Vec<Axis> = sweep.over.iter().map(listed).collect();
    for group in &sweep.zip {
        let named = |axis: &Axis| {
            let (node, param) = &axis.params[0];
            group.iter().any(|s| s.value == format!("{node}.{param}"))
        };
        let (together, apart): (Vec<Axis>, Vec<Axis>) = axes.into_iter().partition(named);
        axes = apart;
        axes.extend(zipped(together)?);
    }
    if let Some(file) = &sweep.csv {
        axes.push(csv::table(&folder.join(&file.value))?);
    }
    Ok(axes)
}

fn listed((node, param, over): &OverParam) -> Axis {
    let values = match over {
        Over::List(list) => list.iter().map(|v| v.value.clone()).collect(),
        Over::Range(given) => values(&given.value),
    };
    Axis {
        params: vec![(node.value.clone(), param.value.clone())],
        rows: values.into_iter().map(|v| vec![v]).collect(),
    }
}

/// One axis out of several that go side by side.
fn zipped(axes: Vec<Axis>) -> Result<Option<Axis>, AxisError> {
    let Some(first) = axes.first() else {
        return Ok(None);
    };
    let count = first.rows.len();
    if axes.iter().any(|a| a.rows.len() != count) {
        let names: Vec<String> = axes
            .iter()
            .map(|a| format!("{}.{}", a.params[0].0, a.params[0].1))
            .collect();
        let counts: Vec<String> = axes.iter().map(|a| a.rows.len().to_string()).collect();
        return Err(AxisError::Unequal(names.join(", "), counts.join(", ")));
    }
    Ok(Some(Axis {
        params: axes.iter().flat_map(|a| a.params.clone()).collect(),
        rows: (0..count)
            .map(|i| axes.iter().flat_map(|a| a.rows[i].clone()).collect())
            .collect(),
    }))
}

/// A Latin hypercube (McKay, Beckman and Conover 1979): every param takes one value in each of as
/// many equal slices as there are points, in an order of its own.
pub(crate) fn hypercube(over: &[OverParam], sample: Sample) -> Axis {
    let n = sample.points;
    let mut state = sample.seed;
    // SplitMix64 (Steele, Lea and Flood 2014).
    let mut dice = move || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut rows = vec![Vec::new(); n];
    for (_, _, values) in over {
        let mut slices: Vec<usize> = (0..n).collect();
        for i in (1..n).rev() {
            slices.swap(i, ((i + 1) as f64 * dice()) as usize);
        }
        for (row, slice) in rows.iter_mut().zip(slices) {
            let share = (slice as f64 + dice()) / n as f64;
            row.push(match values {
                Over::Range(given) => written(between(&given.value, share), given.value.whole),
                Over::List(list) => list[(share * list.len() as f64) as usize].value.clone(),
            });
        }
    }
    let params = |(n, p, _): &OverParam| (n.value.clone(), p.value.clone());
    Axis {
        params: over.iter().map(params).collect(),
        rows,
    }
}

/// `NODE.PARAM=2,3,4` or `NODE.PARAM=2..8/4` (`log` behind it for equal ratios).
///
/// # Errors
///
/// The text gives no values.
pub fn given(text: &str) -> Result<Axis, AxisError> {
    let wrong = || AxisError::Given(text.into());
    let (place, values_text) = text.split_once('=').ok_or_else(wrong)?;
    let (node, param) = place.trim().split_once('.').ok_or_else(wrong)?;
    let listed = match range(values_text) {
        Some(stretch) => values(&stretch),
        None => csv::cells(values_text)
            .iter()
            .map(|v| parse_value(v))
            .collect(),
    };
    if listed.is_empty() || values_text.trim().is_empty() {
        return Err(wrong());
    }
    let ends = values_text.split_once("..").map(|(from, to)| [from, to]);
    if ends.is_some_and(|ends| ends.iter().all(|e| e.trim().parse::<f64>().is_ok())) {
        return Err(AxisError::HowMany(text.into()));
    }
    Ok(Axis {
        params: vec![(node.into(), param.into())],
        rows: listed.into_iter().map(|v| vec![v]).collect(),
    })
}

/// `2..8/4` or `1..100/5log`.
fn range(text: &str) -> Option<Stretch> {
    let (from, rest) = text.split_once("..")?;
    let (to, steps) = rest.split_once('/')?;
    let (steps, log) = match steps.trim().strip_suffix("log") {
        Some(steps) => (steps, true),
        None => (steps, false),
    };
    let whole = [from, to].iter().all(|t| t.trim().parse::<i64>().is_ok());
    let (from, to): (f64, f64) = (from.trim().parse().ok()?, to.trim().parse().ok()?);
    let steps = steps.trim().parse().ok().filter(|n| *n <= 1_000_000)?;
    let good = from.is_finite() && to.is_finite() && (!log || (from > 0.0 && to > 0.0));
    good.then_some(Stretch {
        from,
        to,
        steps: Some(steps),
        log,
        whole,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use stage::Value;

    fn texts(axis: &Axis) -> Vec<String> {
        let row = |r: &Vec<Value>| {
            r.iter()
                .map(|v| v.to_string())
                .collect::<Vec<_>>()
                .join(" ")
        };
        axis.rows.iter().map(row).collect()
    }

    #[test]
    fn ranges_end_at_their_last_value_and_log_steps_are_equal_ratios() {
        assert_eq!(texts(&given("a.b=2..8/4").unwrap()), ["2", "4", "6", "8"]);
        assert_eq!(texts(&given("a.b=0..1/3").unwrap()), ["0.0", "0.5", "1.0"]);
        assert_eq!(
            texts(&given("a.b=0.1..0.5/5").unwrap()),
            ["0.1", "0.2", "0.3", "0.4", "0.5"]
        );
        assert_eq!(
            texts(&given("a.b=0.01..100.0/5log").unwrap()),
            ["0.01", "0.1", "1.0", "10.0", "100.0"]
        );
        assert_eq!(texts(&given("a.b=[1, 2],[3]").unwrap()), ["[1, 2]", "[3]"]);
        assert_eq!(texts(&given("a.b=on,true").unwrap()), ["\"on\"", "true"]);
        for wrong in ["a.b=", "ab=1", "a.b", "=1"] {
            assert!(given(wrong).is_err(), "{wrong}");
        }
    }

    /// A sweep over two ranges and a list, as a sample.
    fn sampled(points: usize, seed: u64) -> Axis {
        let text = format!(
            "[sweep.s]\nover.a = {{ x = {{ from = 0.0, to = 1.0 }}, y = {{ from = 1, to = 1000, log = true }} }}\n\
             over.b = {{ z = [\"p\", \"q\"] }}\nsample = {{ points = {points}, seed = {seed} }}\n"
        );
        let recipe = crate::recipe::read(&text).unwrap();
        axes(&recipe.sweeps[0], Path::new(".")).unwrap().remove(0)
    }

    #[test]
    fn a_latin_hypercube_has_one_point_in_every_slice_and_is_repeatable() {
        for n in [1, 2, 7, 40] {
            let axis = sampled(n, 3);
            let number = |v: &Value| match v {
                Value::Float(x) => *x,
                Value::Int(i) => *i as f64,
                other => panic!("{other}"),
            };
            let mut slices: Vec<usize> = axis
                .rows
                .iter()
                .map(|r| (number(&r[0]) * n as f64) as usize)
                .collect();
            slices.sort();
            assert_eq!(slices, (0..n).collect::<Vec<_>>());
            assert!(
                axis.rows
                    .iter()
                    .all(|r| (1.0..=1000.0).contains(&number(&r[1])))
            );
            let p = axis.rows.iter().filter(|r| r[2] == Value::Text("p".into()));
            assert!(p.count().abs_diff(n - n / 2) <= 1, "lists are taken evenly");
            assert_eq!(sampled(n, 3), axis);
        }
        assert_ne!(sampled(40, 3), sampled(40, 4));
    }
}
