//! Why a verb came to nothing.

use engine::recipe::Mistakes;
use serde_json::{Map, Value, json};

/// Why a verb came to nothing: what to print (nothing if its answer has said it), and the exit code.
pub struct Fault {
    pub(super) code: u8,
    pub(super) text: String,
    /// What `--json` tells beside the text.
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

    /// The pipeline is wrong: every mistake with its place.
    pub fn mistakes(mistakes: Mistakes) -> Fault {
        let text = mistakes.to_string();
        Fault {
            mistakes: Some(Box::new(mistakes)),
            ..Fault::input(text)
        }
    }

    /// The user asked to stop.
    pub fn stopped() -> Fault {
        Fault {
            code: 130,
            ..Fault::input("stopped; run the same command to go on")
        }
    }

    /// A stage failed.
    pub fn stage(text: impl ToString) -> Fault {
        Fault {
            code: 1,
            ..Fault::input(text)
        }
    }

    /// Nodes failed: each with why; `again` is the command that repeats it, if there is one.
    pub fn failed(failures: &[(&str, &str)], again: &str) -> Fault {
        let line = |(node, why): &(&str, &str)| format!("{node} failed: {why}");
        let mut lines: Vec<String> = failures.iter().map(line).collect();
        let one = |(node, why): &(&str, &str)| json!({ "node": node, "why": why });
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

    /// The exit code.
    pub fn code(&self) -> u8 {
        self.code
    }

    /// What `--json` tells.
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
