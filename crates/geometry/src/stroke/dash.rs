use super::StrokeStyle;
use super::chain::{Chain, Segment};
use alloc::vec::Vec;

/// More dashes than this would be finer than any picture: the contour stays whole.
const MAX_DASHES: f64 = (1u32 << 16) as f64;

/// Dashes end at a corner if they end this near to it, as a share of the contour: lengths that
/// come in single precision add up to no less.
const SLACK: f64 = 1e-7;

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
            // A dash of no length that begins the contour is a dot.
            if offset < pattern.rest || (offset == 0.0 && pattern.on) {
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

    /// Whether a dash has ended and nothing of the gap behind it is used up.
    fn just_left(&self) -> bool {
        !self.on && self.rest == self.lengths[self.index]
    }
}

/// The dashes of a contour; `None` if it is not dashed.
pub(super) fn dash(chain: &Chain, style: &StrokeStyle) -> Option<Vec<Chain>> {
    if style.dashes.is_empty() {
        return None;
    }
    let length: f64 = chain.segments.iter().map(Segment::length).sum();
    let mut pattern = Pattern::new(style, length)?;
    let started_on = pattern.on;
    let slack = length * SLACK;
    let mut dashes: Vec<Chain> = Vec::new();
    let mut current: Vec<Segment> = Vec::new();
    let mut cuts = 0u32;
    for segment in &chain.segments {
        let length = segment.length();
        let mut done = 0.0;
        let mut from = segment.from;
        // A zero-length dash at the end of a segment belongs to it.
        while pattern.rest <= length - done + slack && length > 0.0 {
            let next = done + pattern.rest;
            // At a corner exactly: a scrap beyond it would be drawn as a join.
            let at_end = (length - next).abs() <= slack;
            done = if at_end { length } else { next };
            let to = segment.from + (segment.to - segment.from) * (done / length);
            let to = if at_end { segment.to } else { to };
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
        // A dash that begins at the corner begins in the direction of what follows.
        if pattern.on && (done < length || length == 0.0) {
            let smooth = segment.smooth || from != segment.from;
            current.push(Segment { from, smooth, ..*segment });
        }
    }
    if cuts == 0 {
        // All dash or all gap.
        return if started_on { None } else { Some(Vec::new()) };
    }
    if chain.closed && pattern.just_left() {
        // A dash that ended at the seam is as good as one that runs into it; a dot there would
        // be drawn twice.
        current = dashes.pop().map_or_else(Vec::new, |dash| dash.segments);
        if started_on && dashes.is_empty() {
            return None;
        }
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
