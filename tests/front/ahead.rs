//! `plan` and `why` before anything runs: their words in any order, and those of `measure`.

use super::place::Place;

#[test]
fn plan_and_why_take_pipeline_and_node_in_any_order() {
    let place = Place::new();
    place.run("run small.toml").code(0);
    let change = "--set solid.stature_mm=1500";
    for verb in ["plan", "why"] {
        let out = |words: &str| place.run(&format!("{verb} {words} {change}")).code(0).out;
        let reported = out("small.toml body");
        assert!(reported.contains("1750.0 -> 1500.0"), "{reported}");
        assert_eq!(out("body small.toml"), reported);
        // Names of built-in pipelines are nodes as well.
        let both = place.run(&format!("{verb} hull body")).code(2).err;
        assert!(both.contains("input `photos`"), "{both}");
    }
    assert!(
        place
            .run("plan small.toml")
            .code(0)
            .out
            .ends_with("all cached\n")
    );
    let printed = place.run("why small.toml").code(2).err;
    assert!(printed.contains("name one node of: "), "{printed}");
    let printed = place.run("why small.toml nobody").code(2).err;
    assert!(printed.contains("no node `nobody`"), "{printed}");
    // Nodes alone are of the program's own pipeline.
    for words in ["why girths", "plan girths"] {
        let printed = place.run(words).code(2).err;
        assert!(printed.contains("input `photos`"), "{words}: {printed}");
    }
    let printed = place.run("plan smal").code(2).err;
    assert!(printed.contains("smal cannot be read"), "{printed}");
}

#[test]
fn a_graph_of_what_measure_would_run_has_its_own_params() {
    let place = Place::new();
    place.photos("turn", 18);
    let drawn = place.run("graph measure turn --fast").code(0).out;
    assert!(
        drawn.starts_with("digraph") && drawn.contains("girths"),
        "{drawn}"
    );
    let walk = place.run("graph measure turn --walk").code(0).out;
    assert!(
        walk.contains("walked") && !drawn.contains("walked"),
        "{walk}"
    );
    let printed = place.run("graph turn measure").code(2).err;
    assert!(printed.contains("write `measure` first"), "{printed}");
}

#[test]
fn why_compares_with_the_run_of_another_machine() {
    let place = Place::new();
    place
        .run("run small.toml --set solid.stature_mm=1500 --cache elsewhere --out theirs")
        .code(0);
    let asked = "why small.toml body --against theirs/run.json";
    // Nothing was made here: what is known already is printed.
    let reported = place.run(asked).code(0).out;
    assert!(
        reported.contains("solid: differs") && reported.contains("1500.0 -> 1750.0"),
        "{reported}"
    );
    place.run("run small.toml").code(0);
    let reported = place.run(asked).code(0).out;
    assert!(
        reported.starts_with("body: differs\n  from solid: "),
        "{reported}"
    );
    assert!(reported.contains("1500.0 -> 1750.0"), "{reported}");
    let same = place
        .run(&format!("{asked} --set solid.stature_mm=1500"))
        .code(0)
        .out;
    assert_eq!(same, "body: alike\n");
    place.write("no.json", "{}");
    let printed = place
        .run("why small.toml body --against no.json")
        .code(2)
        .err;
    assert!(printed.contains("no record of a run"), "{printed}");
}

#[test]
fn what_measure_would_do_is_planned_by_its_own_words() {
    let place = Place::new();
    place.photos("turn", 18);
    let facts = "--stature 81cm --weight 9";
    let plan = place.run(&format!("plan measure turn {facts} --json"));
    let plan = plan.code(0).json();
    let nodes = plan["nodes"].as_array().unwrap();
    assert!(nodes.iter().any(|n| n["node"] == "report"), "{plan}");
    assert_eq!(
        nodes.iter().find(|n| n["node"] == "photos").unwrap()["state"],
        "will run"
    );
    let walk = place.run("plan measure turn --walk").code(0).out;
    assert!(walk.contains("walked"), "{walk}");
    let why = place
        .run(&format!("why measure turn girths {facts}"))
        .code(0)
        .out;
    assert!(
        why.starts_with("girths: may run\n") && why.contains("\nphotos: will run"),
        "{why}"
    );
    for (words, expected) in [
        ("plan measure nowhere", "nowhere"),
        ("plan measure turn nobody", "no node `nobody`"),
        ("plan measure turn --stature 7km", "--stature"),
        ("why measure turn", "name one node of"),
        ("plan --variant quick measure turn", "write `measure` first"),
        ("why girths measure turn", "write `measure` first"),
        ("plan --strands measure turn", "--strands cuts a pipeline"),
    ] {
        let printed = place.run(words).code(2).err;
        assert!(printed.contains(expected), "{words}: {printed}");
    }
    assert!(
        place
            .run("cache runs --json")
            .code(0)
            .json()
            .as_array()
            .unwrap()
            .is_empty()
    );
    assert!(!place.path("turn-out").exists());
}

