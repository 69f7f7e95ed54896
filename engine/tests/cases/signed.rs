//! A shared store to which strangers may write: who trusts somebody uses what that one signed, and nothing else.

use crate::bucket::Bucket;
use crate::place::{ALL, NONE, Place, chain, graph};
use crate::shared::{caches, texts};
use buckets::Seal;
use engine::graph::Graph;
use engine::store::remote::{Manner, Sharing};
use std::path::Path;
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// Signs with a hash: whoever knows the name can do it, which these tests do not try.
struct Name {
    own: Option<&'static str>,
    trusts: Option<&'static str>,
}

fn signature(who: &str, message: &[u8]) -> String {
    let hash = blake3::hash(&[who.as_bytes(), message].concat());
    format!("{who}:{}", hash.to_hex())
}

impl Seal for Name {
    fn signer(&self) -> Option<&str> {
        self.own
    }
    fn sign(&self, message: &[u8]) -> Option<String> {
        self.own.map(|who| signature(who, message))
    }
    fn is_strict(&self) -> bool {
        self.trusts.is_some()
    }
    fn believes(&self, message: &[u8], word: &str) -> bool {
        [self.own, self.trusts]
            .iter()
            .flatten()
            .any(|who| signature(who, message) == word)
    }
}

/// What a run makes in a cache that shares the bucket, how much went there, what was reported.
fn run(
    place: &Place,
    what: &Graph,
    cache: &Path,
    bucket: &Bucket,
    own: Option<&'static str>,
    trusts: Option<&'static str>,
) -> (Vec<String>, usize, Vec<String>) {
    let printed = Arc::new(Mutex::new(Vec::new()));
    let to = printed.clone();
    let report = move |line: &str| to.lock().unwrap().push(line.to_owned());
    let manner = Manner {
        read_only: false,
        seal: Some(Box::new(Name { own, trusts })),
        ..Manner::default()
    };
    let sharing =
        Sharing::begin(cache, Box::new(bucket.clone()), manner, Box::new(report)).unwrap();
    let made = place.run_in(what, cache, 2);
    let left = sharing.finish(Duration::from_secs(20));
    assert_eq!(left.waiting, 0, "{left:?}");
    let printed = printed.lock().unwrap().clone();
    (made, left.sent, printed)
}

/// A cache's use of a bucket that believes what one signed.
pub(crate) fn trusting(cache: &Path, bucket: &Bucket, who: &'static str) -> Sharing {
    let seal = Name {
        own: None,
        trusts: Some(who),
    };
    let manner = Manner {
        read_only: true,
        seal: Some(Box::new(seal)),
        ..Manner::default()
    };
    Sharing::begin(cache, Box::new(bucket.clone()), manner, Box::new(|_| {})).unwrap()
}

const LAB: Option<&str> = Some("lab");

#[test]
fn what_somebody_trusted_signed_is_used_and_nothing_else() {
    for text in texts() {
        let place = Place::new(&text);
        let bucket = Bucket::new();
        let [a, b, c, d, e] = caches(&place);
        let all = ALL.map(str::to_owned).to_vec();
        assert_eq!(
            run(&place, &chain(1), &a, &bucket, LAB, None),
            (all.clone(), 4, vec![])
        );
        assert_eq!(
            run(&place, &chain(1), &b, &bucket, None, LAB),
            (vec![], 0, vec![])
        );
        // Somebody else signs two more, and nobody signs them either.
        run(&place, &chain(2), &c, &bucket, Some("eve"), None);
        let (made, sent, printed) = run(&place, &chain(2), &d, &bucket, None, LAB);
        assert_eq!((made, sent), (vec!["final".to_owned(), "mid".into()], 0));
        assert!(
            printed.len() == 1 && printed[0].contains("not signed by anybody"),
            "{printed:?}"
        );
        // Who signs writes over what it does not believe; then everybody who trusts it finds it.
        let (made, sent, printed) = run(&place, &chain(2), &e, &bucket, LAB, LAB);
        assert_eq!((made.len(), sent, printed.len()), (2, 2, 1), "{printed:?}");
        let [.., f] = caches::<6>(&place);
        assert_eq!(
            run(&place, &chain(2), &f, &bucket, None, LAB),
            (vec![], 0, vec![])
        );
        // What is here already is nobody's question any more.
        assert_eq!(
            run(&place, &chain(2), &f, &bucket, None, Some("nobody")).0,
            NONE
        );
    }
}

#[test]
fn what_nobody_signed_is_signed_by_who_finds_the_same() {
    let place = Place::new("hello\n");
    let bucket = Bucket::new();
    let [a, b] = caches(&place);
    assert_eq!(run(&place, &chain(1), &a, &bucket, None, None).1, 4);
    // The cache knows them to be there, and that nobody signed them.
    assert_eq!(
        run(&place, &chain(1), &a, &bucket, LAB, None),
        (vec![], 4, vec![])
    );
    assert_eq!(
        run(&place, &chain(1), &a, &bucket, LAB, None),
        (vec![], 0, vec![])
    );
    assert_eq!(
        run(&place, &chain(1), &b, &bucket, None, LAB),
        (vec![], 0, vec![])
    );
}

#[test]
fn a_false_store_with_a_true_signature_is_not_believed() {
    let place = Place::new("hello\n");
    // Whatever runs it comes to something else.
    let unsteady = graph(
        &["x"],
        "[node.clean]\nstage = \"toy.clean\"\nfrom = { files = \"@src\" }\n\
         [node.x]\nstage = \"toy.unsteady\"\nfrom = { text = \"clean\" }\n",
    );
    let [true_one, false_one] = [Bucket::new(), Bucket::new()];
    let [a, b, c, d] = caches(&place);
    run(&place, &unsteady, &a, &true_one, LAB, None);
    run(&place, &unsteady, &b, &false_one, Some("eve"), None);
    let names = true_one.names("ac");
    assert_eq!(names, false_one.names("ac"), "the same keys");
    // A false record under a true signature.
    for name in &names {
        let head = |bytes: &[u8]| {
            let end = bytes.iter().position(|b| *b == b'\n').unwrap();
            String::from_utf8(bytes[..end].to_vec()).unwrap()
        };
        let signature = head(&true_one.bytes(name))
            .rsplit(' ')
            .next()
            .unwrap()
            .to_owned();
        false_one.change(name, |bytes| {
            let old = head(bytes);
            let (rest, _) = old.rsplit_once(' ').unwrap();
            let new = format!("{rest} {signature}");
            bytes.splice(..old.len(), new.into_bytes());
        });
    }
    let (made, _, printed) = run(&place, &unsteady, &c, &false_one, None, LAB);
    assert_eq!(made, ["clean", "x"]);
    assert!(
        printed.len() == 1 && printed[0].contains("not signed by anybody"),
        "{printed:?}"
    );
    assert_eq!(run(&place, &unsteady, &d, &true_one, None, LAB).0, NONE);
    // A signature cut off makes an unsigned record, which is none.
    for name in &names {
        true_one.change(name, |bytes| {
            let end = bytes.iter().position(|b| *b == b'\n').unwrap();
            let old = String::from_utf8(bytes[..end].to_vec()).unwrap();
            let words: Vec<&str> = old.split(' ').collect();
            let new = format!("stage shared 1 {} {} {}", words[3], words[4], words[5]);
            bytes.splice(..end, new.into_bytes());
        });
    }
    let [.., e] = caches::<5>(&place);
    assert_eq!(
        run(&place, &unsteady, &e, &true_one, None, LAB).0,
        ["clean", "x"]
    );
}
