//! What a tool does about bounds that are not met.

use super::bound::Bound;
use super::shortfall::shortfalls;
use crate::{Failure, Session};
use tmesh::Document;

/// Whether bounds that are not met are a failure.
#[derive(clap::Args, Clone, Copy, Debug, Default)]
pub struct StrictArgs {
    /// Fail (exit 1) where elements do not meet the bounds asked for, rather than say so and go on
    #[arg(long)]
    pub strict: bool,
}

impl StrictArgs {
    /// Says what a document does not meet of what was asked of its elements, and returns what was said.
    ///
    /// # Errors
    /// The same with `--strict`, as what cannot be done.
    pub fn judge(self, session: &Session, document: &Document) -> Result<Vec<String>, Failure> {
        let short = shortfalls(document);
        if self.strict && !short.is_empty() {
            return Err(Failure::Impossible(short.join("; ")));
        }
        for sentence in &short {
            session.note(sentence);
        }
        self.say_if_unknown(session, document);
        Ok(short)
    }

    /// Says that `--strict` has nothing to hold a document against, where that is so.
    pub fn say_if_unknown(self, session: &Session, document: &Document) {
        if self.strict && document.wishes.quality() && Bound::of(document).is_empty() {
            session.note(
                "the input does not say what was asked of its elements, so --strict has nothing to hold them against",
            );
        }
    }
}
