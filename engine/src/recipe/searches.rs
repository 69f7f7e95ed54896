//! `[search.NAME]`: its keys.

use super::read::Reader;
use super::tree::Spot;
use super::written::{Method, Sample, Search, Spanned, Sweep};
use stage::{Value, unknown};

/// The keys that a sweep does not have.
const OWN: [&str; 6] = ["method", "budget", "seed", "least", "most", "dear"];

impl Reader {
    pub(super) fn search(&mut self, name: Spanned<String>, value: &Spot<'_>) -> Option<Search> {
        let mut sweep = self.sweep_with(name, value, &OWN);
        let (mut method, mut budget, mut seed) = (Method::Hypercube, None, 1);
        let (mut metric, mut most, mut dear) = (None, false, None);
        for (key, spanned) in self.table(value, "a search") {
            match &*key.name {
                "method" => {
                    let text = self.text(spanned, "`method`");
                    let found = Method::ALL.iter().find(|(word, _)| *word == text.value);
                    let known = Method::ALL.map(|(word, _)| word);
                    match found {
                        Some((_, found)) => method = *found,
                        None => self.wrong(&text.span, unknown("method", &text.value, &known)),
                    }
                }
                "budget" => match self.value(spanned).value {
                    Value::Int(n) if (1..=1_000_000).contains(&n) => budget = Some(n as usize),
                    _ => self.wrong(
                        &spanned.span,
                        "`budget` is how many whole points may be made, 1 to a million",
                    ),
                },
                "seed" => match self.value(spanned).value {
                    Value::Int(n) => seed = n as u64,
                    _ => self.wrong(&spanned.span, "`seed` is a whole number"),
                },
                word @ ("least" | "most") => {
                    most = word == "most";
                    metric = Some(self.text(spanned, "the metric"));
                }
                "dear" => {
                    for (node, params) in self.table(spanned, "`dear`") {
                        for (param, range) in self.table(params, "the param that makes points dear")
                        {
                            let range = Spanned {
                                value: self.stretch(range),
                                span: range.span.clone(),
                            };
                            dear = Some((node.spanned(), param.spanned(), range));
                        }
                    }
                }
                _ => {}
            }
        }
        let halving = method == Method::Halving;
        self.lacking(
            &sweep,
            budget.is_none(),
            metric.is_none(),
            halving != dear.is_some(),
        );
        let (points, metric) = (budget?, metric?);
        sweep.csv = None;
        sweep.zip = vec![];
        sweep.sample = Some(Spanned {
            value: Sample { points, seed },
            span: sweep.name.span.clone(),
        });
        // The metric that is searched for is reported, whatever else is.
        if !sweep.tell.iter().any(|t| t.value == metric.value) {
            sweep.tell.insert(0, metric.clone());
        }
        Some(Search {
            sweep,
            method,
            metric,
            most,
            dear,
        })
    }

    /// What a search needs, and what it cannot have.
    fn lacking(&mut self, sweep: &Sweep, budget: bool, metric: bool, dear: bool) {
        let other = sweep.sample.is_some() || sweep.csv.is_some() || !sweep.zip.is_empty();
        for (wrong, what) in [
            (budget, "a search needs a `budget`: `budget = 40`"),
            (
                metric,
                "name the metric that is to be small or large: `least = \"node.metric\"` or `most = …`",
            ),
            (
                other,
                "a search chooses its points itself: leave `sample`, `csv` and `zip` out",
            ),
            (
                dear,
                "`halving` needs what makes points dear, and no other method does: `dear.body = { iterations = { from = 20, to = 180 } }`",
            ),
        ] {
            if wrong {
                let what = format!("`{}`: {what}", sweep.name.value);
                self.wrong(&sweep.name.span.clone(), what);
            }
        }
    }
}
