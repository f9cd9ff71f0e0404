//! Finished rows into a PNG, as they come.

use crate::error::Failure;
use crate::interrupt::Interrupt;
use crate::output::Target;
use crate::picture::{Channels, Depth, Form, Format, Writer, out_of_turn};
use scumble::Sink;
use scumble::pixel::Image;
use std::time::{Duration, Instant};

/// A sink that writes a PNG: eight bits, sRGB, with alpha only where there may be some.
#[derive(Debug)]
pub(crate) struct PngSink<'a> {
    target: &'a Target,
    interrupt: &'a Interrupt,
    opaque: bool,
    writer: Option<Writer>,
    packed: Vec<u8>,
    spent: Duration,
}

impl<'a> PngSink<'a> {
    /// A sink that opens `target` when the first row is near. `opaque` promises that every pixel
    /// has full alpha, which is then not stored.
    pub(crate) fn new(target: &'a Target, interrupt: &'a Interrupt, opaque: bool) -> Self {
        Self { target, interrupt, opaque, writer: None, packed: Vec::new(), spent: Duration::ZERO }
    }

    /// Time spent on encoding and writing so far.
    pub(crate) fn spent(&self) -> Duration {
        self.spent
    }

    /// Gives the finished picture its name.
    pub(crate) fn commit(self) -> Result<(), Failure> {
        match self.writer {
            Some(writer) => writer.commit(),
            None => Err(Failure::Failed("nothing was drawn".to_owned())),
        }
    }

    fn open(&mut self, width: u32, height: u32) -> Result<(), Failure> {
        let channels = if self.opaque { Channels::Rgb } else { Channels::Rgba };
        let (depth, format) = (Depth::Eight, Format::Png);
        let form = Form { width, height, channels, depth, format, icc: None };
        self.writer = Some(Writer::open(self.target, self.interrupt, form)?);
        Ok(())
    }

    fn write(&mut self, pixels: &[[u8; 4]]) -> Result<(), Failure> {
        let bytes = if self.opaque {
            self.packed.clear();
            self.packed.extend(pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]));
            self.packed.as_slice()
        } else {
            pixels.as_flattened()
        };
        self.writer.as_mut().ok_or_else(out_of_turn)?.rows8(bytes)
    }

    fn close(&mut self) -> Result<(), Failure> {
        self.writer.as_mut().ok_or_else(out_of_turn)?.finish()
    }

    fn timed<T>(&mut self, work: impl FnOnce(&mut Self) -> T) -> T {
        let start = Instant::now();
        let result = work(self);
        self.spent += start.elapsed();
        result
    }
}

impl Sink for PngSink<'_> {
    type Error = Failure;

    fn start(&mut self, width: u32, height: u32) -> Result<(), Failure> {
        self.timed(|sink| sink.open(width, height))
    }

    fn rows(&mut self, _y: u32, rows: &[[u8; 4]]) -> Result<(), Failure> {
        self.timed(|sink| sink.write(rows))
    }

    fn finish(&mut self) -> Result<(), Failure> {
        self.timed(Self::close)
    }
}

/// Writes a picture that is whole already, and gives it its name.
pub(crate) fn write(
    picture: &Image<[u8; 4]>,
    target: &Target,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    let opaque = picture.pixels().iter().all(|p| p[3] == 255);
    let side = |n: usize| u32::try_from(n).map_err(|_| Failure::Limit("too large".to_owned()));
    let mut sink = PngSink::new(target, interrupt, opaque);
    sink.start(side(picture.width())?, side(picture.height())?)?;
    sink.rows(0, picture.pixels())?;
    sink.finish()?;
    sink.commit()?;
    interrupt.release();
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interrupt::tests::unheard;
    use crate::output::FileTarget;
    use png::ColorType;
    use std::fs;
    use std::path::Path;

    fn target(path: &Path) -> Target {
        let path = path.to_owned();
        Target::File(FileTarget { shown: path.clone(), path, may_replace: true })
    }

    /// A 3 × 4 picture whose every byte tells its place.
    fn pixels() -> Vec<[u8; 4]> {
        (0..12).map(|i| [i, 100 + i, 200 + i, 255 - i]).collect()
    }

    fn draw(sink: &mut PngSink<'_>, pixels: &[[u8; 4]]) -> Result<(), Failure> {
        sink.start(3, 4)?;
        sink.rows(0, &pixels[..3])?;
        sink.rows(1, &pixels[3..])?;
        sink.finish()
    }

    fn decode(path: &Path) -> (png::OutputInfo, Vec<u8>, bool) {
        let file = std::io::BufReader::new(fs::File::open(path).unwrap());
        let mut reader = png::Decoder::new(file).read_info().unwrap();
        let srgb = reader.info().srgb.is_some();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut data).unwrap();
        reader.finish().unwrap();
        data.truncate(info.buffer_size());
        (info, data, srgb)
    }

    #[test]
    fn what_goes_in_comes_out() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let (target, interrupt) = (target(&path), unheard());
        let mut sink = PngSink::new(&target, &interrupt, false);
        draw(&mut sink, &pixels()).unwrap();
        assert!(!path.exists());
        assert!(sink.spent() > Duration::ZERO);
        sink.commit().unwrap();
        let (info, data, srgb) = decode(&path);
        assert_eq!((info.width, info.height, info.color_type), (3, 4, ColorType::Rgba));
        assert_eq!(data, pixels().as_flattened());
        assert!(srgb);
    }

    #[test]
    fn an_opaque_picture_stores_no_alpha() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let (target, interrupt) = (target(&path), unheard());
        let mut sink = PngSink::new(&target, &interrupt, true);
        draw(&mut sink, &pixels()).unwrap();
        sink.commit().unwrap();
        let (info, data, _) = decode(&path);
        assert_eq!(info.color_type, ColorType::Rgb);
        let expected: Vec<u8> = pixels().iter().flat_map(|p| [p[0], p[1], p[2]]).collect();
        assert_eq!(data, expected);
    }

    #[test]
    fn a_picture_that_lacks_rows_is_an_error_and_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let (target, interrupt) = (target(&folder.path().join("a.png")), unheard());
        let mut sink = PngSink::new(&target, &interrupt, false);
        sink.start(3, 4).unwrap();
        sink.rows(0, &pixels()[..3]).unwrap();
        assert!(sink.finish().is_err());
        drop(sink);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn rows_out_of_turn_are_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let (target, interrupt) = (target(&folder.path().join("a.png")), unheard());
        let mut sink = PngSink::new(&target, &interrupt, false);
        assert!(sink.rows(0, &pixels()).is_err());
        assert!(sink.finish().is_err());
        assert!(sink.commit().is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_never_taken_for_a_picture() {
        let (target, interrupt) = (Target::Device("/dev/full".into()), unheard());
        let mut sink = PngSink::new(&target, &interrupt, false);
        let drawn = draw(&mut sink, &pixels()).and_then(|()| sink.commit());
        assert!(drawn.unwrap_err().to_string().contains("/dev/full"));
    }
}
