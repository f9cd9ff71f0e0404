use crate::accumulate::AreaRow;
use crate::polygon::PolygonScratch;
use crate::triangle::TriangleScratch;

/// Working memory for [`Shape::rasterize`](crate::Shape::rasterize): make one per thread and use
/// it for every call, and the calls do not allocate once it has grown to what they need.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    pub(crate) triangle: TriangleScratch,
    pub(crate) area: AreaRow,
    pub(crate) polygon: PolygonScratch,
}

impl Scratch {
    /// Empty working memory.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }
}
