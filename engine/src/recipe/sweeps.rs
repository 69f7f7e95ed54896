//! `[sweep.NAME]`: its keys.

use super::read::Reader;
use super::tree::{Item, Spot};
use super::written::{Over, Sample, Spanned, Stretch, Sweep};
use stage::Value;

impl Reader {
    pub(super) fn sweep(&mut self, name: Spanned<String>, value: &Spot<'_>) -> Sweep {
        self.sweep_with(name, value, &[])
    }

    /// A sweep with `further` keys, which somebody else reads.
    pub(super) fn sweep_with(
        &mut self,
        name: Spanned<String>,
        value: &Spot<'_>,
        further: &[&str],
    ) -> Sweep {
        let mut s = Sweep {
            name,
            about: String::new(),
            over: vec![],
            zip: vec![],
            csv: None,
            sample: None,
            replicate: None,
            with: vec![],
            tell: vec![],
            goal: vec![],
        };
        for (key, value) in self.table(value, "a sweep") {
            match &*key.name {
                "about" => s.about = self.text(value, "`about`").value,
                "with" => s.with = self.texts(value, "a variant"),
                "goal" => s.goal = self.texts(value, "a goal"),
                "tell" => s.tell = self.texts(value, "a metric"),
                "csv" => s.csv = Some(self.text(value, "`csv`")),
                "zip" => s.zip = self.zip(value),
                "sample" => s.sample = self.sample(value),
                "replicate" => s.replicate = self.replicate(value),
                "over" => {
                    for (node, params) in self.table(value, "`over`") {
                        for (param, values) in self.table(params, "the params of a node") {
                            let over = self.over(values);
                            s.over.push((node.spanned(), param.spanned(), over));
                        }
                    }
                }
                other if further.contains(&other) => {}
                _ => self.unknown_key(
                    key,
                    &[
                        "about",
                        "over",
                        "zip",
                        "csv",
                        "sample",
                        "replicate",
                        "with",
                        "tell",
                        "goal",
                    ],
                ),
            }
        }
        s
    }

    fn over(&mut self, value: &Spot<'_>) -> Over {
        match &value.item {
            Item::List(list) => Over::List(list.iter().map(|v| self.value(v)).collect()),
            Item::Table(_) => Over::Range(Spanned {
                value: self.stretch(value),
                span: value.span.clone(),
            }),
            _ => Over::List(vec![self.value(value)]),
        }
    }

    pub(super) fn stretch(&mut self, value: &Spot<'_>) -> Stretch {
        let (mut ends, mut steps, mut log) = ([None, None], None, false);
        for (key, spanned) in self.table(value, "a range") {
            let known = ["from", "to", "steps", "log"];
            let value = match known.contains(&&*key.name) {
                true => self.value(spanned).value,
                false => {
                    self.unknown_key(key, &known);
                    continue;
                }
            };
            match (&*key.name, &value) {
                ("from", _) => ends[0] = Some(value),
                ("to", _) => ends[1] = Some(value),
                ("steps", Value::Int(n)) if (1..=1_000_000).contains(n) => {
                    steps = Some(*n as usize)
                }
                ("log", Value::Bool(b)) => log = *b,
                ("log", _) => self.wrong(&spanned.span, "`log` is true or false"),
                _ => self.wrong(&spanned.span, "`steps` is a whole number, 1 to a million"),
            }
        }
        let number = |value: &Option<Value>| match value {
            Some(Value::Int(i)) => Some(*i as f64),
            Some(Value::Float(x)) if x.is_finite() => Some(*x),
            _ => None,
        };
        let (from, to) = (number(&ends[0]), number(&ends[1]));
        if from.is_none() || to.is_none() {
            let what = "a range needs two numbers: `{ from = 1.0, to = 8.0, steps = 4 }`";
            self.wrong(&value.span, what);
        }
        let (from, to) = (from.unwrap_or(1.0), to.unwrap_or(1.0));
        if log && (from <= 0.0 || to <= 0.0) {
            self.wrong(&value.span, "a `log` range needs two numbers above zero");
        }
        let whole = ends.iter().all(|e| matches!(e, Some(Value::Int(_))));
        Stretch {
            from,
            to,
            steps,
            log,
            whole,
        }
    }

    fn zip(&mut self, value: &Spot<'_>) -> Vec<Vec<Spanned<String>>> {
        match &value.item {
            Item::List(list) if list.iter().any(|v| matches!(v.item, Item::List(_))) => list
                .iter()
                .map(|group| self.texts(group, "a param"))
                .collect(),
            _ => vec![self.texts(value, "a param")],
        }
    }

    fn replicate(&mut self, value: &Spot<'_>) -> Option<Spanned<u32>> {
        match self.value(value).value {
            Value::Int(n) if (2..=10_000).contains(&n) => Some(Spanned {
                value: n as u32,
                span: value.span.clone(),
            }),
            _ => {
                let what = "give how often, 2 to 10000: `replicate = 8`";
                self.wrong(&value.span, what);
                None
            }
        }
    }

    fn sample(&mut self, value: &Spot<'_>) -> Option<Spanned<Sample>> {
        let (mut points, mut seed) = (None, 1);
        let Item::Table(table) = &value.item else {
            self.wrong(&value.span, "write `sample = { points = 40, seed = 1 }`");
            return None;
        };
        for (key, value) in table {
            match (&*key.name, self.value(value).value) {
                ("points", Value::Int(n)) if (1..=1_000_000).contains(&n) => {
                    points = Some(n as usize)
                }
                ("seed", Value::Int(n)) => seed = n as u64,
                ("points" | "seed", _) => {
                    self.wrong(&value.span, "a whole number, `points` 1 to a million")
                }
                _ => self.unknown_key(key, &["points", "seed"]),
            }
        }
        if points.is_none() {
            self.wrong(&value.span, "a sample needs `points`");
        }
        Some(Spanned {
            value: Sample {
                points: points?,
                seed,
            },
            span: value.span.clone(),
        })
    }
}
