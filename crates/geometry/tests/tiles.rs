//! Tiles cut an area without gap or overlap, and bins list exactly what touches.
#![allow(missing_docs)]

use proptest::prelude::*;
use scumble_geometry::{IntRect, TileBins, TileGrid};

fn rect(low: i32, high: i32) -> impl Strategy<Value = IntRect> {
    let range = move || (low..high, low..high).prop_map(|(a, b)| (a.min(b), a.max(b)));
    (range(), range()).prop_map(|((x0, x1), (y0, y1))| IntRect::new(x0, y0, x1, y1))
}

proptest! {
    #[test]
    fn tiles_cut_and_bins_list(
        area in rect(-40, 80),
        side in 1..50_u32,
        rects in prop::collection::vec(rect(-60, 100), 0..30),
    ) {
        prop_assume!(!area.is_empty());
        let grid = TileGrid::new(area, side);
        let mut bins = TileBins::new(grid, &rects);
        let mut lists = vec![vec![7]; grid.columns()];
        let mut pixels = 0;
        for band in 0..grid.bands() {
            bins.fill(band, &mut lists);
            for (column, list) in lists.iter().enumerate() {
                let tile = grid.tile(column, band);
                prop_assert!(tile.intersect(&area) == tile && tile.width() <= side);
                pixels += tile.width() * tile.height();
                let touching = |&i: &u32| !rects[i as usize].intersect(&tile).is_empty();
                let expected: Vec<u32> = (0..rects.len() as u32).filter(touching).collect();
                prop_assert_eq!(list, &expected);
            }
        }
        prop_assert_eq!(pixels, area.width() * area.height());
        prop_assert!(grid.tile(grid.columns(), 0).is_empty());
        prop_assert!(grid.tile(0, usize::MAX).is_empty());
    }
}
