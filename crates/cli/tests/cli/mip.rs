use crate::common::{Desk, Picture, png_file, rgba_png};
use ddsfile::{Dds, DxgiFormat};
use ktx2::{Format, TransferFunction};
use serde_json::Value;
use std::fs;

/// 12 × 6, every texel another colour, alpha full.
fn colors() -> Vec<[u8; 4]> {
    (0..72).map(|i| [i * 3, 255 - i * 2, i % 7 * 30, 255]).collect()
}

fn desk() -> Desk {
    Desk::with("a.png", rgba_png(12, &colors()))
}

/// The levels in a folder.
fn levels(desk: &Desk, folder: &str) -> Vec<Picture> {
    let count = fs::read_dir(desk.path(folder)).expect("the folder").count();
    (0..count).map(|l| desk.picture(&format!("{folder}/level_{l:02}.png"))).collect()
}

#[test]
fn a_folder_gets_a_png_a_level() {
    let desk = desk();
    desk.run("mip a.png out").succeeded();
    let levels = levels(&desk, "out");
    let sizes: Vec<_> = levels.iter().map(|l| (l.width, l.height)).collect();
    assert_eq!(sizes, [(12, 6), (6, 3), (3, 1), (1, 1)]);
    assert_eq!(levels[0].pixels, colors());
    // Again, over what is there.
    desk.run("mip a.png out --levels 2 --filter box --space srgb").succeeded();
    let box_mean = |x: usize, y: usize, c: usize| {
        let at = |x: usize, y: usize| f64::from(colors()[y * 12 + x][c]);
        let (x, y) = (2 * x, 2 * y);
        (at(x, y) + at(x + 1, y) + at(x, y + 1) + at(x + 1, y + 1)) / 4.0
    };
    let level = desk.picture("out/level_01.png");
    for (i, pixel) in level.pixels.iter().enumerate() {
        for (c, found) in pixel.iter().enumerate().take(3) {
            assert!((f64::from(*found) - box_mean(i % 6, i / 6, c)).abs() <= 0.5);
        }
    }
}

#[test]
fn light_is_averaged_unless_told_otherwise() {
    let pixels = [[0, 0, 0, 255], [255; 4], [255; 4], [0, 0, 0, 255]];
    let desk = Desk::with("a.png", rgba_png(2, &pixels));
    for (space, grey) in [("", 188), ("--space linear", 188), ("--space srgb", 128)] {
        desk.run(&format!("mip a.png out --filter box {space}")).succeeded();
        assert_eq!(desk.picture("out/level_01.png").pixels, [[grey, grey, grey, 255]]);
    }
}

#[test]
fn containers_hold_the_levels_of_the_files() {
    let desk = desk();
    desk.run("mip a.png out").succeeded();
    let files = levels(&desk, "out");
    desk.run("mip a.png a.ktx2").succeeded();
    let ktx = ktx2::Reader::new(fs::read(desk.path("a.ktx2")).expect("a file")).expect("KTX 2");
    let header = ktx.header();
    assert_eq!(header.format, Some(Format::R8G8B8A8_SRGB));
    assert_eq!((header.pixel_width, header.pixel_height, header.level_count), (12, 6, 4));
    assert_eq!(ktx.transfer_function(), Some(TransferFunction::SRGB));
    assert_eq!(ktx.is_alpha_premultiplied(), Some(false));
    assert!(ktx.writer().is_some_and(|w| w.starts_with("scumble ")));
    let samples: Vec<_> =
        ktx.basic_dfd().expect("a descriptor").sample_information.iter().collect();
    assert_eq!(samples.len(), 4);
    assert_eq!(ktx.levels().len(), files.len());
    for (level, file) in ktx.levels().zip(&files) {
        assert_eq!(level.data, file.pixels.as_flattened());
    }

    desk.run("mip a.png a.dds").succeeded();
    let dds = Dds::read(&mut &*fs::read(desk.path("a.dds")).expect("a file")).expect("DDS");
    assert_eq!(dds.get_dxgi_format(), Some(DxgiFormat::R8G8B8A8_UNorm_sRGB));
    assert_eq!((dds.get_width(), dds.get_height(), dds.get_num_mipmap_levels()), (12, 6, 4));
    let all: Vec<u8> = files.iter().flat_map(|f| f.pixels.as_flattened()).copied().collect();
    assert_eq!(dds.get_data(0).expect("data"), all);
}

