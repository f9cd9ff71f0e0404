//! Which files a scene may use, and reading them.
//!
//! A scene is other people's text; what it names is read only if it lies, once links and `..` are
//! seen through, in the scene's own folder or in one that the user named.

use crate::error::{Failure, reason};
use crate::input::read_capped;
use std::fs::{self, File};
use std::io;
use std::path::{Component, Path, PathBuf};
use std::sync::Mutex;

/// The folders that a scene may read from.
#[derive(Debug)]
pub(crate) struct Folders {
    /// Where relative paths start.
    base: PathBuf,
    /// Canonical; everything below them is allowed.
    allowed: Vec<PathBuf>,
    /// The longest file that is read, in bytes.
    max_bytes: u64,
    /// Canonical paths of what was read.
    used: Mutex<Vec<PathBuf>>,
}

/// Why a file is not read.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Refusal {
    /// It names a protocol.
    #[error("only files can be used, not addresses")]
    Address,
    /// It starts at the root.
    #[error("an absolute path; only paths relative to the scene are followed")]
    Absolute,
    /// It ends up elsewhere.
    #[error("it lies outside the scene's folder; --resources DIR would allow it")]
    Outside,
    /// A folder, a device, a pipe.
    #[error("not a regular file")]
    NotAFile,
    /// Too long.
    #[error("the file is longer than {0} bytes (--max-memory)")]
    TooLong(u64),
    /// The system could not read it.
    #[error("{}", reason(.0))]
    Read(#[from] io::Error),
}

impl Folders {
    /// `base`, which paths are relative to, and further folders.
    pub(crate) fn new(base: &Path, further: &[PathBuf], max_bytes: u64) -> Result<Self, Failure> {
        let base = canonical_folder(base)?;
        let mut allowed = vec![base.clone()];
        for folder in further {
            allowed.push(canonical_folder(folder)?);
        }
        Ok(Self { base, allowed, max_bytes, used: Mutex::default() })
    }

    /// The bytes of the file that the scene calls `href`.
    pub(crate) fn read(&self, href: &str) -> Result<Vec<u8>, Refusal> {
        let path = self.find(href)?;
        if !fs::metadata(&path)?.is_file() {
            return Err(Refusal::NotAFile);
        }
        let file = File::open(&path)?;
        // Asked again of the open file: the name may have been given to something else meanwhile.
        if !file.metadata()?.is_file() {
            return Err(Refusal::NotAFile);
        }
        let data = read_capped(file, self.max_bytes)?.ok_or(Refusal::TooLong(self.max_bytes))?;
        if let Ok(mut used) = self.used.lock() {
            used.push(path);
        }
        Ok(data)
    }

    /// Whether the scene read the file at this canonical path.
    pub(crate) fn has_used(&self, path: &Path) -> bool {
        self.used.lock().is_ok_and(|used| used.iter().any(|p| p == path))
    }

    /// The canonical path of an allowed file.
    fn find(&self, href: &str) -> Result<PathBuf, Refusal> {
        check_form(href)?;
        let path = match fs::canonicalize(self.base.join(href)) {
            // A reference is an address at heart, so `a%20b.png` may mean `a b.png`.
            Err(e) if e.kind() == io::ErrorKind::NotFound => match percent_decoded(href) {
                Some(decoded) => {
                    check_form(&decoded)?;
                    fs::canonicalize(self.base.join(decoded))?
                }
                None => return Err(e.into()),
            },
            other => other?,
        };
        if self.allowed.iter().any(|folder| path.starts_with(folder)) {
            Ok(path)
        } else {
            Err(Refusal::Outside)
        }
    }
}

/// Refuses what is not a relative path by its form alone.
fn check_form(href: &str) -> Result<(), Refusal> {
    let path = Path::new(href);
    let rooted =
        matches!(path.components().next(), Some(Component::Prefix(_) | Component::RootDir));
    if path.is_absolute() || rooted {
        return Err(Refusal::Absolute);
    }
    if has_scheme(href) { Err(Refusal::Address) } else { Ok(()) }
}

/// Whether it starts with `scheme:` (RFC 3986, section 3.1).
fn has_scheme(href: &str) -> bool {
    let Some((scheme, _)) = href.split_once(':') else { return false };
    scheme.starts_with(|c: char| c.is_ascii_alphabetic())
        && scheme.chars().all(|c| c.is_ascii_alphanumeric() || "+-.".contains(c))
}

/// The reference with `%41` read as `A` and so on; `None` if nothing would change or it is not
/// well formed.
fn percent_decoded(href: &str) -> Option<String> {
    let mut parts = href.split('%');
    let mut bytes = parts.next()?.as_bytes().to_vec();
    for part in parts {
        let byte = part.get(..2).and_then(|hex| u8::from_str_radix(hex, 16).ok())?;
        bytes.push(byte);
        bytes.extend_from_slice(&part.as_bytes()[2..]);
    }
    String::from_utf8(bytes).ok().filter(|decoded| decoded != href)
}

