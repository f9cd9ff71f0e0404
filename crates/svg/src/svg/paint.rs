//! Paths, paints and strokes of usvg in our terms.

use scumble_geometry::{Cap, DVec2, FillRule, Homography, Join, Path, Rect, StrokeStyle};
use scumble_pixel::Straight;
use scumble_scene::Command;
use usvg::tiny_skia_path::{self, PathSegment};

pub(super) fn path(data: &tiny_skia_path::Path) -> Path {
    let point = |p: tiny_skia_path::Point| DVec2::new(f64::from(p.x), f64::from(p.y));
    let mut out = Path::new();
    for segment in data.segments() {
        match segment {
            PathSegment::MoveTo(p) => out.move_to(point(p)),
            PathSegment::LineTo(p) => out.line_to(point(p)),
            PathSegment::QuadTo(c, p) => out.quad_to(point(c), point(p)),
            PathSegment::CubicTo(c0, c1, p) => out.cubic_to(point(c0), point(c1), point(p)),
            PathSegment::Close => out.close(),
        };
    }
    out
}

pub(super) fn color(color: usvg::Color, opacity: f32) -> Straight {
    let channel = |v: u8| f32::from(v) / 255.0;
    Straight([channel(color.red), channel(color.green), channel(color.blue), opacity])
}

/// The mean colour over a gradient's offsets from 0 to 1, which stands for the gradient.
pub(super) fn mean_color(gradient: &usvg::BaseGradient, opacity: f32) -> Straight {
    let stops = gradient.stops();
    let at = |stop: &usvg::Stop| color(stop.color(), stop.opacity().get()).premultiply().0;
    let (Some(first), Some(last)) = (stops.first(), stops.last()) else {
        return Straight([0.0; 4]);
    };
    let mut sum = [0.0; 4];
    let mut add = |weight: f32, c: [f32; 4]| {
        for (s, v) in sum.iter_mut().zip(c) {
            *s += weight * v;
        }
    };
    add(first.offset().get(), at(first));
    add(1.0 - last.offset().get(), at(last));
    for pair in stops.windows(2) {
        let half = (pair[1].offset().get() - pair[0].offset().get()) / 2.0;
        add(half, at(&pair[0]));
        add(half, at(&pair[1]));
    }
    let [r, g, b, a] = sum;
    if a <= 0.0 {
        return Straight([0.0; 4]);
    }
    let channel = |v: f32| (v / a).clamp(0.0, 1.0);
    Straight([channel(r), channel(g), channel(b), (a * opacity).clamp(0.0, 1.0)])
}

pub(super) fn fill_rule(rule: usvg::FillRule) -> FillRule {
    match rule {
        usvg::FillRule::NonZero => FillRule::NonZero,
        usvg::FillRule::EvenOdd => FillRule::EvenOdd,
    }
}

pub(super) fn stroke_style(stroke: &usvg::Stroke) -> StrokeStyle {
    StrokeStyle {
        width: f64::from(stroke.width().get()),
        join: match stroke.linejoin() {
            usvg::LineJoin::Miter | usvg::LineJoin::MiterClip => Join::Miter,
            usvg::LineJoin::Round => Join::Round,
            usvg::LineJoin::Bevel => Join::Bevel,
        },
        cap: match stroke.linecap() {
            usvg::LineCap::Butt => Cap::Butt,
            usvg::LineCap::Round => Cap::Round,
            usvg::LineCap::Square => Cap::Square,
        },
        miter_limit: f64::from(stroke.miterlimit().get()),
        dashes: stroke.dasharray().unwrap_or_default().iter().map(|&v| f64::from(v)).collect(),
        dash_offset: f64::from(stroke.dashoffset()),
    }
}

/// Most dashes and gaps that one path is cut into: as many as geometry cuts a contour into, so that
/// none is left whole without a warning.
const MAX_DASHES: f64 = (1u32 << 16) as f64;

/// Takes the dashes away if a path would have too many to be told apart, and says whether it did.
pub(super) fn limit_dashes(style: &mut StrokeStyle, path: &Path) -> bool {
    let period: f64 = style.dashes.iter().sum();
    let count = control_length(path) / period * style.dashes.len() as f64;
    // NaN comes from a length beyond numbers.
    let too_many = !style.dashes.is_empty() && (count.is_nan() || count > MAX_DASHES);
    if too_many {
        style.dashes.clear();
    }
    too_many
}

/// The length of the lines between a path's points, controls included: not less than the path's.
fn control_length(path: &Path) -> f64 {
    use scumble_geometry::PathElement as E;
    let (mut length, mut start, mut at) = (0.0, DVec2::ZERO, DVec2::ZERO);
    for element in path.elements() {
        let from = at;
        let (steps, end) = match *element {
            E::MoveTo(p) => {
                start = p;
                (0.0, p)
            }
            E::LineTo(p) => (from.distance(p), p),
            E::QuadTo(c, p) => (from.distance(c) + c.distance(p), p),
            E::CubicTo(c0, c1, p) => (from.distance(c0) + c0.distance(c1) + c1.distance(p), p),
            E::Close => (from.distance(start), start),
        };
        length += steps;
        at = end;
    }
    length
}

/// The right and the bottom end of everything, from (0, 0); `None` if that has no area.
pub(super) fn extent(commands: &[Command]) -> Option<DVec2> {
    let mut end = DVec2::ZERO;
    let mut add = |map: &Homography, points: &[DVec2]| {
        for p in points.iter().filter_map(|&p| map.project(p)) {
            end = end.max(p);
        }
    };
    for command in commands {
        match command {
            Command::Fill(c) => {
                if let Some(bounds) = c.path.bounds() {
                    add(&c.transform, &bounds.corners());
                }
            }
            Command::Stroke(c) => {
                if let Some(b) = c.path.bounds() {
                    let half = c.style.width / 2.0;
                    let wide = Rect::new(b.x0 - half, b.y0 - half, b.x1 + half, b.y1 + half);
                    add(&c.transform, &wide.corners());
                }
            }
            Command::Gouraud(c) => add(&c.transform, &c.points),
            Command::Textured(c) => add(&c.transform, &c.points),
            Command::Image(c) => add(&c.transform, &c.rect.corners()),
            Command::Hairline(c) => add(&c.transform, &[c.from, c.to]),
            Command::Point(c) => add(&c.transform, &[c.position]),
            Command::PushLayer { .. } | Command::PopLayer => {}
        }
    }
    (end.x > 0.0 && end.y > 0.0 && end.is_finite()).then_some(end)
}
