//! The names of metrics that a stage declares: plain ones, and patterns where a name follows from the input.

/// Whether a name fits one of these: `*` in a pattern is any text, none included.
pub fn fits_any(patterns: &[&str], name: &str) -> bool {
    patterns.iter().any(|pattern| fits(pattern, name))
}

fn fits(pattern: &str, name: &str) -> bool {
    let Some((head, tail)) = pattern.split_once('*') else {
        return pattern == name;
    };
    let Some(rest) = name.strip_prefix(head) else {
        return false;
    };
    let mut starts = (0..=rest.len()).filter(|at| rest.is_char_boundary(*at));
    starts.any(|at| fits(tail, &rest[at..]))
}

#[cfg(test)]
mod tests {
    use super::fits_any;

    #[test]
    fn a_star_is_any_text_and_nothing_else_is() {
        let patterns = ["volume", "girths * error", "* against *"];
        for name in [
            "volume",
            "girths WC error",
            "girths größe L error",
            "mat against disk",
        ] {
            assert!(fits_any(&patterns, name), "{name}");
        }
        for name in ["volumes", "volum", "girths WC", "against", ""] {
            assert!(!fits_any(&patterns, name), "{name}");
        }
        assert!(fits_any(&["*"], "") && !fits_any(&[], "volume"));
    }
}
