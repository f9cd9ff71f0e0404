use super::*;
use crate::{Gradient, encode_row};
use proptest::prelude::*;
use scumble_pixel::WorkingSpace;
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

/// One and four have ways of their own.
fn samples() -> impl Strategy<Value = u32> {
    prop_oneof![Just(1_u32), Just(4), 1..=64_u32]
}

#[derive(Debug, Clone)]
enum Op {
    Block(u32, u32, u32, u32, u32),
    Cover(u32, u32, u64, u32),
    Pixels(u32, u32, u64, u32),
    Square(u32, u32, [u32; 8], u32),
}

fn op() -> impl Strategy<Value = Op> {
    let key = prop_oneof![0..4_u32, Just(Visibility::MAX_KEY)];
    let mask = prop_oneof![any::<u64>(), (0..64_u32).prop_map(|b| 1 << b), Just(u64::MAX)];
    prop_oneof![
        (0..9_u32, 0..9_u32, 0..9_u32, 0..9_u32, key.clone())
            .prop_map(|(x, y, w, h, k)| Op::Block(x, y, w, h, k)),
        (0..9_u32, 0..9_u32, mask.clone(), key.clone())
            .prop_map(|(x, y, m, k)| Op::Cover(x, y, m, k)),
        (0..9_u32, 0..9_u32, mask, key.clone()).prop_map(|(x, y, m, k)| Op::Pixels(x, y, m, k)),
        (0..9_u32, 0..9_u32, square(), key).prop_map(|(x, y, m, k)| Op::Square(x, y, m, k)),
    ]
}

