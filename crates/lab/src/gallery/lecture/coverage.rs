//! Which samples a triangle covers, and how they are found.

use crate::gallery::ink::{BLUE, GREEN, GREY, LIGHT, RED, YELLOW, codes, finish};
use crate::gallery::{Drawn, GalleryError};
use crate::svg::polar;
use scumble::coverage::{
    Cover, IntRect, Order, SampleMask, SamplePattern, Scratch, Shape, Sink, Traversal,
};
use scumble_geometry::{DVec2, Path, Rect};
use scumble_pixel::{Image, Straight};
use scumble_sheet::{Anchor, Cell, Drawing, INK, contact_sheet};

type Points = [DVec2; 3];

const fn p(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

/// The triangle of the small grids, in pixels of theirs.
const SMALL: Points = [p(0.7, 3.3), p(8.3, 0.6), p(9.2, 5.6)];

/// Every sample that a shape covers, in the order in which it is named.
#[derive(Default)]
struct Found(Vec<(i32, i32, u64)>);

impl Sink for Found {
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        self.0.extend((x0..x1).map(|x| (x, y, u64::MAX)));
    }

    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask) {
        self.0.push((x, y, mask.0));
    }
}

fn find(
    points: Points,
    width: i32,
    height: i32,
    pattern: &SamplePattern,
    traversal: Traversal,
) -> Result<Found, GalleryError> {
    let mut found = Found::default();
    if let Some(shape) = Shape::triangle(points)? {
        let clip = IntRect::new(0, 0, width, height);
        shape.rasterize_by(traversal, clip, pattern, &mut Scratch::new(), &mut found);
    }
    Ok(found)
}

/// A grid of square pixels on a drawing.
#[derive(Clone, Copy)]
struct Grid {
    at: DVec2,
    side: f64,
    columns: i32,
    rows: i32,
}

impl Grid {
    fn place(&self, q: DVec2) -> DVec2 {
        self.at + q * self.side
    }

    fn pixel(&self, x: i32, y: i32) -> Rect {
        let a = self.place(p(f64::from(x), f64::from(y)));
        Rect::new(a.x, a.y, a.x + self.side, a.y + self.side)
    }

    fn lines(&self, drawing: &mut Drawing) {
        let (w, h) = (f64::from(self.columns), f64::from(self.rows));
        for x in 0..=self.columns {
            let x = f64::from(x);
            drawing.line([self.place(p(x, 0.0)), self.place(p(x, h))], 1.0, LIGHT);
        }
        for y in 0..=self.rows {
            let y = f64::from(y);
            drawing.line([self.place(p(0.0, y)), self.place(p(w, y))], 1.0, LIGHT);
        }
    }

    fn outline(&self, drawing: &mut Drawing, points: &[DVec2], color: Straight) {
        let placed = points.iter().map(|&q| self.place(q));
        drawing.stroke(Path::polyline(placed, true), 1.6, color);
    }
}

pub(super) fn centres() -> Drawn {
    let mut drawing = Drawing::new(900, 300);
    let pattern = SamplePattern::grid(1)?;
    let found = find(SMALL, 10, 6, &pattern, Traversal::Tiled)?;
    for left in [15.0, 465.0] {
        let grid = Grid { at: p(left, 18.0), side: 42.0, columns: 10, rows: 6 };
        let filled = left > 100.0;
        for &(x, y, _) in found.0.iter().filter(|_| filled) {
            drawing.rect(grid.pixel(x, y), RED);
        }
        grid.lines(&mut drawing);
        for (x, y) in (0..6).flat_map(|y| (0..10).map(move |x| (x, y))).filter(|_| !filled) {
            let covered = found.0.iter().any(|f| (f.0, f.1) == (x, y));
            let centre = grid.place(p(f64::from(x) + 0.5, f64::from(y) + 0.5));
            drawing.dot(centre, 4.6, if covered { RED } else { GREY });
        }
        grid.outline(&mut drawing, &SMALL, INK);
    }
    finish(drawing)
}

/// The edge function: above 0 to the right of the way from `a` to `b`, y being down.
fn edge(a: DVec2, b: DVec2, q: DVec2) -> f64 {
    (b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x)
}

pub(super) fn half_planes() -> Drawn {
    const SIDE: f64 = 206.0;
    let points = [p(36.0, 150.0), p(92.0, 28.0), p(178.0, 120.0)];
    let mut drawing = Drawing::new(900, 250);
    let tint = [codes(RED), codes(GREEN), codes(BLUE), codes(YELLOW)];
    for panel in 0..4 {
        let left = 14 + 222 * panel as u32;
        let inside = |q: DVec2, i: usize| edge(points[i], points[(i + 1) % 3], q) > 0.0;
        let picture = Image::from_fn(SIDE as usize, SIDE as usize, |x, y| {
            let q = p(x as f64 + 0.5, y as f64 + 0.5);
            let lit = if panel < 3 { inside(q, panel) } else { (0..3).all(|i| inside(q, i)) };
            if lit { tint[panel].map(|v| 255 - (255 - v) / 2) } else { [244, 244, 244, 255] }
        })?;
        drawing.picture(picture, left, 12, 1);
        let grid = Grid { at: p(f64::from(left), 12.0), side: 1.0, columns: 1, rows: 1 };
        grid.outline(&mut drawing, &points, INK);
        let title = ["inside edge 0", "inside edge 1", "inside edge 2", "inside all"][panel];
        let at = p(f64::from(left), 12.0 + SIDE + 18.0);
        drawing.text(at, 14.0, Anchor::Start, title, INK);
    }
    finish(drawing)
}

