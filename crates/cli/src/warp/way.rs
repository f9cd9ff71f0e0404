//! Where things go: from the arguments to a map and a size.

use crate::args::{PixelOrigin, Quad, WarpSize, Way};
use crate::error::Failure;
use crate::input::Source;
use crate::picture::{self, Limits, Picture};
use crate::size::Canvas;
use scumble::geometry::{Affine, DVec2, Homography, Rect, Rectified, Winding};
use scumble::pixel::Image;
use scumble::texture::Footprint;
use scumble::warp::{self, Lookup};
use std::path::Path;

/// The longest side of a picture.
const MAX_SIDE: f64 = 1_073_741_823.0;

/// A map from the result to the picture.
#[derive(Debug, Clone)]
pub(crate) enum Map {
    Plane(Homography),
    Lookup(Lookup),
}

impl Map {
    /// Bytes that it takes.
    pub(super) fn memory(&self) -> u64 {
        match self {
            Self::Plane(_) => 0,
            Self::Lookup(map) => map.width() as u64 * map.height() as u64 * 8,
        }
    }
}

impl warp::Map for Map {
    fn at(&self, p: DVec2) -> Option<Footprint> {
        match self {
            Self::Plane(map) => warp::Map::at(map, p),
            Self::Lookup(map) => map.at(p),
        }
    }

    fn homography(&self) -> Option<Homography> {
        match self {
            Self::Plane(map) => Some(*map),
            Self::Lookup(_) => None,
        }
    }
}

/// The map and the size that the arguments mean for a picture.
pub(super) fn choose(
    way: &Way,
    picture: &Picture,
    limits: Limits,
) -> Result<(Map, Canvas), Failure> {
    let size = DVec2::new(picture.width.into(), picture.height.into());
    // The parser lets these pass beside another way.
    for (word, given, needs, there) in [
        ("--inverse", way.inverse, "--matrix", way.matrix.is_some()),
        ("--from", way.from.is_some(), "--to", way.to.is_some()),
    ] {
        if given && !there {
            return Err(Failure::Usage(format!("{word} is for {needs}, which is not there")));
        }
    }
    let origin = match way.pixel_origin {
        PixelOrigin::Corner => DVec2::ZERO,
        PixelOrigin::Center => DVec2::new(0.5, 0.5),
    };
    let (map, (width, height)) = if let Some(path) = &way.map {
        let memory = limits.memory.saturating_sub(picture.pixels.bytes());
        lookup(path, origin, way.size, Limits { memory, ..limits })?
    } else if let Some(corners) = way.rectify {
        rectified(moved(corners, origin), size, way.size)?
    } else {
        let map = forward(way, size, origin)?;
        plane(&map, size, way.size)?
    };
    let canvas = Canvas { width, height, crop: way.crop };
    canvas.check(limits.pixels)?;
    Ok((map, canvas))
}

fn moved(Quad(points): Quad, by: DVec2) -> [DVec2; 4] {
    points.map(|p| p + by)
}

/// The map from the picture to the result that --to or --matrix says, in coordinates of corners.
fn forward(way: &Way, size: DVec2, origin: DVec2) -> Result<Homography, Failure> {
    let corners = Rect::new(0.0, 0.0, size.x, size.y).corners();
    if let Some(to) = way.to {
        let to = moved(to, origin);
        let from = way.from.map_or(corners, |from| moved(from, origin));
        convex("--to", to)?;
        convex("--from", from)?;
        return Homography::from_points(from, to).map_err(|e| wrong("--to", e));
    }
    let Some(matrix) = way.matrix else {
        return Err(Failure::Usage("one of --to, --matrix, --rectify and --map is needed".into()));
    };
    let matrix =
        if way.inverse { matrix.inverse().map_err(|e| wrong("--matrix", e))? } else { matrix };
    let (there, back) =
        (Affine::translate(origin.x, origin.y), Affine::translate(-origin.x, -origin.y));
    let map = Homography::from(there) * matrix * Homography::from(back);
    // A matrix is often known but for its scale, and the sign of that is what lies before the eye:
    // most of the picture should.
    let before = |p: &DVec2| map.project_homogeneous(*p).z > 0.0;
    let seen =
        corners.iter().filter(|p| before(p)).count() * 2 + usize::from(before(&(size * 0.5)));
    Ok(if seen < 5 { Homography::new(map.m.map(|row| row.map(|v| -v))) } else { map })
}