/// Rows that are empty, full, or anything.
fn square() -> impl Strategy<Value = [u32; 8]> {
    prop::array::uniform8(prop_oneof![Just(0), Just(u32::MAX), any::<u32>(), 0..16_u32])
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

fn color(key: u32) -> Premul {
    COLORS.get(key as usize).map_or(Premul::TRANSPARENT, |&c| Premul(c))
}

/// The same colours, each changing over the tile; one of them leaves its range, and one leaves what
/// can be encoded.
fn gradients() -> [Gradient; 4] {
    let right = [[0.01, -0.02, 0.007, 0.0], [0.0; 4], [0.3, -0.3, 0.2, 0.0], [0.01; 4]];
    let below = [[0.0; 4], [0.02, 0.01, 0.013, 0.0], [-0.1, 0.2, -0.3, 0.0], [0.01; 4]];
    let mut key = 0;
    COLORS.map(|here| {
        let (low, high) = match key {
            0 => ([0.1, 0.1, 0.1, 1.0], [0.6, 0.7, 0.9, 1.0]),
            2 => ([-9.0, -9.0, -9.0, 1.0], [9.0, 9.0, 9.0, 1.0]),
            _ => ([0.0; 4], [1.0; 4]),
        };
        let (right, below, at) = (right[key], below[key], key as i32);
        key += 1;
        Gradient::new((5 - 7 * at, at - 2), [here, right, below], [low, high])
    })
}

/// What encoding gradients is to come to.
fn by_gradients(tile: &Visibility, y: u32, space: WorkingSpace, room: usize) -> Vec<[u8; 4]> {
    let mut shaded = vec![Premul::TRANSPARENT; room];
    tile.shade_row(y, &mut shaded, |key, x, out| {
        for (color, x) in out.iter_mut().zip((x as u32)..) {
            *color = gradients()[(key as usize).min(3)].at(x, y);
        }
    });
    shaded.iter().map(|&color| space.export(color)).collect()
}

/// Shading and encoding are the mean over samples of the definition.
fn check_colours(tile: &Visibility, naive: &Naive) -> Result<(), TestCaseError> {
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
            prop_assert_eq!(&codes, &expected);
            let expected = by_gradients(tile, y, space, codes.len());
            tile.encode_gradients(y, &gradients(), space, &mut codes);
            prop_assert_eq!(codes, expected);
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn it_sees_what_came_last(
        runs in prop::collection::vec(
            (1..8_u32, 1..8_u32, samples(), 0..3_u32, prop::collection::vec(op(), 0..40)), 1..3),
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
                    Op::Pixels(x, y, pixels, key) => {
                        tile.fill_pixels(x, y, pixels, key);
                        for (i, r, c) in (0..64).map(|i| (i, i / 8, i % 8)) {
                            let mask = if pixels >> i & 1 == 1 { u64::MAX } else { 0 };
                            naive.set(x + c, y + r, mask, key);
                        }
                    }
                    Op::Square(x, y, rows, key) => {
                        tile.cover_square(x, y, &rows, key);
                        for (r, c) in (0..8).flat_map(|r| (0..8).map(move |c| (r, c))) {
                            let mask = if samples == 4 { rows[r] >> (4 * c) & 15 } else { 0 };
                            naive.set(x + c, y + r as u32, u64::from(mask), key);
                        }
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

proptest! {
    /// Every level gives the keys of the plain loops, whatever lies in the tile.
    #[test]
    fn squares_are_their_definition(
        keys in prop::collection::vec(prop_oneof![0..3_u32, Just(MIXED)], 90),
        mixed in prop::collection::vec(prop::array::uniform4(0..3_u32), 90),
        stride in 8..12_usize,
        (pixels, samples, key) in (any::<u64>(), square(), 0..3_u32),
        within in (0..8_u32).prop_map(|columns| u32::MAX >> (4 * columns)),
    ) {
        let with = |draw: &dyn Fn(&mut Rows<'_>)| {
            let (mut keys, mut mixed) = (keys.clone(), mixed.clone());
            draw(&mut Rows { keys: &mut keys, mixed: &mut mixed, stride });
            // What a pixel that is not mixed holds beside its key means nothing.
            let seen = keys.iter().zip(mixed);
            seen.map(|(&key, of)| (key, (key == MIXED).then_some(of))).collect::<Vec<_>>()
        };
        let filled = with(&|rows| rows.fill(pixels, key));
        let covered = with(&|rows| rows.cover(&samples, within, key));
        for level in [fearless_simd::Level::baseline(), fearless_simd::Level::new()] {
            prop_assert_eq!(&with(&|rows| rows.fill_by(level, pixels, key)), &filled);
            prop_assert_eq!(&with(&|rows| rows.cover_by(level, &samples, within, key)), &covered);
        }
    }
}

/// Rows longer than what is looked at together, and rooms that are shorter or longer than the row.
#[test]
fn long_rows_are_encoded_whole() {
    let mut palette = Palette::new(WorkingSpace::Srgb);
    COLORS.iter().for_each(|&c| palette.push(Premul(c)));
    let mut tile = Visibility::new();
    tile.reset(150, 1, 4, 0);
    (0..150).filter(|x| x % 3 != 1).for_each(|x| tile.cover(x, 0, 0b0110, x % 4));
    for room in [0, 1, 63, 64, 65, 149, 150, 200] {
        let mut shaded = vec![Premul::TRANSPARENT; room];
        tile.shade_row(0, &mut shaded, |key, _, out| out.fill(Premul(COLORS[key as usize])));
        let mut expected = vec![[9; 4]; room];
        encode_row(&shaded[..room.min(150)], WorkingSpace::Srgb, &mut expected);
        let mut codes = vec![[9; 4]; room];
        tile.encode_row(0, &palette, &mut codes);
        assert_eq!(codes, expected);
        let there = room.min(150);
        codes.fill([9; 4]);
        tile.encode_gradients(0, &gradients(), WorkingSpace::Srgb, &mut codes);
        let by_pixel = by_gradients(&tile, 0, WorkingSpace::Srgb, room);
        assert_eq!(codes[..there], by_pixel[..there]);
        assert!(codes[there..].iter().all(|&code| code == [9; 4]));
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