#[test]
fn every_depth_has_its_format() {
    let desk = desk();
    let depths = [
        ("8", Format::R8G8B8A8_SRGB, DxgiFormat::R8G8B8A8_UNorm_sRGB, 4),
        ("16", Format::R16G16B16A16_UNORM, DxgiFormat::R16G16B16A16_UNorm, 8),
        ("half", Format::R16G16B16A16_SFLOAT, DxgiFormat::R16G16B16A16_Float, 8),
        ("float", Format::R32G32B32A32_SFLOAT, DxgiFormat::R32G32B32A32_Float, 16),
    ];
    for (depth, vulkan, dxgi, bytes) in depths {
        desk.run(&format!("mip a.png a.ktx2 --depth {depth}")).succeeded();
        desk.run(&format!("mip a.png a.dds --depth {depth}")).succeeded();
        let ktx = ktx2::Reader::new(fs::read(desk.path("a.ktx2")).expect("a file")).expect("KTX 2");
        assert_eq!(ktx.header().format, Some(vulkan));
        let dds = Dds::read(&mut &*fs::read(desk.path("a.dds")).expect("a file")).expect("DDS");
        assert_eq!(dds.get_dxgi_format(), Some(dxgi));
        let sizes: Vec<_> = ktx.levels().map(|l| l.data.len()).collect();
        assert_eq!(sizes, [72 * bytes, 18 * bytes, 3 * bytes, bytes]);
        let all: Vec<u8> = ktx.levels().flat_map(|l| l.data.to_vec()).collect();
        assert_eq!(dds.get_data(0).expect("data"), all);
    }
}

#[test]
fn cut_outs_keep_their_cover() {
    // A third of the texels, here and there, so that averages fall below the threshold.
    let leaf = |i: u32| i.wrapping_mul(2_654_435_761) >> 24 < 85;
    let pixels: Vec<[u8; 4]> =
        (0..48 * 48).map(|i| [0, 200, 0, if leaf(i) { 255 } else { 0 }]).collect();
    let desk = Desk::with("a.png", rgba_png(48, &pixels));
    let cover = |picture: &Picture| {
        let passing = picture.pixels.iter().filter(|p| p[3] >= 128).count();
        passing as f64 / picture.pixels.len() as f64
    };
    desk.run("mip a.png plain --levels 5").succeeded();
    desk.run("mip a.png kept --levels 5 --alpha-coverage 0.5").succeeded();
    let [plain, kept] = ["plain", "kept"].map(|folder| levels(&desk, folder));
    assert_eq!(kept[0], plain[0]);
    let whole = cover(&kept[0]);
    assert!(cover(&plain[3]) < 0.1);
    for level in &kept {
        // To half a texel of its own, and a tie or two.
        let most = 1.5 / level.pixels.len() as f64;
        assert!((cover(level) - whole).abs() <= most, "{} and {whole}", cover(level));
    }
    let run = desk.run("mip a.png kept --alpha-coverage 0.5 --json").succeeded();
    let value: Value = serde_json::from_slice(&run.out).expect("one object");
    assert_eq!(value["levels"][0]["coverage"], whole);
}

#[test]
fn normals_stay_unit_vectors() {
    let pixels: Vec<[u8; 4]> = (0..64)
        .map(|i| if i % 2 == 0 { [218, 128, 218, 9] } else { [37, 128, 218, 201] })
        .collect();
    let desk = Desk::with("a.png", rgba_png(8, &pixels));
    desk.run("mip a.png out --normal-map --wrap repeat --filter box").succeeded();
    let levels = levels(&desk, "out");
    assert_eq!(levels[0].pixels, pixels);
    for level in &levels[1..] {
        // Two normals that lean to either side: straight up. Alpha is none of their business.
        assert!(level.pixels.iter().all(|p| p[0].abs_diff(128) <= 1 && p[2] == 255 && p[3] == 105));
    }
    desk.run("mip a.png a.ktx2 --normal-map").succeeded();
    let ktx = ktx2::Reader::new(fs::read(desk.path("a.ktx2")).expect("a file")).expect("KTX 2");
    assert_eq!(ktx.header().format, Some(Format::R8G8B8A8_UNORM));
    assert_eq!(ktx.transfer_function(), Some(TransferFunction::Linear));
}

