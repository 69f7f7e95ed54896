//! How long the two networks take: `cargo bench -p person`.

use person::Network;
use std::time::Instant;

fn main() {
    let files: [(&str, &[u8]); 2] = [
        (
            "detector",
            include_bytes!("../../../models/person/detector.net"),
        ),
        (
            "landmarks",
            include_bytes!("../../../models/person/landmarks.net"),
        ),
    ];
    for (name, file) in files {
        let start = Instant::now();
        let network = Network::read(file).expect("a network");
        println!("{name}: read in {:.3} s", start.elapsed().as_secs_f64());
        let input = vec![0.5; network.input().iter().product()];
        let start = Instant::now();
        let rounds = 10;
        for _ in 0..rounds {
            std::hint::black_box(network.run(&input));
        }
        let each = start.elapsed().as_secs_f64() / f64::from(rounds);
        println!("{name}: {each:.4} s a run");
    }
}
