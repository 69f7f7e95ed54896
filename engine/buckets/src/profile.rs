//! A profile of AWS's own files: `~/.aws/credentials` and `~/.aws/config`.
//!
//! The environment counts first. Read are keys that are written down, the region and the endpoint.
//! Other ways to sign on are refused by name: nothing of a file is in any text.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// What is read of a profile.
#[derive(Default, PartialEq, Eq)]
pub(crate) struct Profile {
    pub(crate) keys: Option<Keys>,
    pub(crate) region: Option<String>,
    pub(crate) endpoint: Option<String>,
}

/// Who asks.
#[derive(PartialEq, Eq)]
pub(crate) struct Keys {
    pub(crate) id: String,
    pub(crate) secret: String,
    pub(crate) token: Option<String>,
}

/// Ways to sign on that are not ours, and what they are.
const REFUSED: [(&str, &str); 7] = [
    ("role_arn", "assumes a role"),
    ("sso_session", "signs on by SSO"),
    ("sso_start_url", "signs on by SSO"),
    ("login_session", "signs on by a browser"),
    ("credential_process", "asks a program for its keys"),
    ("credential_source", "takes its keys from elsewhere"),
    (
        "web_identity_token_file",
        "signs on by a token of somebody else",
    ),
];

/// Variables that decide who asks: then no keys of a file count.
const DECIDED: [&str; 5] = [
    "AWS_ACCESS_KEY_ID",
    "AWS_WEB_IDENTITY_TOKEN_FILE",
    "AWS_CONTAINER_CREDENTIALS_RELATIVE_URI",
    "AWS_CONTAINER_CREDENTIALS_FULL_URI",
    "AWS_SKIP_SIGNATURE",
];

/// No file of profiles is larger. \[bytes\]
const MOST: u64 = 1 << 20;

type Section = BTreeMap<String, String>;

/// The profile that `AWS_PROFILE` names, else `default`; nothing where there is none.
///
/// # Errors
///
/// There is no such profile, a file cannot be read, or its profile signs on in a way that is not ours.
pub(crate) fn chosen(env: &dyn Fn(&str) -> Option<String>) -> Result<Profile, String> {
    let env = |name: &str| env(name).filter(|value| !value.is_empty());
    let named = env("AWS_PROFILE").or_else(|| env("AWS_DEFAULT_PROFILE"));
    let name = named.as_deref().unwrap_or("default");
    let home = env("HOME")
        .or_else(|| env("USERPROFILE"))
        .map(PathBuf::from);
    let file = |variable: &str, own: &str| {
        let own = || home.as_ref().map(|home| home.join(".aws").join(own));
        env(variable).map(PathBuf::from).or_else(own)
    };
    let config = section(
        file("AWS_CONFIG_FILE", "config"),
        &[&format!("profile {name}"), name],
    )?;
    let credentials = section(file("AWS_SHARED_CREDENTIALS_FILE", "credentials"), &[name])?;
    if named.is_some() && config.is_none() && credentials.is_none() {
        return Err(format!(
            "AWS_PROFILE={name}: neither ~/.aws/credentials nor ~/.aws/config has such a profile"
        ));
    }
    let (config, credentials) = (config.unwrap_or_default(), credentials.unwrap_or_default());
    let of = |key: &str| credentials.get(key).or(config.get(key)).cloned();
    let answer = DECIDED.iter().any(|variable| env(variable).is_some());
    Ok(Profile {
        keys: if answer { None } else { keys(name, &of)? },
        region: config.get("region").cloned(),
        endpoint: config.get("endpoint_url").cloned(),
    })
}

/// The keys that are written down.
fn keys(name: &str, of: &dyn Fn(&str) -> Option<String>) -> Result<Option<Keys>, String> {
    if let Some((key, what)) = REFUSED.iter().find(|(key, _)| of(key).is_some()) {
        return Err(format!(
            "the profile {name} of ~/.aws {what} ({key}), which this program does not do: put keys into the \
             environment, such as `aws configure export-credentials --profile {name} --format env` prints"
        ));
    }
    let half = |missing: &str| format!("the profile {name} of ~/.aws has no {missing}");
    match (of("aws_access_key_id"), of("aws_secret_access_key")) {
        (None, None) => Ok(None),
        (Some(id), Some(secret)) => Ok(Some(Keys {
            id,
            secret,
            token: of("aws_session_token"),
        })),
        (None, _) => Err(half("aws_access_key_id")),
        (_, None) => Err(half("aws_secret_access_key")),
    }
}

