use super::*;
use crate::error::Failure;
use crate::interrupt::tests::unheard;
use crate::output::{FileTarget, Target};
use moxcms::ColorProfile;
use proptest::prelude::*;
use scumble::pixel::{Premul, WorkingSpace};
use scumble::texture::TextureOptions;

const FORMATS: [Format; 5] = [Format::Png, Format::Jpeg, Format::WebP, Format::Tiff, Format::Exr];
const DEPTHS: [Depth; 4] = [Depth::Eight, Depth::Sixteen, Depth::Half, Depth::Float];
const CHANNELS: [Channels; 4] =
    [Channels::Gray, Channels::GrayAlpha, Channels::Rgb, Channels::Rgba];
const ALL: Limits = Limits { pixels: 1 << 20, memory: 1 << 26 };

/// The bytes of a file of this form and these numbers.
fn file(form: &Form, pixels: &Pixels) -> Result<Vec<u8>, Failure> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture");
    let target =
        Target::File(FileTarget { shown: path.clone(), path: path.clone(), may_replace: true });
    let interrupt = unheard();
    let mut writer = Writer::open(&target, &interrupt, form.clone())?;
    writer.rows(pixels)?;
    writer.finish()?;
    writer.commit()?;
    Ok(std::fs::read(path).unwrap())
}

fn form(format: Format, channels: Channels, depth: Depth) -> Form {
    Form { width: 7, height: 5, channels, depth, format, icc: None }
}

/// Numbers that differ everywhere, alpha never 0.
fn numbers(form: &Form) -> Pixels {
    let count = form.width * form.height * form.channels.count() as u32;
    match form.depth {
        Depth::Eight => Pixels::U8((0..count).map(|i| (i * 37 % 255) as u8 + 1).collect()),
        Depth::Sixteen => Pixels::U16((0..count).map(|i| (i * 3571 % 65535) as u16 + 1).collect()),
        _ => Pixels::F32((0..count).map(|i| i as f32 / 8.0 - 2.0).collect()),
    }
}

/// Every form that is allowed.
fn forms() -> impl Iterator<Item = Form> {
    let all = FORMATS.into_iter().flat_map(|f| CHANNELS.map(|c| (f, c)));
    let all = all.flat_map(|(f, c)| DEPTHS.map(|d| form(f, c, d)));
    all.filter(|form| form.check().is_ok())
}

#[test]
fn what_is_written_is_read() {
    let mut count = 0;
    for form in forms() {
        let pixels = numbers(&form);
        let data = file(&form, &pixels).unwrap();
        assert_eq!(Format::of_content(&data), Some(form.format));
        let read = read_bytes("a", &data, ALL).unwrap();
        assert_eq!((read.width, read.height), (7, 5));
        // WebP has three channels or four.
        let webp = form.format == Format::WebP && form.channels.is_gray();
        assert_eq!(read.channels.has_alpha(), form.channels.has_alpha());
        assert!(webp || read.channels == form.channels, "{form:?}");
        assert_eq!(read.origin.depth, form.depth, "{form:?}");
        assert_eq!(read.premultiplied, form.format == Format::Exr);
        assert_eq!(read.origin.notes, Vec::<String>::new());
        if form.format != Format::Jpeg && !webp {
            assert_eq!(read.pixels, pixels, "{form:?}");
        }
        count += 1;
    }
    assert_eq!(count, 8 + 2 + 4 + 12 + 8);
}

#[cfg(target_os = "linux")]
#[test]
fn what_is_finished_is_on_the_disk() {
    for form in forms() {
        let (target, interrupt) = (Target::Device("/dev/full".into()), unheard());
        let mut writer = Writer::open(&target, &interrupt, form.clone()).unwrap();
        writer.rows(&numbers(&form)).unwrap();
        let full = writer.finish().unwrap_err().to_string();
        assert!(full.contains("/dev/full: No space"), "{form:?} {full}");
    }
}

#[test]
fn a_jpeg_is_close() {
    let form = Form { width: 64, height: 64, ..form(Format::Jpeg, Channels::Rgb, Depth::Eight) };
    let smooth = (0..64 * 64).flat_map(|i| [(i % 64 * 4) as u8, (i / 64 * 4) as u8, 128]);
    let pixels: Vec<u8> = smooth.collect();
    let read = read_bytes("a", &file(&form, &Pixels::U8(pixels.clone())).unwrap(), ALL).unwrap();
    let Pixels::U8(found) = read.pixels else { panic!("eight bits") };
    let worst = found.iter().zip(&pixels).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(worst < Some(9), "{worst:?}");
}

