use scumble_pixel::Image;
use std::convert::Infallible;

/// Where finished rows go: an image in memory, a file being written, a window.
///
/// The calls come in order, from one thread at a time: `start` once, `rows` from the top down
/// until all are there, `finish` once. After an error nothing more is called.
///
/// `P` is a pixel: RGBA with straight alpha in eight bits, or whatever else the work that feeds it
/// offers ([`warp::OutputPixel`](crate::warp::OutputPixel)).
pub trait Sink<P = [u8; 4]>: Send {
    /// What can go wrong.
    type Error: Send;

    /// The picture has `width` columns and `height` rows.
    ///
    /// # Errors
    /// Whatever keeps the sink from taking such a picture; it ends the run.
    fn start(&mut self, width: u32, height: u32) -> Result<(), Self::Error>;

    /// Whole rows, the first of them row `y`.
    ///
    /// # Errors
    /// Whatever keeps the sink from taking the rows; it ends the run.
    fn rows(&mut self, y: u32, rows: &[P]) -> Result<(), Self::Error>;

    /// All rows have been handed over.
    ///
    /// # Errors
    /// Whatever keeps the sink from completing the picture.
    fn finish(&mut self) -> Result<(), Self::Error>;
}

/// A sink that keeps the picture in memory.
#[derive(Debug)]
pub struct ImageSink<P = [u8; 4]> {
    width: usize,
    pixels: Vec<P>,
}

impl<P> Default for ImageSink<P> {
    fn default() -> Self {
        Self { width: 0, pixels: Vec::new() }
    }
}

impl<P> ImageSink<P> {
    /// An empty sink.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The picture. Empty if nothing was rendered.
    #[must_use]
    pub fn into_image(self) -> Image<P> {
        let height = self.pixels.len().checked_div(self.width).unwrap_or(0);
        Image::from_vec(self.width, height, self.pixels).unwrap_or_default()
    }
}

impl<P: Copy + Send> Sink<P> for ImageSink<P> {
    type Error = Infallible;

    fn start(&mut self, width: u32, height: u32) -> Result<(), Infallible> {
        self.width = width as usize;
        self.pixels.clear();
        self.pixels.reserve_exact(width as usize * height as usize);
        Ok(())
    }

    fn rows(&mut self, _y: u32, rows: &[P]) -> Result<(), Infallible> {
        self.pixels.extend_from_slice(rows);
        Ok(())
    }

    fn finish(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}
