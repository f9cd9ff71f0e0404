use super::Map;
use crate::geometry::{DVec2, Matrix2};
use crate::pixel::Image;
use crate::texture::Footprint;

/// A map that stands in a picture: for each pixel of the output, where its centre lies in the source.
///
/// Between the centres it is interpolated, and its derivatives are differences between neighbours, taken
/// on both sides where both are there. A lens, or anything else that another program has computed.
#[derive(Debug, Clone)]
pub struct Lookup {
    positions: Image<[f32; 2]>,
}

impl Lookup {
    /// From the positions of the pixels' centres, in texels of the source. One that is not finite says
    /// that there is nothing.
    #[must_use]
    pub fn new(positions: Image<[f32; 2]>) -> Self {
        Self { positions }
    }

    /// Columns of the output.
    #[must_use]
    pub fn width(&self) -> usize {
        self.positions.width()
    }

    /// Rows of the output.
    #[must_use]
    pub fn height(&self) -> usize {
        self.positions.height()
    }

    /// What stands at a pixel, if it lies in the picture and is a place.
    fn place(&self, x: i64, y: i64) -> Option<DVec2> {
        let [x, y] = [usize::try_from(x).ok()?, usize::try_from(y).ok()?];
        let &[u, v] = self.positions.get(x, y)?;
        let place = DVec2::new(f64::from(u), f64::from(v));
        place.is_finite().then_some(place)
    }

    /// The difference between a pixel's neighbours in the direction of a step, for one pixel.
    fn difference(&self, here: DVec2, x: i64, y: i64, (dx, dy): (i64, i64)) -> Option<DVec2> {
        let before = self.place(x - dx, y - dy);
        let after = self.place(x + dx, y + dy);
        match (before, after) {
            (Some(before), Some(after)) => Some((after - before) * 0.5),
            (Some(before), None) => Some(here - before),
            (None, Some(after)) => Some(after - here),
            (None, None) => None,
        }
    }

    /// The footprint at the centre of a pixel. A pixel without neighbours on an axis sees as much along
    /// it as along the other.
    fn pixel(&self, x: i64, y: i64) -> Option<Footprint> {
        let here = self.place(x, y)?;
        let (along, down) =
            match (self.difference(here, x, y, (1, 0)), self.difference(here, x, y, (0, 1))) {
                (Some(along), Some(down)) => (along, down),
                (Some(along), None) => (along, DVec2::new(-along.y, along.x)),
                (None, Some(down)) => (DVec2::new(down.y, -down.x), down),
                (None, None) => (DVec2::new(1.0, 0.0), DVec2::new(0.0, 1.0)),
            };
        let jacobian = Matrix2::new(along.x, down.x, along.y, down.y);
        Some(Footprint { u: here.x, v: here.y, jacobian })
    }
}

impl Map for Lookup {
    fn at(&self, p: DVec2) -> Option<Footprint> {
        let corner = (p - DVec2::new(0.5, 0.5)).floor();
        let part = p - DVec2::new(0.5, 0.5) - corner;
        let (x, y) = (corner.x as i64, corner.y as i64);
        if part == DVec2::ZERO {
            return self.pixel(x, y);
        }
        // What lies within half a pixel of the picture's edge goes on as the edge does.
        let inside = |i: i64, n: usize| i.clamp(0, (n as i64 - 2).max(0));
        let (x0, y0) = (inside(x, self.width()), inside(y, self.height()));
        let part = part + DVec2::new((x - x0) as f64, (y - y0) as f64);
        // Written so that a NaN lies outside.
        let close = |v: f64| v.abs() <= 2.0;
        if !(close(part.x) && close(part.y)) {
            return None;
        }
        let (x1, y1) = (x0 + i64::from(self.width() > 1), y0 + i64::from(self.height() > 1));
        let [a, b, c, d] = [(x0, y0), (x1, y0), (x0, y1), (x1, y1)].map(|(x, y)| self.place(x, y));
        let (a, b, c, d) = (a?, b?, c?, d?);
        let (top, bottom) = (a + (b - a) * part.x, c + (d - c) * part.x);
        let here = top + (bottom - top) * part.y;
        let nearest = self.pixel(
            (x0 + i64::from(part.x > 0.5)).min(x1),
            (y0 + i64::from(part.y > 0.5)).min(y1),
        )?;
        Some(Footprint { u: here.x, v: here.y, jacobian: nearest.jacobian })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn linear(width: usize, height: usize) -> Lookup {
        let at = |x: usize, y: usize| {
            let (x, y) = (x as f32 + 0.5, y as f32 + 0.5);
            [2.0 * x + 0.5 * y + 1.0, 4.0 * y - x]
        };
        Lookup::new(Image::from_fn(width, height, at).unwrap())
    }

    #[test]
    fn a_linear_map_is_itself_everywhere() {
        let map = linear(5, 4);
        for (x, y) in [(0.5, 0.5), (4.5, 3.5), (2.5, 1.5), (2.2, 3.1), (0.0, 4.0), (5.0, 0.0)] {
            let f = map.at(DVec2::new(x, y)).unwrap();
            let expected = DVec2::new(2.0 * x + 0.5 * y + 1.0, 4.0 * y - x);
            assert!((DVec2::new(f.u, f.v) - expected).length() < 1e-12, "{x} {y}");
            assert_eq!(f.jacobian, Matrix2::new(2.0, 0.5, -1.0, 4.0));
        }
        assert!(map.at(DVec2::new(60.0, 1.0)).is_none());
        assert!(map.at(DVec2::new(f64::NAN, 1.0)).is_none());
    }

    #[test]
    fn holes_and_edges_are_no_trouble() {
        let mut image = Image::filled(3, 3, [f32::NAN; 2]).unwrap();
        assert!(Lookup::new(image.clone()).at(DVec2::new(1.5, 1.5)).is_none());
        image.row_mut(1)[1] = [7.0, 8.0];
        let alone = Lookup::new(image).at(DVec2::new(1.5, 1.5)).unwrap();
        assert_eq!((alone.u, alone.v), (7.0, 8.0));
        assert!(alone.jacobian.is_finite());
        let one = Lookup::new(Image::filled(1, 1, [3.0, 4.0]).unwrap());
        assert_eq!(one.at(DVec2::new(0.7, 0.2)).map(|f| f.u), Some(3.0));
        let none = Lookup::new(Image::default());
        assert!(none.at(DVec2::new(0.5, 0.5)).is_none() && none.at(DVec2::ZERO).is_none());
    }
}
