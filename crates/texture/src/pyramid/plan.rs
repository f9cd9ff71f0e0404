//! Which texels of which level are made, and which of them are kept.

use crate::decimate::Taps;
use crate::level::LARGEST;
use crate::{Decimation, Levels, TextureError, TextureOptions, Wrap};
use alloc::vec::Vec;
use scumble_geometry::IntRect;

/// Texels of a level that are kept on every side of a window: what an ellipse reads by blocks, and
/// what a level adds to its radius, is no more.
const MARGIN: usize = 8;

/// How many times as many texels there must be around an outline: whole levels can be made on several
/// threads, and of their memory the system gives only what is written.
const WORTH: usize = 2;

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
    /// The columns of each row of those that are stored, which may be none; none if all are.
    stored: Vec<Span>,
    /// The filters along columns and rows to the next level; none from the last.
    pub(crate) taps: Option<[Taps; 2]>,
}

/// The filters along columns and rows. Those of sizes that are not even take some time to find.
fn taps([width, height]: [usize; 2], decimation: Decimation, wrap: Wrap) -> [Taps; 2] {
    let columns = Taps::new(width, decimation, wrap);
    let rows = if width == height { columns.clone() } else { Taps::new(height, decimation, wrap) };
    [columns, rows]
}

impl LevelPlan {
    /// The columns of row `y` that are stored, if there are any.
    #[inline(always)]
    pub(crate) fn stored(&self, y: usize) -> Option<Span> {
        let [columns, rows] = self.kept?;
        let stored = self.stored.get(y.wrapping_sub(rows.start)).copied().unwrap_or(columns);
        (stored.start < stored.end).then_some(stored)
    }
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

/// The columns and rows of level `l` that are kept for a window of the image, or all: around an outline,
/// if that is much less.
pub(crate) fn kept_part(image: [usize; 2], l: usize, options: &TextureOptions) -> [Span; 2] {
    let (size, wrap) = (size_of_level(image, l), options.wrap);
    let under = |w: IntRect| {
        let rows = Span::under([w.y0, w.y1], size[1], image[1], wrap);
        [Span::under([w.x0, w.x1], size[0], image[0], wrap), rows]
    };
    let texels = |[columns, rows]: [Span; 2]| columns.len().saturating_mul(rows.len());
    let window = options.window.map_or(size.map(Span::all), under);
    match options.outline(l).map(|outline| under(outline.bounds())) {
        Some(part) if texels(part) < texels(window) / WORTH => part,
        _ => window,
    }
}

/// The columns of each row of level `l` that are stored, of the part that is kept; none if that is all
/// of them.
pub(crate) fn stored_rows(image: [usize; 2], l: usize, options: &TextureOptions) -> Vec<Span> {
    let Some(outline) = options.outline(l).filter(|_| options.wrap != Wrap::Repeat) else {
        return Vec::new();
    };
    let size = size_of_level(image, l);
    let [columns, rows] = kept_part(image, l, options);
    // Sides are below 2²⁹.
    let row = |y: usize| (y as u64 * image[1] as u64 / size[1] as u64) as i32;
    let stored = |y: usize| {
        let read = outline.columns(row(y.saturating_sub(MARGIN)), row(y + 1 + MARGIN) + 1);
        let none = Span { start: columns.start, end: columns.start };
        read.map_or(none, |read| {
            let Span { start, end } = Span::under(read, size[0], image[0], options.wrap);
            let start = start.clamp(columns.start, columns.end);
            Span { start, end: end.clamp(start, columns.end) }
        })
    };
    (rows.start..rows.end).map(stored).collect()
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
            let part = kept_part(image, l, options);
            let more = l + 1 < kept.end;
            LevelPlan {
                size,
                made: part,
                kept: kept.holds(l).then_some(part),
                stored: stored_rows(image, l, options),
                taps: more.then(|| taps(size, decimation, wrap)),
            }
        };
        let levels: Vec<LevelPlan> = (0..kept.end).map(level).collect();
        let mut plan = Self { levels, first: kept.start, circular: false };
        plan.trace(wrap);
        plan
    }

    /// Whether all of every level is made, and kept if any of it is.
    #[cfg(feature = "parallel")]
    pub(crate) fn is_whole(&self) -> bool {
        self.levels.iter().all(|level| {
            let whole = level.size.map(Span::all);
            level.made == whole && level.kept.is_none_or(|part| part == whole)
        })
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
