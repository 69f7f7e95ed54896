//! `[sweep.NAME]`: what it says, and whether it can be.

use super::read::Reader;
use super::tree::{Item, Spot};
use super::{Mistake, Over, Overrides, Recipe, Said, Sample, Stretch, Sweep, vary};
use stage::{AnyStage, Value, unknown};

impl Reader {
    pub(super) fn sweep(&mut self, name: Said<String>, value: &Spot<'_>) -> Sweep {
        let mut s = Sweep {
            name,
            about: String::new(),
            over: vec![],
            zip: vec![],
            csv: None,
            sample: None,
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
                "over" => {
                    for (node, params) in self.table(value, "`over`") {
                        for (param, values) in self.table(params, "the params of a node") {
                            let over = self.over(values);
                            s.over.push((node.said(), param.said(), over));
                        }
                    }
                }
                _ => self.unknown_key(
                    key,
                    &[
                        "about", "over", "zip", "csv", "sample", "with", "tell", "goal",
                    ],
                ),
            }
        }
        s
    }

    fn over(&mut self, value: &Spot<'_>) -> Over {
        match &value.item {
            Item::List(list) => Over::List(list.iter().map(|v| self.value(v)).collect()),
            Item::Table(_) => Over::Range(Said {
                value: self.stretch(value),
                span: value.span.clone(),
            }),
            _ => Over::List(vec![self.value(value)]),
        }
    }

    fn stretch(&mut self, value: &Spot<'_>) -> Stretch {
        let (mut ends, mut steps, mut log) = ([None, None], None, false);
        for (key, said) in self.table(value, "a range") {
            let known = ["from", "to", "steps", "log"];
            let value = match known.contains(&&*key.name) {
                true => self.value(said).value,
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
                ("log", _) => self.wrong(&said.span, "`log` is true or false"),
                _ => self.wrong(&said.span, "`steps` is a whole number, 1 to a million"),
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

    fn zip(&mut self, value: &Spot<'_>) -> Vec<Vec<Said<String>>> {
        match &value.item {
            Item::List(list) if list.iter().any(|v| matches!(v.item, Item::List(_))) => list
                .iter()
                .map(|group| self.texts(group, "a param"))
                .collect(),
            _ => vec![self.texts(value, "a param")],
        }
    }

    fn sample(&mut self, value: &Spot<'_>) -> Option<Said<Sample>> {
        let (mut points, mut seed) = (None, 1);
        let Item::Table(table) = &value.item else {
            self.wrong(&value.span, "say `sample = { points = 40, seed = 1 }`");
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
        Some(Said {
            value: Sample {
                points: points?,
                seed,
            },
            span: value.span.clone(),
        })
    }
}

/// Whether every sweep means something: nodes, params, values, variants, what is told.
pub(super) fn check(
    recipe: &Recipe,
    find: &dyn Fn(&str) -> Option<&'static dyn AnyStage>,
) -> Result<(), Vec<Mistake>> {
    let mut mistakes = Vec::new();
    for sweep in &recipe.sweeps {
        one(recipe, sweep, find, &mut mistakes);
    }
    match mistakes.is_empty() {
        true => Ok(()),
        false => Err(mistakes),
    }
}

fn one(
    recipe: &Recipe,
    sweep: &Sweep,
    find: &dyn Fn(&str) -> Option<&'static dyn AnyStage>,
    mistakes: &mut Vec<Mistake>,
) {
    let mut wrong = |at: &Said<String>, what: String| mistakes.push(Mistake::at(&at.span, what));
    let names: Vec<&str> = recipe.nodes.iter().map(|n| n.name.value.as_str()).collect();
    let variants: Vec<&str> = recipe
        .variants
        .iter()
        .map(|v| v.name.value.as_str())
        .collect();
    if sweep.over.is_empty() && sweep.csv.is_none() && sweep.with.is_empty() {
        let what = "a sweep needs `over`, `csv` or `with`";
        wrong(&sweep.name, format!("`{}`: {what}", sweep.name.value));
    }
    let mut recipes = Vec::new();
    for said in &sweep.with {
        if !variants.contains(&said.value.as_str()) {
            wrong(said, unknown("variant", &said.value, &variants));
            continue;
        }
        let variant = Some(said.value.clone());
        let sets = vec![];
        recipes.extend(vary(recipe, &Overrides { variant, sets }).ok());
    }
    if sweep.with.is_empty() {
        recipes.push(recipe.clone());
    }
    let params: Vec<String> = sweep
        .over
        .iter()
        .map(|(n, p, _)| format!("{}.{}", n.value, p.value))
        .collect();
    for (node, param, over) in &sweep.over {
        if !names.contains(&node.value.as_str()) {
            wrong(node, unknown("node", &node.value, &names));
            continue;
        }
        let values: Vec<Said<Value>> = match over {
            Over::List(list) => list.clone(),
            Over::Range(said) => {
                if said.value.steps.is_none() && sweep.sample.is_none() {
                    let at = Said {
                        value: String::new(),
                        span: said.span.clone(),
                    };
                    wrong(&at, "a range needs `steps`, or the sweep a `sample`".into());
                }
                let values = crate::sweep::axes::values(&said.value);
                let here = |value| Said {
                    value,
                    span: said.span.clone(),
                };
                values.into_iter().map(here).collect()
            }
        };
        if values.is_empty() {
            wrong(param, format!("`{}` takes no value", param.value));
        }
        for recipe in &recipes {
            // A variant may leave the node out: then it is told that it takes no part.
            let Some(there) = recipe.nodes.iter().find(|n| n.name.value == node.value) else {
                wrong(
                    node,
                    format!("a variant of this sweep leaves `{}` out", node.value),
                );
                continue;
            };
            let Some(stage) = find(&there.stage.value) else {
                continue;
            };
            for value in &values {
                let said = [(param.value.clone(), value.value.clone())].into();
                for w in stage.check(&said).err().into_iter().flatten() {
                    let known = stage.params().iter().any(|p| p.name == param.value);
                    let span = if known { &value.span } else { &param.span };
                    let at = Said {
                        value: String::new(),
                        span: span.clone(),
                    };
                    match known {
                        true => wrong(&at, format!("`{}` {}", param.value, w.what)),
                        false => wrong(&at, format!("{}: {}", stage.name(), w.what)),
                    }
                }
            }
        }
    }
    for said in sweep.zip.iter().flatten() {
        if !params.contains(&said.value) {
            let known: Vec<&str> = params.iter().map(String::as_str).collect();
            wrong(said, unknown("param of this sweep", &said.value, &known));
        }
    }
    for said in sweep
        .goal
        .iter()
        .filter(|g| !names.contains(&g.value.as_str()))
    {
        wrong(said, unknown("node", &said.value, &names));
    }
    for said in &sweep.tell {
        let node = said.value.split_once('.').map(|(node, _)| node);
        match node {
            None => wrong(said, "say node.metric, such as \"hull.volume\"".into()),
            Some("error") => {}
            Some(node) if !names.contains(&node) => wrong(said, unknown("node", node, &names)),
            Some(_) => {}
        }
    }
}