#[test]
fn what_a_plan_has_for_a_result_that_broke_is_what_a_run_does() {
    let place = Place::new();
    place.run("run small.toml").code(0);
    let run = place.run("run small.toml --json").code(0).json();
    let nodes = run["nodes"].as_array().unwrap();
    let ring = nodes.iter().find(|node| node["node"] == "ring").unwrap();
    let content = ring["content"].as_str().unwrap();
    let path = place.path(&format!("cache/cas/{}/{content}", &content[..2]));
    let mut blob = std::fs::read(&path).unwrap();
    blob[100] ^= 1;
    std::fs::write(&path, blob).unwrap();
    let plan = place.run("plan small.toml --json").code(0).json();
    let planned = plan["nodes"].as_array().unwrap().iter();
    let will: Vec<&str> = planned
        .filter(|node| node["state"] == "will run")
        .map(|node| node["node"].as_str().unwrap())
        .collect();
    let run = place.run("run small.toml --json").code(0).json();
    let nodes = run["nodes"].as_array().unwrap().iter();
    let did: Vec<&str> = nodes
        .filter(|node| node["status"] != "found")
        .map(|node| node["node"].as_str().unwrap())
        .collect();
    assert_eq!(will, did, "{plan}");
    place.sound();
}

#[test]
fn plan_has_the_words_of_why_impact_graph_and_check_which_work_with_a_hint() {
    let place = Place::new();
    place.run("run small.toml").code(0);
    let set = "--set solid.stature_mm=1500";
    for (now, before) in [
        (
            format!("plan --why body small.toml {set}"),
            format!("why body small.toml {set}"),
        ),
        (
            "plan --reach stature_mm small.toml".into(),
            "impact small.toml stature_mm".into(),
        ),
        (
            "plan --reach all small.toml".into(),
            "impact small.toml".into(),
        ),
        (
            "plan --as mermaid small.toml".into(),
            "graph --as mermaid small.toml".into(),
        ),
        ("plan --check small.toml".into(), "check small.toml".into()),
    ] {
        let (new, old) = (place.run(&now).code(0), place.run(&before).code(0));
        assert_eq!(new.out, old.out, "{now}");
        assert!(!new.out.is_empty() && !new.err.contains(" now; "), "{now}");
        assert!(old.err.contains("` is `tailor plan --"), "{}", old.err);
        let quiet = place.run(&format!("{before} --quiet")).code(0).err;
        assert!(!quiet.contains(" now; "), "{quiet}");
    }
    place.photos("turn", 18);
    let drawn = place.run("plan --as dot measure turn").code(0).out;
    assert!(drawn.starts_with("digraph"), "{drawn}");
    let reached = place.run("plan --reach voxel_mm measure turn").code(0).out;
    assert!(reached.contains("girths"), "{reached}");
    for (words, why) in [
        ("plan --why body solid small.toml", "one too many"),
        ("plan --check measure turn", "give its file or its name"),
        ("plan --reach stature small.toml", "stature_mm"),
        ("plan --why body --check small.toml", "cannot be used with"),
        ("plan --against run.json small.toml", "--why"),
    ] {
        let wrong = place.run(words).code(2).err;
        assert!(wrong.contains(why), "{words}: {wrong}");
    }
}

#[test]
fn the_help_has_nineteen_verbs_and_those_of_before_are_understood() {
    let place = Place::new();
    let help = place.run("--help").code(0).out;
    let verbs = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let verbs: Vec<&str> = verbs.take_while(|line| !line.is_empty()).collect();
    let names = verbs
        .iter()
        .filter_map(|line| line.split_whitespace().next());
    let names: Vec<&str> = names.filter(|name| *name != "help").collect();
    assert_eq!(names.len(), 19, "{names:?}");
    for before in [
        "why", "impact", "graph", "check", "search", "work", "submit", "man",
    ] {
        assert!(!names.contains(&before), "{before}");
        place.run(&format!("{before} --help")).code(0);
    }
    for verb in ["submit", "status", "cancel", "export", "work"] {
        place.run(&format!("cluster {verb} --help")).code(0);
    }
}
