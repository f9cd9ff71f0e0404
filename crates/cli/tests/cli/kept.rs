//! What pictures keep on their way: profile, orientation, depth, what is brighter than white, alpha.

use crate::common::{Desk, rgba_png};
use exr::prelude as exr;
use png::{BitDepth, ColorType};
use std::fs;

const HALF: &str = "--matrix 0.5,0,0,0,0.5,0,0,0,1";
const IDENTITY: &str = "--matrix 1,0,0,0,1,0,0,0,1";

/// A PNG of these codes with whatever chunks.
fn png_with(
    (width, height): (u32, u32),
    (color, depth): (ColorType, BitDepth),
    codes: &[u8],
    more: impl FnOnce(&mut png::Info<'_>),
) -> Vec<u8> {
    let mut info = png::Info::with_size(width, height);
    (info.color_type, info.bit_depth) = (color, depth);
    more(&mut info);
    let mut data = Vec::new();
    let mut writer =
        png::Encoder::with_info(&mut data, info).expect("a form").write_header().expect("a header");
    writer.write_image_data(codes).expect("pixels");
    writer.finish().expect("an end");
    data
}

/// The header and the codes of a PNG.
fn codes(desk: &Desk, name: &str) -> (png::Info<'static>, Vec<u8>) {
    let data = fs::read(desk.path(name)).expect("a picture");
    let mut reader = png::Decoder::new(std::io::Cursor::new(data)).read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut bytes).expect("all rows");
    (reader.info().clone(), bytes)
}

/// The channels of an OpenEXR file by their names, and its width.
fn floats(desk: &Desk, name: &str) -> (usize, Vec<(String, Vec<f32>)>) {
    let image = exr::read_first_flat_layer_from_file(desk.path(name)).expect("an OpenEXR file");
    let layer = image.layer_data;
    let all = layer.channel_data.list.iter();
    let channels = all.map(|c| (c.name.to_string(), c.sample_data.values_as_f32().collect()));
    (layer.size.x(), channels.collect())
}

fn channel<'a>(channels: &'a [(String, Vec<f32>)], name: &str) -> &'a [f32] {
    &channels.iter().find(|(n, _)| n == name).expect("the channel").1
}

/// An ICC profile (2.4) of a display with the primaries of sRGB and a power for its curves.
fn profile(gamma: f64) -> Vec<u8> {
    let fixed = |v: f64| ((v * 65536.0).round() as i32).to_be_bytes();
    let xyz = |v: [f64; 3]| [b"XYZ \0\0\0\0".to_vec(), v.map(fixed).concat()].concat();
    let curve =
        [b"curv\0\0\0\0\0\0\0\x01".as_slice(), &((gamma * 256.0).round() as u16).to_be_bytes()];
    let text = b"desc\0\0\0\0\0\0\0\x06gamma\0";
    let white = [0.9642, 1.0, 0.8249];
    let tags = [
        (b"desc", [text.as_slice(), &[0; 78]].concat()),
        (b"wtpt", xyz(white)),
        (b"rXYZ", xyz([0.4360, 0.2225, 0.0139])),
        (b"gXYZ", xyz([0.3851, 0.7169, 0.0971])),
        (b"bXYZ", xyz([0.1431, 0.0606, 0.7141])),
        (b"rTRC", curve.concat()),
        (b"gTRC", curve.concat()),
        (b"bTRC", curve.concat()),
    ];
    let mut index = (tags.len() as u32).to_be_bytes().to_vec();
    let mut body = Vec::new();
    for (name, value) in tags {
        let at = 132 + 12 * 8 + body.len();
        index.extend(name);
        index.extend((at as u32).to_be_bytes());
        index.extend((value.len() as u32).to_be_bytes());
        body.extend(value);
        body.resize(body.len().next_multiple_of(4), 0);
    }
    let size = (128 + index.len() + body.len()) as u32;
    let mut header = [&size.to_be_bytes(), b"\0\0\0\0\x02\x40\0\0mntrRGB XYZ ".as_slice()].concat();
    header.extend([7, 234, 0, 11, 0, 22, 0, 0, 0, 0, 0, 0]);
    header.extend(b"acsp");
    header.resize(68, 0);
    header.extend(white.map(fixed).concat());
    header.resize(128, 0);
    [header, index, body].concat()
}

