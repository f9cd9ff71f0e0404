use crate::args::STANDARD_STREAM;
use crate::error::Failure;
use crate::input::Source;
use crate::picture::Format;
use crate::resources::Folders;
use std::fs::{self, File};
use std::io::{self, IsTerminal, Read};
use std::path::{Path, PathBuf};

/// What the user said about the picture's place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Request<'a> {
    /// The name given, if any.
    pub(crate) out: Option<&'a Path>,
    /// Whether anything may be replaced.
    pub(crate) force: bool,
    /// Whether standard output is taken by the report.
    pub(crate) json: bool,
}

/// Where the picture goes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Target {
    /// Standard output.
    Stdout,
    /// A regular file, new or replaced.
    File(FileTarget),
    /// Something that exists and is no regular file; written to as it is.
    Device(PathBuf),
}

/// A regular file to be made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct FileTarget {
    /// As the user wrote it.
    pub(crate) shown: PathBuf,
    /// The file itself, links followed.
    pub(crate) path: PathBuf,
    /// Whether a file of that name may give way at the end.
    pub(crate) may_replace: bool,
}

/// Why a file stays.
const READ: &str = "it is what is read; --force replaces it";

/// Bytes that tell every format of pictures.
const LONGEST_SIGNATURE: u64 = 12;

impl Target {
    /// Where the picture of `source` goes, if it may go there.
    pub(crate) fn new(request: &Request<'_>, source: &Source) -> Result<Self, Failure> {
        let standard = Path::new(STANDARD_STREAM);
        match (request.out, source) {
            (Some(path), _) if path != standard => Self::named(path, request.force, source),
            (None, Source::File(scene)) => Self::derived(scene, request.force),
            _ if request.json => Err(Failure::Usage(
                "--json needs standard output for itself; name a file for the picture".to_owned(),
            )),
            _ if io::stdout().is_terminal() => Err(Failure::Usage(
                "standard output is a terminal; name a file for the picture, or pipe it".to_owned(),
            )),
            _ => Ok(Self::Stdout),
        }
    }

    /// The format that its name says; a PNG where there is no ending.
    pub(crate) fn format(&self) -> Result<Format, Failure> {
        let path = match self {
            Self::Stdout => return Ok(Format::Png),
            Self::File(file) => &file.shown,
            Self::Device(path) => path,
        };
        if path.extension().is_none() {
            return Ok(Format::Png);
        }
        Format::of_name(path).ok_or_else(|| {
            Failure::Usage(format!(
                "{}: its ending names no format that is written: .png, .jpg, .webp, .tif or .exr",
                path.display()
            ))
        })
    }

    /// What messages call it.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Stdout => "standard output".to_owned(),
            Self::File(file) => file.shown.display().to_string(),
            Self::Device(path) => path.display().to_string(),
        }
    }

    /// Refuses to replace a file that the scene was made of.
    pub(crate) fn check_unused(&self, folders: &Folders, force: bool) -> Result<(), Failure> {
        match self {
            Self::File(file) if !force && folders.has_used(&file.path) => {
                Err(refusal(&file.shown, "it is one of the scene's images; --force replaces it"))
            }
            _ => Ok(()),
        }
    }

    /// Refuses to replace another file that is read.
    pub(crate) fn check_apart(&self, other: &Source, force: bool) -> Result<(), Failure> {
        match self {
            Self::File(file) if !force && is_scene(&file.path, other) => {
                Err(refusal(&file.shown, READ))
            }
            _ => Ok(()),
        }
    }

    /// Whether it is the file that a path names, or would name.
    pub(crate) fn is_at(&self, path: &Path) -> bool {
        let place = |path: &Path| {
            let folder = path.parent().filter(|p| !p.as_os_str().is_empty());
            Some((
                fs::canonicalize(folder.unwrap_or(Path::new("."))).ok()?,
                path.file_name()?.to_owned(),
            ))
        };
        match self {
            Self::File(file) => place(&file.path).is_some_and(|p| Some(p) == place(path)),
            _ => false,
        }
    }

    fn derived(scene: &Path, force: bool) -> Result<Self, Failure> {
        let stem = scene.file_stem().ok_or_else(|| {
            Failure::Usage(format!("{}: no name for the picture; use -o", scene.display()))
        })?;
        let mut name = stem.to_owned();
        name.push(".png");
        let shown = PathBuf::from(name);
        match Existing::of(&shown)? {
            Existing::Nothing => Ok(Self::File(FileTarget::new_file(&shown, force))),
            Existing::File(_) | Existing::Device if !force => {
                Err(refusal(&shown, "it exists; name it with -o, or use --force"))
            }
            Existing::File(path) => Ok(Self::File(FileTarget { shown, path, may_replace: true })),
            Existing::Device => Ok(Self::Device(shown)),
        }
    }

    fn named(shown: &Path, force: bool, source: &Source) -> Result<Self, Failure> {
        let path = match Existing::of(shown)? {
            Existing::Nothing => return Ok(Self::File(FileTarget::new_file(shown, true))),
            Existing::Device if force => return Ok(Self::Device(shown.to_owned())),
            Existing::Device => {
                return Err(refusal(shown, "not a regular file; --force writes to it as it is"));
            }
            Existing::File(path) => path,
        };
        if !force {
            if is_scene(&path, source) {
                return Err(refusal(shown, READ));
            }
            if !is_picture(&path).map_err(|e| Failure::file(shown, &e))? {
                return Err(refusal(shown, "it exists and is not a picture; --force replaces it"));
            }
        }
        Ok(Self::File(FileTarget { shown: shown.to_owned(), path, may_replace: true }))
    }
}

impl FileTarget {
    fn new_file(shown: &Path, may_replace: bool) -> Self {
        Self { shown: shown.to_owned(), path: shown.to_owned(), may_replace }
    }
}

/// What stands at a path, links followed.
enum Existing {
    Nothing,
    File(PathBuf),
    Device,
}

impl Existing {
    fn of(path: &Path) -> Result<Self, Failure> {
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => Err(refusal(path, "it is a folder")),
            Ok(found) if found.is_file() => {
                let path = fs::canonicalize(path).map_err(|e| Failure::file(path, &e))?;
                Ok(Self::File(path))
            }
            Ok(_) => Ok(Self::Device),
            Err(e) if e.kind() == io::ErrorKind::NotFound => Self::nothing_at(path),
            Err(e) => Err(Failure::file(path, &e)),
        }
    }

    /// Nothing stands there; says so now if nothing could.
    fn nothing_at(path: &Path) -> Result<Self, Failure> {
        if fs::symlink_metadata(path).is_ok() {
            return Err(refusal(path, "a link to something that does not exist"));
        }
        match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
                Err(refusal(folder, "no such folder"))
            }
            _ => Ok(Self::Nothing),
        }
    }
}

fn refusal(path: &Path, why: &str) -> Failure {
    Failure::Failed(format!("{}: {why}", path.display()))
}

fn is_scene(path: &Path, source: &Source) -> bool {
    match source {
        Source::Stdin => false,
        Source::File(scene) => fs::canonicalize(scene).is_ok_and(|scene| scene == path),
    }
}

/// Whether nothing is lost by replacing the file: it is a picture, or a texture's levels, or empty.
fn is_picture(path: &Path) -> io::Result<bool> {
    let mut start = Vec::new();
    File::open(path)?.take(LONGEST_SIGNATURE).read_to_end(&mut start)?;
    let texture = start.starts_with(b"DDS ") || start.starts_with(b"\xabKTX 20\xbb");
    Ok(start.is_empty() || texture || Format::of_content(&start).is_some())
}
