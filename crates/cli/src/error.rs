//! What can go wrong, the line that says so, and the exit status.

use std::fmt::{self, Write as _};
use std::io::{self, Write as _};
use std::path::Path;
use std::process::ExitCode;

/// Why a run ended without its picture.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    /// Something could not be read, understood, drawn or written.
    #[error("{0}")]
    Failed(String),
    /// The arguments contradict each other or the scene.
    #[error("{0}")]
    Usage(String),
    /// The work would take more than the run may use.
    #[error("{0}")]
    Limit(String),
    /// Two pictures differ, which the report says.
    #[error("they differ")]
    Different,
    /// A signal ended the run.
    #[error("interrupted")]
    Interrupted {
        /// The signal's number.
        signal: u8,
    },
}

impl Failure {
    /// A failure of the system with a file or a stream, which `name` says.
    pub(crate) fn io(name: impl fmt::Display, error: &io::Error) -> Self {
        Self::Failed(format!("{name}: {}", reason(error)))
    }

    /// A failure of the system with the file at `path`.
    pub(crate) fn file(path: &Path, error: &io::Error) -> Self {
        Self::io(path.display(), error)
    }

    /// The status that the process ends with.
    pub(crate) fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            Self::Failed(_) => 1,
            Self::Usage(_) => 2,
            Self::Limit(_) => 3,
            Self::Different => 4,
            // As shells count them.
            Self::Interrupted { signal } => 128_u8.saturating_add(*signal),
        })
    }
}

/// What the system said, in words and without its number.
pub(crate) fn reason(error: &io::Error) -> String {
    let text = error.to_string();
    match text.find(" (os error ") {
        Some(end) => text[..end].to_owned(),
        None => text,
    }
}

/// Prints one line on standard error. If that is closed there is nobody to tell.
pub(crate) fn say(message: &dyn fmt::Display) {
    let line = one_line(&format!("scumble: {message}"));
    let _ = writeln!(io::stderr().lock(), "{line}");
}

/// Prints what a reader of the file called `name` left out or assumed.
pub(crate) fn warn(name: &str, notes: &[String]) {
    for note in notes {
        say(&format!("{name}: warning: {note}"));
    }
}

/// The text on one line, with control characters spelled out: a scene's own words end up in
/// messages, and they must neither break the line nor command the terminal.
fn one_line(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() {
            let _ = write!(line, "{}", c.escape_default());
        } else {
            line.push(c);
        }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_stays_on_its_line() {
        assert_eq!(one_line("a\nb\x1b[2Jc"), "a\\nb\\u{1b}[2Jc");
        assert_eq!(one_line("é 図 — “ok”"), "é 図 — “ok”");
    }

    proptest::proptest! {
        #[test]
        fn no_text_commands_the_terminal(text in ".*") {
            assert!(!one_line(&text).chars().any(char::is_control));
        }
    }

    #[test]
    fn each_kind_has_its_status() {
        let code = |f: Failure| format!("{:?}", f.exit_code());
        let expected = |n: u8| format!("{:?}", ExitCode::from(n));
        assert_eq!(code(Failure::Failed(String::new())), expected(1));
        assert_eq!(code(Failure::Usage(String::new())), expected(2));
        assert_eq!(code(Failure::Limit(String::new())), expected(3));
        assert_eq!(code(Failure::Interrupted { signal: 2 }), expected(130));
    }

    #[test]
    fn the_system_speaks_in_words() {
        let error = io::Error::from_raw_os_error(2);
        let failure = Failure::file(Path::new("a.svg"), &error).to_string();
        assert!(failure.starts_with("a.svg: "), "{failure}");
        assert!(!failure.contains("os error"), "{failure}");
    }
}
