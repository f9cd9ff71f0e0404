//! Which texels of which level are made, and which of them are kept.

use crate::decimate::Taps;
use crate::level::LARGEST;
use crate::{Levels, TextureError, TextureOptions, Wrap};
use alloc::vec::Vec;

/// Texels of a level that are kept on every side of a window: what an ellipse reads by blocks, and
/// what a level adds to its radius, is no more.
const MARGIN: usize = 8;

/// Indices along an axis: `start..end`, never empty.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) start: usize,
    pub(crate) end: usize,
}

impl Span {
    pub(crate) const fn all(n: usize) -> Self {
        Self { start: 0, end: n }
    }

    pub(crate) const fn len(self) -> usize {
        self.end - self.start
    }

    pub(crate) const fn holds(self, i: usize) -> bool {
        self.start <= i && i < self.end
    }

    /// The place of an index counted from the first, or that of the nearest index.
    #[inline(always)]
    pub(crate) const fn place(self, i: usize) -> usize {
        if i < self.start {
            0
        } else if i < self.end {
            i - self.start
        } else {
            self.end - self.start - 1
        }
    }

    /// The least span that holds both.
    fn hull(self, other: Self) -> Self {
        Self { start: self.start.min(other.start), end: self.end.max(other.end) }
    }

    /// The texels of a level with `n` of them that lie under `low..high` of `whole` texels of the
    /// image, and the margin.
    fn under([low, high]: [i32; 2], n: usize, whole: usize, wrap: Wrap) -> Self {
        // Sides are below 2²⁹, so this fits; the quotients are ⌊ ⌋ and ⌈ ⌉ of the exact ones.
        let scaled = |i: i32| usize::try_from(i).unwrap_or(0).min(whole) as u64 * n as u64;
        let start = (scaled(low) / whole as u64) as usize;
        let end = scaled(high).div_ceil(whole as u64) as usize;
        if wrap == Wrap::Repeat && (start < MARGIN || end + MARGIN > n) {
            // The margin is at the other end.
            return Self::all(n);
        }
        let start = start.saturating_sub(MARGIN).min(n - 1);
        Self { start, end: (end + MARGIN).min(n).max(start + 1) }
    }
}

/// One level of the pyramid, kept or not.
#[derive(Debug, Clone)]
pub(crate) struct LevelPlan {
    /// Columns and rows of the whole level.
    pub(crate) size: [usize; 2],
    /// Columns and rows that are made.
    pub(crate) made: [Span; 2],
    /// Columns and rows that are kept, all of them made.
    pub(crate) kept: Option<[Span; 2]>,
    /// The filters along columns and rows to the next level; none from the last.
    pub(crate) taps: Option<[Taps; 2]>,
}

/// The levels from the image to the last that is kept.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    pub(crate) levels: Vec<LevelPlan>,
    /// The first that is kept.
    pub(crate) first: usize,
    /// Whether rows are asked for beyond the last that are the first again: all rows of all levels are
    /// made then, in a circle.
    pub(crate) circular: bool,
}

/// Columns and rows of level `l` over an image.
pub(crate) fn size_of_level([width, height]: [usize; 2], l: usize) -> [usize; 2] {
    [width, height].map(|n| n.checked_shr(l as u32).unwrap_or(0).max(1))
}

/// The levels to keep of a pyramid over an image of this size, as a range; at least one.
pub(crate) fn kept_levels([width, height]: [usize; 2], levels: Levels) -> Span {
    let all = width.max(height).checked_ilog2().map_or(1, |l| l as usize + 1);
    match levels {
        Levels::All => Span::all(all),
        Levels::BaseOnly => Span::all(1),
        Levels::Range { first, last } => {
            let first = first.min(all - 1);
            Span { start: first, end: last.saturating_add(1).clamp(first + 1, all) }
        }
    }
}

/// The columns and rows of a level that are kept for a window of the image, or all.
pub(crate) fn kept_part(
    image: [usize; 2],
    level: [usize; 2],
    options: &TextureOptions,
) -> [Span; 2] {
    let wrap = options.wrap;
    match options.window {
        None => level.map(Span::all),
        Some(w) => [
            Span::under([w.x0, w.x1], level[0], image[0], wrap),
            Span::under([w.y0, w.y1], level[1], image[1], wrap),
        ],
    }
}

/// Whether a texture of this size can be made.
pub(crate) fn check(size: [usize; 2]) -> Result<(), TextureError> {
    let [width, height] = size;
    if width == 0 || height == 0 {
        return Err(TextureError::Empty);
    }
    if width.max(height) > LARGEST {
        return Err(TextureError::TooLarge { width, height });
    }
    Ok(())
}

impl Plan {
    /// For an image that has passed [`check`].
    pub(crate) fn new(image: [usize; 2], options: &TextureOptions) -> Self {
        let TextureOptions { wrap, decimation, .. } = *options;
        let kept = kept_levels(image, options.levels);
        let level = |l: usize| {
            let size = size_of_level(image, l);
            let part = kept_part(image, size, options);
            let more = l + 1 < kept.end;
            LevelPlan {
                size,
                made: part,
                kept: kept.holds(l).then_some(part),
                taps: more.then(|| size.map(|n| Taps::new(n, decimation, wrap))),
            }
        };
        let levels: Vec<LevelPlan> = (0..kept.end).map(level).collect();
        let mut plan = Self { levels, first: kept.start, circular: false };
        plan.trace(wrap);
        plan
    }

    /// Finds what each level must be made of, from the last down.
    fn trace(&mut self, wrap: Wrap) {
        let mut crossed = [false; 2];
        for l in (1..self.levels.len()).rev() {
            let coarse = self.levels[l].made;
            let fine = &mut self.levels[l - 1];
            let Some(taps) = &fine.taps else { continue };
            for axis in 0..2 {
                let needed = taps[axis].inputs_of(coarse[axis]);
                let kept = fine.kept.map_or(needed, |kept| kept[axis]);
                fine.made[axis] = kept.hull(needed);
                crossed[axis] |= wrap == Wrap::Repeat && taps[axis].crosses(coarse[axis]);
            }
        }
        // What begins at both ends is hardly less than all.
        for level in &mut self.levels {
            for axis in (0..2).filter(|axis| crossed[*axis]) {
                level.made[axis] = Span::all(level.size[axis]);
            }
        }
        self.circular = crossed[1];
    }
}