#[test]
fn a_jpeg_that_is_all_header_is_damaged() {
    let form = Form { width: 64, height: 64, ..form(Format::Jpeg, Channels::Rgb, Depth::Eight) };
    let mut data = file(&form, &numbers(&form)).unwrap();
    let frame = data.windows(2).position(|m| m == [0xff, 0xc0]).unwrap();
    data[frame + 5..frame + 9].copy_from_slice(&[0x40, 0, 0x40, 0]);
    let limits = Limits { pixels: 1 << 30, memory: 1 << 34 };
    let refused = read_bytes("a", &data, limits).unwrap_err().to_string();
    assert_eq!(refused, "a: there is too little in it for its size");
    assert!(matches!(read_bytes("a", &data, ALL), Err(Failure::Limit(_))));
    // The largest flat picture is not.
    let flat = Form { width: 4096, height: 4096, ..form };
    let data = file(&flat, &Pixels::U8(vec![128; 3 << 24])).unwrap();
    assert!(read_bytes("a", &data, limits).is_ok());
}

#[test]
fn what_a_format_lacks_is_refused() {
    let refused = |f, c, d| matches!(form(f, c, d).check(), Err(Failure::Usage(_)));
    assert!(refused(Format::Jpeg, Channels::Rgba, Depth::Eight));
    assert!(refused(Format::Jpeg, Channels::Rgb, Depth::Sixteen));
    assert!(refused(Format::WebP, Channels::Rgb, Depth::Sixteen));
    assert!(refused(Format::Png, Channels::Rgb, Depth::Float));
    assert!(refused(Format::Tiff, Channels::Rgb, Depth::Half));
    assert!(refused(Format::Exr, Channels::Rgb, Depth::Eight));
    let wide = Form { width: 70_000, ..form(Format::Jpeg, Channels::Rgb, Depth::Eight) };
    assert!(matches!(wide.check(), Err(Failure::Limit(_))));
}

#[test]
fn rows_must_be_all_there_and_no_more() {
    for form in forms() {
        let Pixels::U8(all) = numbers(&form) else { continue };
        assert!(file(&form, &Pixels::U8(all[..all.len() - 1].to_vec())).is_err());
        assert!(file(&form, &Pixels::U8([all.clone(), all.clone()].concat())).is_err());
        assert!(file(&form, &Pixels::F32(vec![0.0; all.len()])).is_err());
    }
}

#[test]
fn a_profile_goes_through() {
    let profiles = [(ColorProfile::new_adobe_rgb(), true), (ColorProfile::new_display_p3(), false)];
    for (profile, has_own_curve) in profiles {
        let icc = profile.encode().unwrap();
        for format in [Format::Png, Format::Jpeg, Format::WebP, Format::Tiff] {
            let form = Form { icc: Some(icc.clone()), ..form(format, Channels::Rgb, Depth::Eight) };
            let read = read_bytes("a", &file(&form, &numbers(&form)).unwrap(), ALL).unwrap();
            assert_eq!(read.icc.as_ref(), Some(&icc), "{format:?}");
            assert_eq!(read.origin.notes, Vec::<String>::new());
            // Display P3 has other primaries than sRGB, and the same curve.
            assert_eq!(matches!(read.tone, Tone::Curves(_)), has_own_curve, "{format:?}");
        }
    }
}

#[test]
fn light_is_the_profiles() {
    let icc = ColorProfile::new_adobe_rgb().encode().ok();
    let form = Form { icc, ..form(Format::Tiff, Channels::Rgb, Depth::Float) };
    let pixels = Pixels::F32((0..105).map(|i| i as f32 / 50.0 - 0.5).collect());
    let read = read_bytes("a", &file(&form, &pixels).unwrap(), ALL).unwrap();
    let light = read.to_linear();
    for (i, light) in light.iter().enumerate() {
        let x = pixels.at(i);
        // Adobe RGB's curve is the power 563/256, mirrored below 0 and going on beyond 1.
        let expected = x.signum() * libm::powf(x.abs(), 2.199_218_8);
        assert!((light - expected).abs() < 1e-4, "{x}: {light}, not {expected}");
    }
}