fn convex(name: &str, quad: [DVec2; 4]) -> Result<Winding, Failure> {
    Winding::of_convex(quad).map_err(|e| wrong(name, e))
}

fn wrong(name: &str, error: impl std::fmt::Display) -> Failure {
    Failure::Usage(format!("{name}: {error}"))
}

fn plane(
    map: &Homography,
    size: DVec2,
    asked: Option<WarpSize>,
) -> Result<(Map, (u32, u32)), Failure> {
    let back = map.inverse().map_err(|e| wrong("--matrix", e))?;
    if let Some(WarpSize::Pixels(width, height)) = asked {
        return Ok((Map::Plane(back), (width, height)));
    }
    let corners = Rect::new(0.0, 0.0, size.x, size.y).corners();
    let seen = corners.map(|p| map.project(p));
    let far = seen.iter().try_fold(DVec2::ZERO, |far, p| p.map(|p| far.max(p)));
    let Some(far) = far else {
        return Err(Failure::Usage(
            "the picture reaches its horizon, so the result would be infinite; give --size".into(),
        ));
    };
    if far.x <= 0.0 || far.y <= 0.0 {
        return Err(Failure::Usage(
            "the picture goes left of or above the result's origin; move it, or give --size".into(),
        ));
    }
    Ok((Map::Plane(back), (side(round_up(far.x))?, side(round_up(far.y))?)))
}

/// The next whole number, but for what is only rounding.
fn round_up(v: f64) -> f64 {
    (v - 1e-6).ceil()
}

fn rectified(
    corners: [DVec2; 4],
    photo: DVec2,
    asked: Option<WarpSize>,
) -> Result<(Map, (u32, u32)), Failure> {
    let found = Rectified::new(corners, photo).map_err(|e| wrong("--rectify", e))?;
    if convex("--rectify", corners)? == Winding::Counterclockwise {
        return Err(Failure::Usage(
            "--rectify: the corners run counterclockwise, which would mirror the page; give top \
             left, top right, bottom right, bottom left"
                .to_owned(),
        ));
    }
    let (width, height) = match asked {
        Some(WarpSize::Pixels(width, height)) => (width, height),
        _ => (side(found.size.x.round())?, side(found.size.y.round())?),
    };
    Ok((Map::Plane(found.map(width.into(), height.into())), (width, height)))
}

fn lookup(
    path: &Path,
    origin: DVec2,
    asked: Option<WarpSize>,
    limits: Limits,
) -> Result<(Map, (u32, u32)), Failure> {
    let source = Source::new(path);
    let map = picture::read(&source, limits)?;
    if !map.origin.depth.is_float() || map.channels.count() < 3 {
        return Err(Failure::Failed(format!(
            "{}: a map has floats, the column in red and the row in green",
            source.name()
        )));
    }
    let size = (map.width, map.height);
    if let Some(WarpSize::Pixels(width, height)) = asked
        && (width, height) != size
    {
        return Err(Failure::Usage(format!(
            "--size {width}x{height}: the map, and so the result, is {} by {}",
            size.0, size.1
        )));
    }
    let count = map.channels.count();
    let alpha =
        |i: usize| if map.channels.has_alpha() { map.pixels.at(i + count - 1) } else { 1.0 };
    // An alpha that is nowhere says nothing: some programs add one and leave it empty.
    let masked = (0..map.pixels.len()).step_by(count).any(|i| alpha(i) >= 0.5);
    let at = |x: usize, y: usize| {
        let i = (y * size.0 as usize + x) * count;
        let (u, v) = (map.pixels.at(i), map.pixels.at(i + 1));
        // Written so that a NaN is nothing.
        let is_there = !masked || alpha(i) >= 0.5;
        if is_there { [u + origin.x as f32, v + origin.y as f32] } else { [f32::NAN; 2] }
    };
    let positions = Image::from_fn(size.0 as usize, size.1 as usize, at);
    let positions = positions.map_err(|e| Failure::Limit(format!("{}: {e}", source.name())))?;
    Ok((Map::Lookup(Lookup::new(positions)), size))
}

/// A side of the result in pixels.
fn side(pixels: f64) -> Result<u32, Failure> {
    if pixels > MAX_SIDE || pixels.is_nan() {
        return Err(Failure::Limit(format!(
            "the result would be {pixels:.0} pixels long; a side has at most {MAX_SIDE:.0}"
        )));
    }
    // In range by the test above, and whole.
    Ok(pixels.max(1.0) as u32)
}
