//! What is known of a capture, as a form.

use super::super::facts::{self, Facts, Sex};
use super::super::record::Record;
use crate::catalog::{Known, Quantity};
use crate::words::language::Words;
use maud::{Markup, html};
use std::collections::{BTreeMap, HashMap};

/// What was typed, if something of it is wrong: nothing has to be typed again.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Slips {
    /// Why, by field.
    pub(crate) why: BTreeMap<&'static str, String>,
    /// All that was typed, over what is known.
    pub(crate) typed: HashMap<String, String>,
    /// Whether nothing is wrong but that other windows changed the same fields meanwhile.
    pub(crate) stale: bool,
}

/// What each field of the form shows.
pub(crate) fn shown(words: Words, record: &Record) -> BTreeMap<&'static str, String> {
    let facts = &record.facts;
    let tick = |set: bool| if set { "yes" } else { "" }.to_owned();
    let numbers = fields(words, facts).into_iter();
    let mut all: BTreeMap<_, _> = numbers.map(|f| (f.name, f.value)).collect();
    all.insert("sex", facts.sex.map_or("", Sex::word).to_owned());
    let plate = record.plate().map(|(number, _)| number.to_string());
    all.insert("plate", plate.unwrap_or_default());
    all.insert("walk", tick(facts.walk));
    all.insert("quick", tick(facts.quick));
    all
}

/// A field of a number: its name, its content, its unit.
struct Field {
    name: &'static str,
    value: String,
    unit: &'static str,
}

fn fields(words: Words, facts: &Facts) -> Vec<Field> {
    let number = |n: Option<f64>| n.map_or(String::new(), |n| words.field(n));
    let field = |(name, known): (&'static str, &Known)| {
        let given = facts.numbers.get(name);
        let (value, unit) = match known.of {
            Quantity::Length("cm") => {
                let unit = if words.inches { "in" } else { "cm" };
                (
                    given.map_or(String::new(), |cm| words.field_length(cm)),
                    unit,
                )
            }
            // The label of an age has its unit.
            Quantity::Age => (number(given), ""),
            of => (number(given), of.unit()),
        };
        Field { name, value, unit }
    };
    let steps = Field {
        name: "steps",
        value: number(facts.steps.map(|s| s as f64)),
        unit: "",
    };
    facts::fields().map(field).chain([steps]).collect()
}

/// The form.
pub(crate) fn form(words: Words, at: &str, record: &Record, slips: &Slips, busy: bool) -> Markup {
    let facts = &record.facts;
    let ticked = |name: &str, kept: bool| match slips.why.is_empty() {
        true => kept,
        false => slips.typed.contains_key(name),
    };
    let plate = match slips.why.is_empty() {
        true => record.plate().map(|(number, _)| number),
        false => slips.typed.get("plate").and_then(|text| text.parse().ok()),
    };
    let typed = slips.typed.get("sex").map(String::as_str);
    let sex = match slips.why.is_empty() {
        true => facts.sex,
        false => Sex::ALL.into_iter().find(|s| Some(s.word()) == typed),
    };
    html! {
        section aria-labelledby="facts-title" {
            h2 #facts-title { (words.text("facts-title")) }
            p { (words.text("facts-about")) }
            form method="post" action=(format!("{at}/facts")) {
                // What the fields showed, so that another window's changes are not undone.
                input type="hidden" name="unit" value=(words.unit());
                @for (name, now) in shown(words, record) {
                    input type="hidden" name=(format!("was_{name}")) value=(now);
                }
                fieldset disabled[busy] {
                    legend .hidden { (words.text("facts-title")) }
                    div .fields {
                        @for field in fields(words, facts) { (number(words, &field, slips)) }
                        label { span { (words.text("fact-sex")) }
                            select name="sex" {
                                option value="" selected[sex.is_none()] { (words.text("fact-sex-none")) }
                                @for one in Sex::ALL {
                                    option value=(one.word()) selected[sex == Some(one)] { (words.text(&format!("fact-sex-{}", one.word()))) }
                                }
                            }
                            small .soft { (words.text("hint-sex")) }
                            (slip(slips, "sex"))
                        }
                        label { span { (words.text("fact-plate")) }
                            select name="plate" {
                                option value="" selected[plate.is_none()] { (words.text("fact-plate-none")) }
                                @for (number, kept) in record.files.iter().filter(|(_, k)| !k.video) {
                                    option value=(number) selected[plate == Some(*number)] {
                                        (number) ": " (kept.name)
                                    }
                                }
                            }
                            small .soft { (words.text("hint-plate")) }
                            (slip(slips, "plate"))
                        }
                    }
                    div .choices {
                        label { input type="checkbox" name="walk" value="yes" checked[ticked("walk", facts.walk)]; (words.text("fact-walk")) (slip(slips, "walk")) }
                        label { input type="checkbox" name="quick" value="yes" checked[ticked("quick", facts.quick)]; (words.text("fact-quick")) (slip(slips, "quick")) }
                    }
                    div .bar { button type="submit" { (words.text("facts-keep")) } }
                }
            }
        }
    }
}

/// What is wrong with a field that is no number.
fn slip(slips: &Slips, name: &str) -> Markup {
    html! { @if let Some(why) = slips.why.get(name) { small .bad { (why) } } }
}

fn number(words: Words, field: &Field, slips: &Slips) -> Markup {
    let slip = slips.why.get(field.name);
    let value = slips.typed.get(field.name).unwrap_or(&field.value);
    let (about, wrong) = (
        format!("hint-{}", field.name),
        format!("slip-{}", field.name),
    );
    let describes = if slip.is_some() {
        format!("{about} {wrong}")
    } else {
        about.clone()
    };
    html! {
        label {
            span { (words.text(&format!("fact-{}", field.name.replace('_', "-")))) }
            span .unit {
                input type="text" inputmode="decimal" autocomplete="off" name=(field.name) value=(value)
                    aria-describedby=(describes) aria-invalid[slip.is_some()];
                @if !field.unit.is_empty() { span { (field.unit) } }
            }
            small .soft id=(about) { (words.text(&format!("hint-{}", field.name.replace('_', "-")))) }
            @if let Some(why) = slip { small .bad id=(wrong) { (why) } }
        }
    }
}
