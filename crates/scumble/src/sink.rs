use scumble_pixel::Image;
use std::convert::Infallible;

/// Where finished rows go: an image in memory, a file being written, a window.
///
/// The calls come in order, from one thread at a time: `start` once, `rows` from the top down
/// until all are there, `finish` once. After an error nothing more is called.
pub trait Sink: Send {
    /// What can go wrong.
    type Error: Send;

    /// The picture has `width` columns and `height` rows.
    ///
    /// # Errors
    /// Whatever keeps the sink from taking such a picture; it ends the run.
    fn start(&mut self, width: u32, height: u32) -> Result<(), Self::Error>;

    /// Whole rows, the first of them row `y`: sRGB-encoded, straight alpha, eight bits each.
    ///
    /// # Errors
    /// Whatever keeps the sink from taking the rows; it ends the run.
    fn rows(&mut self, y: u32, rows: &[[u8; 4]]) -> Result<(), Self::Error>;

    /// All rows have been handed over.
    ///
    /// # Errors
    /// Whatever keeps the sink from completing the picture.
    fn finish(&mut self) -> Result<(), Self::Error>;
}

/// A sink that keeps the picture in memory.
#[derive(Debug, Default)]
pub struct ImageSink {
    width: usize,
    pixels: Vec<[u8; 4]>,
}

impl ImageSink {
    /// An empty sink.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The picture: sRGB-encoded, straight alpha. Empty if nothing was rendered.
    #[must_use]
    pub fn into_image(self) -> Image<[u8; 4]> {
        let height = self.pixels.len().checked_div(self.width).unwrap_or(0);
        Image::from_vec(self.width, height, self.pixels).unwrap_or_default()
    }
}

impl Sink for ImageSink {
    type Error = Infallible;

    fn start(&mut self, width: u32, height: u32) -> Result<(), Infallible> {
        self.width = width as usize;
        self.pixels.clear();
        self.pixels.reserve_exact(width as usize * height as usize);
        Ok(())
    }

    fn rows(&mut self, _y: u32, rows: &[[u8; 4]]) -> Result<(), Infallible> {
        self.pixels.extend_from_slice(rows);
        Ok(())
    }

    fn finish(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}
