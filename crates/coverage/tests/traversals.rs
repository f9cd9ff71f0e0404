//! Every way of finding the samples finds the same.
#![allow(missing_docs)]

mod common;
use common::*;
use proptest::prelude::*;
use scumble_coverage::*;

const OTHERS: [Traversal; 6] = [
    Traversal::Scanline,
    Traversal::Incremental(Order::RowMajor),
    Traversal::Incremental(Order::Backtrack),
    Traversal::Incremental(Order::ZigZag),
    Traversal::Incremental(Order::Morton),
    Traversal::Incremental(Order::Hilbert),
];

fn by(traversal: Traversal, shape: &Shape, clip: IntRect, pattern: &SamplePattern) -> Collected {
    let mut out = Collected::new(pattern);
    shape.rasterize_by(traversal, clip, pattern, &mut Scratch::new(), &mut out);
    out
}

/// Triangles from slivers to some that need 64 bits inside a block.
fn corners() -> impl Strategy<Value = [[i64; 2]; 3]> {
    let far = prop_oneof![Just(1), Just(1), Just(9), Just(20_000)];
    ([point(18), point(18), point(18)], far)
        .prop_map(|(p, far)| p.map(|v| v.map(|c| (c * far).clamp(-(1 << 29), 1 << 29))))
}

/// Squares tell the samples of the definition, on every level.
fn check_squares(
    shape: &Shape,
    clip: IntRect,
    pattern: &SamplePattern,
    definition: &Collected,
) -> Result<(), TestCaseError> {
    for level in levels() {
        let mut found = BySquares(Collected::new(pattern));
        shape.rasterize(clip, pattern, &mut Scratch::with_level(level), &mut found);
        prop_assert_eq!(&found.0, definition, "{:?}", level);
    }
    Ok(())
}

proptest! {
    #[test]
    fn squares_agree_in_wide_clips(
        p in [point(160), point(160), point(160)],
        far in prop::sample::select(vec![1, 9]),
        corner in (-20..20, -20..20),
        size in (1..200, 1..40),
        standard in prop::sample::select(vec![1, 4]),
    ) {
        let Some(shape) = triangle(&p.map(|v| v.map(|c| c * far))) else { return Ok(()) };
        let clip = IntRect::new(corner.0, corner.1, corner.0 + size.0, corner.1 + size.1);
        let pattern = SamplePattern::standard(standard).unwrap();
        let definition = by(Traversal::Scanline, &shape, clip, &pattern);
        check_squares(&shape, clip, &pattern, &definition)?;
    }

    #[test]
    fn all_traversals_and_levels_agree(p in corners(), pattern in any_pattern()) {
        let Some(shape) = triangle(&p) else { return Ok(()) };
        let definition = by(Traversal::BoundingBox, &shape, WINDOW, &pattern);
        for traversal in OTHERS {
            let found = by(traversal, &shape, WINDOW, &pattern);
            prop_assert_eq!(&found, &definition, "{:?}", traversal);
        }
        for level in levels() {
            let mut found = Collected::new(&pattern);
            let mut scratch = Scratch::with_level(level);
            shape.rasterize(WINDOW, &pattern, &mut scratch, &mut found);
            prop_assert_eq!(&found, &definition, "{:?}", level);
        }
        check_squares(&shape, WINDOW, &pattern, &definition)?;
    }

    #[test]
    fn polygons_agree_with_their_definition(
        contours in prop::collection::vec(prop::collection::vec(point(18), 3..9), 1..3),
        far in prop::sample::select(vec![1, 1, 300, 20_000]),
        rule in rule(),
        pattern in any_pattern(),
    ) {
        let grown = |p: [i64; 2]| p.map(|c| (c * far).clamp(-(1 << 29), 1 << 29));
        let contours: Vec<Vec<_>> =
            contours.into_iter().map(|c| c.into_iter().map(grown).collect()).collect();
        let Some(shape) = polygon(&contours, rule) else { return Ok(()) };
        let definition = by(Traversal::BoundingBox, &shape, WINDOW, &pattern);
        prop_assert_eq!(&by(Traversal::Scanline, &shape, WINDOW, &pattern), &definition);
        for level in levels() {
            let mut found = Collected::new(&pattern);
            let mut scratch = Scratch::with_level(level);
            shape.rasterize(WINDOW, &pattern, &mut scratch, &mut found);
            prop_assert_eq!(&found, &definition, "{:?}", level);
        }
    }
}

#[test]
fn orders_visit_as_they_say() {
    struct Steps(Vec<(i32, i32)>);
    impl Sink for Steps {
        fn run(&mut self, y: i32, x0: i32, x1: i32) {
            assert_eq!(x1, x0 + 1);
            self.0.push((x0, y));
        }
        fn pixel(&mut self, _: i32, _: i32, _: SampleMask) {}
    }
    // It fills the square of 4 × 4 pixels at the origin.
    let shape = triangle(&[[-1024, -1024], [4096, -1024], [-1024, 4096]]).unwrap();
    let pattern = SamplePattern::standard(1).unwrap();
    let path = |order| {
        let mut steps = Steps(Vec::new());
        let clip = IntRect::new(0, 0, 4, 4);
        let way = Traversal::Incremental(order);
        shape.rasterize_by(way, clip, &pattern, &mut Scratch::new(), &mut steps);
        assert_eq!(steps.0.len(), 16);
        steps.0
    };
    let far = |path: &[(i32, i32)]| {
        path.windows(2).filter(|w| (w[0].0 - w[1].0).abs() + (w[0].1 - w[1].1).abs() != 1).count()
    };
    assert_eq!(far(&path(Order::RowMajor)), 3);
    assert_eq!(far(&path(Order::ZigZag)), 0);
    assert_eq!(far(&path(Order::Hilbert)), 0);
    assert_eq!(path(Order::Morton)[..5], [(0, 0), (1, 0), (0, 1), (1, 1), (2, 0)]);
    assert_eq!(path(Order::Backtrack)[..5], [(0, 0), (1, 0), (2, 0), (3, 0), (0, 1)]);
}