pub(super) fn shared_edges() -> Drawn {
    let mut drawing = Drawing::new(900, 330);
    let rim = [p(1.5, 3.5), p(3.5, 1.5), p(5.5, 1.5), p(5.5, 3.5), p(3.5, 5.5), p(1.5, 5.5)];
    let middle = p(3.5, 3.5);
    let triangles: Vec<Points> = (0..6).map(|i| [middle, rim[i], rim[(i + 1) % 6]]).collect();
    let pattern = SamplePattern::grid(1)?;
    for panel in 0..3 {
        let left = 16.0 + 296.0 * f64::from(panel);
        let grid = Grid { at: p(left, 34.0), side: 40.0, columns: 7, rows: 7 };
        let title = ["L <= 0", "L < 0", "the top-left rule"][panel as usize];
        drawing.text(p(left, 22.0), 14.0, Anchor::Start, title, INK);
        grid.lines(&mut drawing);
        for triangle in &triangles {
            grid.outline(&mut drawing, triangle, GREY);
        }
        for (x, y) in (0..7).flat_map(|y| (0..7).map(move |x| (x, y))) {
            let q = p(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let mut count = 0;
            for &t in &triangles {
                let signs = [0, 1, 2].map(|i| edge(t[i], t[(i + 1) % 3], q));
                let takes = match panel {
                    0 => signs.iter().all(|s| *s >= 0.0),
                    1 => signs.iter().all(|s| *s > 0.0),
                    _ => find(t, 7, 7, &pattern, Traversal::Tiled)?
                        .0
                        .iter()
                        .any(|f| (f.0, f.1) == (x, y)),
                };
                count += u32::from(takes);
            }
            let color = [LIGHT, GREEN, RED][count.min(2) as usize];
            drawing.dot(grid.place(q), 8.0, color);
            let at = grid.place(q) + p(0.0, 4.2);
            let ink = if count == 0 { GREY } else { Straight::WHITE };
            drawing.text(at, 12.0, Anchor::Middle, &count.to_string(), ink);
        }
    }
    finish(drawing)
}

pub(super) fn orders() -> Drawn {
    let mut drawing = Drawing::new(910, 210);
    let points = [p(0.4, 11.3), p(5.2, 0.7), p(15.4, 15.2)];
    let pattern = SamplePattern::grid(1)?;
    let orders = [
        (Order::RowMajor, "by rows"),
        (Order::ZigZag, "zigzag"),
        (Order::Backtrack, "backtrack"),
        (Order::Morton, "Morton"),
        (Order::Hilbert, "Hilbert"),
    ];
    for (index, (order, name)) in orders.into_iter().enumerate() {
        let left = 14.0 + 178.0 * index as f64;
        let grid = Grid { at: p(left, 12.0), side: 10.5, columns: 16, rows: 16 };
        grid.lines(&mut drawing);
        let found = find(points, 16, 16, &pattern, Traversal::Incremental(order))?;
        let centre =
            |f: &(i32, i32, u64)| grid.place(p(f64::from(f.0) + 0.5, f64::from(f.1) + 0.5));
        let last = found.0.len().max(2) - 1;
        for (i, pair) in found.0.windows(2).enumerate() {
            let t = i as f32 / last as f32;
            let color = std::array::from_fn(|k| BLUE.0[k] + (RED.0[k] - BLUE.0[k]) * t);
            drawing.line([centre(&pair[0]), centre(&pair[1])], 2.2, Straight(color));
        }
        grid.outline(&mut drawing, &points, GREY);
        drawing.text(p(left, 200.0), 14.0, Anchor::Start, name, INK);
    }
    finish(drawing)
}

pub(super) fn blocks() -> Drawn {
    const SIDE: f64 = 7.0;
    let points = [p(3.4, 50.7), p(46.3, 3.2), p(115.2, 60.4)];
    let mut drawing = Drawing::new(864, 530);
    let grid = Grid { at: p(12.0, 12.0), side: 8.0 * SIDE, columns: 15, rows: 8 };
    let mut counts = [0; 3];
    if let Some(shape) = Shape::triangle(points)? {
        for (x, y) in (0..8).flat_map(|y| (0..15).map(move |x| (x, y))) {
            let cover = shape.covers(IntRect::new(8 * x, 8 * y, 8 * x + 8, 8 * y + 8));
            let (kind, color) = match cover {
                Cover::None => (0, Straight::WHITE),
                Cover::Full => (1, GREEN),
                Cover::Partial => (2, YELLOW),
            };
            counts[kind] += 1;
            drawing.rect(grid.pixel(x, y), color);
        }
    }
    grid.lines(&mut drawing);
    let corners = points.map(|q| q / 8.0);
    grid.outline(&mut drawing, &corners, INK);
    let [rejected, accepted, tested] = counts;
    let line = format!(
        "120 blocks: {rejected} rejected, {accepted} accepted, {tested} tested: {} of 7680 samples",
        tested * 64
    );
    drawing.text(p(12.0, 490.0), 15.0, Anchor::Start, &line, INK);
    finish(drawing)
}

pub(super) fn supersampling() -> Drawn {
    let mut cells = Vec::new();
    for samples in [1, 4, 16] {
        let words = if samples == 1 { "1 sample".to_owned() } else { format!("{samples} samples") };
        cells.push(Cell::new(shares(samples)?, [words]));
    }
    finish(contact_sheet(&cells, 3, 1))
}

/// A triangle by so many samples a pixel, each pixel with its share of them.
fn shares(samples: usize) -> Drawn {
    let points = [p(0.6, 2.8), p(5.6, 0.5), p(6.3, 4.6)];
    let pattern = SamplePattern::grid(samples)?;
    let found = find(points, 7, 5, &pattern, Traversal::Tiled)?;
    let full = pattern.full_mask().0;
    let share = |mask: u64| (mask & full).count_ones() as f32 / samples as f32;
    let color = |share: f32| Straight(std::array::from_fn(|k| 1.0 + (RED.0[k] - 1.0) * share));
    let mut drawing = Drawing::new(284, 204);
    let grid = Grid { at: p(2.0, 2.0), side: 40.0, columns: 7, rows: 5 };
    for &(x, y, mask) in &found.0 {
        drawing.rect(grid.pixel(x, y), color(share(mask)));
    }
    grid.lines(&mut drawing);
    grid.outline(&mut drawing, &points, INK);
    for (x, y) in (0..5).flat_map(|y| (0..7).map(move |x| (f64::from(x), f64::from(y)))) {
        for &[ox, oy] in pattern.offsets() {
            let at = p(x + f64::from(ox) / 256.0, y + f64::from(oy) / 256.0);
            drawing.dot(grid.place(at), 1.8, INK);
        }
    }
    for &(x, y, mask) in found.0.iter().filter(|_| samples < 16) {
        // Between the four dots, or below the one, on a plate that keeps edges off the number.
        let below = if samples == 1 { 16.0 } else { 4.2 };
        let at = grid.place(p(f64::from(x) + 0.5, f64::from(y) + 0.5)) + p(0.0, below);
        let words = format!("{:.0}%", 100.0 * share(mask));
        let half = scumble_sheet::text_width(&words, 12.0) / 2.0 + 1.5;
        let plate = Rect::new(at.x - half, at.y - 10.4, at.x + half, at.y + 2.0);
        drawing.rect(plate, color(share(mask)));
        drawing.text(at, 12.0, Anchor::Middle, &words, Straight::BLACK);
    }
    finish(drawing)
}

/// Spokes about a point, thinner than a pixel near it.
pub(super) fn spokes(center: f64, radius: f64, count: u32) -> Path {
    let mut path = Path::default();
    for i in 0..count {
        let turn = (f64::from(i) + 0.37) / f64::from(count);
        let width = 0.18 / f64::from(count);
        let (a, b) = (
            polar(center, center, radius, turn - width),
            polar(center, center, radius, turn + width),
        );
        path.move_to(p(center, center)).line_to(p(a.0, a.1)).line_to(p(b.0, b.1)).close();
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gallery::errata::says;

    /// L of the slides: below 0 inside, for the winding that they have, y being up.
    fn slides(a: DVec2, b: DVec2, q: DVec2) -> f64 {
        (b.y - a.y) * (q.x - a.x) - (b.x - a.x) * (q.y - a.y)
    }

    /// Centres of the small grid where all three are below 0.
    fn inside(t: Points) -> usize {
        let centres = (0..6).flat_map(|y| (0..10).map(move |x| (x, y)));
        let all = |q: DVec2| (0..3).all(|i| slides(t[i], t[(i + 1) % 3], q) < 0.0);
        centres.filter(|&(x, y)| all(p(f64::from(x) + 0.5, f64::from(y) + 0.5))).count()
    }

    #[test]
    fn a_step_down_is_the_negative_difference() {
        for i in 0..3 {
            let (a, b) = (SMALL[i], SMALL[(i + 1) % 3]);
            let q = p(4.0, 3.0);
            let step = slides(a, b, q + p(0.0, 1.0)) - slides(a, b, q);
            assert!((step + (b.x - a.x)).abs() < 1e-12, "{step}");
        }
        let (a, b) = (SMALL[0], SMALL[1]);
        says(&format!("dX₀ = {:.1} and the step −{:.1}", b.x - a.x, b.x - a.x));
    }

    #[test]
    fn the_other_winding_has_no_inside() {
        let [a, b, c] = SMALL;
        let found = inside(SMALL).max(inside([a, c, b]));
        assert_eq!(inside(SMALL).min(inside([a, c, b])), 0);
        says(&format!("{found} samples one way round and 0 the other"));
    }
}
