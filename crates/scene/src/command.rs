use crate::ImageId;
use scumble_geometry::{DVec2, FillRule, Homography, Path, Rect, StrokeStyle};
use scumble_pixel::Straight;
use std::sync::Arc;

/// One step of painting.
#[derive(Debug, Clone, PartialEq)]
pub enum Command {
    /// Begins a group that is painted apart, on nothing, and then laid over what is below.
    PushLayer {
        /// Opacity of the group as a whole, in 0…1.
        opacity: f32,
    },
    /// Ends the innermost group.
    PopLayer,
    /// A filled outline.
    Fill(Fill),
    /// A stroked outline.
    Stroke(Stroke),
    /// A triangle with a colour at each corner.
    Gouraud(GouraudTriangle),
    /// A triangle of a texture.
    Textured(TexturedTriangle),
    /// A picture in a rectangle.
    Image(ImageQuad),
    /// A line that is one pixel wide at any scale.
    Hairline(Hairline),
    /// One whole pixel.
    Point(Point),
}

/// An outline filled with one colour.
#[derive(Debug, Clone, PartialEq)]
pub struct Fill {
    /// The outline, in its own units; open contours are closed.
    pub path: Arc<Path>,
    /// What counts as inside.
    pub rule: FillRule,
    /// From the path's units to scene units.
    pub transform: Homography,
    /// The paint.
    pub color: Straight,
}

/// The stroke of an outline in one colour. It is widened in the path's own units, before the
/// transform, as SVG does; the renderer widens it, because only it knows how fine curves must be.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// The outline, in its own units.
    pub path: Arc<Path>,
    /// Width, joins, caps and dashes, in the path's units.
    pub style: StrokeStyle,
    /// From the path's units to scene units.
    pub transform: Homography,
    /// The paint.
    pub color: Straight,
}

impl Stroke {
    /// How many pixels a unit of the path's coordinates is worth on the canvas, at the most, for a
    /// map from those units to pixels. At least a little, and near a horizon, where it has no
    /// bound, at most 10⁴: curves that fine serve any picture.
    #[must_use]
    pub fn largest_scale(&self, to_canvas: &Homography) -> f64 {
        let corners = self.path.bounds().into_iter().flat_map(|rect| rect.corners());
        let largest = corners
            .map(|p| to_canvas.jacobian(p).axes().major)
            .filter(|scale| scale.is_finite())
            .fold(0.0, f64::max);
        if largest > 0.0 { largest.min(1e4) } else { 1.0 }
    }
}

/// A triangle with colours interpolated between its corners.
#[derive(Debug, Clone, PartialEq)]
pub struct GouraudTriangle {
    /// The corners, in either winding.
    pub points: [DVec2; 3],
    /// The colour of each corner.
    pub colors: [Straight; 3],
    /// From the points' units to scene units.
    pub transform: Homography,
}

/// A triangle whose colours come from an image.
#[derive(Debug, Clone, PartialEq)]
pub struct TexturedTriangle {
    /// The corners, in either winding.
    pub points: [DVec2; 3],
    /// Where each corner lies in the image: (0, 0) its top left corner, (1, 1) its bottom right.
    pub uvs: [DVec2; 3],
    /// The image.
    pub image: ImageId,
    /// Opacity in 0…1.
    pub opacity: f32,
    /// From the points' units to scene units.
    pub transform: Homography,
}

/// A picture drawn into a rectangle, edge to edge.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageQuad {
    /// The image.
    pub image: ImageId,
    /// Where it goes, in its own units.
    pub rect: Rect,
    /// The part of the image that fills the rectangle: (0, 0) to (1, 1) is all of it.
    pub source: Rect,
    /// Whether to show texels as they are, without filtering (`image-rendering: pixelated`).
    pub pixelated: bool,
    /// Opacity in 0…1.
    pub opacity: f32,
    /// From the rectangle's units to scene units.
    pub transform: Homography,
}

/// A line one pixel wide. At one sample a pixel it is a chain of whole pixels, one for each step
/// along its longer direction; with more samples it is an antialiased quad.
#[derive(Debug, Clone, PartialEq)]
pub struct Hairline {
    /// One end.
    pub from: DVec2,
    /// The other end.
    pub to: DVec2,
    /// The paint.
    pub color: Straight,
    /// From the ends' units to scene units.
    pub transform: Homography,
}

/// The one pixel that holds a position, whole.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// The position.
    pub position: DVec2,
    /// The paint.
    pub color: Straight,
    /// From the position's units to scene units.
    pub transform: Homography,
}
