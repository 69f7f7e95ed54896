//! A capture looked at before minutes are spent, and the capture.toml that follows from it.

use super::place::Place;
use crate::small;

/// A turn of twelve photos of the sample, all of one half of the turn.
fn turn() -> Place {
    let place = Place::sharing();
    // At their own size: the mat's tags are small.
    for photo in &small::photos()[..12] {
        let name = photo.file_name().unwrap().to_str().unwrap();
        place.write(&format!("turn/{name}"), std::fs::read(photo).unwrap());
    }
    place
}

#[test]
fn what_is_odd_is_reported_by_photo_and_what_can_be_measured() {
    let place = turn();
    let reported = place.run("doctor turn --json").code(0).json();
    assert_eq!(reported["photos"], 12);
    assert_eq!(reported["motion"], "turn");
    assert_eq!(reported["findings"][0]["grade"], "doubt", "{reported}");
    let warned = reported["warnings"].to_string();
    assert!(
        warned.contains("numbers 0 to 11") && warned.contains("--mat-tag"),
        "{warned}"
    );
    let lengths = |reported: &serde_json::Value| {
        reported["can"]["lengths"]["text"]
            .as_str()
            .unwrap()
            .to_owned()
    };
    assert!(lengths(&reported).starts_with("relative"), "{reported}");
    let known = place
        .run("doctor turn --json --mat-tag 60 --stature 81")
        .code(0)
        .json();
    assert!(lengths(&known).contains("the marker mat"), "{known}");
    assert_eq!(known["warnings"].as_array().unwrap().len(), 0, "{known}");
    // One photo blurred, one brighter.
    let spoil = |name: &str, how: &dyn Fn(&mut shape::Rgb)| {
        let path = place.path("turn").join(name);
        let photo = shape::Photo::of(name, [800, 1200], std::fs::read(&path).unwrap());
        let mut pixels = photo.decode().unwrap();
        how(&mut pixels);
        std::fs::write(path, shape::rgb_to_jpeg(&pixels, 92)).unwrap();
    };
    spoil("0003.jpg", &|p| {
        let sharp = p.clone();
        for y in 3..p.height - 3 {
            for x in 3..p.width - 3 {
                let near = (0..49).map(|k| sharp.at(x + k % 7 - 3, y + k / 7 - 3));
                let sum = near.fold([0u32; 3], |s, v| [0, 1, 2].map(|c| s[c] + u32::from(v[c])));
                *p.at_mut(x, y) = sum.map(|s| (s / 49) as u8);
            }
        }
    });
    spoil("0008.jpg", &|p| {
        p.data
            .iter_mut()
            .for_each(|v| *v = v.map(|c| (u32::from(c) * 3 / 4) as u8));
    });
    let reported = place.run("doctor turn").code(0).out;
    let line = |words: &str| {
        reported
            .lines()
            .find(|l| l.contains(words))
            .unwrap_or_default()
            .to_owned()
    };
    assert!(line("blurred").contains("0003.jpg: "), "{reported}");
    assert!(line("exposed from").contains("0008.jpg: "), "{reported}");
    assert!(reported.contains("what can be measured"), "{reported}");
    // A statue on a mat is nobody who turns on the spot.
    let reported = place.run("doctor turn --json --turning").code(0).json();
    let can = reported["can"].as_object().unwrap();
    assert_eq!(can.keys().collect::<Vec<_>>(), ["lengths", "turning"]);
    assert_eq!(can["turning"]["code"], "find-can-not-turning", "{reported}");
}

