use super::*;
use proptest::prelude::*;
use scumble_pixel::Straight;

/// The definition: every sample of every pixel stored, always.
struct Naive {
    width: usize,
    height: usize,
    samples: usize,
    colors: Vec<Premul>,
}

impl Naive {
    fn new(width: u32, height: u32, samples: u32, background: Premul) -> Self {
        let (width, height, samples) = (width as usize, height as usize, samples as usize);
        Self { width, height, samples, colors: vec![background; width * height * samples] }
    }

    fn sample(&mut self, x: usize, y: usize, s: usize) -> Option<&mut Premul> {
        (x < self.width && y < self.height && s < self.samples)
            .then(|| &mut self.colors[(y * self.width + x) * self.samples + s])
    }

    fn blend(&mut self, x: usize, y: usize, s: usize, color: Premul) {
        if let Some(below) = self.sample(x, y, s) {
            *below = if color.alpha() == 1.0 { color } else { color.over(*below) };
        }
    }

    fn pixel(&self, x: usize, y: usize) -> Premul {
        let start = (y * self.width + x) * self.samples;
        mean(&self.colors[start..start + self.samples])
    }

    fn apply(&mut self, op: &Op) {
        let samples = self.samples;
        match op {
            Op::Block(x, y, w, h, c) => {
                for (row, column) in (*y..y + h).flat_map(|r| (*x..x + w).map(move |c| (r, c))) {
                    (0..samples).for_each(|s| self.blend(column as usize, row as usize, s, *c));
                }
            }
            Op::Run(x, y, colors) => {
                for (i, &c) in colors.iter().enumerate() {
                    (0..samples).for_each(|s| self.blend(*x as usize + i, *y as usize, s, c));
                }
            }
            Op::Masked(x, y, mask, c) => {
                for s in (0..64).filter(|s| mask >> s & 1 == 1) {
                    self.blend(*x as usize, *y as usize, s, *c);
                }
            }
            Op::Samples(x, y, mask, colors) => {
                for (s, &c) in (0..64).filter(|s| mask >> s & 1 == 1).zip(colors) {
                    self.blend(*x as usize, *y as usize, s, c);
                }
            }
        }
    }
}

#[derive(Debug, Clone)]
enum Op {
    Block(u32, u32, u32, u32, Premul),
    Run(u32, u32, Vec<Premul>),
    Masked(u32, u32, u64, Premul),
    Samples(u32, u32, u64, Vec<Premul>),
}

fn apply(tile: &mut Tile, op: &Op) {
    match op {
        Op::Block(x, y, w, h, c) => tile.fill_block(*x, *y, *w, *h, *c),
        Op::Run(x, y, colors) => tile.blend_run(*x, *y, colors),
        Op::Masked(x, y, mask, c) => tile.blend_masked(*x, *y, *mask, *c),
        Op::Samples(x, y, mask, colors) => tile.blend_samples(*x, *y, *mask, colors),
    }
}

/// Few distinct colours, so that equal ones meet; opaque, clear and between.
fn colour() -> impl Strategy<Value = Premul> {
    let straight = prop_oneof![
        Just([0.2, 0.4, 0.6, 1.0]),
        Just([0.9, 0.1, 0.3, 1.0]),
        Just([0.9, 0.1, 0.3, 0.3]),
        Just([0.0; 4]),
        prop::array::uniform4(0.0_f32..=1.0),
    ];
    straight.prop_map(|c| Straight(c).premultiply())
}

/// Masks of many samples and of few, and complements that close a pixel.
fn mask() -> impl Strategy<Value = u64> {
    prop_oneof![any::<u64>(), 0..16_u64, Just(u64::MAX), Just(0xff), Just(!0xff)]
}

fn op() -> impl Strategy<Value = Op> {
    let colours = || prop::collection::vec(colour(), 0..20);
    prop_oneof![
        (0..6_u32, 0..5_u32, 0..5_u32, 0..5_u32, colour())
            .prop_map(|(x, y, w, h, c)| Op::Block(x, y, w, h, c)),
        (0..6_u32, 0..5_u32, colours()).prop_map(|(x, y, c)| Op::Run(x, y, c)),
        (0..6_u32, 0..5_u32, mask(), colour()).prop_map(|(x, y, m, c)| Op::Masked(x, y, m, c)),
        (0..6_u32, 0..5_u32, mask(), colours()).prop_map(|(x, y, m, c)| Op::Samples(x, y, m, c)),
    ]
}

fn ops() -> impl Strategy<Value = Vec<Op>> {
    prop::collection::vec(op(), 0..40)
}

