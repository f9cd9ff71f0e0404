//! Seamless meshes: every sample inside belongs to exactly one triangle.
#![allow(missing_docs)]

mod common;
use common::mesh::{Mesh, Random};
use common::*;
use proptest::prelude::*;
use scumble_coverage::*;
use std::collections::BTreeMap;

/// At least 10⁵ cases here, which take a second or two; more if the environment says so.
fn many() -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: default.cases.max(100_000), ..default }
}

proptest! {
    #![proptest_config(many())]

    #[test]
    fn each_sample_of_a_mesh_belongs_to_one_triangle(seed in any::<u64>(), grain in 0..8u32, n in 0..4usize) {
        let mesh = Mesh::random(&mut Random::new(seed), 12, 1 << grain);
        let pattern = SamplePattern::standard([1, 2, 4, 16][n]).unwrap();
        let clip = IntRect::new(-2, -2, 9, 9);
        let mut owned = BTreeMap::new();
        let mut scratch = Scratch::new();
        for t in &mesh.triangles {
            let shape = triangle(t).unwrap();
            let mut out = Collected::new(&pattern);
            shape.rasterize(clip, &pattern, &mut scratch, &mut out);
            for (at, mask) in out.masks {
                let before = owned.entry(at).or_insert(0);
                prop_assert_eq!(*before & mask, 0, "owned twice at {:?}", at);
                *before |= mask;
            }
        }
        let whole = polygon(&[mesh.outline], FillRule::NonZero);
        let whole = whole.map_or_else(BTreeMap::new, |s| raster(&s, clip, &pattern).masks);
        prop_assert_eq!(owned, whole);
    }
}

proptest! {
    #[test]
    fn moving_by_whole_pixels_and_turning_the_corners_change_nothing(
        p in [point(18), point(18), point(18)],
        by in (-1000..1000i64, -1000..1000i64),
        pattern in any_pattern(),
    ) {
        let Some(shape) = triangle(&p) else { return Ok(()) };
        let here = raster(&shape, WINDOW, &pattern);
        let [a, b, c] = p;
        for turned in [[b, c, a], [c, a, b], [c, b, a], [b, a, c], [a, c, b]] {
            prop_assert_eq!(&raster(&triangle(&turned).unwrap(), WINDOW, &pattern), &here);
        }
        let moved = p.map(|v| [v[0] + by.0 * 256, v[1] + by.1 * 256]);
        let (dx, dy) = (by.0 as i32, by.1 as i32);
        let window = IntRect::new(WINDOW.x0 + dx, WINDOW.y0 + dy, WINDOW.x1 + dx, WINDOW.y1 + dy);
        let there = raster(&triangle(&moved).unwrap(), window, &pattern).masks;
        let back: BTreeMap<_, _> =
            there.into_iter().map(|((x, y), mask)| ((x - dx, y - dy), mask)).collect();
        prop_assert_eq!(back, here.masks);
    }
}
