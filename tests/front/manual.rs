//! What is written for people: completions, pages for `man`, pictures under their own ending.

use super::place::Place;

#[test]
fn every_verb_is_completed_and_has_a_page() {
    let place = Place::new();
    place.run("man --out pages").code(0);
    let script = place.run("completions bash").code(0).out;
    let main = place.run("man").code(0).out;
    for verb in ["measure", "doctor", "score", "run", "sweep", "cache"] {
        assert!(
            script.contains(&format!("tailor__subcmd__{verb}")),
            "{verb}"
        );
        assert!(main.contains(&format!("tailor\\-{verb}(1)")), "{verb}");
        let page = std::fs::read_to_string(place.path(&format!("pages/tailor-{verb}.1")));
        assert!(page.unwrap().contains(".SH OPTIONS"), "{verb}");
    }
    assert!(script.contains("--stature"), "flags are completed");
    place.write("file", "");
    let wrong = place.run("man --out file").code(2).err;
    assert!(wrong.contains("cannot write"), "{wrong}");
    place.run("completions abacus").code(2);
}

#[test]
fn the_help_of_a_verb_has_what_it_uses_in_plain_letters() {
    let place = Place::new();
    let help = |verb: &str| place.run(&format!("{verb} --help")).code(0).out;
    let all = help("");
    let verbs = all
        .lines()
        .skip_while(|l| !l.starts_with("Commands:"))
        .skip(1);
    let verbs = verbs.take_while(|l| !l.is_empty());
    let verbs: Vec<&str> = verbs.filter_map(|l| l.split_whitespace().next()).collect();
    assert!(verbs.len() > 15, "{all}");
    for verb in verbs.iter().filter(|v| **v != "help") {
        let reported = help(verb);
        assert!(!reported.contains("\\["), "{reported}");
        if !cfg!(feature = "remote") {
            assert!(
                !reported.contains("--store <") && !reported.contains("--trust"),
                "{reported}"
            );
        }
    }
    for verb in ["mat", "pipelines", "follow", "stages"] {
        assert!(!help(verb).contains("--sign-key"), "{verb}");
    }
    let stages = place.run("stages").code(0).out;
    assert!(!stages.contains("\\["), "{stages}");
    // What the help leaves out is understood.
    place
        .run("check small.toml --store file:///nowhere")
        .code(0);
}

#[test]
fn a_picture_gets_the_ending_of_what_it_is() {
    let place = Place::new();
    place.run("run small.toml").code(0);
    let show = "show body --pipeline small.toml --as views -o";
    let wrong = place.run(&format!("{show} body.png")).code(2).err;
    assert!(wrong.contains("give the file that ending"), "{wrong}");
    place.run(&format!("{show} body.jpg")).code(0);
    assert!(place.path("body.jpg").exists() && !place.path("body.png").exists());
}
