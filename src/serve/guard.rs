//! Who may ask: only whoever holds the token, of this machine's own name, and no other page.
//!
//! The token is in the address that the program prints; the browser trades it for a cookie.
//! A page of elsewhere cannot read the cookie, is not sent it (`SameSite=Strict`), and is refused by what
//! browsers send of a request's origin. A name of elsewhere that leads here (DNS rebinding) is refused by `Host`.

use std::io::Read;

/// A request's origin, as it names it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Asked<'a> {
    /// Whether it changes nothing (GET, HEAD).
    pub(super) reads: bool,
    /// `Host`.
    pub(super) host: Option<&'a str>,
    /// `Origin`.
    pub(super) origin: Option<&'a str>,
    /// `Sec-Fetch-Site`.
    pub(super) site: Option<&'a str>,
    /// `Cookie`.
    pub(super) cookie: Option<&'a str>,
    /// `Authorization`.
    pub(super) authorization: Option<&'a str>,
}

/// Why a request is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub(super) enum Refused {
    /// It was sent to another name.
    #[error(
        "this name leads to tailor, but it is not its own: open the address that the program printed"
    )]
    Host,
    /// It was sent by a page of elsewhere.
    #[error("another page asked for this: only tailor's own pages may")]
    Origin,
    /// Without the token.
    #[error(
        "this address is not known here: open the one that the program printed, with its token"
    )]
    Token,
}

/// Who may ask.
#[derive(Debug, Clone)]
pub(super) struct Guard {
    token: String,
    hosts: Vec<String>,
    cookie: String,
}

impl Guard {
    /// For a server of this port under these names.
    pub(super) fn new(token: String, names: &[String], port: u16) -> Guard {
        Guard {
            token,
            hosts: names.iter().map(|name| format!("{name}:{port}")).collect(),
            // Cookies of one name are shared by all ports of a machine.
            cookie: format!("tailor-{port}"),
        }
    }

    /// Whether a text is the token; takes as long whatever it is.
    pub(super) fn is_token(&self, text: &str) -> bool {
        let (a, b) = (self.token.as_bytes(), text.as_bytes());
        a.len() == b.len() && a.iter().zip(b).fold(0, |all, (x, y)| all | (x ^ y)) == 0
    }

    /// The cookie that carries the token.
    pub(super) fn set_cookie(&self) -> String {
        format!(
            "{}={}; Path=/; HttpOnly; SameSite=Strict",
            self.cookie, self.token
        )
    }

    /// Whether a request comes from here, with the token or without it.
    ///
    /// # Errors
    ///
    /// It was sent to another name, or by another page.
    pub(super) fn is_from_here(&self, asked: &Asked<'_>) -> Result<(), Refused> {
        let host = asked.host.filter(|h| self.hosts.iter().any(|own| own == h));
        let host = host.ok_or(Refused::Host)?;
        let own = |origin: &str| origin.strip_prefix("http://") == Some(host);
        match (asked.origin, asked.site) {
            (Some(origin), _) if !own(origin) => Err(Refused::Origin),
            (_, Some("same-origin")) => Ok(()),
            // Somebody typed the address, or opened it from another program.
            (_, Some("none")) if asked.reads => Ok(()),
            (_, Some(_)) => Err(Refused::Origin),
            (Some(_), None) => Ok(()),
            // No browser: it names no origin, and has no cookies of other sites.
            (None, None) if asked.reads || asked.authorization.is_some() => Ok(()),
            (None, None) => Err(Refused::Origin),
        }
    }

    /// Whether a request may be answered.
    ///
    /// # Errors
    ///
    /// As [`Guard::is_from_here`], or without the token.
    pub(super) fn admits(&self, asked: &Asked<'_>) -> Result<(), Refused> {
        self.is_from_here(asked)?;
        let bearer = asked.authorization.and_then(|a| a.strip_prefix("Bearer "));
        let cookies = asked.cookie.unwrap_or_default().split(';');
        let cookie = |pair: &str| {
            let (name, value) = pair.trim().split_once('=')?;
            (name == self.cookie).then(|| value.to_owned())
        };
        let shown = bearer.map(str::to_owned);
        let shown = shown.into_iter().chain(cookies.filter_map(cookie));
        match shown.into_iter().any(|token| self.is_token(&token)) {
            true => Ok(()),
            false => Err(Refused::Token),
        }
    }
}

