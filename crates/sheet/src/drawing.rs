use crate::font;
use scumble_geometry::{Cap, DVec2, FillRule, Homography, Join, Path, Rect, StrokeStyle};
use scumble_pixel::{Image, Straight};
use scumble_scene::{
    Command, Fill, ImageId, ImageQuad, ImageWrap, Scene, SceneImage, Stroke, View,
};
use std::sync::Arc;

/// The colour of words and frames: nearly black.
pub const INK: Straight = Straight([0.125, 0.125, 0.125, 1.0]);

/// Which point of a line of text is at the place given for it, on the baseline.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Anchor {
    /// Its beginning.
    #[default]
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// A sheet under construction: white, and what is put on it, later things on top.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    width: u32,
    height: u32,
    images: Vec<SceneImage>,
    commands: Vec<Command>,
}

impl Drawing {
    /// An empty sheet of so many pixels.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self { width, height, images: Vec::new(), commands: Vec::new() }
    }

    /// Columns of the sheet.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows of the sheet.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Fills a path, holes and all, by the nonzero rule.
    pub fn fill(&mut self, path: Path, color: Straight) -> &mut Self {
        self.commands.push(Command::Fill(Fill {
            path: Arc::new(path),
            rule: FillRule::NonZero,
            transform: Homography::IDENTITY,
            color,
        }));
        self
    }

    /// Fills a rectangle.
    pub fn rect(&mut self, rect: Rect, color: Straight) -> &mut Self {
        self.fill(Path::rect(rect), color)
    }

    /// Fills a disc.
    pub fn dot(&mut self, center: DVec2, radius: f64, color: Straight) -> &mut Self {
        self.fill(Path::ellipse(center, DVec2::new(radius, radius)), color)
    }

    /// Draws along a path with a round pen.
    pub fn stroke(&mut self, path: Path, width: f64, color: Straight) -> &mut Self {
        self.pen(path, width, Vec::new(), color)
    }

    /// Draws a line through points with a round pen.
    pub fn line(
        &mut self,
        points: impl IntoIterator<Item = DVec2>,
        width: f64,
        color: Straight,
    ) -> &mut Self {
        self.stroke(Path::polyline(points, false), width, color)
    }

    /// As [`line`](Self::line), in dashes and gaps of equal length.
    pub fn dashed(
        &mut self,
        points: impl IntoIterator<Item = DVec2>,
        width: f64,
        dash: f64,
        color: Straight,
    ) -> &mut Self {
        self.pen(Path::polyline(points, false), width, vec![dash; 2], color)
    }

    /// A line of text.
    pub fn text(
        &mut self,
        at: DVec2,
        size: f64,
        anchor: Anchor,
        text: &str,
        color: Straight,
    ) -> &mut Self {
        let width = font::text_width(text, size);
        let before = match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => width / 2.0,
            Anchor::End => width,
        };
        let path = font::strokes(text, size, at - DVec2::new(before, 0.0));
        self.stroke(path, font::pen(size), color)
    }

    /// A picture, its top left corner at a pixel's, each of its pixels a square of `scale` pixels. One
    /// without pixels, and a scale of 0, draw nothing.
    pub fn picture(&mut self, picture: Image<[u8; 4]>, x: u32, y: u32, scale: u32) -> &mut Self {
        if picture.pixels().is_empty() || scale == 0 {
            return self;
        }
        let (x0, y0, scale) = (f64::from(x), f64::from(y), f64::from(scale));
        let (width, height) = (picture.width() as f64, picture.height() as f64);
        let image = ImageId(self.images.len());
        self.images.push(SceneImage { pixels: picture, wrap: ImageWrap::Clamp });
        self.commands.push(Command::Image(ImageQuad {
            image,
            rect: Rect::new(x0, y0, x0 + width * scale, y0 + height * scale),
            source: Rect::new(0.0, 0.0, 1.0, 1.0),
            pixelated: true,
            opacity: 1.0,
            transform: Homography::IDENTITY,
        }));
        self
    }

    /// The sheet as a scene of its own size, on white.
    #[must_use]
    pub fn into_scene(self) -> Scene {
        Scene {
            view: View::Fit { size: DVec2::new(f64::from(self.width), f64::from(self.height)) },
            background: Some(Straight::WHITE),
            images: self.images,
            commands: self.commands,
        }
    }

    fn pen(&mut self, path: Path, width: f64, dashes: Vec<f64>, color: Straight) -> &mut Self {
        let cap = if dashes.is_empty() { Cap::Round } else { Cap::Butt };
        self.commands.push(Command::Stroke(Stroke {
            path: Arc::new(path),
            style: StrokeStyle { width, join: Join::Round, cap, dashes, ..StrokeStyle::default() },
            transform: Homography::IDENTITY,
            color,
        }));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_anchor_moves_the_line() {
        let bounds = |anchor| {
            let mut drawing = Drawing::new(9, 9);
            drawing.text(DVec2::new(100.0, 0.0), 20.0, anchor, "HH", INK);
            match &drawing.into_scene().commands[0] {
                Command::Stroke(stroke) => stroke.path.bounds().unwrap(),
                other => panic!("{other:?}"),
            }
        };
        let width = font::text_width("HH", 20.0);
        assert_eq!(bounds(Anchor::Start).x0, 100.0);
        assert_eq!(bounds(Anchor::End).x1, 100.0);
        assert_eq!(bounds(Anchor::Middle).x0, 100.0 - width / 2.0);
    }

    #[test]
    fn a_picture_lies_on_whole_pixels() {
        let mut drawing = Drawing::new(50, 50);
        let picture = Image::filled(4, 3, [9; 4]).unwrap();
        drawing.picture(picture.clone(), 5, 6, 3).picture(picture, 0, 0, 0);
        drawing.picture(Image::default(), 0, 0, 1);
        let scene = drawing.into_scene();
        assert_eq!((scene.images.len(), scene.commands.len()), (1, 1));
        match &scene.commands[0] {
            Command::Image(quad) => assert_eq!(quad.rect, Rect::new(5.0, 6.0, 17.0, 15.0)),
            other => panic!("{other:?}"),
        }
    }
}