#[test]
fn a_profile_that_unpacks_beyond_measure_is_left_out() {
    // A hundred megabytes of zeros in a hundred kilobytes.
    let bomb = stripes(Some(&vec![0; 100 << 20]));
    assert!(bomb.len() < 1 << 20);
    let desk = Desk::with("a.png", bomb);
    let run = desk.run(&format!("warp a.png b.png {IDENTITY} --border clamp"));
    assert_eq!(run.code, Some(0), "{}", run.err);
    assert_eq!(run.err, "scumble: a.png: warning: its ICC profile is damaged and was left out\n");
    assert!(codes(&desk, "b.png").0.icc_profile.is_none());
    let data = stripes(Some(b"no profile"));
    desk.put("c.png", data);
    let run = desk.run("diff b.png c.png");
    assert!(run.err.contains("c.png: warning: its ICC profile is damaged"), "{}", run.err);
}

/// Columns of black and white by turns, under a profile.
fn stripes(icc: Option<&[u8]>) -> Vec<u8> {
    let row: Vec<u8> = (0..64).flat_map(|x| [if x % 2 == 0 { 0 } else { 255 }; 3]).collect();
    png_with((64, 64), (ColorType::Rgb, BitDepth::Eight), &row.repeat(64), |info| {
        info.icc_profile = icc.map(|icc| icc.to_vec().into());
    })
}

#[test]
fn a_profile_is_kept_and_light_is_averaged_by_its_curves() {
    let icc = profile(1.8);
    let desk = Desk::with("a.png", stripes(Some(&icc)));
    desk.put("plain.png", stripes(None));
    let (size, gray) = ("--size 8x8 --border repeat", 9 * 8 * 3 / 2);
    let warp = |file: &str, space: &str| {
        let matrix = "--matrix 0.125,0,0,0,0.125,0,0,0,1";
        desk.run(&format!("warp {file} b.png {matrix} {size} --space {space}")).succeeded();
        let (info, codes) = codes(&desk, "b.png");
        (info.icc_profile.map(|icc| icc.into_owned()), codes[gray])
    };
    // Half of the light: 255 · ½^(1/1.8) is 173.6, and 187.5 by the curve of sRGB.
    let (kept, light) = warp("a.png", "linear");
    assert!(kept.as_deref() == Some(&icc) && light.abs_diff(174) <= 1, "{light}");
    let (none, light) = warp("plain.png", "linear");
    assert!(none.is_none() && light.abs_diff(188) <= 1, "{light}");
    let (kept, mean) = warp("a.png", "srgb");
    assert!(kept.as_deref() == Some(&icc) && mean.abs_diff(128) <= 1, "{mean}");

    desk.run("mip a.png levels --filter box").succeeded();
    let (info, codes_1) = codes(&desk, "levels/level_01.png");
    assert_eq!(info.icc_profile.as_deref(), Some(&icc[..]));
    assert!(codes_1.iter().all(|c| c.abs_diff(174) <= 1));
    desk.run("filter a.png f.png --kernel box:2 --space linear").succeeded();
    let (info, filtered) = codes(&desk, "f.png");
    assert_eq!((info.icc_profile.as_deref(), info.color_type), (Some(&icc[..]), ColorType::Rgb));
    assert!(filtered[gray * 8].abs_diff(174) <= 1, "{}", filtered[gray * 8]);
    // Other formats carry it, too; OpenEXR has light instead.
    for name in ["c.jpg", "c.tif", "c.webp"] {
        desk.run(&format!("warp a.png {name} {IDENTITY} --border clamp")).succeeded();
        desk.run(&format!("warp {name} d.png {IDENTITY} --border clamp")).succeeded();
        assert_eq!(codes(&desk, "d.png").0.icc_profile.as_deref(), Some(&icc[..]), "{name}");
    }
    desk.run(&format!("warp b.png e.exr {IDENTITY} --border clamp")).succeeded();
    let (_, light) = floats(&desk, "e.exr");
    let expected = libm::pow(f64::from(mean) / 255.0, 461.0 / 256.0);
    assert!((f64::from(channel(&light, "G")[9]) - expected).abs() < 2e-3);
}

/// EXIF that says an orientation and nothing else.
fn exif(orientation: u8) -> Vec<u8> {
    let start = b"MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0".as_slice();
    [start, &[orientation], &[0; 6]].concat()
}

