//! Programs that users may allow, whose processes are pretended: their folders, permissions and results are real.

use super::application::{CATALOG, Results, Text};
use super::seam;
use crate::graph::Graph;
use crate::recipe::{Overrides, Pipeline};
use programs::pretended::{Pretended, pretend};
use stage::Files;
use std::path::Path;
use std::rc::Rc;

/// The program that leaves a link to a photo among its results.
pub(super) const BAD: usize = 2;

/// The graph of a program of a number, whom nobody asked yet.
pub(super) fn program(number: usize) -> Graph {
    pretend(does);
    let text = format!(
        "goal = \"it\"\n[input.turn]\nfiles = \"*.jpg\"\n[node.it]\nstage = \"exec\"\n\
         command = [\"no-such-program\", \"--number\", \"{number}\", \"{{from.turn}}\", \"{{out}}\"]\n\
         from = {{ turn = \"@turn\" }}\nout = \"text\"\n"
    );
    let pipeline = Pipeline::of_text("program.toml", &text, &CATALOG).expect("a pipeline");
    pipeline.graph(&Overrides::default()).expect("a graph")
}

/// What it makes of some files.
pub(super) fn makes(number: usize, files: &Files) -> Results {
    let photos = files.entries.iter();
    let photos = photos.map(|entry| files.read(entry).expect("a photo"));
    let text = Text(given(number, photos));
    Rc::new(vec![stage::to_bytes(&text)])
}

fn given(number: usize, photos: impl Iterator<Item = Vec<u8>>) -> Vec<u8> {
    let mut text = format!("{number}:").into_bytes();
    photos.for_each(|photo| text.extend(photo));
    text
}

/// What it does: reads what it was given, in the order of names, and writes it.
fn does(words: &[String]) -> Pretended {
    let [_, _, number, from, out] = words else {
        return Pretended::Fails;
    };
    let number: usize = number.parse().expect("a number");
    let photos = crate::store::below(Path::new(from)).into_iter();
    let text = given(
        number,
        photos.map(|path| std::fs::read(path).expect("a photo")),
    );
    if !seam::works("program", 2, &text) {
        return Pretended::Killed;
    }
    let out = Path::new(out);
    #[cfg(unix)]
    if number == BAD {
        let photo = Path::new(from).join("0.jpg");
        std::os::unix::fs::symlink(photo, out.join("b.txt")).expect("a link");
    }
    std::fs::write(out.join("a.txt"), text).expect("a result");
    Pretended::Done
}
