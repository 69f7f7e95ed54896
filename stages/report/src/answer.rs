//! Which answer a page shows: the full one, or a first one from a coarse surface.

stage::choice! {
    /// Which answer the page tells.
    pub enum Answer {
        /// The full one.
        Full = "full",
        /// A first one, from a coarse surface.
        First = "first",
        /// A first one that the full one follows.
        Followed = "followed",
        /// A first one that the full one should have followed, which failed or was stopped.
        Unfinished = "unfinished",
    }
}

impl Answer {
    /// The banner of a page that shows a first answer.
    pub(crate) fn first(self) -> String {
        let follows = match self {
            Answer::Full => return String::new(),
            Answer::First => "the full one was not asked for",
            Answer::Followed => "the full one follows and replaces this page",
            Answer::Unfinished => "the full one failed or was stopped",
        };
        format!(
            "<p class=\"warn\"><b>First answer from the coarse surface</b>; {follows}. Waist and hip alone, with wider intervals.</p>"
        )
    }
}
