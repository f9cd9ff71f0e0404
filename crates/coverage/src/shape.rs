use crate::polygon::Polygon;
use crate::triangle::Triangle;
use crate::{AreaSink, CoverageError, SamplePattern, Scratch, Sink, Traversal, guard};
use alloc::boxed::Box;
use scumble_geometry::{DVec2, FillRule, IntRect};

/// How much of a rectangle a shape covers, as far as a quick test tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Cover {
    /// No sample of the rectangle, whatever the pattern: certain.
    None,
    /// Perhaps some: the quick test does not know.
    Partial,
    /// Every sample of the rectangle, whatever the pattern: certain.
    Full,
}

/// A primitive set up for rasterization: a triangle or a polygon, snapped to 1/256 pixel.
#[derive(Debug, Clone)]
pub struct Shape(Kind);

#[derive(Debug, Clone)]
enum Kind {
    Triangle(Triangle),
    Polygon(Box<Polygon>),
}

impl Shape {
    /// A triangle of either winding. `None` if it has no area once its corners are snapped to
    /// 1/256 pixel: such a triangle owns no sample.
    ///
    /// # Errors
    /// [`CoverageError::NotFinite`] for a NaN or infinite coordinate. Any finite triangle is
    /// right; what lies beyond ±2²¹ pixels is clipped away.
    pub fn triangle(p: [DVec2; 3]) -> Result<Option<Self>, CoverageError> {
        if let Some(fixed) = Triangle::snap(p) {
            return Ok(Triangle::new(fixed).map(|t| Self(Kind::Triangle(t))));
        }
        Self::polygon([&p[..]], FillRule::NonZero)
    }

    /// A polygon of any number of contours, each closed by itself, filled by `rule`. Contours may
    /// cross themselves and each other. `None` if none of them encloses an area once snapped.
    ///
    /// # Errors
    /// [`CoverageError::NotFinite`] for a NaN or infinite coordinate.
    pub fn polygon<'a>(
        contours: impl IntoIterator<Item = &'a [DVec2]>,
        rule: FillRule,
    ) -> Result<Option<Self>, CoverageError> {
        let mut builder = Polygon::builder();
        for contour in contours {
            if builder.push_snapped(contour) {
                builder.close();
                continue;
            }
            if let Some(&bad) = contour.iter().find(|p| !p.is_finite()) {
                return Err(CoverageError::NotFinite(bad));
            }
            for (i, &p) in contour.iter().enumerate() {
                let next = contour[if i + 1 < contour.len() { i + 1 } else { 0 }];
                guard::clamp_segment(p, next, |v| builder.push(v));
            }
            builder.close();
        }
        if let Some(corners) = builder.triangle() {
            return Ok(Triangle::new(corners).map(|t| Self(Kind::Triangle(t))));
        }
        Ok(builder.finish(rule).map(|p| Self(Kind::Polygon(Box::new(p)))))
    }

    /// How many edges the outline has that cross rows, once snapped: what it costs to draw, apart
    /// from the pixels.
    #[must_use]
    pub fn edge_count(&self) -> usize {
        match &self.0 {
            Kind::Triangle(_) => 3,
            Kind::Polygon(p) => p.edge_count(),
        }
    }

    /// The pixels that can own a sample: no other does, whatever the pattern.
    #[must_use]
    pub fn bounds(&self) -> IntRect {
        match &self.0 {
            Kind::Triangle(t) => t.bounds(),
            Kind::Polygon(p) => p.bounds(),
        }
    }

    /// A quick test of a rectangle of pixels, for binning and for dropping what is hidden.
    /// An empty rectangle is not covered.
    #[must_use]
    pub fn covers(&self, rect: IntRect) -> Cover {
        // Beyond the bounds nothing is covered, so only the part within needs a look.
        let inner = rect.intersect(&self.bounds());
        if inner.is_empty() {
            return Cover::None;
        }
        let cover = match &self.0 {
            Kind::Triangle(t) => t.covers(inner),
            Kind::Polygon(p) => p.covers(inner),
        };
        if cover == Cover::Full && inner != rect { Cover::Partial } else { cover }
    }

    /// Names every sample of `pattern` that the shape covers within `clip`.
    ///
    /// The set of samples does not depend on `clip`: cutting the picture into tiles of any size and
    /// calling this once for each gives the same.
    pub fn rasterize(
        &self,
        clip: IntRect,
        pattern: &SamplePattern,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) {
        let region = clip.intersect(&self.bounds());
        if region.is_empty() {
            return;
        }
        match &self.0 {
            Kind::Triangle(t) => {
                t.rasterize(region, pattern, scratch.level, &mut scratch.triangle, sink);
            }
            Kind::Polygon(p) => {
                p.rasterize(region, pattern, scratch.level, &mut scratch.polygon, sink);
            }
        }
    }

    /// [`Shape::rasterize`] by another way of finding the samples: the same samples, in another
    /// order and another time.
    pub fn rasterize_by(
        &self,
        traversal: Traversal,
        clip: IntRect,
        pattern: &SamplePattern,
        scratch: &mut Scratch,
        sink: &mut impl Sink,
    ) {
        let region = clip.intersect(&self.bounds());
        if region.is_empty() {
            return;
        }
        match (&self.0, traversal) {
            (_, Traversal::Tiled) => self.rasterize(clip, pattern, scratch, sink),
            (Kind::Triangle(t), _) => t.traverse(traversal, region, pattern, sink),
            (Kind::Polygon(p), Traversal::BoundingBox) => p.test_each(region, pattern, sink),
            (Kind::Polygon(_), _) => self.rasterize(clip, pattern, scratch, sink),
        }
    }

    /// Tells how much of each pixel within `clip` the shape covers.
    ///
    /// The area is that of the snapped shape, exact to about 10⁻⁷ (the error of each edge in a
    /// pixel is 2⁻³², the result an f32), overlaps and crossings counted by the fill rule. It does
    /// not depend on `clip`, and the areas of the pieces of a mesh add up to the area of the whole
    /// (the [crate] page has the fine print on scribbles).
    pub fn rasterize_area(&self, clip: IntRect, scratch: &mut Scratch, sink: &mut impl AreaSink) {
        let region = clip.intersect(&self.bounds());
        if region.is_empty() {
            return;
        }
        match &self.0 {
            Kind::Triangle(t) => t.rasterize_area(region, scratch.level, &mut scratch.area, sink),
            Kind::Polygon(p) => p.rasterize_area(region, scratch.level, &mut scratch.polygon, sink),
        }
    }
}
