use super::StrokeStyle;
use super::chain::{Chain, Segment};
use alloc::vec::Vec;

/// More dashes than this would be finer than any picture: the contour stays whole.
const MAX_DASHES: f64 = (1u32 << 16) as f64;

/// Where the pattern stands while it is laid along a contour.
struct Pattern<'a> {
    lengths: &'a [f64],
    index: usize,
    on: bool,
    /// What is left of the current dash or gap.
    rest: f64,
}

impl<'a> Pattern<'a> {
    /// `None` if the style has no usable pattern.
    fn new(style: &'a StrokeStyle, contour_length: f64) -> Option<Self> {
        let lengths = style.dashes.as_slice();
        let sum: f64 = lengths.iter().sum();
        let usable = lengths.iter().all(|&d| d >= 0.0) && sum > 0.0 && sum.is_finite();
        let period = if lengths.len().is_multiple_of(2) { sum } else { 2.0 * sum };
        let dashes = contour_length / sum * lengths.len() as f64;
        if !(usable && period.is_finite() && style.dash_offset.is_finite() && dashes <= MAX_DASHES)
        {
            return None;
        }
        // The remainder is exact, so that far offsets cost neither time nor precision.
        let phase = style.dash_offset % period;
        let mut offset = if phase < 0.0 { phase + period } else { phase };
        let mut pattern = Self { lengths, index: 0, on: true, rest: lengths[0] };
        // At most twice through the pattern.
        for _ in 0..2 * lengths.len() {
            if offset < pattern.rest {
                break;
            }
            offset -= pattern.rest;
            pattern.next();
        }
        pattern.rest = (pattern.rest - offset).max(0.0);
        Some(pattern)
    }

    fn next(&mut self) {
        self.index = (self.index + 1) % self.lengths.len();
        self.rest = self.lengths[self.index];
        self.on = !self.on;
    }
}

/// The dashes of a contour; `None` if it is not dashed.
pub(super) fn dash(chain: &Chain, style: &StrokeStyle) -> Option<Vec<Chain>> {
    let length: f64 = chain.segments.iter().map(Segment::length).sum();
    let mut pattern = Pattern::new(style, length)?;
    let started_on = pattern.on;
    let mut dashes: Vec<Chain> = Vec::new();
    let mut current: Vec<Segment> = Vec::new();
    let mut cuts = 0u32;
    for segment in &chain.segments {
        let length = segment.length();
        let mut done = 0.0;
        let mut from = segment.from;
        // A zero-length dash at the end of a segment belongs to it.
        while pattern.rest <= length - done && length > 0.0 {
            done += pattern.rest;
            let to = segment.from + (segment.to - segment.from) * (done / length);
            if pattern.on {
                let smooth = segment.smooth || from != segment.from;
                current.push(Segment { from, to, smooth, ..*segment });
                let segments = core::mem::take(&mut current);
                dashes.push(Chain { segments, closed: false });
            }
            from = to;
            pattern.next();
            cuts += 1;
        }
        pattern.rest -= length - done;
        if pattern.on {
            let smooth = segment.smooth || from != segment.from;
            current.push(Segment { from, smooth, ..*segment });
        }
    }
    if cuts == 0 {
        // All dash or all gap.
        return if started_on { None } else { Some(Vec::new()) };
    }
    // What begins just as the contour ends is none of it.
    if current.iter().any(|s| s.from != s.to) {
        let joins_first = chain.closed && started_on && !dashes.is_empty();
        if joins_first {
            current.append(&mut dashes[0].segments);
            dashes[0].segments = current;
        } else {
            dashes.push(Chain { segments: current, closed: false });
        }
    }
    Some(dashes)
}
