//! "Did you mean": the known name that is nearest to a mistyped one.

use crate::{Message, message};

crate::messages! {
    UNKNOWN = "recipe-unknown": "there is no {what} `{name}`; known: {known}";
    UNKNOWN_NEAR = "recipe-unknown-near": "there is no {what} `{name}`; did you mean `{near}`? known: {known}";
    UNKNOWN_NONE = "recipe-unknown-none": "there is no {what} `{name}`; there are none";
}

/// The message about an unknown name: the nearest known one, and what there is.
pub fn unknown(what: &str, name: &str, known: &[&str]) -> Message {
    let there = known.join(", ");
    match nearest(name, known) {
        Some(near) => {
            message!(
                UNKNOWN_NEAR,
                what = what,
                name = name,
                near = near,
                known = there
            )
        }
        None if known.is_empty() => message!(UNKNOWN_NONE, what = what, name = name),
        None => message!(UNKNOWN, what = what, name = name, known = there),
    }
}

/// The known name within a third of the letters by edit distance, the first of the nearest; else the only one that
/// goes on where this one ends: a param without its unit.
pub fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    near(name, known).or_else(|| {
        let more = |k: &&&str| {
            k.strip_prefix(name)
                .is_some_and(|rest| rest.starts_with('_'))
        };
        let mut longer = known.iter().filter(more);
        let first = longer.next().filter(|_| !name.is_empty())?;
        longer.next().is_none().then_some(*first)
    })
}

fn near<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    let most = (name.chars().count() / 3).max(1);
    let near = known
        .iter()
        .map(|k| (distance(name, k), *k))
        .min_by_key(|(d, _)| *d)?;
    (near.0 <= most).then_some(near.1)
}

/// Edits that turn `a` into `b`: insertions, deletions, replacements, and two neighbours exchanged
/// (optimal string alignment, after Damerau 1964).
fn distance(a: &str, b: &str) -> usize {
    let [a, b] = [a, b].map(|text| text.chars().collect::<Vec<char>>());
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let replace = rows[i][j] + usize::from(a[i] != b[j]);
            let mut least = replace.min(rows[i][j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                least = least.min(rows[i - 1][j - 1] + 1);
            }
            row.push(least);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_finger_is_forgiven() {
        assert_eq!(
            nearest("voxle_mm", &["consensus", "voxel_mm"]),
            Some("voxel_mm")
        );
        assert_eq!(nearest("colour", &["consensus", "voxel_mm"]), None);
        assert_eq!(nearest("veiws", &["views", "with"]), Some("views"));
        assert_eq!(nearest("voxel", &["cell_mm", "voxel_mm"]), Some("voxel_mm"));
        assert_eq!(nearest("voxel", &["voxel_mm", "voxel_px"]), None);
        assert_eq!(nearest("", &["_mm"]), None);
    }

    #[test]
    fn what_there_is_is_listed_apart() {
        let message = |name, known: &[&str]| unknown("param", name, known);
        assert_eq!(
            message("colour", &["consensus", "voxel_mm"]),
            "there is no param `colour`; known: consensus, voxel_mm"
        );
        assert_eq!(
            message("voxle_mm", &["voxel_mm"]),
            "there is no param `voxle_mm`; did you mean `voxel_mm`? known: voxel_mm"
        );
        assert_eq!(message("x", &[]), "there is no param `x`; there are none");
    }
}
