use crate::Position;
use core::fmt;
use std::collections::HashMap;

/// Something in the document that was not drawn as it says.
///
/// It displays as `line:column: message`, with the number of times if there are several.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Warning {
    /// What, and what was done instead.
    pub message: String,
    /// The first place where it happened.
    pub position: Option<Position>,
    /// How often it happened.
    pub count: usize,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(position) = self.position {
            write!(f, "{position}: ")?;
        }
        f.write_str(&self.message)?;
        if self.count > 1 {
            write!(f, " ({} times)", self.count)?;
        }
        Ok(())
    }
}

/// Different warnings that are kept; a hostile document could otherwise have as many as bytes.
const MAX_KINDS: usize = 100;

/// Collects warnings: one for each message, with the first place and a count.
#[derive(Debug, Default)]
pub(crate) struct Warnings {
    kinds: Vec<Kind>,
    by_message: HashMap<String, usize>,
    beyond: usize,
}

#[derive(Debug)]
struct Kind {
    message: String,
    offset: Option<usize>,
    count: usize,
}

impl Warnings {
    /// Adds a warning about the bytes at `offset` of the document.
    pub(crate) fn add(&mut self, offset: impl Into<Option<usize>>, message: impl Into<String>) {
        let message = message.into();
        if let Some(&i) = self.by_message.get(&message) {
            self.kinds[i].count += 1;
        } else if self.kinds.len() < MAX_KINDS {
            self.by_message.insert(message.clone(), self.kinds.len());
            self.kinds.push(Kind { message, offset: offset.into(), count: 1 });
        } else {
            self.beyond += 1;
        }
    }

    /// The warnings in order of first appearance.
    pub(crate) fn finish(self, text: &str) -> Vec<Warning> {
        let mut out: Vec<Warning> = self
            .kinds
            .into_iter()
            .map(|kind| Warning {
                message: kind.message,
                position: kind.offset.map(|offset| Position::at(text, offset)),
                count: kind.count,
            })
            .collect();
        if self.beyond > 0 {
            out.push(Warning {
                message: "more warnings, not listed".into(),
                position: None,
                count: self.beyond,
            });
        }
        out
    }
}
