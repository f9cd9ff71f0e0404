use crate::area::AreaRow;
use crate::polygon::PolygonScratch;
use crate::triangle::TriangleScratch;
use fearless_simd::Level;

/// Working memory for [`Shape::rasterize`](crate::Shape::rasterize): make one per thread and use
/// it for every call, and the calls do not allocate once it has grown to what they need.
///
/// It also carries the instruction set that the kernels use. All give the same samples.
#[derive(Debug, Clone)]
pub struct Scratch {
    pub(crate) level: Level,
    pub(crate) triangle: TriangleScratch,
    pub(crate) area: AreaRow,
    pub(crate) polygon: PolygonScratch,
}

impl Scratch {
    /// Empty working memory, and the best instruction set that this processor has (without the
    /// feature `std`: that the crate was compiled for).
    #[must_use]
    pub fn new() -> Self {
        #[cfg(feature = "std")]
        let level = Level::new();
        #[cfg(not(feature = "std"))]
        let level = Level::baseline();
        Self::with_level(level)
    }

    /// Empty working memory, and an instruction set of the caller's choice.
    #[must_use]
    pub fn with_level(level: Level) -> Self {
        Self {
            level,
            triangle: TriangleScratch::default(),
            area: AreaRow::default(),
            polygon: PolygonScratch::default(),
        }
    }

    /// The instruction set in use.
    #[must_use]
    pub fn level(&self) -> Level {
        self.level
    }
}

impl Default for Scratch {
    fn default() -> Self {
        Self::new()
    }
}