/// The one name of a folder that exists.
fn canonical_folder(path: &Path) -> Result<PathBuf, Failure> {
    let canonical = fs::canonicalize(path).map_err(|e| Failure::file(path, &e))?;
    if canonical.is_dir() {
        Ok(canonical)
    } else {
        Err(Failure::Failed(format!("{}: not a folder", path.display())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tempfile::TempDir;

    /// `out.png`, `scene/in.png`, `scene/a b.png`, `scene/sub/deep.png`.
    fn tree() -> TempDir {
        let root = tempfile::tempdir().unwrap();
        fs::create_dir_all(root.path().join("scene/sub")).unwrap();
        for name in ["out.png", "scene/in.png", "scene/a b.png", "scene/sub/deep.png"] {
            fs::write(root.path().join(name), name).unwrap();
        }
        root
    }

    fn folders(root: &TempDir, further: &[PathBuf]) -> Folders {
        Folders::new(&root.path().join("scene"), further, 100).unwrap()
    }

    #[test]
    fn the_scenes_folder_and_below_are_open() {
        let root = tree();
        let folders = folders(&root, &[]);
        assert_eq!(folders.read("in.png").unwrap(), b"scene/in.png");
        assert_eq!(folders.read("sub/deep.png").unwrap(), b"scene/sub/deep.png");
        assert_eq!(folders.read("sub/../in.png").unwrap(), b"scene/in.png");
        assert_eq!(folders.read("../scene/in.png").unwrap(), b"scene/in.png");
        assert_eq!(folders.read("a b.png").unwrap(), b"scene/a b.png");
        assert_eq!(folders.read("a%20b.png").unwrap(), b"scene/a b.png");
    }

    #[test]
    fn elsewhere_is_closed_unless_it_was_named() {
        let root = tree();
        let closed = folders(&root, &[]);
        assert!(matches!(closed.read("../out.png"), Err(Refusal::Outside)));
        assert!(matches!(closed.read("%2e%2e/out.png"), Err(Refusal::Outside)));
        let open = folders(&root, &[root.path().to_owned()]);
        assert_eq!(open.read("../out.png").unwrap(), b"out.png");
    }

    #[test]
    fn a_folder_whose_name_begins_alike_is_elsewhere() {
        let root = tree();
        fs::create_dir(root.path().join("scene2")).unwrap();
        fs::write(root.path().join("scene2/x.png"), "x").unwrap();
        assert!(matches!(folders(&root, &[]).read("../scene2/x.png"), Err(Refusal::Outside)));
    }

    #[cfg(unix)]
    #[test]
    fn links_are_seen_through() {
        use std::os::unix::fs::symlink;
        let root = tree();
        symlink(root.path().join("out.png"), root.path().join("scene/link.png")).unwrap();
        symlink(root.path(), root.path().join("scene/up")).unwrap();
        let folders = folders(&root, &[]);
        assert!(matches!(folders.read("link.png"), Err(Refusal::Outside)));
        assert!(matches!(folders.read("up/out.png"), Err(Refusal::Outside)));
        assert!(folders.read("up/scene/in.png").is_ok());
    }

    #[test]
    fn addresses_and_absolute_paths_are_refused_unseen() {
        let root = tree();
        let folders = folders(&root, &[]);
        let absolute = root.path().join("scene/in.png");
        assert!(matches!(folders.read(absolute.to_str().unwrap()), Err(Refusal::Absolute)));
        assert!(matches!(folders.read("//host/x.png"), Err(Refusal::Absolute)));
        for href in ["https://example.org/x.png", "file:///x.png", "data:image/png,", "c:x.png"] {
            let refused = folders.read(href);
            assert!(matches!(refused, Err(Refusal::Address | Refusal::Absolute)), "{href}");
        }
    }

    #[test]
    fn only_regular_files_of_a_decent_length_are_read() {
        let root = tree();
        let folders = folders(&root, &[]);
        assert!(matches!(folders.read("sub"), Err(Refusal::NotAFile)));
        assert!(matches!(folders.read(""), Err(Refusal::NotAFile)));
        assert!(matches!(folders.read("none.png"), Err(Refusal::Read(_))));
        assert!(matches!(folders.read("nul\0.png"), Err(Refusal::Read(_))));
        fs::write(root.path().join("scene/long.png"), [0; 101]).unwrap();
        assert!(matches!(folders.read("long.png"), Err(Refusal::TooLong(100))));
    }

    proptest::proptest! {
        #[test]
        fn no_spelling_leads_outside(href in "(\\.\\.|\\.|%2e|%2E%2e|/|%2f|sub|up|in\\.png|out\\.png|%|\\\\){1,8}") {
            let root = tree();
            fs::write(root.path().join("scene/up"), "scene/up").unwrap();
            if let Ok(data) = folders(&root, &[]).read(&href) {
                assert!(data.starts_with(b"scene/"), "{href}");
            }
        }
    }

    #[test]
    fn what_was_read_is_remembered() {
        let root = tree();
        let folders = folders(&root, &[]);
        let path = root.path().join("scene/in.png").canonicalize().unwrap();
        assert!(!folders.has_used(&path));
        folders.read("sub/../in.png").unwrap();
        assert!(folders.has_used(&path));
    }

    #[test]
    fn a_folder_that_is_not_there_is_said_at_once() {
        let root = tree();
        assert!(Folders::new(&root.path().join("none"), &[], 1).is_err());
        assert!(Folders::new(root.path(), &[root.path().join("out.png")], 1).is_err());
    }

    #[test]
    fn percent_signs_are_decoded_with_care() {
        assert_eq!(percent_decoded("a%20b").as_deref(), Some("a b"));
        assert_eq!(percent_decoded("%C3%A9").as_deref(), Some("é"));
        for href in ["plain", "%", "%2", "%zz", "100%é", "%ff"] {
            assert_eq!(percent_decoded(href), None, "{href}");
        }
    }
}
