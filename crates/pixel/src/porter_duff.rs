use crate::Premul;

/// The compositing operators of Porter and Duff, "Compositing Digital Images" (SIGGRAPH 1984).
///
/// Each takes a fraction F of the source and a fraction G of the destination:
/// result = F·source + G·destination, in premultiplied components, where F is one of 0, 1, the
/// destination's α and 1 − it, and G likewise with the source's α.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum PorterDuff {
    /// Nothing: F = 0, G = 0.
    Clear,
    /// The source alone: F = 1, G = 0.
    Source,
    /// The destination alone: F = 0, G = 1.
    Destination,
    /// The source in front: F = 1, G = 1 − αs. The usual way to paint; [`Premul::over`].
    #[default]
    SourceOver,
    /// The source behind: F = 1 − αd, G = 1.
    DestinationOver,
    /// The source where the destination is: F = αd, G = 0.
    SourceIn,
    /// The destination where the source is: F = 0, G = αs.
    DestinationIn,
    /// The source where the destination is not: F = 1 − αd, G = 0.
    SourceOut,
    /// The destination where the source is not: F = 0, G = 1 − αs.
    DestinationOut,
    /// The source on the destination, which keeps its shape: F = αd, G = 1 − αs.
    SourceAtop,
    /// The destination on the source, whose shape results: F = 1 − αd, G = αs.
    DestinationAtop,
    /// Each where the other is not: F = 1 − αd, G = 1 − αs.
    Xor,
    /// Both added, each component at most 1: F = 1, G = 1.
    Plus,
}

impl PorterDuff {
    /// `source` and `destination` composited.
    ///
    /// ```
    /// use scumble_pixel::{PorterDuff, Premul};
    ///
    /// let (ink, mask) = (Premul([0.5, 0.25, 0.0, 0.5]), Premul([0.0, 0.0, 0.0, 0.5]));
    /// assert_eq!(PorterDuff::SourceIn.apply(ink, mask), Premul([0.25, 0.125, 0.0, 0.25]));
    /// ```
    #[must_use]
    #[inline]
    pub fn apply(self, source: Premul, destination: Premul) -> Premul {
        let (s, d) = (source.alpha(), destination.alpha());
        let (f, g) = match self {
            Self::Clear => return Premul::TRANSPARENT,
            Self::Source => return source,
            Self::Destination => return destination,
            Self::SourceOver => return source.over(destination),
            Self::DestinationOver => return destination.over(source),
            Self::SourceIn => return source.scaled(d),
            Self::DestinationIn => return destination.scaled(s),
            Self::SourceOut => return source.scaled(1.0 - d),
            Self::DestinationOut => return destination.scaled(1.0 - s),
            Self::SourceAtop => (d, 1.0 - s),
            Self::DestinationAtop => (1.0 - d, s),
            Self::Xor => (1.0 - d, 1.0 - s),
            Self::Plus => (1.0, 1.0),
        };
        let sum: [f32; 4] = core::array::from_fn(|i| f * source.0[i] + g * destination.0[i]);
        Premul(if self == Self::Plus { sum.map(|v| v.min(1.0)) } else { sum })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Straight;
    use PorterDuff::*;
    use proptest::prelude::*;

    const ALL: [PorterDuff; 13] = [
        Clear,
        Source,
        Destination,
        SourceOver,
        DestinationOver,
        SourceIn,
        DestinationIn,
        SourceOut,
        DestinationOut,
        SourceAtop,
        DestinationAtop,
        Xor,
        Plus,
    ];

    /// The operator with the two colours' parts exchanged.
    fn mirrored(op: PorterDuff) -> PorterDuff {
        match op {
            Source => Destination,
            Destination => Source,
            SourceOver => DestinationOver,
            DestinationOver => SourceOver,
            SourceIn => DestinationIn,
            DestinationIn => SourceIn,
            SourceOut => DestinationOut,
            DestinationOut => SourceOut,
            SourceAtop => DestinationAtop,
            DestinationAtop => SourceAtop,
            Clear | Xor | Plus => op,
        }
    }

    /// What remains of two opaque or empty colours: the paper's table of which quadrants survive,
    /// as (source alone, destination alone, both overlap: 's', 'd' or nothing).
    fn survives(op: PorterDuff) -> (bool, bool, char) {
        match op {
            Clear => (false, false, ' '),
            Source => (true, false, 's'),
            Destination => (false, true, 'd'),
            SourceOver => (true, true, 's'),
            DestinationOver => (true, true, 'd'),
            SourceIn => (false, false, 's'),
            DestinationIn => (false, false, 'd'),
            SourceOut => (true, false, ' '),
            DestinationOut => (false, true, ' '),
            SourceAtop => (false, true, 's'),
            DestinationAtop => (true, false, 'd'),
            Xor => (true, true, ' '),
            Plus => (true, true, '+'),
        }
    }

    #[test]
    fn the_quadrants_of_the_paper() {
        let (red, blue) = (Premul([1.0, 0.0, 0.0, 1.0]), Premul([0.0, 0.0, 1.0, 1.0]));
        let none = Premul::TRANSPARENT;
        for op in ALL {
            let (source, destination, both) = survives(op);
            assert_eq!(op.apply(red, none), if source { red } else { none }, "{op:?}");
            assert_eq!(op.apply(none, blue), if destination { blue } else { none }, "{op:?}");
            let overlap = match both {
                's' => red,
                'd' => blue,
                '+' => Premul([1.0, 0.0, 1.0, 1.0]),
                _ => none,
            };
            assert_eq!(op.apply(red, blue), overlap, "{op:?}");
            assert_eq!(op.apply(none, none), none, "{op:?}");
        }
    }

    proptest! {
        #[test]
        fn mirrored_operators_exchange_the_parts(
            a in prop::array::uniform4(0.0_f32..=1.0),
            b in prop::array::uniform4(0.0_f32..=1.0),
        ) {
            let (a, b) = (Straight(a).premultiply(), Straight(b).premultiply());
            for op in ALL {
                let result = op.apply(a, b);
                prop_assert_eq!(result, mirrored(op).apply(b, a));
                // Still premultiplied: no component exceeds the alpha by more than rounding.
                prop_assert!(result.0.iter().all(|&v| v >= 0.0 && v <= result.alpha() + 1e-6));
            }
        }
    }
}
