use super::*;
use proptest::prelude::*;
use std::{vec, vec::Vec};

/// The definition: every sample of every pixel stored, always.
struct Naive {
    width: u32,
    height: u32,
    samples: u32,
    keys: Vec<u32>,
}

impl Naive {
    fn set(&mut self, x: u32, y: u32, mask: u64, key: u32) {
        if x < self.width && y < self.height {
            let first = ((y * self.width + x) * self.samples) as usize;
            for s in (0..self.samples as usize).filter(|s| mask >> s & 1 == 1) {
                self.keys[first + s] = key;
            }
        }
    }
}

#[derive(Debug, Clone)]
enum Op {
    Block(u32, u32, u32, u32, u32),
    Cover(u32, u32, u64, u32),
}

fn op() -> impl Strategy<Value = Op> {
    let key = prop_oneof![0..4_u32, Just(Visibility::MAX_KEY)];
    let mask = prop_oneof![any::<u64>(), (0..64_u32).prop_map(|b| 1 << b), Just(u64::MAX)];
    prop_oneof![
        (0..9_u32, 0..9_u32, 0..9_u32, 0..9_u32, key.clone())
            .prop_map(|(x, y, w, h, k)| Op::Block(x, y, w, h, k)),
        (0..9_u32, 0..9_u32, mask, key).prop_map(|(x, y, m, k)| Op::Cover(x, y, m, k)),
    ]
}

/// All samples of a row, as `row` tells them.
fn samples_of(tile: &Visibility, y: u32, samples: u32) -> Vec<u32> {
    let mut out = Vec::new();
    for seen in tile.row(y) {
        match seen {
            Seen::Whole { x, len, key } => {
                assert_eq!(out.len(), x * samples as usize);
                out.extend(vec![key; len * samples as usize]);
            }
            Seen::Mixed { x, keys } => {
                assert_eq!(out.len(), x * samples as usize);
                out.extend(keys);
            }
        }
    }
    out
}

/// Four colours, one that is not opaque, for keys 0 to 3; beyond them, nothing.
const COLORS: [[f32; 4]; 4] =
    [[0.2, 0.3, 0.7, 1.0], [1.0, 0.0, 0.1, 1.0], [0.9, 0.9, 0.8, 1.0], [0.1, 0.2, 0.3, 0.4]];

/// Shading and encoding are the mean over samples of the definition.
fn check_colours(tile: &Visibility, naive: &Naive) -> Result<(), TestCaseError> {
    let color = |key: u32| COLORS.get(key as usize).map_or(Premul::TRANSPARENT, |&c| Premul(c));
    for space in [WorkingSpace::Srgb, WorkingSpace::Linear] {
        let mut palette = Palette::new(space);
        COLORS.iter().for_each(|&c| palette.push(Premul(c)));
        for y in 0..naive.height {
            let row = (naive.width * naive.samples) as usize;
            let keys = &naive.keys[y as usize * row..][..row];
            let samples: Vec<Premul> = keys.iter().map(|&k| color(k)).collect();
            let pixels: Vec<Premul> = samples.chunks(naive.samples as usize).map(mean).collect();
            let mut shaded = vec![Premul::TRANSPARENT; naive.width as usize];
            tile.shade_row(y, &mut shaded, |key, _, out| out.fill(color(key)));
            prop_assert_eq!(&shaded, &pixels);
            let mut codes = vec![[9; 4]; naive.width as usize];
            tile.encode_row(y, &palette, &mut codes);
            let expected: Vec<_> = pixels.iter().map(|&p| space.export(p)).collect();
            prop_assert_eq!(codes, expected);
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn it_sees_what_came_last(
        runs in prop::collection::vec(
            (1..8_u32, 1..8_u32, 1..=64_u32, 0..3_u32, prop::collection::vec(op(), 0..40)), 1..3),
    ) {
        // Several in one tile, so that what an earlier one left behind would show.
        let mut tile = Visibility::new();
        for (width, height, samples, background, ops) in runs {
            tile.reset(width, height, samples, background);
            let keys = vec![background; (width * height * samples) as usize];
            let mut naive = Naive { width, height, samples, keys };
            for op in ops {
                match op {
                    Op::Block(x, y, w, h, key) => {
                        if h == 1 {
                            tile.fill_run(x, y, w, key);
                        } else {
                            tile.fill_block(x, y, w, h, key);
                        }
                        for (row, column) in
                            (y..y + h).flat_map(|r| (x..x + w).map(move |c| (r, c)))
                        {
                            naive.set(column, row, u64::MAX, key);
                        }
                    }
                    Op::Cover(x, y, mask, key) => {
                        tile.cover(x, y, mask, key);
                        naive.set(x, y, mask, key);
                    }
                }
            }
            let row = (width * samples) as usize;
            for y in 0..height {
                let seen = samples_of(&tile, y, samples);
                prop_assert_eq!(&seen[..], &naive.keys[y as usize * row..][..row]);
            }
            check_colours(&tile, &naive)?;
            prop_assert_eq!(tile.row(height).count(), 0);
            prop_assert_eq!(tile.row(u32::MAX).count(), 0);
        }
    }
}

#[test]
fn runs_are_as_long_as_they_can_be() {
    let mut tile = Visibility::new();
    tile.reset(8, 1, 1, 3);
    tile.fill_block(2, 0, 3, 1, 9);
    tile.fill_block(5, 0, 1, 1, 9);
    let runs: Vec<Seen> = tile.row(0).collect();
    let whole = |x, len, key| Seen::Whole { x, len, key };
    assert_eq!(runs, [whole(0, 2, 3), whole(2, 4, 9), whole(6, 2, 3)]);
}