#[test]
fn pictures_are_turned_upright_by_every_command() {
    // a b c over d e f, held as orientation 6 has it, is d a, e b, f c.
    let stored = [[10; 3], [50; 3], [90; 3], [130; 3], [170; 3], [210; 3]].concat();
    let turned = png_with((3, 2), (ColorType::Rgb, BitDepth::Eight), &stored, |info| {
        info.exif_metadata = Some(exif(6).into());
    });
    let desk = Desk::with("turned.png", turned);
    let upright = [130, 10, 170, 50, 210, 90].map(|v| [v, v, v, 255]);
    desk.put("upright.png", rgba_png(2, &upright));
    let check = |name: &str| {
        let picture = desk.picture(name);
        assert_eq!((picture.width, picture.height), (2, 3), "{name}");
        assert_eq!(picture.pixels, upright, "{name}");
        assert!(codes(&desk, name).0.exif_metadata.is_none());
    };
    desk.run("mip turned.png levels").succeeded();
    check("levels/level_00.png");
    desk.run("filter turned.png f.png --low-pass 1").succeeded();
    check("f.png");
    let warp = format!("warp turned.png w.png {IDENTITY} --border clamp --space srgb");
    desk.run(&format!("{warp} --magnify catmull-rom --kernel box")).succeeded();
    let picture = desk.picture("w.png");
    assert_eq!((picture.width, picture.height), (2, 3));
    let corners = [(0, 0), (1, 0), (0, 2), (1, 2)].map(|(x, y)| picture.at(x, y)[0]);
    assert!(corners[1] < corners[0] && corners[0] < corners[2] && corners[3] < corners[2]);
    assert_eq!(
        desk.run("diff turned.png upright.png").succeeded().out,
        b"the pictures are equal\n"
    );
}

#[test]
fn sixteen_bits_stay_sixteen() {
    // A plane: its average under a pixel is what stands in the middle of that.
    let plane = |x: f64, y: f64| 9000.0 + 411.0 * x + 97.25 * y;
    let value = |x: u32, y: u32| plane(f64::from(x) + 0.5, f64::from(y) + 0.5).round() as u16;
    let bytes: Vec<u8> = (0..48 * 96)
        .flat_map(|i| {
            let v = value(i % 96, i / 96);
            [v, v / 2, 40_000].map(u16::to_be_bytes).concat()
        })
        .collect();
    let picture = png_with((96, 48), (ColorType::Rgb, BitDepth::Sixteen), &bytes, |_| ());
    let desk = Desk::with("a.png", picture);
    for way in
        ["warp a.png b.png --space srgb --border mirror", "filter a.png b.png --kernel box:3"]
    {
        let (way, scale) = match way.starts_with("warp") {
            true => (format!("{way} {HALF}"), 2.0),
            false => (way.to_owned(), 1.0),
        };
        desk.run(&way).succeeded();
        let (info, codes) = codes(&desk, "b.png");
        assert_eq!((info.bit_depth, info.color_type), (BitDepth::Sixteen, ColorType::Rgb));
        let code = |i: usize| f64::from(u16::from_be_bytes([codes[2 * i], codes[2 * i + 1]]));
        // Away from the edges.
        for (x, y) in [(10, 6), (20, 12), (30, 17), (37, 9)] {
            let i = 3 * (y * info.width as usize + x);
            let expected = plane(scale * (x as f64 + 0.5), scale * (y as f64 + 0.5));
            assert!((code(i) - expected).abs() <= 3.0, "{way}: {} {expected}", code(i));
            assert!((code(i + 1) - expected / 2.0).abs() <= 3.0 && code(i + 2) == 40_000.0);
        }
    }
}

/// An OpenEXR file of 64 × 32 with a ramp from below nothing to beyond white.
fn glare(desk: &Desk) -> impl Fn(f64) -> f64 {
    let ramp = |x: f64| -1.0 + x / 8.0;
    exr::write_rgb_file(desk.path("a.exr"), 64, 32, |x, _| {
        let v = ramp(x as f64 + 0.5) as f32;
        (v, 2.0 * v, 20.0_f32)
    })
    .expect("a picture");
    ramp
}

#[test]
fn floats_stay_as_dark_and_as_bright_as_they_are() {
    let desk = Desk::new();
    let ramp = glare(&desk);
    let close = |found: f32, expected: f64| {
        (f64::from(found) - expected).abs() < 2e-3 * expected.abs().max(1.0)
    };
    for out in ["b.exr", "b.tif"] {
        desk.run(&format!("warp a.exr {out} {HALF} --border mirror")).succeeded();
        // By way of another run, so that both formats are read.
        desk.run(&format!("warp {out} c.exr {IDENTITY} --border clamp")).succeeded();
        let (width, channels) = floats(&desk, "c.exr");
        assert_eq!(width, 32);
        for x in [4, 9, 17, 27] {
            let i = 8 * width + x;
            let expected = ramp(2.0 * x as f64 + 1.0);
            assert!(close(channel(&channels, "R")[i], expected), "{out} {x}");
            assert!(close(channel(&channels, "G")[i], 2.0 * expected), "{out} {x}");
            assert!(close(channel(&channels, "B")[i], 20.0), "{out} {x}");
        }
    }
    desk.run("mip a.exr levels --filter box --levels 3").succeeded();
    for (l, side) in [(1_usize, 32), (2, 16)] {
        let (width, channels) = floats(&desk, &format!("levels/level_{l:02}.exr"));
        assert_eq!(width, side);
        for x in 0..width {
            let expected = ramp((x as f64 + 0.5) * f64::from(1 << l));
            assert!(close(channel(&channels, "R")[x], expected), "{l} {x}");
            assert!(close(channel(&channels, "B")[x], 20.0), "{l} {x}");
        }
    }
    desk.run("filter a.exr f.exr --kernel box:3 --space linear").succeeded();
    let (width, channels) = floats(&desk, "f.exr");
    assert!(
        (2..62).all(|x| close(channel(&channels, "G")[9 * width + x], 2.0 * ramp(x as f64 + 0.5)))
    );
}

