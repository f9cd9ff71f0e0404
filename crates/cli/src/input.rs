//! What is read: from a file or standard input, no longer than it may be.

use crate::args::STANDARD_STREAM;
use crate::error::Failure;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Where the scene comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Source {
    /// Standard input.
    Stdin,
    /// A file.
    File(PathBuf),
}

impl Source {
    /// What the argument names.
    pub(crate) fn new(path: &Path) -> Self {
        if path.as_os_str() == STANDARD_STREAM { Self::Stdin } else { Self::File(path.to_owned()) }
    }

    /// What messages call it.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Stdin => "<stdin>".to_owned(),
            Self::File(path) => path.display().to_string(),
        }
    }

    /// The folder that the scene's own paths start from.
    pub(crate) fn folder(&self) -> &Path {
        let parent = match self {
            Self::Stdin => None,
            Self::File(path) => path.parent(),
        };
        parent.filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
    }

    /// Says at once if there is nothing to read.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        let Self::File(path) = self else { return Ok(()) };
        let found = fs::metadata(path).map_err(|e| Failure::file(path, &e))?;
        if found.is_dir() {
            return Err(Failure::Failed(format!("{}: it is a folder", path.display())));
        }
        Ok(())
    }

    /// All of it, if it is at most `max` bytes.
    pub(crate) fn read(&self, max: u64) -> Result<Vec<u8>, Failure> {
        let text = match self {
            Self::Stdin => read_capped(io::stdin().lock(), max),
            Self::File(path) => File::open(path).and_then(|file| read_capped(file, max)),
        };
        match text {
            Ok(Some(text)) => Ok(text),
            Ok(None) => Err(Failure::Limit(format!(
                "{}: the file is longer than {max} bytes, which --max-memory sets",
                self.name()
            ))),
            Err(e) => Err(Failure::io(self.name(), &e)),
        }
    }
}

/// Everything that `reader` holds, or `None` if that is more than `max` bytes.
pub(crate) fn read_capped(reader: impl Read, max: u64) -> io::Result<Option<Vec<u8>>> {
    let mut data = Vec::new();
    reader.take(max.saturating_add(1)).read_to_end(&mut data)?;
    Ok((data.len() as u64 <= max).then_some(data))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dash_is_standard_input() {
        assert_eq!(Source::new(Path::new("-")), Source::Stdin);
        assert_eq!(Source::new(Path::new("./-")), Source::File("./-".into()));
    }

    #[test]
    fn paths_start_from_the_scenes_folder() {
        assert_eq!(Source::new(Path::new("a.svg")).folder(), Path::new("."));
        assert_eq!(Source::new(Path::new("x/a.svg")).folder(), Path::new("x"));
        assert_eq!(Source::new(Path::new("/a.svg")).folder(), Path::new("/"));
        assert_eq!(Source::Stdin.folder(), Path::new("."));
    }

    #[test]
    fn the_cap_is_exact() {
        assert_eq!(read_capped(&b"1234"[..], 4).unwrap(), Some(b"1234".to_vec()));
        assert_eq!(read_capped(&b"12345"[..], 4).unwrap(), None);
        assert_eq!(read_capped(io::repeat(0), 1000).unwrap(), None);
        assert_eq!(read_capped(&b""[..], 0).unwrap(), Some(vec![]));
    }

    #[test]
    fn a_folder_is_no_scene() {
        let folder = tempfile::tempdir().unwrap();
        let source = Source::new(folder.path());
        assert!(matches!(source.check(), Err(Failure::Failed(_))));
        assert!(matches!(source.read(10), Err(Failure::Failed(_))));
        assert!(Source::new(&folder.path().join("none.svg")).check().is_err());
        assert!(Source::Stdin.check().is_ok());
    }
}
