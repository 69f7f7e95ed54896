//! `tailor cache ls|du|gc|verify`.

use super::{Fault, House};
use crate::store::Store;
use crate::store::keeper::{self, Kept};
use clap::{Args, Subcommand};
use serde_json::json;

/// Arguments of `tailor cache`.
#[derive(Args)]
pub(crate) struct Cache {
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Subcommand)]
enum Verb {
    /// The results, largest first
    Ls,
    /// How much the store holds
    Du,
    /// Remove what is worth least until the store fits a budget
    Gc {
        /// Greatest size, such as 500M or 20G
        #[arg(long)]
        max_size: String,
        /// Runs whose results are kept whatever their size
        #[arg(long, default_value_t = 1)]
        keep_runs: usize,
        /// Say what would go, remove nothing
        #[arg(long)]
        dry_run: bool,
    },
    /// Read everything; put aside what is corrupt
    Verify,
}

/// `500M` as bytes.
fn bytes(text: &str) -> Option<u64> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let factor = match text[digits.len()..]
        .to_ascii_uppercase()
        .trim_end_matches('B')
    {
        "" => 1u64,
        "K" => 1 << 10,
        "M" => 1 << 20,
        "G" => 1 << 30,
        _ => return None,
    };
    digits
        .parse::<f64>()
        .ok()
        .filter(|x| *x >= 0.0)
        .map(|x| (x * factor as f64) as u64)
}

/// Does it.
pub(crate) fn cache(cache: &Cache, house: &House) -> Result<(), Fault> {
    let store = Store::open(&house.cache).map_err(Fault::input)?;
    let mut kept = keeper::list(&store);
    let total: u64 = kept.iter().map(|k| k.bytes).sum();
    let mib = |bytes: u64| bytes as f64 / f64::from(1 << 20);
    match &cache.verb {
        Verb::Ls => {
            kept.sort_by(|a, b| b.bytes.cmp(&a.bytes).then(a.key.cmp(&b.key)));
            let line = |k: &Kept| {
                format!(
                    "{} {:>9.2} MiB {:>8.2} s  {}",
                    &k.key[..12],
                    mib(k.bytes),
                    k.seconds,
                    k.stage
                )
            };
            if house.json {
                let one = |k: &Kept| json!({ "key": k.key, "bytes": k.bytes, "seconds": k.seconds, "stage": k.stage });
                super::outln!("{}", kept.iter().map(one).collect::<serde_json::Value>());
            } else {
                kept.iter().for_each(|k| super::outln!("{}", line(k)));
            }
        }
        Verb::Du => {
            let parts = keeper::parts_size(&store);
            if house.json {
                super::outln!(
                    "{}",
                    json!({ "results": kept.len(), "bytes": total, "parts_bytes": parts })
                );
            } else {
                super::outln!(
                    "{} results, {:.1} MiB; parts {:.1} MiB",
                    kept.len(),
                    mib(total),
                    mib(parts)
                );
            }
        }
        Verb::Gc {
            max_size,
            keep_runs,
            dry_run,
        } => {
            let most = bytes(max_size)
                .ok_or_else(|| Fault::input(format!("`{max_size}` is no size: say 500M or 20G")))?;
            let gone = keeper::gc(&store, most, *keep_runs, *dry_run);
            let (freed, seconds) = gone
                .iter()
                .fold((0, 0.0), |(b, s), k| (b + k.bytes, s + k.seconds));
            let verb = if *dry_run { "would remove" } else { "removed" };
            if house.json {
                super::outln!(
                    "{}",
                    json!({ "removed": gone.len(), "bytes": freed, "rebuild_seconds": seconds, "dry_run": dry_run })
                );
            } else {
                super::outln!(
                    "{verb} {} results, {:.1} MiB; to rebuild them: {seconds:.1} s",
                    gone.len(),
                    mib(freed)
                );
            }
        }
        Verb::Verify => {
            let bad = keeper::verify(&store);
            if house.json {
                super::outln!("{}", json!({ "checked": kept.len(), "bad": bad }));
            } else {
                super::outln!("{} results checked, {bad} put aside", kept.len());
            }
        }
    }
    Ok(())
}
