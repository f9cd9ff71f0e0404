//! One-pixel lines.
#![allow(missing_docs)]

use proptest::prelude::*;
use scumble_coverage::*;

const CLIP: IntRect = IntRect::new(0, 0, 40, 30);

fn pixels(a: [f64; 2], b: [f64; 2], clip: IntRect) -> Vec<(i32, i32)> {
    let mut out = Vec::new();
    hairline(a.into(), b.into(), clip, |x, y| out.push((x, y)));
    out
}

#[test]
fn it_steps_from_the_left_end_and_takes_floors() {
    assert_eq!(pixels([1.5, 2.5], [4.5, 4.0], CLIP), [(1, 2), (2, 3), (3, 3), (4, 4)]);
    assert_eq!(pixels([4.5, 4.0], [1.5, 2.5], CLIP), [(1, 2), (2, 3), (3, 3), (4, 4)]);
    assert_eq!(pixels([2.0, 1.0], [2.9, 3.5], CLIP), [(2, 1), (2, 2), (2, 3)]);
    // A steep line that rises to the right starts at its lower, left end.
    assert_eq!(pixels([2.9, 1.0], [2.0, 3.5], CLIP), [(2, 1), (2, 2), (2, 3)]);
    assert_eq!(pixels([4.0, 1.2], [3.0, 4.0], CLIP), [(3, 2), (3, 3), (3, 4)]);
    assert_eq!(pixels([7.2, 8.9], [7.2, 8.9], CLIP), [(7, 8)]);
    // The last step must not pass the far end, but a level line fills its last column.
    assert_eq!(pixels([0.9, 0.0], [2.8, 0.5], CLIP), [(0, 0), (1, 0)]);
    assert_eq!(pixels([0.9, 0.0], [2.8, 0.0], CLIP), [(0, 0), (1, 0), (2, 0)]);
}

#[test]
fn any_numbers_end_soon() {
    for a in [0.0, 5.5, -1e6, 1e9, 1e30, -1e308, 1e308, f64::INFINITY, f64::NAN] {
        for b in [0.0, -7.25, 3e7, -1e30, 1.7e308, f64::NEG_INFINITY, f64::NAN] {
            let n = pixels([a, b], [b, a], CLIP).len() + pixels([a, 3.0], [b, 5.0], CLIP).len();
            assert!(n <= 80);
        }
    }
    assert!(pixels([0.0, 0.0], [9.0, 9.0], IntRect::new(3, 3, 3, 9)).is_empty());
}

proptest! {
    #[test]
    fn tiles_give_the_same(a in [-50.0..90.0f64, -50.0..90.0], b in [-50.0..90.0f64, -50.0..90.0]) {
        let mut whole = pixels(a, b, CLIP);
        prop_assert!(whole.iter().all(|&(x, y)| CLIP.contains(x, y)));
        let mut parts = Vec::new();
        for y in (0..30).step_by(7) {
            for x in (0..40).step_by(9) {
                parts.extend(pixels(a, b, IntRect::new(x, y, x + 9, y + 7).intersect(&CLIP)));
            }
        }
        whole.sort_unstable();
        parts.sort_unstable();
        prop_assert_eq!(parts, whole);
    }
}
