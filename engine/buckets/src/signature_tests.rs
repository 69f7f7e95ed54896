//! Keys as files: who is believed, until when, and what is reported of files that are none.

use super::*;
use crate::seal::Seal;
use std::time::Duration;
use system::clock::simulated::{self, Time};

/// As on a day.
fn on<T>(day: i64, what: impl FnOnce() -> T) -> T {
    let wall_ns = i128::from(day) * 86_400_000_000_000;
    let passed = Duration::ZERO;
    simulated::set(Some(Time { wall_ns, passed }));
    let done = what();
    simulated::set(None);
    done
}

#[test]
fn what_is_signed_is_believed_of_those_who_are_trusted_and_of_nobody_else() {
    let place = tempfile::tempdir().unwrap();
    let file = |name: &str| place.path().join(name);
    let line = keygen(&file("a"), 365).unwrap();
    keygen(&file("b"), 365).unwrap();
    std::fs::write(file("trust"), format!("# ours\n\n{line}  # lab\n")).unwrap();
    let keys = |sign: &str| Keys::read(Some(&file(sign)), None).unwrap();
    let reader = Keys::read(None, Some(&file("trust"))).unwrap();
    let signed = keys("a").sign(b"message").unwrap();
    assert!(reader.believes(b"message", &signed));
    assert!(!reader.believes(b"massage", &signed));
    assert!(!reader.believes(b"message", &keys("b").sign(b"message").unwrap()));
    let last = if signed.ends_with('0') { "1" } else { "0" };
    for wrong in [
        "",
        "ed25519",
        "ed25519::",
        &format!("{}{last}", &signed[..signed.len() - 1]),
    ] {
        assert!(!reader.believes(b"message", wrong), "{wrong}");
    }
    assert!(reader.is_strict() && reader.sign(b"message").is_none());
    // Who signs trusts itself.
    let both = Keys::read(Some(&file("b")), Some(&file("trust"))).unwrap();
    assert!(both.believes(b"message", &both.sign(b"message").unwrap()));
}

#[test]
fn files_that_are_no_keys_are_refused_and_none_is_written_over() {
    let place = tempfile::tempdir().unwrap();
    let file = |name: &str| place.path().join(name);
    keygen(&file("a"), 365).unwrap();
    assert!(keygen(&file("a"), 365).is_err(), "it is there already");
    std::fs::write(file("c.pub"), "").unwrap();
    assert!(keygen(&file("c"), 365).is_err() && !file("c").exists());
    let reported = |sign: Option<&str>, trust: Option<&str>| {
        let of = |name: Option<&str>| name.map(file);
        let read = Keys::read(of(sign).as_deref(), of(trust).as_deref());
        read.err().map(|why| why.to_string()).unwrap_or_default()
    };
    std::fs::write(file("none"), "# nobody\n").unwrap();
    std::fs::write(file("odd"), "ed25519 xyz\n").unwrap();
    assert!(reported(Some("missing"), None).contains("missing"));
    assert!(reported(Some("a.pub"), None).contains("is no signing key"));
    assert!(reported(None, Some("none")).contains("has no public key"));
    assert!(reported(None, Some("odd")).contains("line 1 is no public key"));
    std::fs::write(
        file("day"),
        format!("ed25519 {} until 2026-02-30\n", "0".repeat(64)),
    )
    .unwrap();
    assert!(reported(None, Some("day")).contains("line 1 is no public key"));
    assert_eq!(reported(Some("a"), Some("a.pub")), "");
    let secret = std::fs::read_to_string(file("a")).unwrap();
    std::fs::write(file("a"), secret.replace(HEAD, FORMER)).unwrap();
    assert_eq!(reported(Some("a"), Some("a.pub")), "");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let open = std::fs::Permissions::from_mode(0o644);
        std::fs::set_permissions(file("a"), open).unwrap();
        assert!(reported(Some("a"), None).contains("other users may read"));
    }
}

#[test]
fn keys_expire_and_can_be_revoked() {
    let place = tempfile::tempdir().unwrap();
    let file = |name: &str| place.path().join(name);
    let [a, b] = ["a", "b"].map(|name| keygen(&file(name), 10).unwrap());
    std::fs::write(file("trust"), format!("{a}\n{b}\n")).unwrap();
    let (today, trust) = (day::today(), file("trust"));
    let sign = |name: &str, day| on(day, || Keys::read(Some(&file(name)), None));
    let reader = |day| on(day, || Keys::read(None, Some(&trust)));
    let why = |keys: Result<Keys, NoKey>| keys.err().expect("refused").to_string();
    let signed = sign("a", today).ok().unwrap().sign(b"message").unwrap();
    let believed = |keys: &Keys, day| on(day, || keys.believes(b"message", &signed));
    assert!(believed(&reader(today + 10).ok().unwrap(), today + 10));
    // A day later nobody is believed, and nobody signs.
    let later = today + 11;
    assert!(why(reader(later)).contains("expired or revoked"));
    assert!(why(sign("a", later)).contains("was good until"));
    // Nor by who began before.
    let (early, signer) = (reader(today).ok().unwrap(), sign("a", today).ok().unwrap());
    assert!(believed(&early, today + 10) && !believed(&early, later));
    assert!(on(today + 10, || signer.sign(b"message")).is_some());
    assert!(on(later, || signer.sign(b"message")).is_none());
    std::fs::write(file("trust"), a.replace("until", "# until")).unwrap();
    assert!(believed(&reader(later).ok().unwrap(), later));
    std::fs::write(file("trust"), format!("{a}\n{b}\n")).unwrap();
    std::fs::write(file("revoked"), format!("# lost\n{a}\n")).unwrap();
    let strict = reader(today).ok().unwrap();
    assert!(!strict.believes(b"message", &signed));
    let other = sign("b", today).ok().unwrap().sign(b"message").unwrap();
    assert!(strict.believes(b"message", &other));
    let both = Keys::read(Some(&file("a")), Some(&trust));
    assert!(why(both).contains("revoked"));
    std::fs::write(file("revoked"), "nobody\n").unwrap();
    assert!(why(reader(today)).contains("revoked: line 1"));
}
