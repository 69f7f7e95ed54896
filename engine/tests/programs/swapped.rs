//! A program that stays, and exchanges what is in its folder between two jobs.

use crate::application::{Place, Text};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;

/// Does its first job, and then exchanges its folder for a link to another one, or for what `exchange` makes.
fn stays(place: &Place, exchange: &str) -> String {
    let program = format!(
        "#!/usr/bin/python3\nimport sys, json, os, time\nprint(json.dumps({{'ready': True}}), flush=True)\n\
         for count, line in enumerate(sys.stdin):\n    words = json.loads(line)\n    out = words[0]\n\
         \x20   try: open(out, 'w').write('job ' + words[1])\n    except OSError as e: sys.stderr.write(str(e))\n\
         \x20   folder = os.path.dirname(out)\n    if os.path.exists(folder + '/../left-behind'):\n\
         \x20       open(out, 'w').write('beside what was left')\n    if count == 0:\n\
         \x20       try:\n            {exchange}\n        except OSError as e: sys.stderr.write(str(e))\n\
         \x20   print(json.dumps({{'done': True}}), flush=True)\n"
    );
    place.write("stays", &program);
    let path = place.path("stays");
    std::fs::set_permissions(&path, PermissionsExt::from_mode(0o755)).unwrap();
    path.display().to_string()
}

/// Two jobs of one program, one after the other: what became of each.
fn jobs(place: &Place, program: &str) -> Vec<Result<String, String>> {
    let node = |name: &str, n: i32| {
        format!(
            "[node.{name}]\nstage = \"exec\"\nout = \"text\"\nkeep = true\ntimeout_s = 5.0\n\
             command = [{program:?}, \"{{out}}\", \"{{with.n}}\"]\nwith = {{ n = {n} }}\n"
        )
    };
    let nodes = format!("goal = [\"x\", \"y\"]\n{}{}", node("x", 1), node("y", 2));
    let graph = place.graph(&nodes);
    let all: Vec<usize> = (0..graph.nodes.len()).collect();
    place.allow(&graph);
    let options = engine::Options {
        threads: Some(1),
        ..place.options()
    };
    let outcome = engine::run(&graph, &[], &all, &options, &(), &false.into());
    let outcome = outcome.unwrap();
    let one = |name: &&str| match outcome.read::<Text>(name) {
        Ok(text) => Ok(text.0.clone()),
        Err(why) => Err(why.to_string()),
    };
    ["x", "y"].iter().map(one).collect()
}

fn whole(folder: &Path) -> bool {
    folder.join("photo.jpg").exists() && folder.join("in/notes.txt").exists()
}

#[test]
fn a_link_in_place_of_a_folder_empties_nothing() {
    let place = Place::new();
    let victim = place.path("victim");
    std::fs::create_dir_all(victim.join("in")).unwrap();
    std::fs::write(victim.join("photo.jpg"), "mine").unwrap();
    std::fs::write(victim.join("in/notes.txt"), "mine").unwrap();
    let link = format!("os.rename(folder, folder + '2'); os.symlink({victim:?}, folder)");
    // The job's folder, those above it, and its folder to work in.
    for (i, exchange) in [
        link.clone(),
        format!("folder = os.path.dirname(folder); {link}"),
        format!("folder = os.getcwd(); {link}"),
        format!("os.symlink({victim:?}, os.getcwd() + '/link'); os.symlink({victim:?}, folder + '/link')"),
    ]
    .iter()
    .enumerate()
    {
        let program = stays(&place, &format!("time.sleep(0.05); {exchange}"));
        let _ = jobs(&place, &program);
        assert!(whole(&victim), "{i}");
        assert_eq!(crate::application::left(&place.path("cache")).len(), 0, "{i}");
        let _ = std::fs::remove_dir_all(place.path("cache"));
    }
}

#[test]
fn a_result_is_taken_from_nowhere_else() {
    let place = Place::new();
    // Nothing else there, so that it would pass for a result.
    std::fs::create_dir(place.path("elsewhere")).unwrap();
    place.write("elsewhere/text.txt", "not the program's");
    let elsewhere = place.path("elsewhere");
    let exchange =
        format!("import shutil; shutil.rmtree(folder); os.symlink({elsewhere:?}, folder)");
    let program = stays(&place, &exchange);
    let made = jobs(&place, &program);
    assert!(
        made.iter()
            .all(|made| made.as_deref() != Ok("not the program's")),
        "{made:?}"
    );
}

#[test]
fn each_job_has_a_folder_of_its_own() {
    let place = Place::new();
    for left in [
        "open(folder + '/../left-behind', 'w').write('of the first')",
        "os.chmod(folder, 0)",
    ] {
        let made = jobs(&place, &stays(&place, left));
        let made: Vec<Option<&str>> = made.iter().map(|m| m.as_deref().ok()).collect();
        // Whichever of the two comes first.
        assert_eq!(made, [Some("job 1"), Some("job 2")], "{left}");
    }
}

#[test]
fn who_does_not_listen_is_ended_in_time() {
    let place = Place::new();
    place.write(
        "deaf",
        "#!/bin/sh\necho '{\"ready\": true}'\nexec sleep 600\n",
    );
    let path = place.path("deaf");
    std::fs::set_permissions(&path, PermissionsExt::from_mode(0o755)).unwrap();
    let long = "x".repeat(300_000);
    let node = format!(
        "[node.x]\nstage = \"exec\"\nout = \"text\"\nkeep = true\ntimeout_s = 1.0\n\
         command = [{path:?}, \"{{out}}\", \"{{with.long}}\"]\nwith = {{ long = \"{long}\" }}\n"
    );
    let why = place.failure(&node);
    assert!(
        why.contains("was ended after 1 s"),
        "{}",
        &why[..why.len().min(300)]
    );
}