#[test]
fn a_sheet_shows_all_levels() {
    let desk = desk();
    desk.run("mip a.png out --sheet sheet.png").succeeded();
    let sheet = desk.picture("sheet.png");
    assert_eq!((sheet.width, sheet.height), (8 + 12 + 8 + 6 + 8, 8 + 3 + 8 + 1 + 8 + 1 + 8));
    assert_eq!(sheet.part(8, 8, 12, 6).pixels, colors());
    assert_eq!(sheet.at(0, 0), [48, 48, 48, 255]);
}

#[test]
fn slips_are_said_in_a_line_and_cost_nothing() {
    let desk = desk();
    desk.put("gray.png", png_file(4));
    desk.put("notes.dds", "words");
    let png = rgba_png(12, &colors());
    desk.put("cut.png", &png[..png.len() / 2]);
    desk.run("mip none.png out").failed(1, "none.png: ", &[]);
    desk.run("mip cut.png out").failed(1, "cut.png: ", &[]);
    desk.run("mip a.png b.png").failed(2, "b.png: ", &["folder"]);
    desk.run("mip a.png -").failed(2, "-: ", &["folder"]);
    desk.run("mip a.png notes.dds").failed(1, "notes.dds: ", &["not a picture"]);
    desk.run("mip a.png .").succeeded();
    desk.run("mip level_00.png .").failed(1, "./level_00.png: ", &["--force"]);
    (0..4).for_each(|l| fs::remove_file(desk.path(&format!("level_{l:02}.png"))).expect("a level"));
    desk.run("mip a.png none/out").failed(1, "none: no such folder", &[]);
    desk.run("mip gray.png out --normal-map").failed(2, "--normal-map", &[]);
    desk.run("mip gray.png out --alpha-coverage 0.5").failed(2, "--alpha-coverage", &["no alpha"]);
    desk.run("mip a.png out --max-memory 2K").failed(3, "a.png: ", &["--max-memory"]);
    desk.run("mip a.png out --max-pixels 71").failed(3, "a.png: ", &["--max-pixels"]);
    desk.run("mip a.png out --alpha-coverage 2").misused("alpha-coverage");
    desk.run("mip a.png out --levels 0").misused("at least one level");
    desk.run("mip a.png out --normal-map --space srgb").misused("cannot be used with");
    desk.run("mip a.png").misused("<OUT>");
    assert_eq!(desk.names(), ["a.png", "cut.png", "gray.png", "notes.dds"]);
}

#[test]
fn a_sheet_takes_nothings_place() {
    let desk = desk();
    desk.run("mip a.png a.dds --sheet a.dds").failed(2, "--sheet a.dds: ", &["replace"]);
    fs::create_dir(desk.path("out")).expect("a folder");
    let inside = desk.run("mip a.png out --sheet out/level_00.png");
    inside.failed(2, "--sheet out/level_00.png: ", &["replace"]);
    assert_eq!(fs::read_dir(desk.path("out")).expect("the folder").count(), 0);
    desk.run("mip a.png out --sheet out/sheet.png").succeeded();
    desk.run("mip a.png a.dds --sheet level_00.png").succeeded();
}

#[test]
fn levels_appear_together_or_not_at_all() {
    let desk = desk();
    fs::create_dir_all(desk.path("out/level_02.png")).expect("a folder");
    desk.run("mip a.png out").failed(1, "out/level_02.png: it is a folder", &[]);
    assert_eq!(fs::read_dir(desk.path("out")).expect("the folder").count(), 1);
}

#[test]
fn standard_input_is_read() {
    let desk = desk();
    desk.run("mip a.png named.dds").succeeded();
    let png = fs::read(desk.path("a.png")).expect("a file");
    desk.run_with_input("mip - piped.dds", &png).succeeded();
    let [named, piped] =
        ["named.dds", "piped.dds"].map(|f| fs::read(desk.path(f)).expect("a file"));
    assert_eq!(named, piped);
}
