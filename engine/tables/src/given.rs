//! Replicates and comparisons of them, as tables for people.

use super::aligned::{lines, table, to_the_right};
use super::cells::short;
use super::paired::Pairs;
use super::spread::{Group, Spread};

/// Replicates: a row each set of params, mean ± standard deviation and how many have it.
pub fn replicates_text(groups: &[Group]) -> String {
    let Some(first) = groups.first() else {
        return String::new();
    };
    let mut all = table();
    let texts = first.params.len() + usize::from(first.variant.is_some());
    let variant = first.variant.iter().map(|_| "variant".to_owned());
    let params = first.params.iter().map(|(name, _)| name.clone());
    let units = first.spreads.iter();
    let units = units.map(|s| format!("{} {}", s.name, s.unit).trim_end().to_owned());
    all.add_row(variant.chain(params).chain(units));
    for group in groups {
        let params = group.params.iter().map(|(_, value)| value.clone());
        let cells = group.spreads.iter().map(|s| cell(s, group));
        all.add_row(group.variant.iter().cloned().chain(params).chain(cells));
    }
    (texts..texts + first.spreads.len()).for_each(|column| to_the_right(&mut all, column));
    let n = groups.iter().map(|g| g.points).max().unwrap_or(0);
    format!(
        "{}\nmean ± standard deviation of {n} replicates; behind it how many have it, where not all do\n",
        lines(&mut all)
    )
}

/// `1.52 ± 0.03`, and `(7: 1 refused)` where not all have it.
fn cell(s: &Spread, group: &Group) -> String {
    let mean = s.mean.map_or("-".to_owned(), short);
    let sd = s.sd.map_or(String::new(), |sd| format!(" ± {}", short(sd)));
    let mut fewer = Vec::new();
    fewer.extend((s.refused > 0).then(|| format!("{} refused", s.refused)));
    fewer.extend((group.failed > 0).then(|| format!("{} failed", group.failed)));
    match fewer.is_empty() {
        true => mean + &sd,
        false => format!("{mean}{sd} ({}: {})", s.n, fewer.join(", ")),
    }
}

/// The table of groups: its head, and a row a group.
pub(crate) fn spread_cells(groups: &[Group]) -> (Vec<String>, Vec<Vec<String>>) {
    let Some(first) = groups.first() else {
        return Default::default();
    };
    let variant = first.variant.iter().map(|_| "variant".to_owned());
    let params = first.params.iter().map(|(name, _)| name.clone());
    let units = first.spreads.iter();
    let units = units.map(|s| format!("{} {}", s.name, s.unit).trim_end().to_owned());
    let row = |group: &Group| -> Vec<String> {
        let params = group.params.iter().map(|(_, value)| value.clone());
        let cells = group.spreads.iter().map(|s| cell(s, group));
        let variant = group.variant.iter().cloned();
        variant.chain(params).chain(cells).collect()
    };
    let head = variant.chain(params).chain(units).collect();
    (head, groups.iter().map(row).collect())
}

/// The head of a table of pairs.
pub(crate) fn pairs_head(first: &str, second: &str) -> Vec<String> {
    let words = [
        "params",
        "metric",
        first,
        second,
        "difference",
        "95 %",
        "d",
        "p",
        "differ",
        "pairs",
        "refused",
    ];
    words.map(str::to_owned).to_vec()
}

/// The row of a pair, under that head.
pub(crate) fn pairs_row(p: &Pairs) -> Vec<String> {
    let params: Vec<String> = p.params.iter().map(|(k, v)| format!("{k}={v}")).collect();
    let number = |x: Option<f64>| x.map_or("-".to_owned(), short);
    let signed = |x: f64| match short(x).starts_with('-') {
        true => short(x),
        false => format!("+{}", short(x)),
    };
    let interval = p.effect.and_then(|(_, interval)| interval);
    let [only_first, only_second, neither] = p.alone;
    let refused = match only_first + only_second + neither {
        0 => "0".to_owned(),
        _ => format!(
            "{} first, {} second",
            only_second + neither,
            only_first + neither
        ),
    };
    let differ = match p.differ() {
        Some(true) => "yes",
        Some(false) => "no",
        None if p.n == 0 => "-",
        None => "too few",
    };
    vec![
        params.join(" "),
        format!("{} {}", p.name, p.unit).trim_end().to_owned(),
        number(p.means.map(|m| m[0])),
        number(p.means.map(|m| m[1])),
        p.effect
            .map_or("-".to_owned(), |(effect, _)| signed(effect)),
        interval.map_or("-".to_owned(), |[low, high]| {
            format!("{} to {}", signed(low), signed(high))
        }),
        number(p.size),
        p.p.map_or("-".to_owned(), |p| {
            if p < 0.001 {
                "< 0.001".to_owned()
            } else {
                format!("{p:.3}")
            }
        }),
        differ.to_owned(),
        p.n.to_string(),
        refused,
    ]
}

/// A pair as a row.
pub(crate) type PairRow = fn(&Pairs) -> Vec<String>;

/// Head and rows of a table of pairs.
pub(crate) fn pairs_cells(first: &str, second: &str) -> (Vec<String>, PairRow) {
    (pairs_head(first, second), pairs_row)
}

/// Two sides over common replicates: effect, interval, test, and what was refused.
pub fn pairs_text(first: &str, second: &str, pairs: &[Pairs]) -> String {
    let mut all = table();
    let head = pairs_head(first, second);
    all.add_row(&head);
    for pair in pairs {
        all.add_row(pairs_row(pair));
    }
    (2..head.len()).for_each(|column| to_the_right(&mut all, column));
    let drawn = pairs.iter().any(|p| !p.exact && p.n > 0);
    let test = match drawn {
        true => "by 65536 draws of signs, always the same",
        false => "by all signs",
    };
    format!(
        "\n{second} less {first}, replicate by replicate\n{}\n95 %: Student's interval of the mean difference; p: how likely chance alone gives as much, {test}; fewer than six pairs are too few for any\n",
        lines(&mut all)
    )
}