#[test]
fn a_shuffled_turn_is_stopped_in_seconds_by_measure_too() {
    let place = Place::new();
    for i in 0..18 {
        let photo = small::photo(&format!("{:04}.jpg", i * 7 % 18));
        place.write(&format!("turn/{i:04}.jpg"), photo);
    }
    let reported = place.run("doctor turn --json").code(1).json();
    assert_eq!(reported["findings"][0]["grade"], "stop", "{reported}");
    assert!(reported["can"]["girths"]["text"] == "no", "{reported}");
    let printed = place.run("measure turn").code(1).err;
    for expected in [
        "photos failed",
        "not in turning order",
        "any-order.toml",
        "photos.stop=false",
    ] {
        assert!(printed.contains(expected), "{expected}: {printed}");
    }
    assert!(!place.has("keypoints", "done", "made"));
}

#[test]
fn exchanged_photos_are_named_with_their_places() {
    let place = Place::new();
    for i in 0..18 {
        let shown = match i {
            4 => 9,
            9 => 4,
            i => i,
        };
        let photo = small::photo(&format!("{shown:04}.jpg"));
        place.write(&format!("turn/{i:04}.jpg"), photo);
    }
    let printed = place.run("run body tracks --input photos=turn").code(1).err;
    for expected in [
        "2 photos are out of turning order (0004.jpg, 0009.jpg)",
        "0004.jpg shows what is between 0008.jpg and 0010.jpg",
    ] {
        assert!(printed.contains(expected), "{expected}: {printed}");
    }
}

#[test]
fn another_mat_than_the_one_on_the_disk_stops() {
    let place = turn();
    let mat = "--mat-tag 60 --mat-ring";
    let right = format!("doctor turn --json {mat} 187 --mat-ids 0-11");
    let reported = place.run(&right).code(0).json();
    assert!(!reported["findings"].to_string().contains("another mat"));
    for wrong in [
        "200 --mat-ids 0-11",
        "187 --mat-ids 0-15",
        "187 --mat-ids 20-31",
    ] {
        let reported = place.run(&format!("doctor turn --json {mat} {wrong}"));
        let reported = reported.code(1).json();
        let first = &reported["findings"][0];
        assert_eq!(first["grade"], "stop", "{reported}");
        let what = first["what"]["text"].as_str().unwrap();
        assert!(what.contains("12 go around, numbers 0 to 11"), "{what}");
        let girths = reported["can"]["girths"]["text"].as_str().unwrap();
        assert!(girths.starts_with("no"), "{girths}");
    }
}

#[test]
fn init_writes_what_photos_show_once_and_measure_reads_it() {
    let place = turn();
    let printed = place
        .run("init turn --stature 5ft10in --mat-tag 59.7 --sex female --born 2016-05-01 --date 2026-05-01")
        .code(0)
        .out;
    let text = std::fs::read_to_string(place.path("turn/capture.toml")).unwrap();
    assert!(printed.contains(&text), "{printed}");
    let file: toml::Table = text.parse().unwrap();
    assert_eq!(file["views"].as_integer(), Some(12));
    assert_eq!(file["subject"]["height_cm"].as_float(), Some(177.8));
    let printed = ["sex", "born"].map(|key| file["subject"][key].as_str().unwrap());
    assert_eq!(printed, ["female", "2016-05-01"]);
    assert_eq!(file["date"].as_str(), Some("2026-05-01"));
    assert_eq!(file["mat"]["tag_size_mm"].as_float(), Some(59.7));
    for expected in [
        "marker tags 0 to 11, 12 on a ring",
        "EXIF has 50 mm",
        "# The subject's stature; 10 to 300 cm; --stature",
        "# weight_kg",
        "# plate",
    ] {
        assert!(text.contains(expected), "{expected}: {text}");
    }
    let reported = place.run("doctor turn --json").code(0).json();
    assert_eq!(
        reported["warnings"].as_array().unwrap().len(),
        0,
        "every key is known: {reported}"
    );
    // What somebody wrote is never touched.
    place.write("turn/capture.toml", "name = \"mine\"\n");
    let printed = place.run("init turn").code(2).err;
    assert!(printed.contains("is there already"), "{printed}");
    let kept = std::fs::read_to_string(place.path("turn/capture.toml")).unwrap();
    assert_eq!(kept, "name = \"mine\"\n");
}

