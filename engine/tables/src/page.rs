//! A sweep as one page: each number over each param, maps, all of them side by side, what differs, its tables.

use super::cells::{cell, columns, names, short, trouble, values};
use super::given::{pairs_head, pairs_row, spread_cells};
use super::html;
use super::paired::{Pairs, of_variants};
use super::plot::{Plot, References, plots};
use super::reported::Reported;
use super::spread::{Group, spread};
use super::table::{as_csv, summary};
use engine::sweep::Row;
use serde_json::json;

const SCRIPT: &str = include_str!("page.js");

/// A sweep as it is shown: its page, and each plot with the numbers that it shows, as files.
pub struct Shown {
    /// The page.
    pub page: String,
    /// Names and texts of the plots' files: SVG, and CSV beside it.
    pub plots: Vec<(String, String)>,
}

/// What is behind a point.
#[derive(Debug, Clone, Default)]
pub struct Behind {
    /// Commands that give it.
    pub commands: Vec<String>,
    /// Where it is: a node, what the link gives, the address.
    pub links: Vec<(String, String, String)>,
}

impl Behind {
    /// As a cell of a table.
    fn cell(&self) -> String {
        if self.commands.is_empty() && self.links.is_empty() {
            return "<td></td>".to_owned();
        }
        let mut list = String::new();
        for node in self.links.chunk_by(|a, b| a.0 == b.0) {
            let link = |(_, word, address): &(String, String, String)| {
                format!(
                    " <a href=\"{}\">{}</a>",
                    html::escaped(address),
                    html::escaped(word)
                )
            };
            let links: String = node.iter().map(link).collect();
            list += &format!("<li>{}:{links}</li>", html::escaped(&node[0].0));
        }
        format!(
            "<td><details><summary>more</summary><ul>{list}</ul><pre>{}</pre></details></td>",
            html::escaped(&self.commands.join("\n"))
        )
    }
}

/// The page and its plots; `behind` is what is behind a row.
pub fn page(
    name: &str,
    about: &str,
    rows: &[Row],
    references: &References<'_>,
    behind: &dyn Fn(&Row) -> Behind,
) -> Shown {
    let reported: Vec<Reported> = rows.iter().map(Reported::of).collect();
    let repeated = reported.iter().any(|t| t.replicate.is_some());
    let groups = spread(&reported);
    let plots = plots(&groups, references);
    let title = if about.is_empty() { name } else { about };
    let mut body = format!(
        "<h1>{}</h1>\n<p class=\"soft\">sweep <code>{}</code>; {}</p>\n",
        html::escaped(title),
        html::escaped(name),
        html::escaped(&summary(rows)),
    );
    let (beside, lines): (Vec<&Plot>, Vec<&Plot>) =
        plots.iter().partition(|p| p.file == "parallel");
    let drawn: String = lines.iter().map(|p| figure(p)).collect();
    let what = match (drawn.is_empty(), repeated) {
        (true, _) => "Nothing varies, or no metric was given.".to_owned(),
        (_, true) => "Dots are means of replicates, bars what holds them nineteen times in twenty."
            .to_owned(),
        _ => still(&groups),
    };
    body += &format!(
        "<section><h2>Each number over each param</h2><p id=\"legend\" class=\"soft\">{}</p><div id=\"view\" class=\"plots\">{drawn}</div></section>\n",
        html::escaped(&what)
    );
    for plot in beside {
        body += &format!(
            "<section><h2>All side by side</h2><div id=\"parallel\">{}</div></section>\n",
            inside(plot)
        );
    }
    if repeated {
        body += &section("Replicates", &spread_table(&groups));
        for ([first, second], pairs) in of_variants(&reported) {
            body += &pairs_section(&first, &second, &pairs);
        }
    }
    body += &section("All points", &points_table(rows, behind, repeated));
    let files = |p: &Plot| {
        let table = as_csv(p.data.clone());
        [
            (format!("{}.svg", p.file), p.svg.clone()),
            (format!("{}.csv", p.file), table),
        ]
    };
    Shown {
        page: html::page(title, &body, &json!({}), SCRIPT),
        plots: plots.iter().flat_map(files).collect(),
    }
}

