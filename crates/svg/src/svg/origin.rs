use crate::numbers::Cursor;
use scumble_geometry::DVec2;

/// The point that `transform-origin` means, in a viewport of this size; a third value, the depth,
/// is not looked at. `None` for what it cannot be.
pub(super) fn parse(text: &str, viewport: DVec2) -> Option<DVec2> {
    let mut values = text.split_ascii_whitespace();
    let first = values.next()?;
    let second = values.next().unwrap_or("center");
    // Keywords may come in either order; a pair such as `top left` is turned round.
    let (x, y) = match (first, second) {
        ("top" | "bottom", x) => (x, first),
        (x, y @ ("left" | "right")) => (y, x),
        pair => pair,
    };
    Some(DVec2::new(offset(x, viewport.x)?, offset(y, viewport.y)?))
}

fn offset(text: &str, side: f64) -> Option<f64> {
    match text {
        "left" | "top" => return Some(0.0),
        "center" => return Some(side / 2.0),
        "right" | "bottom" => return Some(side),
        _ => {}
    }
    let mut cursor = Cursor::new(text);
    let number = cursor.number()?;
    match cursor.rest {
        "" | "px" => Some(number),
        "%" => Some(number / 100.0 * side),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_percentages_and_keywords() {
        let at = |text| parse(text, DVec2::new(200.0, 100.0)).map(|p| (p.x, p.y));
        assert_eq!(at("10px 20"), Some((10.0, 20.0)));
        assert_eq!(at("10"), Some((10.0, 50.0)));
        assert_eq!(at("50% 25% 7px"), Some((100.0, 25.0)));
        assert_eq!(at("top left"), Some((0.0, 0.0)));
        assert_eq!(at("center"), Some((100.0, 50.0)));
        assert_eq!(at("right bottom"), Some((200.0, 100.0)));
        assert_eq!(at("1em 2em"), None);
        assert_eq!(at(""), None);
    }
}
