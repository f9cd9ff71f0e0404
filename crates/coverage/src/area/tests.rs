use super::*;
use crate::{AreaSink, Level};
use fearless_simd::{dispatch, prelude::*};
use proptest::prelude::*;

/// Collects the areas of one row.
struct Row(Vec<f32>);

impl AreaSink for Row {
    fn run(&mut self, _: i32, x0: i32, x1: i32) {
        (x0..x1).for_each(|x| self.pixel(x, 0, 1.0));
    }
    fn pixel(&mut self, x: i32, _: i32, area: f32) {
        assert_eq!(self.0[x as usize], 0.0, "named twice");
        self.0[x as usize] = area;
    }
}

const WIDTH: i32 = 40;

fn edge() -> impl Strategy<Value = [i32; 4]> {
    let x = -4 * 256..(WIDTH + 4) * 256;
    (x.clone(), -600..256, x, 1..600)
        .prop_filter_map("level", |(x0, y0, x1, y1)| (y0 < y1).then_some([x0, y0, x1, y1]))
}

/// The edge within the row y = 0.
fn reach([x0, y0, x1, y1]: [i32; 4]) -> Reach {
    let height = |y: i32| f64::from(y.clamp(0, 256)) / 256.0;
    Slope::new(x0, y0, x1, y1).reach(height(y0), height(y1))
}

/// What lies right of the edge in pixel x, by the definition.
fn right(reach: &Reach, x: i32) -> f64 {
    if reach.sign < 0.0 {
        reach.height - reach.part(f64::from(-1 - x))
    } else {
        reach.part(f64::from(x))
    }
}

proptest! {
    #[test]
    fn a_row_sums_its_edges_to_the_bit(
        mut edges in prop::collection::vec((edge(), prop::bool::ANY), 1..6),
        clip in (0..WIDTH, 1..WIDTH),
    ) {
        let clip = (clip.0, (clip.0 + clip.1).min(WIDTH));
        edges.sort_by(|a, b| {
            let left = |e: [i32; 4]| reach(e).extent()[0];
            left(a.0).total_cmp(&left(b.0))
        });
        let mut row = AreaRow::default();
        row.start(clip.0, clip.1);
        let mut found = Row(vec![0.0; WIDTH as usize]);
        dispatch!(Level::new(), simd => {
            row.begin(0.0);
            for (i, (e, up)) in edges.iter().enumerate() {
                let (reach, weight) = (reach(*e), if *up { -1.0 } else { 1.0 });
                let pixels = touched(reach.extent(), clip.0, clip.1);
                let is_last = i + 1 == edges.len();
                if is_last && pixels.1 - pixels.0 < CHUNK && row.is_beyond(pixels.0) {
                    row.add_lone(simd, 0, &reach, pixels, weight, &mut found);
                } else {
                    row.open(simd, 0, pixels, &mut found);
                    row.add(simd, &reach, pixels, weight);
                }
            }
            row.finish(simd, 0, &mut found);
        });
        for x in 0..WIDTH {
            let sum: f64 = edges
                .iter()
                .map(|(e, up)| if *up { -right(&reach(*e), x) } else { right(&reach(*e), x) })
                .sum();
            let expected = if x < clip.0 || x >= clip.1 { 0.0 } else { sum.clamp(0.0, 1.0) as f32 };
            prop_assert_eq!(found.0[x as usize], expected, "pixel {}", x);
        }
    }

    #[test]
    fn a_part_is_the_mean_of_what_is_left_behind(e in edge(), x in 0..WIDTH) {
        let reach = reach(e);
        let c = f64::from(x);
        const STEPS: i32 = 4000;
        let mean: f64 = (0..STEPS)
            .map(|i| {
                let t = (f64::from(i) + 0.5) / f64::from(STEPS);
                let at = reach.from + (reach.to - reach.from) * t;
                (c + 1.0 - at).clamp(0.0, 1.0)
            })
            .sum::<f64>() / f64::from(STEPS);
        prop_assert!((reach.part(c) - reach.height * mean).abs() < 1e-4);
    }

    #[test]
    fn it_does_not_matter_where_a_sum_is_cut(e in edge(), at in 1..256, x in 0..WIDTH) {
        let whole = reach(e);
        let start = f64::from(e[1].max(0)) / 256.0;
        let end = f64::from(e[3].min(256)) / 256.0;
        let cut = (f64::from(at) / 256.0).clamp(start, end);
        let upper = Slope::new(e[0], e[1], e[2], e[3]).reach(start, cut);
        let c = f64::from(x);
        // Left behind before the cut: nothing is added after it.
        if upper.to >= c + 1.0 {
            prop_assert_eq!(upper.part(c), whole.part(c));
        }
        // Not reached after the whole row: all of the height is right of it.
        if c >= whole.to {
            prop_assert_eq!(whole.part(c) - upper.part(c), end - cut);
        }
    }

    #[test]
    fn eight_are_as_one(e in edge(), first in -4..WIDTH) {
        let reach = reach(e);
        let columns: [f64; 8] = core::array::from_fn(|i| f64::from(first + i as i32));
        let mut found = [0.0; 8];
        dispatch!(Level::new(), simd => {
            let c = fearless_simd::f64x8::from_slice(simd, &columns);
            let ends = [reach.from, reach.to];
            eight_parts(simd, c, ends, reach.height, reach.half_rise).store_slice(&mut found);
        });
        prop_assert_eq!(found, columns.map(|c| reach.part(c)));
    }

    #[test]
    fn what_lies_right_of_it_is_the_same_in_eights(e in edge(), first in -4..WIDTH) {
        let reach = reach(e);
        for weight in [1.0, -1.0] {
            let mut found = [0.0; 8];
            dispatch!(Level::new(), simd => {
                eight_right(simd, first, &reach, weight).store_slice(&mut found);
            });
            let expected: [f64; 8] =
                core::array::from_fn(|i| weight * reach.right(f64::from(first + i as i32)));
            prop_assert_eq!(found, expected);
        }
    }
}
