//! Curves in a frame.

use super::ink::{GREY, LIGHT};
use scumble_geometry::{DVec2, Rect};
use scumble_pixel::Straight;
use scumble_sheet::{Anchor, Drawing, INK};

/// Size of the words at the axes.
const SMALL: f64 = 13.0;

/// A frame on a drawing, and which numbers it spans.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plot {
    pub(super) frame: Rect,
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
}

impl Plot {
    /// Where a point of the plot lies on the drawing.
    pub(super) fn place(&self, x: f64, y: f64) -> DVec2 {
        let along = |v: f64, [from, to]: [f64; 2]| (v - from) / (to - from);
        let frame = &self.frame;
        DVec2::new(
            frame.x0 + along(x, self.x) * (frame.x1 - frame.x0),
            frame.y1 - along(y, self.y) * (frame.y1 - frame.y0),
        )
    }

    /// The frame's two axes, and a title over it.
    pub(super) fn axes(&self, drawing: &mut Drawing, title: &str) {
        let corners = [
            DVec2::new(self.frame.x0, self.frame.y0),
            DVec2::new(self.frame.x0, self.frame.y1),
            DVec2::new(self.frame.x1, self.frame.y1),
        ];
        drawing.line(corners, 1.2, GREY);
        let at = DVec2::new(self.frame.x0, self.frame.y0 - 6.0);
        drawing.text(at, SMALL + 1.0, Anchor::Start, title, INK);
    }

    /// A line across at each of these heights, and its label.
    pub(super) fn rules(&self, drawing: &mut Drawing, labels: &[(f64, &str)]) {
        for &(y, label) in labels {
            let (from, to) = (self.place(self.x[0], y), self.place(self.x[1], y));
            drawing.line([from, to], 1.0, LIGHT);
            let at = from + DVec2::new(-6.0, 4.5);
            drawing.text(at, SMALL, Anchor::End, label, INK);
        }
    }

    /// A tick and a label below at each of these places.
    pub(super) fn ticks(&self, drawing: &mut Drawing, labels: &[(f64, &str)]) {
        for &(x, label) in labels {
            let at = self.place(x, self.y[0]);
            drawing.line([at, at + DVec2::new(0.0, 4.0)], 1.2, GREY);
            drawing.text(at + DVec2::new(0.0, 17.0), SMALL, Anchor::Middle, label, INK);
        }
    }

    /// A function from end to end.
    pub(super) fn curve(
        &self,
        drawing: &mut Drawing,
        color: Straight,
        width: f64,
        f: impl Fn(f64) -> f64,
    ) {
        let steps = (self.frame.x1 - self.frame.x0).max(1.0) * 2.0;
        let count = steps as u32;
        let at = |i: u32| {
            let x = self.x[0] + (self.x[1] - self.x[0]) * f64::from(i) / f64::from(count);
            self.place(x, f(x))
        };
        drawing.line((0..=count).map(at), width, color);
    }

    /// Discs at points.
    pub(super) fn dots(&self, drawing: &mut Drawing, color: Straight, points: &[(f64, f64)]) {
        for &(x, y) in points {
            drawing.dot(self.place(x, y), 3.6, color);
        }
    }
}