#[test]
fn a_profile_for_other_colours_is_left_out() {
    let icc = ColorProfile::new_gray_with_gamma(2.2).encode().ok();
    let form = Form { icc, ..form(Format::Tiff, Channels::Rgb, Depth::Eight) };
    let read = read_bytes("a", &file(&form, &numbers(&form)).unwrap(), ALL).unwrap();
    assert_eq!((read.icc, read.origin.notes.len()), (None, 1));
    let form = Form { icc: Some(b"rubbish".to_vec()), ..form };
    let read = read_bytes("a", &file(&form, &numbers(&form)).unwrap(), ALL).unwrap();
    assert_eq!((read.icc, read.origin.notes.len()), (None, 1));
}

#[test]
fn codes_survive_a_profiles_light() {
    let icc = ColorProfile::new_adobe_rgb().encode().ok();
    let form = Form { width: 256, height: 1, ..form(Format::Png, Channels::Gray, Depth::Eight) };
    let form = Form { icc, channels: Channels::Rgb, ..form };
    let codes: Vec<u8> = (0..=255).flat_map(|v| [v; 3]).collect();
    let read = read_bytes("a", &file(&form, &Pixels::U8(codes.clone())).unwrap(), ALL).unwrap();
    let light = read.to_linear();
    let color = |&[r, g, b]: &[f32; 3]| Premul([r, g, b, 1.0]);
    let colors: Vec<_> = light.as_chunks::<3>().0.iter().map(color).collect();
    let mut out = Pixels::empty(Depth::Eight);
    Encoder::new(WorkingSpace::Linear, &read.tone, &form).row(&colors, &mut out);
    assert_eq!(out, Pixels::U8(codes));
}

#[test]
fn premultiplied_colours_are_averaged_as_they_are() {
    // Half-transparent red of full strength beside nothing.
    let form = Form { width: 2, height: 1, ..form(Format::Exr, Channels::Rgba, Depth::Half) };
    let pixels = Pixels::F32(vec![0.5, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0]);
    let read = read_bytes("a", &file(&form, &pixels).unwrap(), ALL).unwrap();
    let space = WorkingSpace::Linear;
    let decimation = scumble::texture::Decimation::Box;
    let options = TextureOptions { space, decimation, ..Default::default() };
    let texture = read.texture(&options).unwrap();
    assert_eq!(texture.level(1).unwrap().pixels(), [[0.25, 0.0, 0.0, 0.25]]);
}

#[test]
fn limits_are_checked_before_anything_is_decoded() {
    for form in forms() {
        let data = file(&form, &numbers(&form)).unwrap();
        let few = Limits { pixels: 34, ..ALL };
        let little = Limits { memory: data.len() as u64 + 10, ..ALL };
        for limits in [few, little] {
            let refused = read_bytes("a", &data, limits);
            assert!(matches!(refused, Err(Failure::Limit(_))), "{form:?} {refused:?}");
        }
    }
}

#[test]
fn no_part_of_a_file_is_taken_for_the_whole() {
    for form in forms() {
        let data = file(&form, &numbers(&form)).unwrap();
        for end in 0..data.len() {
            // OpenEXR and TIFF may end in bytes that nobody needs; what comes of the others' last
            // bytes, a checksum or a terminator, decoders differ on.
            let read = read_bytes("a", &data[..end], ALL);
            let same = read.as_ref().is_ok_and(|p| p.pixels == numbers(&form));
            assert!(read.is_err() || same || form.format == Format::Jpeg, "{form:?} {end}");
        }
    }
}

proptest! {
    #[test]
    fn no_damage_is_more_than_an_error(
        which in 0..34_usize,
        at in any::<proptest::sample::Index>(),
        bytes in proptest::collection::vec(any::<u8>(), 1..5),
    ) {
        let form = forms().nth(which).unwrap();
        let mut data = file(&form, &numbers(&form)).unwrap();
        let at = at.index(data.len());
        for (old, new) in data[at..].iter_mut().zip(bytes) {
            *old = new;
        }
        if let Ok(read) = read_bytes("a", &data, ALL) {
            let count = read.width as usize * read.height as usize * read.channels.count();
            prop_assert_eq!(read.pixels.len(), count);
        }
    }
}