/// A text that nobody guesses: so many bytes of the system's randomness, as hex.
///
/// # Errors
///
/// The system gives none.
pub(super) fn random(bytes: usize) -> std::io::Result<String> {
    let mut noise = vec![0; bytes];
    std::fs::File::open("/dev/urandom")?.read_exact(&mut noise)?;
    Ok(noise.iter().map(|b| format!("{b:02x}")).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guard() -> Guard {
        let names = ["127.0.0.1", "localhost"].map(str::to_owned);
        Guard::new("secret".into(), &names, 8000)
    }

    const GOOD: Asked<'_> = Asked {
        reads: true,
        host: Some("127.0.0.1:8000"),
        origin: None,
        site: Some("same-origin"),
        cookie: Some("lang=de; tailor-8000=secret"),
        authorization: None,
    };

    #[test]
    fn own_pages_are_answered() {
        assert_eq!(guard().admits(&GOOD), Ok(()));
        let typed = Asked {
            site: Some("none"),
            ..GOOD
        };
        assert_eq!(guard().admits(&typed), Ok(()));
        let post = Asked {
            reads: false,
            origin: Some("http://127.0.0.1:8000"),
            ..GOOD
        };
        assert_eq!(guard().admits(&post), Ok(()));
        let (cookie, authorization) = (None, Some("Bearer secret"));
        let program = Asked {
            reads: false,
            site: None,
            cookie,
            authorization,
            ..GOOD
        };
        assert_eq!(guard().admits(&program), Ok(()));
    }

    #[test]
    fn pages_of_elsewhere_are_refused_though_they_have_the_cookie() {
        for host in [
            None,
            Some("evil.example:8000"),
            Some("127.0.0.1"),
            Some("127.0.0.1:8001"),
        ] {
            assert_eq!(
                guard().admits(&Asked { host, ..GOOD }),
                Err(Refused::Host),
                "{host:?}"
            );
        }
        for site in ["cross-site", "same-site"] {
            let asked = Asked {
                site: Some(site),
                ..GOOD
            };
            assert_eq!(guard().admits(&asked), Err(Refused::Origin));
        }
        // `localhost` is ours as well, but another origin than the one that was asked.
        for origin in [
            "null",
            "http://evil.example",
            "http://localhost:8000",
            "https://127.0.0.1:8000",
        ] {
            let asked = Asked {
                reads: false,
                origin: Some(origin),
                ..GOOD
            };
            assert_eq!(guard().admits(&asked), Err(Refused::Origin), "{origin}");
        }
        let typed = Asked {
            reads: false,
            site: Some("none"),
            ..GOOD
        };
        assert_eq!(guard().admits(&typed), Err(Refused::Origin));
        let mute = Asked {
            reads: false,
            site: None,
            ..GOOD
        };
        assert_eq!(guard().admits(&mute), Err(Refused::Origin));
    }

    #[test]
    fn without_the_token_nothing_is_answered() {
        for cookie in [
            None,
            Some(""),
            Some("tailor-8000=wrong!"),
            Some("tailor-8001=secret"),
        ] {
            assert_eq!(
                guard().admits(&Asked { cookie, ..GOOD }),
                Err(Refused::Token),
                "{cookie:?}"
            );
        }
        let authorization = Some("Bearer secre");
        let asked = Asked {
            cookie: None,
            authorization,
            ..GOOD
        };
        assert_eq!(guard().admits(&asked), Err(Refused::Token));
    }

    #[test]
    fn tokens_differ() {
        let (a, b) = (random(16).unwrap(), random(16).unwrap());
        assert!(a.len() == 32 && a != b);
    }
}
