//! What strangers put into a shared store, and stores that do not answer: nobody's signature is put on what somebody
//! else made, nothing waits for ever, and what is there is for its owner.

use super::place::Place;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Every file below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let all = super::privacy::all(folder).into_iter();
    all.filter(|path| path.is_file()).collect()
}

/// An object of a shared store: its head's words, the body of its record, its result.
fn object(path: &Path) -> (Vec<String>, serde_json::Value, Vec<u8>) {
    let bytes = fs::read(path).unwrap();
    let end = bytes.iter().position(|b| *b == b'\n').unwrap();
    let head = String::from_utf8(bytes[..end].to_vec()).unwrap();
    let head: Vec<String> = head.split(' ').map(str::to_owned).collect();
    let (file, blob) = bytes[end + 1..].split_at(head[4].parse().unwrap());
    let body = file.splitn(2, |b| *b == b'\n').nth(1).unwrap();
    (head, serde_json::from_slice(body).unwrap(), blob.to_vec())
}

/// Writes an object with another record and result, unsigned.
fn forge(path: &Path, record: &serde_json::Value, blob: &[u8]) {
    let body = serde_json::to_string_pretty(record).unwrap() + "\n";
    let file = format!("{}\n{body}", blake3::hash(body.as_bytes()).to_hex());
    let head = format!("stage shared 1 n {} {}\n", file.len(), blob.len());
    fs::write(path, [head.as_bytes(), file.as_bytes(), blob].concat()).unwrap();
}

/// The object of the first stage of a name.
fn of_stage(place: &Place, stage: &str) -> PathBuf {
    let made = |path: &PathBuf| {
        let text = String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned();
        text.contains(&format!("\"{stage} v"))
    };
    files(&place.path("store/ac"))
        .into_iter()
        .find(made)
        .unwrap()
}

fn shared(place: &Place) -> String {
    fs::create_dir_all(place.path("store")).unwrap();
    format!("--store file://{}", place.path("store").display())
}

