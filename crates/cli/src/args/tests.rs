use super::*;
use clap::CommandFactory;
use clap::error::ErrorKind;

fn render(arguments: &[&str]) -> Result<Render, ErrorKind> {
    let words = ["scumble", "render"].iter().chain(arguments);
    match Cli::try_parse_from(words).map_err(|e| e.kind())?.command {
        Command::Render(render) => Ok(*render),
        _ => unreachable!("the word is render"),
    }
}

#[test]
fn the_definition_is_consistent() {
    Cli::command().debug_assert();
}

#[test]
fn a_scene_alone_is_enough() {
    let render = render(&["a.svg"]).unwrap();
    assert_eq!(render.scene, PathBuf::from("a.svg"));
    assert_eq!((render.out, render.output), (None, None));
    assert_eq!(render.limits.max_memory, scumble::DEFAULT_MAX_MEMORY);
    assert_eq!(render.limits.max_pixels, 1_000_000_000);
    assert_eq!(render.limits.threads, 0);
    assert_eq!(render.files.profile, Profile::Auto);
}

#[test]
fn every_option_is_read() {
    let render = render(&[
        "-",
        "-o",
        "-",
        "-w",
        "10",
        "-H",
        "20",
        "-z",
        "1.5",
        "--crop",
        "0,0,1,1",
        "--profile",
        "course",
        "--samples",
        "4",
        "--pattern",
        "grid",
        "--shade",
        "sample",
        "--quality",
        "high",
        "--pixel",
        "bilinear",
        "--kernel",
        "smooth",
        "--magnify",
        "lanczos2",
        "--level",
        "linear",
        "--max-eccentricity",
        "8",
        "--space",
        "linear",
        "--background",
        "none",
        "--interpolate",
        "affine",
        "--resources",
        "a",
        "--resources",
        "b",
        "-j",
        "2",
        "--max-memory",
        "1G",
        "--max-pixels",
        "10M",
        "--force",
        "-q",
        "--json",
    ])
    .unwrap();
    assert_eq!(render.files.resources.len(), 2);
    assert_eq!(render.quality.quality, Some("high"));
    assert_eq!(render.quality.pixel, Some(Pixel::Bilinear));
    assert_eq!(render.quality.level, Some(Level::Linear));
    assert_eq!(render.quality.pattern, Some(Pattern::Grid));
    assert_eq!(render.quality.shade, Some(Shade::Sample));
    assert_eq!(render.quality.interpolate, Some(Interpolate::Affine));
    assert_eq!(render.color.space, Some(Space::Linear));
    assert_eq!(render.color.background, Some(Background::Transparent));
    assert!(render.files.force && render.report.quiet && render.report.json);
}

#[test]
fn the_picture_is_named_once() {
    assert_eq!(
        render(&["a.svg", "b.png", "-o", "c.png"]).unwrap_err(),
        ErrorKind::ArgumentConflict
    );
    assert_eq!(render(&["a.svg", "b.png"]).unwrap().out, Some(PathBuf::from("b.png")));
}

#[test]
fn words_are_checked() {
    assert_eq!(render(&[]).unwrap_err(), ErrorKind::MissingRequiredArgument);
    assert_eq!(render(&["a", "--pixel", "cubic"]).unwrap_err(), ErrorKind::InvalidValue);
    assert_eq!(render(&["a", "--quality", "best"]).unwrap_err(), ErrorKind::InvalidValue);
    assert_eq!(render(&["a", "--kernel", "own"]).unwrap_err(), ErrorKind::InvalidValue);
    assert_eq!(render(&["a", "--samples", "3"]).unwrap_err(), ErrorKind::ValueValidation);
    assert_eq!(render(&["a", "--nonsense"]).unwrap_err(), ErrorKind::UnknownArgument);
}

#[test]
fn a_choice_knows_its_word() {
    assert_eq!(choice::name(Pixel::Ewa), "ewa");
    assert_eq!(choice::name(Profile::Course), "course");
}
