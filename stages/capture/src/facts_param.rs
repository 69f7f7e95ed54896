//! Facts as a param: every value is checked as that of a `capture.toml` is.

use crate::facts::Facts;
use crate::person_keys::read_person;
use crate::rig::{RigFile, read_table};
use stage::{Message, Mistake, ParamType, Value, message};

stage::messages! {
    NO_TABLE = "rig-facts": "wants a table of capture.toml's keys, but {value} is none";
}

impl ParamType for Facts {
    const NAME: &'static str = "a table of capture.toml's keys";

    fn read(value: &Value) -> Option<Self> {
        let mut mistakes = Vec::new();
        let read = Self::read_within("", value, &mut mistakes)?;
        mistakes.is_empty().then_some(read)
    }

    /// Every value is checked here; what is missing may be in the file.
    fn read_within(name: &str, value: &Value, mistakes: &mut Vec<Mistake>) -> Option<Self> {
        let mut wrong = |what: Message| {
            let name = name.to_owned();
            mistakes.push(Mistake { name, what });
        };
        let Value::Table(given) = value else {
            wrong(message!(NO_TABLE, value = value.to_string()));
            return None;
        };
        let facts = Facts(given.clone());
        match read_table(facts.table()) {
            Ok(RigFile { unknown, .. }) => {
                unknown.into_iter().for_each(&mut wrong);
                let person = read_person(facts.table());
                person.err().into_iter().for_each(|e| wrong(e.what));
            }
            Err(error) if error.missing => {}
            Err(error) => wrong(error.what),
        }
        Some(facts)
    }

    fn value(&self) -> Value {
        Value::Table(self.0.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rig::read_rig;

    fn facts(text: &str) -> Value {
        fn value(v: &toml::Value) -> Value {
            match v {
                toml::Value::Table(t) => {
                    Value::Table(t.iter().map(|(k, v)| (k.clone(), value(v))).collect())
                }
                toml::Value::Array(l) => Value::List(l.iter().map(value).collect()),
                toml::Value::Float(x) => Value::Float(*x),
                toml::Value::Integer(i) => Value::Int(*i),
                toml::Value::String(t) => Value::Text(t.clone()),
                other => panic!("{other}"),
            }
        }
        value(&toml::Value::Table(text.parse().unwrap()))
    }

    #[test]
    fn what_is_given_wins_over_the_file_and_the_rest_stays() {
        let file = "step_deg = 20.0\n[subject]\nheight_cm = 165\n[camera]\nfocal_px = 900\n\
                    [reference]\nkind = \"subject_height\"\nlength_mm = 1650";
        let given = facts("[subject]\nheight_cm = 178\n[camera]\nfocal_35mm = 26");
        let rig = read_rig(file, &Facts::read(&given).unwrap()).unwrap().rig;
        assert_eq!(rig.stature_mm, Some(1780.0));
        assert_eq!((rig.focal_35mm, rig.focal_px), (Some(26.0), None));
        assert_eq!(rig.reference, None, "the file's reference is the stature");
        proof::near(rig.step.unwrap().to_degrees(), 20.0, 1e-12);
    }

    #[test]
    fn what_is_wrong_is_refused_before_anything_is_read() {
        let mistakes_of = |text: &str| {
            let mut mistakes = Vec::new();
            Facts::read_within("facts", &facts(text), &mut mistakes);
            mistakes
        };
        for (text, part) in [
            (
                "subject.height_cm = 1780",
                "`subject.height_cm` wants a number from 10 to 300",
            ),
            ("subject.hight_cm = 178", "did you mean `height_cm`"),
            ("stepdeg = 20", "did you mean `step_deg`"),
            (
                "subject.sex = \"f\"",
                "`subject.sex` wants \"female\" or \"male\"",
            ),
        ] {
            let mistakes = mistakes_of(text);
            assert_eq!(mistakes.len(), 1, "{mistakes:?}");
            assert!(mistakes[0].what.contains(part), "{mistakes:?}");
        }
        // The rest of a mat may be in the file.
        assert_eq!(mistakes_of("mat.ring_radius_mm = 187"), []);
    }
}