/// The contents of a run's nodes.
fn contents(place: &Place, args: &str) -> Vec<String> {
    let run = place
        .run(&format!("run small.toml --json {args}"))
        .code(0)
        .json();
    let nodes = run["nodes"].as_array().unwrap().iter();
    nodes
        .map(|n| n["content"].as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn nobody_signs_what_strangers_put_there() {
    let place = Place::new();
    let store = shared(&place);
    let truth = contents(&place, &format!("--cache stranger {store}"));
    let ring = of_stage(&place, "synth.ring");
    let (_, mut record, mut blob) = object(&ring);
    *blob.last_mut().unwrap() ^= 1;
    record["content"] = blake3::hash(&blob).to_hex().as_str().into();
    forge(&ring, &record, &blob);
    // Without keys everybody is believed, as documented.
    let keys = format!("{store} --sign-key lab.key --trust trusted");
    assert_ne!(contents(&place, &format!("--cache lab {store}")), truth);
    place.run("cache keygen lab.key --cache none").code(0);
    fs::copy(place.path("lab.key.pub"), place.path("trusted")).unwrap();
    let printed = place
        .run(&format!("run small.toml --cache lab {keys}"))
        .code(0);
    assert!(printed.err.contains("unsigned"), "{}", printed.err);
    let (head, ..) = object(&ring);
    assert_eq!(head[2], "1", "signed: {head:?}");
    let strict = format!("--cache reader {store} --trust trusted --store-read-only");
    assert_eq!(contents(&place, &strict), truth);
    // Who makes it by itself signs it, and then it is found.
    assert_eq!(contents(&place, &format!("--cache other {keys}")), truth);
    assert_eq!(object(&ring).0[2], "2");
    assert_eq!(contents(&place, &strict.replace("reader", "third")), truth);
}

#[test]
fn a_cache_that_was_copied_is_signed_by_nobody() {
    let place = Place::new();
    place.run("run small.toml --cache theirs").code(0);
    place.run("cache keygen lab.key --cache none").code(0);
    // As it comes out of an archive, times and all.
    place.bash("cp -rp theirs mine").code(0);
    let keys = format!("{} --sign-key lab.key", shared(&place));
    place
        .run(&format!("run small.toml --cache mine {keys}"))
        .code(0);
    let all = files(&place.path("store/ac"));
    assert!(all.len() == 4 && all.iter().all(|path| object(path).0[2] == "1"));
    place
        .run(&format!("run small.toml --cache theirs {keys}"))
        .code(0);
    assert!(all.iter().all(|path| object(path).0[2] == "2"));
}

#[test]
fn sizes_and_times_that_strangers_give_move_nothing() {
    let place = Place::new();
    let store = shared(&place);
    let truth = contents(&place, &format!("--cache stranger {store}"));
    for (stage, field, value) in [
        ("synth.ring", "bytes", serde_json::json!(u64::MAX)),
        ("synth.solid", "seconds", serde_json::json!(1e308)),
    ] {
        let path = of_stage(&place, stage);
        let (_, mut record, blob) = object(&path);
        record[field] = value;
        forge(&path, &record, &blob);
    }
    assert_eq!(contents(&place, &format!("--cache mine {store}")), truth);
    let plan = place.run("plan small.toml --cache mine").code(0).out;
    assert!(plan.lines().all(|line| line.len() < 200), "{plan}");
    place
        .run("cache gc --max-size 1k --keep-runs 0 --cache mine")
        .code(0);
    let left = place.run("cache du --json --cache mine").code(0).json();
    assert!(left["bytes"].as_u64().unwrap() <= 1024, "{left}");
}

#[test]
fn a_plan_that_nobody_trusted_signed_is_not_worked_on() {
    let place = Place::new();
    let store = shared(&place);
    place.run("cache keygen lab.key --cache none").code(0);
    fs::copy(place.path("lab.key.pub"), place.path("trusted")).unwrap();
    let plan = |keys: &str| {
        let line = format!("plan small.toml --strands --json --cache one {store} {keys}");
        let printed = place.run(&line).code(0).json();
        printed["plan"].as_str().unwrap().to_owned()
    };
    let work = |name: &str, cache: &str| {
        let line = format!("work --plan {name} --strand 0 --cache {cache} {store} --trust trusted");
        place.run(&line)
    };
    let name = plan("");
    let printed = work(&name, "two");
    assert_ne!(printed.code, Some(0));
    assert!(printed.err.contains("not signed"), "{}", printed.err);
    plan("--sign-key lab.key");
    work(&name, "two").code(0);
}

#[test]
fn objects_of_a_shared_folder_are_for_its_owner_unless_it_is_shared() {
    let place = Place::new();
    let store = shared(&place);
    let modes = |mode: u32| {
        let all = super::privacy::all(&place.path("store"));
        for path in all.iter().skip(1) {
            let is = fs::metadata(path).unwrap().permissions().mode() & 0o777;
            let wanted = if path.is_dir() {
                mode | (mode >> 1 & 0o111)
            } else {
                mode
            };
            assert_eq!(is, wanted, "{}: {is:o}", path.display());
        }
        assert!(all.len() > 8);
    };
    place
        .run(&format!("run small.toml --cache a {store}"))
        .code(0);
    modes(0o600);
    fs::remove_dir_all(place.path("store")).unwrap();
    fs::create_dir(place.path("store")).unwrap();
    let group = fs::Permissions::from_mode(0o770);
    fs::set_permissions(place.path("store"), group).unwrap();
    place
        .run(&format!("run small.toml --cache b {store}"))
        .code(0);
    modes(0o660);
}

/// Answers with a byte at a time, sixty-four a second.
fn drip(mut stream: std::net::TcpStream) {
    use std::io::{Read, Write};
    let _ = stream.read(&mut [0; 4096]);
    let head = "HTTP/1.1 200 OK\r\nContent-Length: 4000\r\nETag: \"a\"\r\n\
                Last-Modified: Tue, 01 Jan 2030 00:00:00 GMT\r\n\r\n";
    let _ = stream.write_all(head.as_bytes());
    while stream.write_all(b"a").is_ok() {
        std::thread::sleep(Duration::from_secs(1) / 64);
    }
}

#[test]
fn a_store_that_never_answers_or_drips_costs_no_more_than_is_set() {
    // Taken, and never answered.
    delayed(std::mem::forget);
    delayed(|stream| _ = std::thread::spawn(|| drip(stream)));
}

/// Runs with a store that does this with whoever asks it.
fn delayed(answers: impl Fn(std::net::TcpStream) + Send + 'static) {
    let place = Place::new();
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let port = listener.local_addr().unwrap().port();
    std::thread::spawn(move || listener.incoming().flatten().for_each(answers));
    let begun = Instant::now();
    let printed = place.bash(&format!(
        "AWS_ACCESS_KEY_ID=a AWS_SECRET_ACCESS_KEY=b AWS_REGION=us-east-1 AWS_ALLOW_HTTP=true \
         AWS_ENDPOINT_URL=http://127.0.0.1:{port} timeout 60 {} run small.toml --store s3://b/p --store-wait 3",
        env!("CARGO_BIN_EXE_tailor")
    ));
    let (took, printed) = (begun.elapsed(), printed.code(0));
    assert!(printed.err.contains("does not answer"), "{}", printed.err);
    // The run itself takes a moment, longer on a busy machine.
    assert!(took < Duration::from_secs(8), "{took:?}: {}", printed.err);
}

#[test]
fn forgetting_there_finds_what_other_machines_made_and_the_plans() {
    let place = Place::new();
    let store = shared(&place);
    place.write("turn.toml", super::privacy::TURN);
    place.photos("anna", 3);
    place.photos("bert", 4);
    for who in ["anna", "bert"] {
        let line = format!("run turn.toml --input photos={who} --cache other {store}");
        place.run(&line).code(0);
        let line = format!("plan turn.toml --strands --input photos={who} --cache other {store}");
        place.run(&line).code(0);
    }
    // Here only the photos were read, by another param.
    let line = format!(
        "run turn.toml photos --input photos=anna --set photos.most=100 --cache mine {store}"
    );
    place.run(&line).code(0);
    let photo = fs::read(place.path("anna/0000.jpg")).unwrap();
    let has = |bytes: &[u8]| {
        let all = files(&place.path("store"));
        let holds = |path: &&PathBuf| {
            let file = fs::read(path).unwrap();
            file.windows(bytes.len()).any(|window| window == bytes)
        };
        all.iter().filter(holds).count()
    };
    assert!(has(b"/anna\"") > 0 && has(&photo[2000..2400]) > 1);
    place
        .run(&format!("cache forget anna --cache mine {store}"))
        .code(0);
    assert_eq!(has(b"/anna\""), 0);
    // Bert's first photo is the same as anna's; his results are his.
    assert_eq!(has(&photo[2000..2400]), 1);
    let line = format!("run turn.toml --json --input photos=bert --cache new {store}");
    let run = place.run(&line).code(0).json();
    for node in run["nodes"].as_array().unwrap() {
        assert_eq!(node["status"], "found", "{node}");
    }
}

#[test]
fn what_push_leaves_behind_is_no_success() {
    let place = Place::new();
    let store = format!("{} --store-wait 3", shared(&place));
    place.run(&format!("run small.toml {store}")).code(0);
    // The store takes nothing more: a file is where results would be. A run goes on without it.
    fs::rename(place.path("store/ac"), place.path("ac")).unwrap();
    place.write("store/ac", "");
    let run = format!("run small.toml --set ring.views=5 {store}");
    let left = place.run(&run).code(0).err;
    assert!(left.contains("could not be uploaded"), "{left}");
    let push = format!("cache push {store}");
    let left = place.run(&push).code(1).err;
    assert!(left.contains("could not be uploaded"), "{left}");
    place.run(&format!("{push} --json")).code(1);
    fs::remove_file(place.path("store/ac")).unwrap();
    fs::rename(place.path("ac"), place.path("store/ac")).unwrap();
    place.run(&push).code(0);
    place.run(&push).code(0);
}