fn bits(p: Premul) -> [u32; 4] {
    p.0.map(f32::to_bits)
}

fn rows(tile: &Tile) -> Vec<Vec<Premul>> {
    (0..tile.height())
        .map(|y| {
            let mut row = vec![Premul::TRANSPARENT; tile.width() as usize];
            tile.resolve_row(y, &mut row);
            row
        })
        .collect()
}

fn assert_same(tile: &Tile, naive: &Naive) -> Result<(), TestCaseError> {
    for (y, row) in rows(tile).iter().enumerate() {
        for (x, &pixel) in row.iter().enumerate() {
            prop_assert_eq!(bits(pixel), bits(naive.pixel(x, y)), "({}, {})", x, y);
        }
    }
    Ok(())
}

const WIDTH: u32 = 5;
const HEIGHT: u32 = 4;

proptest! {
    #[test]
    fn areas_are_parts_of_a_colour(
        samples in 1..=16_u32,
        masks in prop::collection::vec(any::<u64>(), 8),
        areas in prop::collection::vec(
            prop_oneof![Just(0.0_f32), Just(1.0), 0.0_f32..1.0], 0..10),
        alpha in prop_oneof![Just(1.0_f32), 0.0_f32..1.0],
        x in 0..9_u32,
    ) {
        let background = Straight([0.2, 0.9, 0.4, 0.7]).premultiply();
        let color = Straight([0.8, 0.3, 0.6, alpha]).premultiply();
        let mut tile = Tile::new();
        tile.reset(8, 1, samples, background);
        for (x, mask) in (0..).zip(masks) {
            tile.blend_masked(x, 0, mask, Premul([0.1, 0.1, 0.1, 1.0]));
        }
        let mut by_pixel = tile.clone();
        tile.blend_areas(x, 0, &areas, color);
        for (x, &area) in (x..).zip(&areas) {
            by_pixel.blend_run(x, 0, &[color.scaled(area)]);
        }
        let [mut found, mut expected] = [[Premul::TRANSPARENT; 8]; 2];
        tile.resolve_row(0, &mut found);
        by_pixel.resolve_row(0, &mut expected);
        prop_assert_eq!(found, expected);
    }
}

proptest! {
    #[test]
    fn equals_the_naive_twin(samples in 1..=64_u32, background in colour(), ops in ops()) {
        let mut tile = Tile::new();
        tile.reset(WIDTH, HEIGHT, samples, background);
        let mut naive = Naive::new(WIDTH, HEIGHT, samples, background);
        for op in &ops {
            apply(&mut tile, op);
            naive.apply(op);
        }
        assert_same(&tile, &naive)?;
    }

    #[test]
    fn composite_equals_the_naive_twin(
        samples in 1..=16_u32,
        below in ops(),
        above in ops(),
        opacity in prop_oneof![Just(1.0_f32), 0.0..=1.0_f32],
    ) {
        let grey = Premul([0.5, 0.5, 0.5, 1.0]);
        let (mut tile, mut layer) = (Tile::new(), Tile::new());
        tile.reset(WIDTH, HEIGHT, samples, grey);
        layer.reset(WIDTH, HEIGHT, samples, Premul::TRANSPARENT);
        let mut naive = Naive::new(WIDTH, HEIGHT, samples, grey);
        let mut naive_layer = Naive::new(WIDTH, HEIGHT, samples, Premul::TRANSPARENT);
        below.iter().for_each(|op| { apply(&mut tile, op); naive.apply(op); });
        above.iter().for_each(|op| { apply(&mut layer, op); naive_layer.apply(op); });
        tile.composite(&layer, opacity);
        if opacity > 0.0 {
            for (b, a) in naive.colors.iter_mut().zip(&naive_layer.colors) {
                blend(b, a.scaled(opacity));
            }
        }
        assert_same(&tile, &naive)?;
    }

    #[test]
    fn a_used_tile_is_as_good_as_new(before in ops(), after in ops(), samples in 1..=16_u32) {
        let (mut used, mut new) = (Tile::new(), Tile::new());
        used.reset(7, 9, 5, Premul::TRANSPARENT);
        before.iter().for_each(|op| apply(&mut used, op));
        for tile in [&mut used, &mut new] {
            tile.reset(WIDTH, HEIGHT, samples, Premul::TRANSPARENT);
            after.iter().for_each(|op| apply(tile, op));
        }
        prop_assert_eq!(rows(&used), rows(&new));
    }

    #[test]
    fn mean_of_equals_is_the_value(color in colour(), samples in 1..=64_usize) {
        prop_assert_eq!(bits(mean(&vec![color; samples])), bits(color));
    }

    #[test]
    fn mean_is_the_mean(colors in prop::collection::vec(colour(), 1..=64)) {
        let found = mean(&colors);
        for c in 0..4 {
            let sum: f64 = colors.iter().map(|p| f64::from(p.0[c])).sum();
            prop_assert!((f64::from(found.0[c]) - sum / colors.len() as f64).abs() < 1e-6);
        }
    }
}

