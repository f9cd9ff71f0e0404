use kurbo::BezPath;

/// An outline of lines and Bézier curves, possibly of many contours.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Path(pub BezPath);
