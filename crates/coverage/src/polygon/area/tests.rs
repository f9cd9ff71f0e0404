use super::*;
use crate::FixedPoint;
use alloc::vec::Vec;
use proptest::prelude::*;
use scumble_geometry::FillRule;

/// What a sink hears of each pixel.
#[derive(Default, PartialEq, Debug)]
struct Areas(Vec<(i32, i32, f32)>);

impl AreaSink for Areas {
    fn run(&mut self, y: i32, x0: i32, x1: i32) {
        (x0..x1).for_each(|x| self.pixel(x, y, 1.0));
    }
    fn pixel(&mut self, x: i32, y: i32, area: f32) {
        self.0.push((x, y, area));
    }
}

/// Whether all edges untied one by one give the same bits as what is drawn.
fn check_short_way(polygon: &Polygon) -> Result<(), TestCaseError> {
    for rect in [polygon.bounds(), IntRect::new(3, 0, 11, 8)] {
        let rect = rect.intersect(&polygon.bounds());
        if rect.is_empty() {
            continue;
        }
        let clipped = Clipped { polygon, rect };
        let mut scratch = PolygonScratch::default();
        let (mut short, mut long) = (Areas::default(), Areas::default());
        dispatch!(Level::new(), simd => {
            clipped.rasterize::<_, true>(simd, &mut scratch, &mut short);
            clipped.rasterize::<_, false>(simd, &mut scratch, &mut long);
        });
        prop_assert_eq!(short, long);
    }
    Ok(())
}

proptest! {
    #[test]
    fn the_short_way_gives_the_same_bits(
        contours in prop::collection::vec(
            prop::collection::vec((-600..5000i32, -200..2500i32), 3..9),
            1..4,
        ),
        even_odd in any::<bool>(),
        grid in 0..8u32,
    ) {
        let mut builder = Polygon::builder();
        for contour in &contours {
            contour
                .iter()
                .for_each(|p| builder.push(FixedPoint { x: p.0 >> grid << grid, y: p.1 >> grid << grid }));
            builder.close();
        }
        let rule = if even_odd { FillRule::EvenOdd } else { FillRule::NonZero };
        let Some(polygon) = builder.finish(rule) else { return Ok(()) };
        check_short_way(&polygon)?;
    }

    #[test]
    fn the_short_way_gives_the_same_bits_for_many_edges(
        radii in prop::collection::vec(1.0..3000.0f64, 3..120),
        (turns, even_odd) in (1..4u32, any::<bool>()),
    ) {
        // Around once it does not cross itself; around again it does.
        let mut builder = Polygon::builder();
        let step = f64::from(turns) * core::f64::consts::TAU / radii.len() as f64;
        for (i, r) in radii.iter().enumerate() {
            let (sin, cos) = (step * i as f64).sin_cos();
            builder.push(FixedPoint { x: (2.0 * r * cos) as i32, y: (r * sin) as i32 });
        }
        builder.close();
        let rule = if even_odd { FillRule::EvenOdd } else { FillRule::NonZero };
        let Some(polygon) = builder.finish(rule) else { return Ok(()) };
        check_short_way(&polygon)?;
    }

    #[test]
    fn a_clip_of_many_edges_changes_nothing(
        points in prop::collection::vec((-600..200_000i32, -200..9000i32), 100..300),
        reach in 1..20_000i32,
        even_odd in any::<bool>(),
        (width, height, dx, dy) in (20..90i32, 5..40i32, 0..5i32, 0..5i32),
    ) {
        // Short edges and long ones.
        let mut builder = Polygon::builder();
        let mut at = FixedPoint { x: 0, y: 0 };
        for (i, p) in points.iter().enumerate() {
            let near = |from: i32, to: i32| from + (to - from).clamp(-reach, reach);
            at = if i % 50 == 0 {
                FixedPoint { x: p.0, y: p.1 }
            } else {
                FixedPoint { x: near(at.x, p.0), y: near(at.y, p.1) }
            };
            builder.push(at);
        }
        builder.close();
        let rule = if even_odd { FillRule::EvenOdd } else { FillRule::NonZero };
        let Some(polygon) = builder.finish(rule) else { return Ok(()) };
        let bounds = polygon.bounds();
        let mut scratch = PolygonScratch::default();
        let mut areas = |regions: &mut dyn Iterator<Item = IntRect>| {
            let mut all = Areas::default();
            for region in regions.filter(|r| !r.is_empty()) {
                polygon.rasterize_area(region, Level::new(), &mut scratch, &mut all);
            }
            all.0.retain(|p| p.2 > 0.0);
            all.0.sort_by_key(|p| (p.1, p.0));
            all
        };
        let whole = areas(&mut core::iter::once(bounds));
        let mut tiles = Vec::new();
        for y in (bounds.y0 - dy..bounds.y1).step_by(height as usize) {
            for x in (bounds.x0 - dx..bounds.x1).step_by(width as usize) {
                tiles.push(IntRect::new(x, y, x + width, y + height).intersect(&bounds));
            }
        }
        prop_assert_eq!(whole, areas(&mut tiles.into_iter()));
    }
}
