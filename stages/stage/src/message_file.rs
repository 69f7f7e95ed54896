//! Messages in files: in JSON a sentence as it is, or its code, fields and sentence; in artifacts the same one after the other.

use crate::message::Parts;
use crate::{Field, Message};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::collections::BTreeMap;

/// A message in JSON.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    Plain(String),
    Coded {
        code: String,
        text: String,
        #[serde(default)]
        fields: BTreeMap<String, InPlace>,
    },
}

/// A field in JSON.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum InPlace {
    Text(String),
    List(Vec<InPlace>),
    Number {
        #[serde(serialize_with = "number")]
        value: f64,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        digits: Option<u8>,
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        signed: bool,
        #[serde(default, skip_serializing_if = "String::is_empty")]
        unit: String,
    },
    Message(Box<Written>),
}

/// What is whole is written without a point.
fn number<S: Serializer>(value: &f64, to: S) -> Result<S::Ok, S::Error> {
    match value.fract() == 0.0 && value.abs() < 1e15 {
        true => to.serialize_i64(*value as i64),
        false => to.serialize_f64(*value),
    }
}

impl Serialize for Message {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match to.is_human_readable() {
            true => Written::from(self.clone()).serialize(to),
            false => self.0.serialize(to),
        }
    }
}

impl<'de> Deserialize<'de> for Message {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Message, D::Error> {
        match from.is_human_readable() {
            true => Written::deserialize(from).map(Message::from),
            false => Parts::deserialize(from).map(|parts| Message(Box::new(parts))),
        }
    }
}

impl From<Message> for Written {
    fn from(message: Message) -> Written {
        let Parts { code, fields, text } = *message.0;
        match code.is_empty() {
            true => Written::Plain(text),
            false => Written::Coded {
                code,
                text,
                fields: fields.into_iter().map(|(n, f)| (n, f.into())).collect(),
            },
        }
    }
}

impl From<Written> for Message {
    fn from(written: Written) -> Message {
        match written {
            Written::Plain(text) => Message::from(text),
            Written::Coded { code, text, fields } => {
                let fields = fields.into_iter().map(|(n, f)| (n, f.into()));
                Message::of(&code, fields.collect(), text)
            }
        }
    }
}

impl From<Field> for InPlace {
    fn from(field: Field) -> InPlace {
        match field {
            Field::Number {
                value,
                digits,
                signed,
                unit,
            } => InPlace::Number {
                value,
                digits,
                signed,
                unit,
            },
            Field::Text(text) => InPlace::Text(text),
            Field::List(all) => InPlace::List(all.into_iter().map(Into::into).collect()),
            Field::Message(message) => InPlace::Message(Box::new((*message).into())),
        }
    }
}

impl From<InPlace> for Field {
    fn from(written: InPlace) -> Field {
        match written {
            InPlace::Number {
                value,
                digits,
                signed,
                unit,
            } => Field::Number {
                value,
                digits,
                signed,
                unit,
            },
            InPlace::Text(text) => Field::Text(text),
            InPlace::List(all) => Field::List(all.into_iter().map(Into::into).collect()),
            InPlace::Message(message) => Field::Message(Box::new((*message).into())),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Message, message};
    use serde_json::json;

    crate::messages! {
        PARTS = "warn-parts": "{count} {count|part|parts} on {names}, {share:.1 %} of it, {by:+.0 mm}, {off:.0 °}";
        WHOLE = "warn-whole": "{why}: {what}";
    }

    fn parts() -> Message {
        let names = ["a.jpg", "b.jpg"].map(String::from);
        message!(
            PARTS,
            count = 1usize,
            names = names.as_slice(),
            share = 2.25,
            by = 3.4,
            off = 7.6
        )
    }

    #[test]
    fn a_sentence_has_its_fields_as_the_template_writes_them() {
        assert_eq!(
            MESSAGES
                .iter()
                .map(|kind| kind.fields().len())
                .collect::<Vec<_>>(),
            [5, 2]
        );
        let text = "1 part on a.jpg, b.jpg, 2.2 % of it, +3 mm, 8°";
        assert_eq!(parts().as_str(), text);
        let about = parts().of_what("front").with_remedy("look at it");
        assert_eq!(about.as_str(), format!("front: {text}; look at it"));
        let plain = Message::from("so so").of_what("front");
        assert_eq!((plain.as_str(), plain.code()), ("front: so so", ""));
    }

    #[test]
    fn messages_come_back_from_json_and_from_artifacts_and_old_sentences_are_read() {
        let whole = message!(WHOLE, why = parts(), what = f64::NAN).of_what("x");
        for message in [parts(), whole, "so so".into()] {
            let written = serde_json::to_string(&message).unwrap();
            assert_eq!(
                serde_json::from_str::<Message>(&written).unwrap(),
                message,
                "{written}"
            );
            let config = bincode::config::standard();
            let packed = bincode::serde::encode_to_vec(&message, config).unwrap();
            let (back, _): (Message, usize) =
                bincode::serde::decode_from_slice(&packed, config).unwrap();
            assert_eq!(back, message);
        }
        assert_eq!(json!(Message::from("so so")), json!("so so"));
        let fields = &json!(parts())["fields"];
        assert_eq!(fields["count"], json!({ "value": 1 }));
        let share = json!({ "value": 2.2, "digits": 1, "unit": "%" });
        assert_eq!(fields["share"], share);
    }
}
