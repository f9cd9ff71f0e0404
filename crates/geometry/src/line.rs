use crate::DVec2;

/// The rectangle that a straight line of the given width covers, with butt ends: `None` if the
/// line has no length, the width is not positive, or a number is not finite.
///
/// The corners are a + n, b + n, b − n, a − n, where n is half the width to the *left* of the
/// direction of travel as the eye sees it (y down); the quad turns clockwise.
///
/// ```
/// use scumble_geometry::{DVec2, line_quad};
/// let quad = line_quad(DVec2::new(0.0, 5.0), DVec2::new(10.0, 5.0), 2.0);
/// assert_eq!(quad.map(|q| (q[0], q[2])), Some((DVec2::new(0.0, 4.0), DVec2::new(10.0, 6.0))));
/// ```
#[must_use]
pub fn line_quad(a: DVec2, b: DVec2, width: f64) -> Option<[DVec2; 4]> {
    quad(a, b, width, 0.0)
}

/// As [`line_quad`] with square ends: half the width longer at both.
#[must_use]
pub fn line_quad_square(a: DVec2, b: DVec2, width: f64) -> Option<[DVec2; 4]> {
    quad(a, b, width, 1.0)
}

/// `cap`: by how many half-widths it is longer at each end.
fn quad(a: DVec2, b: DVec2, width: f64, cap: f64) -> Option<[DVec2; 4]> {
    let offset = b - a;
    // Scaled before the length is taken, so that neither tiny nor huge lines leave the range.
    let size = offset.abs().max_element();
    if !(size > 0.0 && size.is_finite() && width > 0.0) {
        return None;
    }
    let scaled = offset / size;
    let along = scaled / scaled.length() * (width * 0.5);
    let left = DVec2::new(along.y, -along.x);
    let (a, b) = (a - along * cap, b + along * cap);
    let corners = [a + left, b + left, b - left, a - left];
    corners.iter().all(|p| p.is_finite()).then_some(corners)
}
