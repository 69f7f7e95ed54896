//! Why a verb came to nothing.

use engine::recipe::Mistakes;
use engine::store::StoreError;
use engine::strands::PlanError;
use serde_json::{Map, Value, json};
use stage::{Coded, Message, message};

stage::messages! {
    STOPPED = "cli-stopped": "stopped; run the same command to go on";
}

/// Why a verb failed: what to print (nothing if its answer has reported it), and the exit code.
pub struct Fault {
    pub(super) code: u8,
    pub(super) text: String,
    /// What `--json` has beside the text.
    pub(super) more: Map<String, Value>,
    /// What is wrong with a pipeline, place by place.
    pub(super) mistakes: Option<Box<Mistakes>>,
}

impl Fault {
    /// The input or the pipeline is wrong.
    pub fn input(text: impl ToString) -> Fault {
        Fault {
            code: 2,
            text: text.to_string(),
            more: Map::new(),
            mistakes: None,
        }
    }

    /// The input is wrong, by an error that may have a code.
    pub fn of(why: impl Coded) -> Fault {
        let why = why.message();
        match why.code() {
            "" => Fault::input(why),
            _ => Fault::coded(&why),
        }
    }

    /// The input is wrong, in a way that has a code.
    pub fn coded(why: &Message) -> Fault {
        let more = [("message".to_owned(), json!(why))];
        Fault {
            more: more.into_iter().collect(),
            ..Fault::input(why)
        }
    }

    /// The same, of a stage that failed.
    #[must_use]
    pub fn of_stage(self) -> Fault {
        Fault { code: 1, ..self }
    }

    /// The pipeline is wrong: every mistake with its place.
    pub fn mistakes(mistakes: Mistakes) -> Fault {
        let text = mistakes.to_string();
        Fault {
            mistakes: Some(Box::new(mistakes)),
            ..Fault::input(text)
        }
    }

    /// A plan cannot be used.
    pub(super) fn plan(why: PlanError) -> Fault {
        match why {
            PlanError::Store(why @ StoreError::Disk { .. }) => Fault::stage(why),
            why => Fault::input(why),
        }
    }

    /// The user asked to stop.
    pub fn stopped() -> Fault {
        Fault {
            code: 130,
            ..Fault::coded(&message!(STOPPED))
        }
    }

    /// A stage failed.
    pub fn stage(text: impl ToString) -> Fault {
        Fault::input(text).of_stage()
    }

    /// Nodes failed: each with why; `again` is the command that repeats it, if there is one.
    pub fn failed(failures: &[(&str, &Message)], again: &str) -> Fault {
        let line = |(node, why): &(&str, &Message)| format!("{node} failed: {why}");
        let mut lines: Vec<String> = failures.iter().map(line).collect();
        let one = |(node, why): &(&str, &Message)| json!({ "node": node, "why": why });
        let mut more = Map::new();
        more.insert("failures".into(), failures.iter().map(one).collect());
        if !again.is_empty() {
            lines.push(format!("to repeat it: {again}"));
            more.insert("repeat".into(), again.into());
        }
        Fault {
            more,
            ..Fault::stage(lines.join("\n"))
        }
    }

    /// What is wrong, in words.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The same in another language: what has a code by `words`, `again` before the command that repeats it.
    pub fn in_words(mut self, words: impl Fn(&Message) -> String, again: &str) -> Fault {
        let read = |why: &Value| {
            let why = serde_json::from_value::<Message>(why.clone());
            why.ok().as_ref().map(&words)
        };
        let failures = self.more.get("failures").and_then(Value::as_array);
        let lines = failures.into_iter().flatten().filter_map(|failure| {
            Some(format!(
                "{}: {}",
                failure["node"].as_str()?,
                read(&failure["why"])?
            ))
        });
        let lines: Vec<String> = lines
            .chain(self.more.get("message").and_then(read))
            .collect();
        if let Some(mistakes) = &self.mistakes {
            self.text = mistakes.as_ref().clone().in_words(words).to_string();
        } else if !lines.is_empty() {
            let repeat = self.more.get("repeat").and_then(Value::as_str);
            let repeat = repeat.map(|command| format!("{again}: {command}"));
            self.text = lines
                .into_iter()
                .chain(repeat)
                .collect::<Vec<_>>()
                .join("\n");
        }
        self
    }

    /// The exit code.
    pub fn code(&self) -> u8 {
        self.code
    }

    /// Why, as messages: of each node that failed, else of the whole.
    pub fn messages(&self) -> Vec<Message> {
        let failures = self.more.get("failures").and_then(Value::as_array);
        let whys = failures.into_iter().flatten().map(|f| &f["why"]);
        let all = whys.chain(self.more.get("message"));
        let all: Vec<Message> = all
            .filter_map(|why| serde_json::from_value(why.clone()).ok())
            .collect();
        match all.is_empty() {
            true => vec![self.text.as_str().into()],
            false => all,
        }
    }

    /// What `--json` has.
    pub fn json(self) -> Value {
        let mut answer = self.more;
        if let Some(Value::Object(mistakes)) = self.mistakes.map(|mistakes| mistakes.json()) {
            answer.extend(mistakes);
        }
        answer.insert("error".into(), self.text.into());
        answer.insert("code".into(), self.code.into());
        Value::Object(answer)
    }
}
