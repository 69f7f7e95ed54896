//! The known numbers of a capture as flags.

use super::length::{age_months, length_mm, weight_kg};
use super::stated::All;
use crate::catalog::{KNOWN, Known, Quantity};
use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches};
use command::Fault;
use stage::{Message, message};
use std::collections::BTreeMap;

stage::messages! {
    IN_METRES = "number-in-metres": "; did you mean {metres}m?";
    BEYOND = "fail-number-beyond": "{flag}: `{text}` is not from {least} to {most}{unit}{hint}";
    UNREADABLE = "fail-number": "{flag}: {why}";
    NO_NUMBER = "cli-no-number": "`{text}` is not a number";
    NOT_WHOLE = "cli-no-whole-number": "`{text}` is not a whole number";
}

/// What was given, by flag.
#[derive(Clone, Default)]
pub(super) struct Numbers(BTreeMap<&'static str, String>);

impl Numbers {
    /// Whether this flag was given.
    pub(super) fn has(&self, flag: &str) -> bool {
        self.0.contains_key(flag)
    }

    /// What was given by this flag, if it is a plain number.
    pub(super) fn plain(&self, flag: &str) -> Option<f64> {
        self.0.get(flag)?.parse().ok()
    }

    /// All that was given, as keys of `capture.toml`.
    ///
    /// # Errors
    ///
    /// The first that cannot be read.
    pub(super) fn stated(&self, all: &mut All) -> Result<(), Fault> {
        for known in &KNOWN {
            let Some(text) = self.0.get(known.flag) else {
                continue;
            };
            let flag = format!("--{}", known.flag);
            let value = value(known, text).map_err(|why| Fault::coded(&why))?;
            all.put(&flag, text, known.key, &value);
        }
        Ok(())
    }
}

/// A number in its key's unit, if it can be.
fn value(known: &Known, text: &str) -> Result<toml::Value, Message> {
    let flag = format!("--{}", known.flag);
    let value = read(known, text);
    let value = value.map_err(|why| message!(UNREADABLE, flag = &flag, why = why))?;
    let number = value.as_float().or(value.as_integer().map(|n| n as f64));
    let (least, most) = (known.least, known.most);
    let believed = |number: f64| (least..=most).contains(&number);
    if number.is_some_and(believed) {
        return Ok(value);
    }
    let bare = text.trim().parse::<f64>().ok();
    let metres = bare.filter(|n| known.of == Quantity::Length("cm") && believed(100.0 * n));
    let hint = metres.map(|n| message!(IN_METRES, metres = n.to_string()));
    let unit = match known.of.unit() {
        "" => String::new(),
        unit => format!(" {unit}"),
    };
    Err(message!(
        BEYOND,
        flag = flag,
        text = text,
        least = least.to_string(),
        most = most.to_string(),
        unit = unit,
        hint = hint.unwrap_or_default()
    ))
}

fn read(known: &Known, text: &str) -> Result<toml::Value, Message> {
    Ok(match known.of {
        Quantity::Length(unit) => {
            let per = if unit == "cm" { 10.0 } else { 1.0 };
            (length_mm(text, unit)? / per).into()
        }
        Quantity::Weight => weight_kg(text)?.into(),
        Quantity::Age => (age_months(text)? / 12.0).into(),
        Quantity::Number(_) => {
            let number = text.trim().parse::<f64>();
            number.map_err(|_| message!(NO_NUMBER, text = text))?.into()
        }
        Quantity::Count => {
            let count = text.trim().parse::<i64>();
            count.map_err(|_| message!(NOT_WHOLE, text = text))?.into()
        }
    })
}

impl FromArgMatches for Numbers {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Numbers, Error> {
        let given = |known: &Known| Some((known.flag, matches.get_one::<String>(known.flag)?));
        let given = KNOWN.iter().filter_map(given);
        Ok(Numbers(
            given.map(|(flag, text)| (flag, text.clone())).collect(),
        ))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        self.0.append(&mut Numbers::from_arg_matches(matches)?.0);
        Ok(())
    }
}

impl Args for Numbers {
    fn augment_args(command: Command) -> Command {
        let arg = |known: &Known| {
            let arg = Arg::new(known.flag).long(known.flag);
            arg.value_name(known.value)
                .help(known.help())
                .allow_negative_numbers(true)
        };
        command.args(KNOWN.iter().map(arg))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Numbers::augment_args(command)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_that_cannot_be_is_refused_with_its_limits_and_the_unit_that_may_be_meant() {
        let known = |flag: &str| KNOWN.iter().find(|known| known.flag == flag).unwrap();
        let wrong = |flag: &str, text: &str| value(known(flag), text).unwrap_err();
        assert_eq!(
            wrong("stature", "1.76"),
            "--stature: `1.76` is not from 10 to 300 cm; did you mean 1.76m?"
        );
        assert_eq!(
            wrong("weight", "560"),
            "--weight: `560` is not from 0.5 to 500 kg"
        );
        assert_eq!(wrong("views", "-1"), "--views: `-1` is not from 0 to 10000");
        assert_eq!(wrong("focal", "wide"), "--focal: `wide` is not a number");
        assert_eq!(
            value(known("stature"), "1.76m").unwrap().as_float(),
            Some(176.0)
        );
    }
}
