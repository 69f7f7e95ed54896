//! Long values in a table: cut to a line that shows where they differ.

/// A value in a table has no more letters than this.
const MOST: usize = 48;

/// Two values on a line each, long ones from a little before where they differ.
pub(super) fn short(values: [&String; 2]) -> [String; 2] {
    let [old, new] = values.map(|v| v.split_whitespace().collect::<Vec<_>>().join(" "));
    let same = old.chars().zip(new.chars()).take_while(|(a, b)| a == b);
    let same = same.count();
    let cut = |text: String| {
        let all: Vec<char> = text.chars().collect();
        if all.len() <= MOST {
            return text;
        }
        let from = same.saturating_sub(MOST / 3).min(all.len() - MOST);
        let piece: String = all[from..from + MOST].iter().collect();
        let (before, after) = (from > 0, from + MOST < all.len());
        let dots = |is: bool| if is { "…" } else { "" };
        format!("{}{piece}{}", dots(before), dots(after))
    };
    [cut(old), cut(new)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_values_are_cut_to_where_they_differ() {
        let long = |end: &str| format!("{}\n{end}{}", "configuration ".repeat(60), "z".repeat(200));
        let [old, new] = short([&long("--enable-a"), &long("--enable-b")]);
        assert!(
            old.chars().count() <= MOST + 2 && !old.contains('\n'),
            "{old}"
        );
        assert!(
            old.contains("enable-a") && new.contains("enable-b"),
            "{old} {new}"
        );
        assert_eq!(short([&"6.1".into(), &"7".into()]), ["6.1", "7"]);
        // One that is short and one that is long.
        let [old, new] = short([&"none".into(), &long("")]);
        assert!(old == "none" && new.chars().count() == MOST + 1, "{new}");
    }
}