/// The first section of one of these names, if there is the file and the section.
fn section(file: Option<PathBuf>, names: &[&str]) -> Result<Option<Section>, String> {
    let Some(file) = file else { return Ok(None) };
    let Some(text) = read(&file)? else {
        return Ok(None);
    };
    let mut sections: BTreeMap<String, Section> = BTreeMap::new();
    let mut here: Option<String> = None;
    for (at, line) in text.lines().enumerate() {
        let plain = line.trim();
        let wrong = |what: &str| format!("{}, line {}: {what}", file.display(), at + 1);
        if plain.is_empty() || plain.starts_with(['#', ';']) {
            continue;
        }
        if let Some(rest) = plain.strip_prefix('[') {
            let name = rest
                .split(']')
                .next()
                .filter(|name| name.len() < rest.len());
            let name = name.ok_or_else(|| wrong("a section ends with `]`"))?;
            let words: Vec<&str> = name.split_whitespace().collect();
            let name = words.join(" ");
            sections.entry(name.clone()).or_default();
            here = Some(name);
            continue;
        }
        // What is further in belongs to a key above that is none of ours.
        if line.starts_with([' ', '\t']) {
            continue;
        }
        let (key, value) = plain
            .split_once('=')
            .ok_or_else(|| wrong("write KEY = VALUE"))?;
        let here = here.as_ref().ok_or_else(|| wrong("it is in no section"))?;
        if let Some(section) = sections.get_mut(here) {
            section.insert(key.trim().to_lowercase(), value.trim().to_owned());
        }
    }
    Ok(names.iter().find_map(|name| sections.remove(*name)))
}

/// The text of a file, if there is one.
fn read(file: &Path) -> Result<Option<String>, String> {
    let wrong = |why: &dyn Display| format!("{}: {why}", file.display());
    match std::fs::metadata(file) {
        Err(why) if why.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(why) => return Err(wrong(&why)),
        Ok(meta) if meta.len() > MOST => return Err(wrong(&"is larger than any such file")),
        Ok(_) => {}
    }
    let text = std::fs::read_to_string(file);
    text.map(Some).map_err(|why| wrong(&why))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What comes of files and variables.
    fn of(credentials: &str, config: &str, env: &[(&str, &str)]) -> Result<Profile, String> {
        let home = tempfile::tempdir().unwrap();
        let aws = home.path().join(".aws");
        std::fs::create_dir(&aws).unwrap();
        for (name, text) in [("credentials", credentials), ("config", config)] {
            if !text.is_empty() {
                std::fs::write(aws.join(name), text).unwrap();
            }
        }
        chosen(&|name| match name {
            "HOME" => Some(home.path().display().to_string()),
            _ => env
                .iter()
                .find(|(n, _)| *n == name)
                .map(|(_, v)| (*v).to_owned()),
        })
    }

    const CREDENTIALS: &str = "# of the lab\n[default]\naws_access_key_id = one\naws_secret_access_key=s1\n\n\
        [lab]\naws_access_key_id=two\naws_secret_access_key = s2==\naws_session_token = t\n";
    const CONFIG: &str = "[default]\nregion = eu-west-1\n[profile lab]\nregion=eu-central-1\n\
        endpoint_url = https://s3.lab.example\ns3 =\n  addressing_style = path\n";

    #[test]
    fn a_profile_tells_keys_region_and_endpoint_and_the_environment_counts_first() {
        let plain = of(CREDENTIALS, CONFIG, &[]).ok().unwrap();
        assert_eq!(plain.keys.unwrap().id, "one");
        assert_eq!(
            (plain.region.as_deref(), plain.endpoint),
            (Some("eu-west-1"), None)
        );
        let lab = of(CREDENTIALS, CONFIG, &[("AWS_PROFILE", "lab")])
            .ok()
            .unwrap();
        let keys = lab.keys.unwrap();
        assert_eq!(
            (&*keys.id, &*keys.secret, keys.token.as_deref()),
            ("two", "s2==", Some("t"))
        );
        assert_eq!(lab.region.as_deref(), Some("eu-central-1"));
        assert_eq!(lab.endpoint.as_deref(), Some("https://s3.lab.example"));
        let answer = [("AWS_PROFILE", "lab"), ("AWS_ACCESS_KEY_ID", "mine")];
        let answer = of(CREDENTIALS, CONFIG, &answer).ok().unwrap();
        assert!(answer.keys.is_none() && answer.region.is_some());
        assert!(of("", "", &[]).ok().unwrap() == Profile::default());
    }

    #[test]
    fn what_cannot_be_done_is_refused_by_name_and_without_secrets() {
        let lab = [("AWS_PROFILE", "lab")];
        for (credentials, config, part) in [
            ("", "", "neither ~/.aws/credentials nor ~/.aws/config"),
            (
                "",
                "[profile lab]\nsso_session = secret\n",
                "signs on by SSO (sso_session)",
            ),
            (
                CREDENTIALS,
                "[profile lab]\nrole_arn = secret\n",
                "assumes a role (role_arn)",
            ),
            (
                "",
                "[profile lab]\ncredential_process = secret\n",
                "asks a program",
            ),
            (
                "[lab]\naws_access_key_id = secret\n",
                "",
                "has no aws_secret_access_key",
            ),
            ("[lab\n", "", "line 1: a section ends"),
            ("[lab]\nsecret\n", "", "line 2: write KEY = VALUE"),
            ("secret = secret\n", "", "line 1: it is in no section"),
        ] {
            let why = of(credentials, config, &lab).err().unwrap();
            assert!(why.contains(part) && !why.contains("= secret"), "{why}");
        }
    }
}
