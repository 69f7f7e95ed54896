//! A fleet on paper: captures measured by many workers that share a bucket, event by event: `cargo bench --bench fleet`.
//!
//! Nothing is measured here: who works, what is asked of the bucket and when follow from the assumptions
//! in `assumed.rs` and from what `engine/src/store/remote` does. Equal assumptions give equal lines.
//! `-- --json docs/tables/fleet.json` writes what the table in docs/lab/cluster.md is made from.

mod assumed;

use assumed::*;
use serde_json::{Value, json};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// What a worker does next. A request is asked for when its turn comes, so that the bucket takes all
/// requests in the order in which they come.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Act {
    /// Begins with a capture: so many requests are left (format, plan, the first record).
    Begin(u8),
    /// Works on a node, which nobody has made.
    Make(u8),
    /// Has made a node.
    Made(u8),
    /// Lists the store before a node: so many requests are left.
    List(u8, u8),
    /// Two creates that race, one that is read, one that is removed: so many requests are left.
    Probe(u8),
    /// An upload of a node: so many requests are left.
    Upload(u8, u8),
}

/// One scenario.
struct Fleet {
    workers: usize,
    captures: usize,
    /// Parts of the bucket that each take the full rate; keys are spread over them evenly.
    parts: usize,
    /// Captures in one plan.
    plan: usize,
}

/// What came of it.
#[derive(Default)]
struct Figures {
    seconds: f64,
    reads: u64,
    writes: u64,
    bytes: f64,
    /// Seconds that workers worked, of all that they had.
    worked: f64,
    longest_wait: f64,
}

struct Dice(u64);

impl Dice {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// The bucket: when each part takes its next request that reads, or writes.
struct Bucket {
    free: Vec<[f64; 2]>,
    dice: Dice,
    figures: Figures,
}

impl Bucket {
    /// When a request is answered that comes now and moves so many bytes.
    fn asked(&mut self, now: f64, writes: bool, bytes: f64) -> f64 {
        let part = self.dice.bits() as usize % self.free.len();
        let (class, rate) = if writes { (1, WRITES) } else { (0, READS) };
        let free = &mut self.free[part][class];
        let taken = free.max(now);
        *free = taken + 1.0 / rate;
        let figures = &mut self.figures;
        figures.longest_wait = figures.longest_wait.max(taken - now);
        *(if writes {
            &mut figures.writes
        } else {
            &mut figures.reads
        }) += 1;
        figures.bytes += bytes;
        taken + ANSWER_S + bytes / WORKER_BYTES
    }
}

#[derive(Clone, Copy, Default)]
struct Worker {
    /// Uploads under way.
    open: u8,
    /// Has made its last node and waits for its uploads.
    ended: bool,
}

/// How many requests an upload takes: is it there, the blob, the record.
fn requests(node: u8) -> u8 {
    match BYTES[node as usize] {
        bytes if bytes <= SMALL => 1,
        bytes if bytes <= WORTH_ASKING => 2,
        _ => 3,
    }
}

/// The fleet while it works.
struct Run<'a> {
    fleet: &'a Fleet,
    bucket: Bucket,
    workers: Vec<Worker>,
    /// Captures that nobody has begun with.
    left: usize,
    heap: BinaryHeap<Reverse<(u64, u32, Act)>>,
    worked: f64,
}

fn simulate(fleet: &Fleet) -> Figures {
    let first = fleet.workers.min(fleet.captures);
    let mut run = Run {
        fleet,
        bucket: Bucket {
            free: vec![[0.0; 2]; fleet.parts],
            dice: Dice(1),
            figures: Figures::default(),
        },
        workers: vec![Worker::default(); fleet.workers],
        left: fleet.captures - first,
        heap: BinaryHeap::new(),
        worked: 0.0,
    };
    // Machines start within a minute.
    for worker in 0..first {
        let start = 60.0 * worker as f64 / fleet.workers as f64;
        run.next(start, worker as u32, Act::Begin(3));
    }
    let mut now = 0.0;
    while let Some(Reverse((time, id, act))) = run.heap.pop() {
        now = time as f64 / 1e6;
        run.act(now, id, act);
    }
    let mut figures = run.bucket.figures;
    figures.seconds = now;
    figures.worked = run.worked / (now * fleet.workers as f64);
    figures
}