const RED: Premul = Premul([1.0, 0.0, 0.0, 1.0]);
const WHITE: Premul = Premul([1.0; 4]);

fn tile(samples: u32) -> Tile {
    let mut tile = Tile::new();
    tile.reset(WIDTH, HEIGHT, samples, WHITE);
    tile
}

#[test]
fn pixels_split_and_unite() {
    let mut t = tile(16);
    t.blend_masked(1, 1, 0x00ff, RED);
    assert_eq!(t.split_pixels(), 1);
    // The other half in the same colour, as from the neighbour in a mesh.
    t.blend_masked(1, 1, 0xff00, RED);
    assert_eq!(t.split_pixels(), 0);
    // What changes nothing splits nothing.
    t.blend_masked(1, 1, 0x0f0f, RED);
    assert_eq!(t.split_pixels(), 0);
    t.blend_masked(2, 2, 1, RED);
    t.blend_masked(3, 2, 1, RED);
    t.fill_block(2, 2, 1, 1, RED);
    assert_eq!(t.split_pixels(), 1);
    t.blend_run(3, 2, &[RED]);
    assert_eq!(t.split_pixels(), 0);
}

#[test]
fn one_sample_never_splits() {
    let mut t = tile(1);
    t.blend_masked(0, 0, 1, RED);
    t.blend_masked(1, 0, !1, RED);
    t.blend_samples(2, 0, 1, &[RED]);
    assert_eq!(t.split_pixels(), 0);
    assert_eq!(rows(&t)[0], [RED, WHITE, RED, WHITE, WHITE]);
}

#[test]
fn a_layer_of_another_shape() {
    let mut layer = Tile::new();
    layer.reset(2, 9, 4, Premul::TRANSPARENT);
    layer.fill_block(0, 0, 9, 9, RED);
    layer.blend_masked(1, 0, 0b0011, WHITE);
    let mut t = tile(16);
    t.composite(&layer, 1.0);
    let pink = Premul([1.0, 0.5, 0.5, 1.0]);
    assert_eq!(rows(&t)[0], [RED, pink, WHITE, WHITE, WHITE]);
    assert_eq!(rows(&t)[3], [RED, RED, WHITE, WHITE, WHITE]);
    t.composite(&layer, f32::NAN);
    assert_eq!(rows(&t)[0][0], RED);
}

#[test]
fn nonsense_is_ignored() {
    let mut t = Tile::new();
    t.fill_block(0, 0, 1, 1, RED);
    t.blend_masked(0, 0, 1, RED);
    t.resolve_row(0, &mut [WHITE]);
    t.reset(u32::MAX, 0, 0, WHITE);
    assert_eq!((t.width(), t.height(), t.samples()), (Tile::MAX_SIDE, 0, 1));
    t.reset(WIDTH, HEIGHT, 1000, WHITE);
    assert_eq!(t.samples(), 64);
    t.fill_block(u32::MAX, 1, u32::MAX, u32::MAX, RED);
    t.fill_block(4, 3, u32::MAX, u32::MAX, RED);
    t.blend_run(u32::MAX, u32::MAX, &[RED]);
    t.blend_masked(5, 0, 1, RED);
    t.blend_samples(0, 4, u64::MAX, &[RED]);
    t.blend_samples(0, 0, u64::MAX, &[]);
    assert_eq!(rows(&t).concat().iter().filter(|&&p| p == RED).count(), 1);
    let nan = Premul([f32::NAN; 4]);
    t.blend_masked(0, 0, 3, nan);
    t.composite(&t.clone(), f32::INFINITY);
}

#[test]
fn memory_is_as_stated() {
    for samples in [1, 4, 64] {
        let mut t = Tile::new();
        t.reset(32, 32, samples, WHITE);
        for _ in 0..2 {
            for i in 0..32 * 32 {
                t.blend_masked(i % 32, i / 32, 1, RED);
            }
            let bytes = size_of::<Premul>() * (t.colors.capacity() + t.store.color_capacity())
                + size_of::<Slot>() * t.slots.capacity()
                + SampleStore::OVERHEAD * t.store.slot_capacity();
            assert!(bytes as u64 <= Tile::max_bytes(32, 32, samples), "{bytes}");
            t.reset(32, 32, samples, WHITE);
        }
    }
}