/// Sides against each other as a page: names of both and their pairs.
pub fn pairs_page(all: &[(&str, &str, &[Pairs])]) -> String {
    let title = all
        .first()
        .map_or(String::new(), |(first, _, _)| format!("Against {first}"));
    let sections = all
        .iter()
        .map(|(first, second, pairs)| pairs_section(first, second, pairs));
    let body: String = sections.collect();
    html::page(
        &title,
        &format!("<h1>{}</h1>\n{body}", html::escaped(&title)),
        &json!({}),
        "",
    )
}

fn pairs_section(first: &str, second: &str, pairs: &[Pairs]) -> String {
    let rows: Vec<Vec<String>> = pairs.iter().map(pairs_row).collect();
    let table = html::table("", &pairs_head(first, second), &rows);
    section(
        &format!("{second} less {first}, replicate by replicate"),
        &table,
    )
}

fn section(title: &str, body: &str) -> String {
    format!(
        "<section><h2>{}</h2>{body}</section>\n",
        html::escaped(title)
    )
}

/// A drawing within a page, which names no address.
fn inside(plot: &Plot) -> String {
    plot.svg
        .replace(" xmlns=\"http://www.w3.org/2000/svg\"", "")
}

fn figure(plot: &Plot) -> String {
    let one = |(name, color): &(String, &str)| {
        format!(
            "<span><i style=\"background:{color}\"></i>{}</span>",
            html::escaped(name)
        )
    };
    let legend: String = plot.legend.iter().map(one).collect();
    let legend = match legend.is_empty() {
        true => legend,
        false => format!("<div class=\"legend\">{legend}</div>"),
    };
    format!(
        "<figure><figcaption>{}</figcaption>{}{legend}</figure>\n",
        html::escaped(&plot.title),
        inside(plot)
    )
}

/// What is the same at every point that has it, and so not drawn.
fn still(groups: &[Group]) -> String {
    let mut same = Vec::new();
    let spreads = groups.first().map_or(&[][..], |g| &g.spreads);
    for (k, spread) in spreads.iter().enumerate().filter(|_| groups.len() > 1) {
        let mut reported = groups.iter().filter_map(|g| g.spreads[k].mean);
        let Some(value) = reported.next() else {
            continue;
        };
        if reported.all(|v| v == value) {
            let unit = match spread.unit.is_empty() {
                true => String::new(),
                false => format!(" [{}]", spread.unit),
            };
            same.push(format!("{}{unit} {}", spread.name, short(value)));
        }
    }
    match same.is_empty() {
        true => String::new(),
        false => format!(
            "The same at every point, so not drawn: {}.",
            same.join("; ")
        ),
    }
}

fn spread_table(groups: &[Group]) -> String {
    let (mut head, rows) = spread_cells(groups);
    head.push("points".to_owned());
    let place = |(n, place): (usize, &usize)| format!("<a href=\"#all-{place}\">{}</a> ", n + 1);
    let places = |i: usize| {
        let links: String = groups[i].places.iter().enumerate().map(place).collect();
        format!("<td>{links}</td>")
    };
    match rows.is_empty() {
        true => String::new(),
        false => html::table_with("points", &head, &rows, &places),
    }
}

fn points_table(rows: &[Row], behind: &dyn Fn(&Row) -> Behind, repeated: bool) -> String {
    let columns = columns(rows);
    let mut head = names(rows);
    let units = columns.iter().map(|(name, unit)| match unit.is_empty() {
        true => name.clone(),
        false => format!("{name} [{unit}]"),
    });
    head.extend(units);
    head.extend(["made", "time", "trouble", "behind it"].map(String::from));
    let cells = |row: &Row| {
        let mut cells = values(row);
        cells.extend(
            columns
                .iter()
                .map(|(n, _)| cell(row, n).map_or(String::new(), short)),
        );
        cells.extend([row.made.to_string(), format!("{:.1} s", row.seconds)]);
        cells.push(trouble(row).unwrap_or_default());
        cells
    };
    let more = |i: usize| behind(&rows[i]).cell();
    let id = if repeated { "all" } else { "points" };
    let cells: Vec<Vec<String>> = rows.iter().map(cells).collect();
    html::table_with(id, &head, &cells, &more)
}
