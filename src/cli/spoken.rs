//! The reader's language, and what is read in it: messages, and why a verb came to nothing.

use crate::words::language::{Language, Words};
use crate::words::messages::in_words;
use clap::Args;
use command::Fault;
use stage::Message;

/// The flag that chooses the language of the screen.
#[derive(Args, Clone, Default)]
pub(crate) struct Spoken {
    /// The language of the screen: en or de; that of the environment (LC_ALL, LC_MESSAGES, LANG) if not given
    #[arg(long, value_name = "LANGUAGE", value_parser = ["en", "de"])]
    lang: Option<String>,
}

impl Spoken {
    /// In this language, with lengths in centimetres.
    pub(super) fn words(&self) -> Words {
        let given = self.lang.as_deref().and_then(Language::of);
        Words {
            language: given.unwrap_or_else(Language::of_environment),
            inches: false,
        }
    }

    /// What came of a verb, and why nothing did, in that language as far as it has a code.
    pub(crate) fn read<T>(&self, done: Result<T, Fault>) -> Result<T, Fault> {
        let words = self.words();
        done.map_err(|fault| match words.language {
            Language::En => fault,
            Language::De => fault.in_words(|why| in_words(words, why), &words.text("screen-again")),
        })
    }
}

impl study::reader::Reader for Words {
    fn message(&self, message: &Message) -> String {
        in_words(*self, message)
    }

    fn number(&self, number: String) -> String {
        self.written(&number)
    }
}

/// A message of a stage. The English texts of pages speak of their fields where stages speak of flags.
pub(super) fn reported(words: Words, message: &Message) -> String {
    match words.language {
        Language::En => message.to_string(),
        Language::De => in_words(words, message),
    }
}
