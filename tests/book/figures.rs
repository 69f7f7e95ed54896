//! Tables of figures: those that programs of the repository take, and the line below all other tables.

use super::lab::data_of;
use super::tables::{hold, number, signed};
use super::{pages, read};
use serde_json::Value;
use std::fmt::Write;

pub(crate) fn json(name: &str) -> Value {
    serde_json::from_str(&read(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// As many digits as mean something: from ten on none behind the point.
pub(crate) fn digits(x: f64) -> String {
    match x.abs() {
        a if a >= 9.95 => format!("{x:.0}"),
        a if a >= 0.995 => format!("{x:.1}"),
        _ => format!("{x:.2}"),
    }
}

/// With a thin gap between thousands.
fn grouped(x: f64) -> String {
    let text = format!("{x:.0}");
    let (head, tail) = text.split_at(text.len().saturating_sub(3));
    match head {
        "" => tail.into(),
        _ if text.len() < 4 => text,
        _ => format!("{} {tail}", grouped(head.parse().unwrap())),
    }
}

#[test]
fn the_engine_beside_ninja_and_make() {
    let data = json("docs/tables/engine.json");
    let mut table = String::from(
        "| tool | nodes | first run | a stage | nothing to do | one source changed | plan | memory |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    for row in data["rows"].as_array().unwrap() {
        let nodes = number(&row["nodes"]);
        let ms = |key: &str| row[key].as_f64().map(|x| format!("{x:.1} ms"));
        let first = row["first_s"].as_f64();
        let cells = [
            row["tool"].as_str().map(str::to_owned),
            Some(grouped(nodes)),
            first.map(|s| format!("{s:.2} s")),
            first.map(|s| format!("{:.2} ms", s * 1e3 / nodes)),
            ms("nothing_ms"),
            ms("one_changed_ms"),
            ms("plan_ms"),
            row["memory_mb"].as_f64().map(|x| format!("{x:.0} MB")),
        ];
        let cells = cells.map(Option::unwrap_or_default);
        let _ = writeln!(table, "| {} |", cells.join(" | "));
    }
    let text = |key: &str| data[key].as_str().unwrap();
    let (ninja, make) = (&data["beside"][0], &data["beside"][1]);
    let _ = write!(
        table,
        "\n*{}, {}, {}; ninja {}, {}.*\n",
        text("program"),
        text("date"),
        text("machine"),
        ninja.as_str().unwrap(),
        make.as_str().unwrap(),
    );
    hold("docs/lab/engine.md", "engine", &table);
}

#[test]
fn a_fleet_on_paper() {
    let data = json("docs/tables/fleet.json");
    let mut table = String::from(
        "| workers | captures | parts | captures a plan | hours | of it at work | reads/s | writes/s | \
         longest wait for the bucket | TB moved | requests, dollars |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for row in data["rows"].as_array().unwrap() {
        let whole = |key: &str| grouped(number(&row[key]));
        let cells = [
            whole("workers"),
            whole("captures"),
            whole("parts"),
            whole("captures_a_plan"),
            format!("{:.2}", number(&row["hours"])),
            format!("{:.1} %", number(&row["at_work_percent"])),
            whole("reads_a_second"),
            whole("writes_a_second"),
            format!("{:.0} s", number(&row["longest_wait_s"])),
            format!("{:.1}", number(&row["moved_tb"])),
            whole("requests_dollars"),
        ];
        let _ = writeln!(table, "| {} |", cells.join(" | "));
    }
    hold("docs/lab/cluster.md", "fleet", &table);
}

/// What a fit of the shipped model did on a family that it had not seen.
pub(crate) fn held_out<'a>(
    model: &'a toml::Value,
    family: &str,
    level: &str,
) -> impl Fn(&str) -> f64 + 'a {
    let all = model["held_out"].as_array().unwrap();
    let is = |row: &&toml::Value| {
        row["family"].as_str() == Some(family) && row["level"].as_str() == Some(level)
    };
    let row = all
        .iter()
        .find(is)
        .unwrap_or_else(|| panic!("{family} {level}"));
    |key| match &row[key] {
        toml::Value::Integer(n) => *n as f64,
        value => value.as_float().unwrap(),
    }
}

const DRIVEN: &str = "made bodies driven to single people";
const RANGE: &str = "made bodies over their own range, infants to the old";
const REACH: &str = "arms on the trunk, remeshed";
const STRANGERS: &str = "adults of no family that is fitted on (160 to 246 of strangers)";

/// How far a level of a family left out is off: bodies, bias, level, tape, and how many intervals contain it.
fn cells(model: &toml::Value, family: &str, level: &str) -> String {
    let of = held_out(model, family, level);
    let pair = |a: &str, b: &str| format!("{}; {}", digits(of(a)), digits(of(b)));
    let tape = pair("tape_middle_percent", "tape_nine_in_ten_percent");
    let bias = signed(&format!("{:+.1}", of("bias_mm")));
    let height = pair("middle_mm", "nine_in_ten_mm");
    let covered = format!("{:.2}", of("coverage_of_90"));
    format!(
        "{:.0} | {bias} | {height} | {tape} | {covered}",
        of("bodies")
    )
}

#[test]
fn levels_and_necks_of_bodies_left_out() {
    let model: toml::Value = toml::from_str(&read("models/levels-1.toml")).unwrap();
    let mut table = String::from(
        "| left out | level | bodies | bias | level | tape | 90 % interval contains |\n|---|---|---|---|---|---|---|\n",
    );
    let own = format!("{RANGE} (their own nipples and navels, which are not people's)");
    for (head, family, levels) in [
        (
            DRIVEN,
            "survey",
            &["waist", "navel", "hip_bone", "chest"][..],
        ),
        (own.as_str(), "range", &["chest", "navel"]),
        (REACH, "reach", &["chest"]),
        (STRANGERS, "strangers", &["chest", "navel"]),
    ] {
        for (k, level) in levels.iter().enumerate() {
            let head = if k == 0 {
                format!("{head} ")
            } else {
                String::new()
            };
            let name = level.replace('_', " ");
            let _ = writeln!(
                table,
                "| {head}| {name} | {} |",
                cells(&model, family, level)
            );
        }
    }
    hold("docs/lab/girths.md", "levels", &table);
    let mut table = String::from(
        "| left out | bodies | bias, mm | level, mm | tape, % | 90 % interval contains |\n|---|---|---|---|---|---|\n",
    );
    for (head, family) in [(RANGE, "range"), (DRIVEN, "survey"), (REACH, "reach")] {
        let _ = writeln!(table, "| {head} | {} |", cells(&model, family, "larynx"));
    }
    hold("docs/lab/girths.md", "necks", &table);
}

#[test]
fn upper_arms_of_bodies_left_out() {
    let model: toml::Value = toml::from_str(&read("models/levels-1.toml")).unwrap();
    let mut table = String::from(
        "| left out | law | arms | bias, mm | level, mm | tape, % | 90 % interval contains |\n|---|---|---|---|---|---|---|\n",
    );
    for (head, family) in [
        (RANGE, "range"),
        (DRIVEN, "survey"),
        (REACH, "reach"),
        ("poses", "poses"),
    ] {
        for (law, level) in [
            ("straight, with the shoulder", "upper_arm_by_shoulder"),
            ("straight, without", "upper_arm"),
            ("bent, with the shoulder", "upper_arm_bent_by_shoulder"),
            ("bent, without", "upper_arm_bent"),
        ] {
            let cells = cells(&model, family, level);
            let _ = writeln!(table, "| {head} | {law} | {cells} |");
        }
    }
    hold("docs/lab/girths.md", "arms", &table);
}

#[test]
fn girths_of_made_bodies_end_to_end() {
    let text = read("models/tables/girths.csv");
    let rows: Vec<Vec<&str>> = text
        .lines()
        .skip(1)
        .map(|l| l.split(',').collect())
        .collect();
    let mut table = String::from(
        "| | measured | tape, middle; nine in ten % | 90 % interval contains |\n|---|---|---|---|\n",
    );
    let all = ["range/", "reach/", "survey/"];
    for (head, girth, families) in [
        ("hip", &["HC"][..], &all[..]),
        ("thigh", &["TC_L", "TC_R"], &all),
        ("calf", &["CFC_L", "CFC_R"], &all),
        ("upper arm", &["AC_L", "AC_R"], &all),
        ("chest", &["CC"], &all),
        ("waist (bodies driven to people)", &["WC"], &["survey/"]),
        (
            "neck (against the rig's plane, which leans otherwise)",
            &["NC"],
            &all,
        ),
    ] {
        let ours = |row: &&Vec<&str>| {
            girth.contains(&row[1]) && families.iter().any(|f| row[0].starts_with(f))
        };
        let of: Vec<&Vec<&str>> = rows.iter().filter(ours).collect();
        let measured = of.iter().filter(|row| row[2].is_empty());
        let number = |text: &str| text.parse::<f64>().ok();
        let judged = measured.filter_map(|row| {
            let (tape, truth) = (number(row[3])?, number(row[6])?);
            let inside = (number(row[4])?..=number(row[5])?).contains(&truth);
            Some((100.0 * (tape / truth - 1.0).abs(), inside))
        });
        let mut judged: Vec<(f64, bool)> = judged.collect();
        judged.sort_by(|a, b| a.0.total_cmp(&b.0));
        let at = |share: f64| judged[((judged.len() - 1) as f64 * share) as usize].0;
        let covered = judged.iter().filter(|j| j.1).count() as f64 / judged.len() as f64;
        let _ = writeln!(
            table,
            "| {head} | {} of {} | {}; {} | {covered:.2} |",
            grouped(judged.len() as f64),
            grouped(of.len() as f64),
            digits(at(0.5)),
            digits(at(0.9)),
        );
    }
    hold("docs/girths.md", "end-to-end", &table);
}

/// Whether a cell is a figure: a number, with what follows it.
fn is_figure(cell: &str) -> bool {
    let rest = cell.trim_start_matches(['*', '+', '-', '−', '±', '–']);
    rest.starts_with(|c: char| c.is_ascii_digit())
}

/// Tables of figures of a page that are neither between marks nor above a line with how and when they were written by
/// hand.
fn of_unknown_age(page: &str) -> Vec<String> {
    let text = read(page);
    let lines: Vec<&str> = text.lines().collect();
    let (mut at, mut marked, mut found) = (0, false, Vec::new());
    while at < lines.len() {
        let begin = at;
        marked = (marked || lines[at].starts_with("<!-- ")) && !lines[at].starts_with("<!-- /");
        while lines.get(at).is_some_and(|l| l.starts_with('|')) {
            at += 1;
        }
        let rows = lines[begin..at].iter().skip(2);
        let cells = rows.flat_map(|l| l.trim_matches('|').split('|').skip(1));
        let cells: Vec<&str> = cells.map(str::trim).filter(|c| !c.is_empty()).collect();
        let figures = cells.iter().filter(|c| is_figure(c)).count();
        let mut below = lines[at..].iter().take(2);
        let reported = below.any(|l| l.starts_with("*Written by hand, 20"));
        if figures > 0 && figures * 3 >= cells.len() && !reported && !marked {
            found.push(format!("{page}: {}", lines[begin]));
        }
        at = at.max(begin + 1);
    }
    found
}

#[test]
fn a_table_of_figures_comes_from_data_or_is_marked_as_written_by_hand() {
    let pages = pages().into_iter().filter(|page| data_of(page).is_none());
    let found: Vec<String> = pages.flat_map(|page| of_unknown_age(&page)).collect();
    assert_eq!(found, Vec::<String>::new());
}
