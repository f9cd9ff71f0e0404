use scumble::coverage::{SampleMask, SamplePattern, Scratch, Shape, Sink};
use scumble::geometry::IntRect;

/// Which samples of a canvas a shape owns: a mask for each pixel, row by row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ownership {
    canvas: IntRect,
    full: u64,
    masks: Vec<u64>,
}

/// How often each sample of a canvas is owned.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tally {
    /// Samples that are owned at all.
    pub union: Ownership,
    /// Samples that are owned more than once.
    pub repeated: Ownership,
}

/// The samples of a pattern that a shape owns within a canvas.
#[must_use]
pub fn samples_of(shape: Option<&Shape>, canvas: IntRect, pattern: &SamplePattern) -> Ownership {
    let mut owned = Ownership::empty(canvas, pattern);
    if let Some(shape) = shape {
        shape.rasterize(canvas, pattern, &mut Scratch::new(), &mut owned);
    }
    owned
}

impl Ownership {
    /// No sample at all.
    #[must_use]
    pub fn empty(canvas: IntRect, pattern: &SamplePattern) -> Self {
        let pixels = canvas.width() as usize * canvas.height() as usize;
        Self { canvas, full: pattern.full_mask().0, masks: vec![0; pixels] }
    }

    /// How many samples.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.masks.iter().map(|mask| mask.count_ones()).sum()
    }

    /// The mask of a pixel; 0 outside the canvas.
    #[must_use]
    pub fn mask(&self, x: i32, y: i32) -> u64 {
        if self.canvas.contains(x, y) { self.masks[self.index(x, y)] } else { 0 }
    }

    fn index(&self, x: i32, y: i32) -> usize {
        let (column, row) = (x - self.canvas.x0, y - self.canvas.y0);
        row as usize * self.canvas.width() as usize + column as usize
    }
}

impl Sink for Ownership {
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        for x in x0..x1 {
            let at = self.index(x, y);
            self.masks[at] |= self.full;
        }
    }

    fn pixel(&mut self, x: i32, y: i32, mask: SampleMask) {
        let at = self.index(x, y);
        self.masks[at] |= mask.0;
    }
}

impl Tally {
    /// Nothing owned.
    #[must_use]
    pub fn new(canvas: IntRect, pattern: &SamplePattern) -> Self {
        let empty = Ownership::empty(canvas, pattern);
        Self { union: empty.clone(), repeated: empty }
    }

    /// Adds what one shape owns.
    pub fn add(&mut self, owned: &Ownership) {
        for (at, mask) in owned.masks.iter().enumerate() {
            self.repeated.masks[at] |= self.union.masks[at] & mask;
            self.union.masks[at] |= mask;
        }
    }
}
