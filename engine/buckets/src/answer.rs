//! What a bucket answers when it does not do what it is asked, and what to do about it.

use crate::objects::Trouble;

/// It is not there; or why it could not be asked.
pub(crate) fn absent(error: &object_store::Error) -> Result<(), Trouble> {
    match error {
        object_store::Error::NotFound { .. } if !no_bucket(&plain(error)) => Ok(()),
        _ => Err(trouble(error)),
    }
}

fn no_bucket(text: &str) -> bool {
    [
        "NoSuchBucket",
        "ContainerNotFound",
        "The specified bucket does not exist",
    ]
    .iter()
    .any(|word| text.contains(word))
}

/// What went wrong, and what to do about it.
pub(crate) fn trouble(error: &object_store::Error) -> Trouble {
    use object_store::Error::{NotFound, PermissionDenied, Unauthenticated};
    let text = plain(error);
    let has = |words: &[&str]| words.iter().any(|word| text.contains(word));
    if has(&[
        "RequestTimeTooSkewed",
        "difference between the request time",
    ]) {
        return Trouble::Refused(format!(
            "its clock and the one of this machine are apart: set this machine's clock ({text})"
        ));
    }
    if has(&[
        "QuotaExceeded",
        "InsufficientStorage",
        "status code: 507",
        "XMinioStorageFull",
        "No space left",
        "os error 28",
    ]) {
        return Trouble::Refused(format!(
            "its quota is full: free space there (`cache sweep-store`) ({text})"
        ));
    }
    match error {
        NotFound { .. } if no_bucket(&text) => Trouble::Refused(format!(
            "there is no such bucket: make it first, or look at the address ({text})"
        )),
        PermissionDenied { .. } | Unauthenticated { .. } => Trouble::Refused(format!(
            "it refuses: are the credentials in the environment (AWS_ACCESS_KEY_ID, AWS_SECRET_ACCESS_KEY, …) those of somebody who may do this? ({text})"
        )),
        NotFound { .. } => Trouble::Refused(text),
        _ if has(&["status code: 4"]) && !has(&["status code: 408", "status code: 429"]) => {
            Trouble::Refused(text)
        }
        _ => Trouble::Down(text),
    }
}

/// An error with its causes on a line, without what addresses hold behind a `?`.
pub(crate) fn plain(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let more = error.to_string();
        if !text.contains(&more) {
            text += &format!(": {more}");
        }
        cause = error.source();
    }
    let cut = |word: &str| {
        word.split_once('?')
            .map_or(word.to_owned(), |(head, _)| format!("{head}?…"))
    };
    let words: Vec<String> = reported(&text).split_whitespace().map(cut).collect();
    words
        .join(" ")
        .chars()
        .filter(|c| !c.is_control())
        .take(MOST_TEXT)
        .collect()
}

/// A text with a server's XML in its own words: code and message.
fn reported(text: &str) -> String {
    let Some((before, xml)) = text
        .split_once("<?xml")
        .or_else(|| text.split_once("<Error>"))
    else {
        return text.to_owned();
    };
    let of = |tag: &str| {
        let (_, rest) = xml.split_once(&format!("<{tag}>"))?;
        rest.split_once(&format!("</{tag}>")).map(|(text, _)| text)
    };
    let answer: Vec<&str> = ["Code", "Message"].into_iter().filter_map(of).collect();
    let after = xml.rsplit_once('>').map_or("", |(_, after)| after);
    format!("{before}{}{after}", answer.join(": "))
}

const MOST_TEXT: usize = 400;

#[cfg(test)]
mod tests {
    use super::reported;

    #[test]
    fn what_a_server_answers_in_xml_is_shown_in_words() {
        let xml = "Server returned 403 Forbidden: <?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Error><Code>AccessDenied</Code>\
            <Message>Access Denied.</Message><Resource>/lab/ac</Resource><RequestId>1</RequestId></Error> (try 1)";
        assert_eq!(
            reported(xml),
            "Server returned 403 Forbidden: AccessDenied: Access Denied. (try 1)"
        );
        let bare = "status code: 404: <Error><Code>NoSuchBucket</Code></Error>";
        assert_eq!(reported(bare), "status code: 404: NoSuchBucket");
        assert_eq!(reported("plain <b> text"), "plain <b> text");
    }
}
