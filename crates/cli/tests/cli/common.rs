//! A folder to run the command in, and what came of a run.

use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A white ground, a red square from (2, 1) to (6, 5), 10 × 8 pixels in all.
pub(crate) const SQUARE: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="10" height="8">
  <rect width="10" height="8" fill="#fff"/>
  <rect x="2" y="1" width="4" height="4" fill="#f00"/>
</svg>
"##;

/// A scene with a bit of everything that a crop could disturb: slanted edges, curves, alpha.
pub(crate) const SHAPES: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="200" height="150">
  <circle cx="80.5" cy="70.25" r="55.3" fill="#0a7"/>
  <path d="M10 140 C 60 20, 140 20, 190 140 Z" fill="#d40" fill-opacity="0.5"/>
  <line x1="3" y1="7" x2="196" y2="141" stroke="#024" stroke-width="3.7"/>
</svg>
"##;

/// A folder of its own that a test runs the command in.
pub(crate) struct Desk {
    folder: TempDir,
}

/// What a run left behind.
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) out: Vec<u8>,
    pub(crate) err: String,
}

/// A decoded PNG.
#[derive(Debug, PartialEq)]
pub(crate) struct Picture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) pixels: Vec<[u8; 4]>,
}

impl Desk {
    pub(crate) fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder") }
    }

    /// One with a file on it.
    pub(crate) fn with(name: &str, content: impl AsRef<[u8]>) -> Self {
        let desk = Self::new();
        desk.put(name, content);
        desk
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn put(&self, name: &str, content: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, content).expect("a file");
    }

    /// The names of everything in the folder, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).expect("the folder");
        let name = |e: std::io::Result<fs::DirEntry>| e.expect("an entry").file_name();
        let mut names: Vec<String> =
            entries.map(|e| name(e).into_string().expect("a plain name")).collect();
        names.sort();
        names
    }

    /// The command with these arguments, separated by blanks, in this folder.
    pub(crate) fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_scumble"));
        command.current_dir(self.folder.path());
        command.args(arguments.split_whitespace());
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    pub(crate) fn run(&self, arguments: &str) -> Run {
        Run::of(self.command(arguments).output().expect("the command starts"))
    }

    /// A run with `input` on its standard input.
    pub(crate) fn run_with_input(&self, arguments: &str, input: &[u8]) -> Run {
        let mut child =
            self.command(arguments).stdin(Stdio::piped()).spawn().expect("the command starts");
        // It may end without having read it all.
        let _ = child.stdin.take().expect("its input").write_all(input);
        Run::of(child.wait_with_output().expect("the command ends"))
    }

    /// A run whose standard output nobody reads.
    pub(crate) fn run_unread(&self, arguments: &str) -> Run {
        let mut child = self.command(arguments).spawn().expect("the command starts");
        drop(child.stdout.take());
        Run::of(child.wait_with_output().expect("the command ends"))
    }

    pub(crate) fn picture(&self, name: &str) -> Picture {
        Picture::decode(&fs::read(self.path(name)).expect("a picture"))
    }
}

impl Run {
    fn of(output: Output) -> Self {
        Self {
            code: output.status.code(),
            out: output.stdout,
            err: String::from_utf8(output.stderr).expect("messages are UTF-8"),
        }
    }

    /// Ended well, with nothing to say.
    #[track_caller]
    pub(crate) fn succeeded(self) -> Self {
        assert_eq!((self.code, self.err.as_str()), (Some(0), ""));
        self
    }

    /// Ended with `code` and one line on standard error that begins so and holds all of `parts`.
    #[track_caller]
    pub(crate) fn failed(self, code: i32, start: &str, parts: &[&str]) -> Self {
        assert_eq!(self.code, Some(code), "{}", self.err);
        assert!(self.err.starts_with(&format!("scumble: {start}")), "{}", self.err);
        assert_eq!(self.err.matches('\n').count(), 1, "one line: {}", self.err);
        for part in parts {
            assert!(self.err.contains(part), "{part:?} in {}", self.err);
        }
        self
    }

    /// Ended as a usage error of the argument parser, which may take several lines.
    #[track_caller]
    pub(crate) fn misused(self, part: &str) -> Self {
        assert_eq!(self.code, Some(2), "{}", self.err);
        assert!(self.err.contains(part), "{part:?} in {}", self.err);
        assert!(self.out.is_empty());
        self
    }
}

impl Picture {
    pub(crate) fn decode(data: &[u8]) -> Self {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(data));
        decoder.set_transformations(png::Transformations::ALPHA);
        let mut reader = decoder.read_info().expect("a PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut bytes).expect("all rows");
        reader.finish().expect("the end");
        let pixels = match info.color_type {
            png::ColorType::GrayscaleAlpha => {
                bytes.as_chunks().0.iter().map(|&[y, a]| [y, y, y, a]).collect()
            }
            _ => bytes.as_chunks::<4>().0.to_vec(),
        };
        Self { width: info.width as usize, height: info.height as usize, pixels }
    }

    pub(crate) fn at(&self, x: usize, y: usize) -> [u8; 4] {
        self.pixels[y * self.width + x]
    }

    /// The pixels of a part.
    pub(crate) fn part(&self, x: usize, y: usize, width: usize, height: usize) -> Self {
        let rows = (y..y + height).flat_map(|y| &self.pixels[y * self.width + x..][..width]);
        Self { width, height, pixels: rows.copied().collect() }
    }
}

/// A PNG of `side` × `side` grey pixels.
pub(crate) fn png_file(side: u32) -> Vec<u8> {
    let mut data = Vec::new();
    let mut encoder = png::Encoder::new(&mut data, side, side);
    encoder.set_color(png::ColorType::Grayscale);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&vec![128; (side * side) as usize]).expect("pixels");
    writer.finish().expect("an end");
    data
}

/// A PNG of pixels with alpha, `width` to a row.
pub(crate) fn rgba_png(width: usize, pixels: &[[u8; 4]]) -> Vec<u8> {
    let mut data = Vec::new();
    let height = pixels.len() / width;
    let mut encoder = png::Encoder::new(&mut data, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(pixels.as_flattened()).expect("pixels");
    writer.finish().expect("an end");
    data
}

/// A scene of one image, the file called `href`.
pub(crate) fn scene_of(href: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"8\" height=\"8\">\n  \
         <image width=\"8\" height=\"8\" href=\"{href}\"/>\n</svg>\n"
    )
}