impl Run<'_> {
    fn next(&mut self, seconds: f64, id: u32, act: Act) {
        let time = (seconds * 1e6) as u64;
        self.heap.push(Reverse((time, id, act)));
    }

    /// A worker does what it does next.
    fn act(&mut self, now: f64, id: u32, act: Act) {
        let (then, next) = match act {
            Act::Begin(left) => {
                let bytes = match left {
                    3 => 100.0,
                    2 => PLAN_BYTES * self.fleet.plan as f64,
                    _ => 0.0,
                };
                let next = match left {
                    1 => Act::Make(0),
                    _ => Act::Begin(left - 1),
                };
                (self.bucket.asked(now, false, bytes), next)
            }
            Act::Make(node) => {
                let spread = 1.0 + SPREAD * (2.0 * self.bucket.dice.unit() - 1.0);
                let took = SECONDS[node as usize] * spread;
                self.worked += took;
                (now + took, Act::Made(node))
            }
            Act::Made(node) => {
                self.workers[id as usize].open += 1;
                let upload = match node {
                    0 => Act::Probe(4),
                    _ => Act::Upload(node, requests(node)),
                };
                self.next(now, id, upload);
                match node as usize + 1 < BYTES.len() {
                    // After eight that are not there the store is listed, and found to be too large.
                    true if node == 7 => (now, Act::List(node + 1, LISTED)),
                    true => (self.bucket.asked(now, false, 0.0), Act::Make(node + 1)),
                    false => {
                        self.workers[id as usize].ended = true;
                        return;
                    }
                }
            }
            Act::List(node, 0) => (self.bucket.asked(now, false, 0.0), Act::Make(node)),
            Act::List(node, left) => {
                let answered = self.bucket.asked(now, false, LIST_BYTES);
                (answered, Act::List(node, left - 1))
            }
            Act::Probe(left) => {
                let next = match left {
                    1 => Act::Upload(0, requests(0)),
                    _ => Act::Probe(left - 1),
                };
                (self.bucket.asked(now, left != 2, 100.0), next)
            }
            Act::Upload(_, 0) => {
                let worker = &mut self.workers[id as usize];
                worker.open -= 1;
                if !worker.ended || worker.open > 0 || self.left == 0 {
                    return;
                }
                self.left -= 1;
                *worker = Worker::default();
                (now, Act::Begin(3))
            }
            Act::Upload(node, n) => (self.upload(now, node, n), Act::Upload(node, n - 1)),
        };
        self.next(then, id, next);
    }

    /// When a request of an upload is answered.
    fn upload(&mut self, now: f64, node: u8, n: u8) -> f64 {
        let bytes = BYTES[node as usize] as f64;
        match (requests(node), n) {
            (3, 3) => self.bucket.asked(now, false, 0.0),
            (1, 1) => self.bucket.asked(now, true, bytes + RECORD_BYTES),
            (_, 1) => self.bucket.asked(now, true, RECORD_BYTES),
            _ => self.bucket.asked(now, true, bytes),
        }
    }
}

/// The figures of a fleet, as they are printed.
fn row(fleet: &Fleet) -> Value {
    let figures = simulate(fleet);
    let captures = fleet.captures as f64;
    let requests = (figures.reads + figures.writes) as f64;
    let dollars = figures.reads as f64 / 1e3 * PRICE[0] + figures.writes as f64 / 1e3 * PRICE[1];
    let gb = BYTES.iter().sum::<u64>() as f64 * captures / 1e9;
    let rounded = |x: f64, parts: f64| (x * parts).round() / parts;
    json!({
        "workers": fleet.workers,
        "captures": fleet.captures,
        "parts": fleet.parts,
        "captures_a_plan": fleet.plan,
        "hours": rounded(figures.seconds / 3600.0, 100.0),
        "at_work_percent": rounded(100.0 * figures.worked, 10.0),
        "reads_a_second": rounded(figures.reads as f64 / figures.seconds, 1.0),
        "writes_a_second": rounded(figures.writes as f64 / figures.seconds, 1.0),
        "longest_wait_s": rounded(figures.longest_wait, 10.0),
        "moved_tb": rounded(figures.bytes / 1e12, 10.0),
        "requests_a_node": rounded(requests / (captures * BYTES.len() as f64), 100.0),
        "requests_dollars": rounded(dollars, 1.0),
        "kept_a_month_dollars": rounded(gb * PRICE[2], 1.0),
    })
}

fn main() {
    #[rustfmt::skip]
    let fleets = [
        (1_000, 10_000, 1, 1_000),
        (10_000, 1_000_000, 1, 1_000),
        (10_000, 50_000, 1, 1_000_000),
        (50_000, 250_000, 1, 1_000),
        (100_000, 300_000, 1, 1_000),
        (100_000, 300_000, 4, 1_000),
    ];
    let mut rows = Vec::new();
    for (workers, captures, parts, plan) in fleets {
        #[rustfmt::skip]
        let row = row(&Fleet { workers, captures, parts, plan });
        println!("{row}");
        rows.push(row);
    }
    let args: Vec<String> = std::env::args().collect();
    if let Some(at) = args.iter().position(|a| a == "--json") {
        let text = serde_json::to_string_pretty(&json!({ "rows": rows })).unwrap();
        std::fs::write(&args[at + 1], text + "\n").unwrap();
    }
}