#[test]
fn a_photo_without_the_subject_is_named_in_seconds_with_how_to_use_it() {
    let place = Place::sharing();
    place.photos("turn", 9);
    let plate = small::photo("plate.jpg");
    for (at, name) in ["0009.jpg", "0007-again.jpg"].iter().enumerate() {
        place.write(&format!("turn/{name}"), &plate);
        let printed = place.run("doctor turn").code(1).out;
        let line = printed
            .lines()
            .find(|l| l.contains("stop"))
            .unwrap_or_default();
        for expected in [*name, "empty scene", &format!("plate = \"{name}\"")] {
            assert!(line.contains(expected), "{expected}: {printed}");
        }
        let printed = place.run("measure turn --mat-tag 60").code(1).err;
        assert!(
            printed.contains("photos failed") && printed.contains(name),
            "{printed}"
        );
        assert!(!printed.contains("two legs"), "{printed}");
        // With that line it is the plate from there on.
        if at == 0 {
            let seen = place
                .run(&format!("doctor turn --plate {name} --json"))
                .code(0)
                .json();
            assert_eq!(
                (&seen["photos"], &seen["plate"]),
                (&9.into(), &(*name).into())
            );
        }
        std::fs::remove_file(place.path("turn").join(name)).unwrap();
    }
}

#[test]
fn copies_are_named_where_too_few_photos_are_left() {
    let place = Place::new();
    place.photos("turn", 1);
    let photo = std::fs::read(place.path("turn/0000.jpg")).unwrap();
    for i in 1..5 {
        place.write(&format!("turn/000{i}.jpg"), &photo);
    }
    let printed = place.run("doctor turn").code(1).err;
    for expected in [
        "1 of 5 photos",
        "0001.jpg = 0000.jpg",
        "0004.jpg = 0000.jpg",
        "at least 3",
    ] {
        assert!(printed.contains(expected), "{expected}: {printed}");
    }
    place.photos("turn", 4);
    let seen = place.run("doctor turn").code(0).out;
    assert!(
        seen.contains("0004.jpg is the same file as 0000.jpg"),
        "{seen}"
    );
    place.write("turn/capture.toml", "views = 5\n");
    let printed = place.run("doctor turn").code(1).err;
    assert!(printed.contains("0004.jpg = 0000.jpg"), "{printed}");
}

#[test]
fn a_mat_that_is_too_small_in_the_picture_is_named_and_one_of_a_megapixel_is_read() {
    let place = Place::sharing();
    let sample = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/person");
    let facts = std::fs::read_to_string(sample.join("capture.toml")).unwrap();
    let facts = facts.replace("views = 18", "views = 9");
    let facts = facts.replace("step_deg = 20.0", "step_deg = 40.0");
    let facts = facts.replace("plate = \"images/plate.jpg\"\n", "");
    for (folder, width) in [("turn", 960), ("small", 480)] {
        place.write(&format!("{folder}/capture.toml"), &facts);
        for i in (0..18).step_by(2) {
            let name = format!("{i:04}.jpg");
            let photo = std::fs::read(sample.join("images").join(&name)).unwrap();
            let path = format!("{folder}/images/{name}");
            place.write(&path, &photo);
            if width < 960 {
                let photo = image::open(place.path(&path)).unwrap();
                photo
                    .thumbnail(width, 2 * width)
                    .save(place.path(&path))
                    .unwrap();
            }
        }
    }
    let warned = |folder: &str| {
        let printed = place.run(&format!("doctor {folder}")).out;
        let line = printed.lines().find(|l| l.contains("of the mat's 16 tags"));
        line.map(str::to_owned)
    };
    assert_eq!(warned("turn"), None);
    let small = warned("small").unwrap();
    assert!(
        small.starts_with("  doubt ") && small.contains("too small"),
        "{small}"
    );
}