#[test]
fn what_is_no_number_is_told_before_it_is_everywhere() {
    let desk = Desk::new();
    exr::write_rgb_file(desk.path("a.exr"), 8, 4, |x, y| {
        (if (x, y) == (5, 2) { f32::INFINITY } else { 0.5 }, 0.5_f32, 0.5_f32)
    })
    .expect("a picture");
    desk.run("filter a.exr b.exr --low-pass 0.1").failed(1, "a.exr: ", &["5,2", "not finite"]);
    desk.run("spectrum a.exr b.png").failed(1, "a.exr: ", &["5,2"]);
    assert_eq!(desk.names(), ["a.exr"]);
}

#[test]
fn colour_stays_colour_where_alpha_fades() {
    let color = [200, 100, 50, 255];
    let desk = Desk::with("a.png", rgba_png(40, &[color; 40 * 30]));
    let warp = |out: &str, more: &str| {
        let mut command = desk.command(&format!("warp a.png {out} --size 60x50 {more}"));
        let output = command.args(["--to", "5,9 52,4 55,41 9,46"]).output().expect("a run");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    };
    warp("straight.png", "");
    let straight = desk.picture("straight.png");
    let faded = straight.pixels.iter().filter(|p| (1..255).contains(&p[3])).count();
    assert!(faded > 100, "{faded}");
    for pixel in straight.pixels.iter().filter(|p| p[3] > 0) {
        assert!((0..3).all(|c| pixel[c].abs_diff(color[c]) <= 1), "{pixel:?}");
    }
    // Multiplied in where the format has it so, in light.
    warp("light.exr", "--depth float");
    let (_, channels) = floats(&desk, "light.exr");
    let red = f64::from(scumble::pixel::srgb::decode(200.0 / 255.0));
    let alpha = channel(&channels, "A");
    for (i, r) in channel(&channels, "R").iter().enumerate() {
        assert!((f64::from(*r) - red * f64::from(alpha[i])).abs() < 1e-3, "{i}");
        assert!((alpha[i] - f32::from(straight.pixels[i][3]) / 255.0).abs() < 0.004, "{i}");
    }
    // And what is multiplied in comes back straight.
    desk.run(&format!("warp light.exr back.png {IDENTITY} --depth 8")).succeeded();
    for pixel in desk.picture("back.png").pixels.iter().filter(|p| p[3] > 8) {
        assert!((0..3).all(|c| pixel[c].abs_diff(color[c]) <= 3), "{pixel:?}");
    }
    // Over a ground the edge is the mixture that the alpha says.
    warp("over.png", "--border white --space srgb");
    for (over, pixel) in desk.picture("over.png").pixels.iter().zip(&straight.pixels) {
        let a = f64::from(pixel[3]) / 255.0;
        let expected = [0, 1, 2].map(|c| a * f64::from(color[c]) + (1.0 - a) * 255.0);
        assert!((0..3).all(|c| (f64::from(over[c]) - expected[c]).abs() <= 1.5), "{over:?} {a}");
    }
}

#[test]
fn light_without_alpha_is_no_less_light() {
    let desk = Desk::new();
    exr::write_rgba_file(desk.path("a.exr"), 16, 16, |_, _| (3.0_f32, 2.0_f32, 1.0_f32, 0.0_f32))
        .expect("a picture");
    desk.run(&format!("warp a.exr b.exr {IDENTITY} --border clamp")).succeeded();
    desk.run("filter a.exr c.exr --kernel gaussian:2 --space linear").succeeded();
    for name in ["b.exr", "c.exr"] {
        let (_, channels) = floats(&desk, name);
        let colour = ["R", "G", "B", "A"].map(|n| channel(&channels, n)[8 * 16 + 8]);
        let close = colour.iter().zip([3.0, 2.0, 1.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-3);
        assert!(close, "{name}: {colour:?}");
    }
}
