//! The SVG profile: what usvg resolves, and what we carry through it.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod common;

use common::{data_uri, names, png, read, svg, svg_text, warnings};
use scumble_geometry::{DVec2, FillRule, Rect};
use scumble_scene::{Command, Fill, ImageQuad, ImageWrap, TexturedTriangle, View};
use scumble_svg::{Parsed, ProfileChoice};

fn fills(parsed: &Parsed) -> Vec<&Fill> {
    let fills = parsed.scene.commands.iter().filter_map(|c| match c {
        Command::Fill(fill) => Some(fill),
        _ => None,
    });
    fills.collect()
}

#[track_caller]
fn only_fill(inside: &str) -> Fill {
    match &svg(inside).scene.commands[..] {
        [Command::Fill(fill)] => fill.clone(),
        other => panic!("{other:?}"),
    }
}

#[track_caller]
fn only_image(inside: &str) -> ImageQuad {
    match &svg(inside).scene.commands[..] {
        [Command::Image(image)] => image.clone(),
        other => panic!("{other:?}"),
    }
}

#[track_caller]
fn only_textured(inside: &str) -> TexturedTriangle {
    match &svg(inside).scene.commands[..] {
        [Command::Textured(triangle)] => triangle.clone(),
        other => panic!("{other:?}"),
    }
}

/// Where a command's map takes a point.
#[track_caller]
fn near(actual: Option<DVec2>, expected: (f64, f64)) {
    let actual = actual.unwrap();
    let d = actual - DVec2::new(expected.0, expected.1);
    assert!(d.length() < 1e-5, "{actual} {expected:?}");
}

const TEXTURE: &str = "<texture texid='t' filename='a.png'/>";
const TEXTRI: &str = "<textri texid='t' points='0 0 10 0 0 10' uvs='0 0 1 0 0 1'/>";
const RECT: &str = "<rect width='10' height='10'/>";

#[test]
fn shapes_become_fills_and_strokes() {
    for shape in [
        "<rect width='3' height='3'/>",
        "<circle r='3'/>",
        "<ellipse rx='3' ry='2'/>",
        "<polygon points='0 0 1 0 0 1'/>",
        "<polyline points='0 0 1 0 0 1'/>",
        "<path d='M0 0h3v3'/>",
    ] {
        assert_eq!(names(&svg(shape)), ["fill"], "{shape}");
        let stroked = shape.replace("/>", " stroke='red'/>");
        assert_eq!(names(&svg(&stroked)), ["fill", "stroke"], "{shape}");
        let outline = stroked.replace("/>", " fill='none'/>");
        assert_eq!(names(&svg(&outline)), ["stroke"], "{shape}");
        let under = stroked.replace("/>", " paint-order='stroke'/>");
        assert_eq!(names(&svg(&under)), ["stroke", "fill"], "{shape}");
    }
    assert_eq!(names(&svg("<line x2='3' stroke='red'/>")), ["stroke"]);
    assert_eq!(names(&svg("<line x2='3'/>")), [""; 0]);
}

#[test]
fn strokes_keep_their_style() {
    let parsed = svg("<path d='M0 0h9v9' fill='none' stroke='red' stroke-width='3' \
        stroke-linejoin='round' stroke-linecap='square' stroke-miterlimit='7' \
        stroke-dasharray='1 2 3' stroke-dashoffset='4' stroke-opacity='.5'/>");
    let [Command::Stroke(stroke)] = &parsed.scene.commands[..] else { panic!("{parsed:?}") };
    assert_eq!(stroke.style.width, 3.0);
    assert_eq!(stroke.style.join, scumble_geometry::Join::Round);
    assert_eq!(stroke.style.cap, scumble_geometry::Cap::Square);
    assert_eq!(stroke.style.miter_limit, 7.0);
    assert_eq!(stroke.style.dashes, [1.0, 2.0, 3.0, 1.0, 2.0, 3.0]);
    assert_eq!(stroke.style.dash_offset, 4.0);
    assert_eq!(stroke.color.0, [1.0, 0.0, 0.0, 0.5]);
}

#[test]
fn styles_cascade() {
    let color = |inside: &str| only_fill(inside).color.0;
    let red = [1.0, 0.0, 0.0, 1.0];
    assert_eq!(color("<g fill='red'><rect width='1' height='1'/></g>"), red);
    assert_eq!(color("<style>.a{fill:red}</style><rect class='a' width='1' height='1'/>"), red);
    assert_eq!(
        color("<style>rect{fill:blue}</style><rect style='fill:red' width='1' height='1'/>"),
        red
    );
    assert_eq!(color("<g color='red'><rect fill='currentColor' width='1' height='1'/></g>"), red);
    assert_eq!(
        color(
            "<style>g:first-child > rect{fill:red}</style><g/><g><rect width='1' height='1'/></g>"
        ),
        [0.0, 0.0, 0.0, 1.0]
    );
    let commented =
        "<style><!-- rect{fill:blue} -->rect{fill:red}</style><rect width='1' height='1'/>";
    assert_eq!(color(commented), red);
    let other = "<style type='text/less'>rect{fill:red}</style><rect width='1' height='1'/>";
    assert_eq!(color(other), [0.0, 0.0, 0.0, 1.0]);
    assert_eq!(only_fill("<path fill-rule='evenodd' d='M0 0h1v1'/>").rule, FillRule::EvenOdd);
    let half = color("<rect width='1' height='1' fill='red' fill-opacity='.5'/>");
    assert_eq!(half, [1.0, 0.0, 0.0, 0.5]);
    for hidden in ["display='none'", "visibility='hidden'", "opacity='0'", "style='display:none'"] {
        assert_eq!(names(&svg(&format!("<g {hidden}>{RECT}{TEXTURE}{TEXTRI}</g>"))), [""; 0]);
    }
}

#[test]
fn root_size_and_view_box() {
    let of = |root: &str| {
        let text = format!("<svg xmlns='http://www.w3.org/2000/svg' {root}>{RECT}</svg>");
        let parsed = read(ProfileChoice::Svg, &text).unwrap();
        let end = fills(&parsed)[0].transform.project(DVec2::splat(10.0)).unwrap();
        let View::Fit { size } = parsed.scene.view else { panic!("{parsed:?}") };
        (size.to_array(), end.to_array())
    };
    assert_eq!(of("width='100' height='50'"), ([100.0, 50.0], [10.0, 10.0]));
    assert_eq!(of("width='1in' height='50'"), ([96.0, 50.0], [10.0, 10.0]));
    assert_eq!(of("viewBox='0 0 20 10'"), ([20.0, 10.0], [10.0, 10.0]));
    assert_eq!(of("width='100' height='100' viewBox='0 0 20 10'"), ([100.0, 100.0], [50.0, 75.0]));
    assert_eq!(
        of("width='100' height='100' viewBox='0 0 20 10' preserveAspectRatio='none'"),
        ([100.0, 100.0], [50.0, 100.0])
    );
    assert_eq!(of("width='100' viewBox='0 0 20 10'"), ([100.0, 50.0], [50.0, 50.0]));
    // Without any size the drawing is the size.
    assert_eq!(of(""), ([10.0, 10.0], [10.0, 10.0]));
    assert_eq!(of("width='nan' height='4'"), ([10.0, 10.0], [10.0, 10.0]));
}

#[test]
fn transforms_in_every_place_and_spelling() {
    for text in [
        "<g transform='translate(10 20) scale(2)'>R</g>",
        "<g style='transform:translate(10px, 20px) scale(2)'>R</g>",
        "<style>.m { transform: translate(10px, 20px) scale(200%) }</style><g class='m'>R</g>",
        "<g transform='translate(10 20)'><g transform='scale(2)'>R</g></g>",
        "<g transform='scale(3)' style='transform:matrix(2 0 0 2 10 20)'>R</g>",
        "<g transform='matrix3d(2 0 0 0 0 2 0 0 0 0 1 0 10 20 0 1)'>R</g>",
        "<g transform='scale(2)' transform-origin='-10 -20'>R</g>",
        "<g style='transform:scale(2); transform-origin: -10px -20px'>R</g>",
        "<svg x='10' y='20' width='20' height='20' viewBox='0 0 10 10'>R</svg>",
        "<defs><g id='d'>R</g></defs><use href='#d' x='5' y='10' transform='scale(2)'/>",
    ] {
        let fill = only_fill(&text.replace('R', RECT));
        near(fill.transform.project(DVec2::ZERO), (10.0, 20.0));
        near(fill.transform.project(DVec2::splat(10.0)), (30.0, 40.0));
    }
}

/// (x, y) ↦ (x, y)/(1 + x/10).
const TILT: &str = "matrix3d(1 0 0 .1 0 1 0 0 0 0 1 0 0 0 0 1)";

#[test]
fn perspective_in_every_place() {
    for text in [
        "<g transform='T'>R</g>",
        "<g style='fill:red;transform:T'>R</g>",
        "<style>g.m{fill:red;transform:T}</style><g class='m'>R</g>",
        "<style>/* .n{ */ .m{transform:T !important}</style><g class='m' style='transform:scale(3)'>R</g>",
        "<defs><g id='d' transform='T'>R</g></defs><use href='#d'/>",
        "<defs><g id='d'>R</g></defs><use href='#d' transform='T'/>",
        "<defs><symbol id='d'>R</symbol></defs><use href='#d' style='transform:T'/>",
        "<svg transform='T'>R</svg>",
        "<a transform='T'>R</a>",
        "<switch transform='T'>R</switch>",
    ] {
        let parsed = svg(&text.replace('R', RECT).replace('T', TILT));
        let [fill] = fills(&parsed)[..] else { panic!("{text} {parsed:?}") };
        near(fill.transform.project(DVec2::ZERO), (0.0, 0.0));
        near(fill.transform.project(DVec2::splat(10.0)), (5.0, 5.0));
    }
    let direct = only_fill(&format!("<rect width='10' height='10' transform='{TILT}'/>"));
    near(direct.transform.project(DVec2::splat(10.0)), (5.0, 5.0));
    // The `x` and `y` of a `use` lie inside its transform.
    let inside = format!(
        "<defs>{}</defs><use href='#d' x='10' transform='{TILT}'/>",
        RECT.replace("<rect", "<rect id='d'")
    );
    near(only_fill(&inside).transform.project(DVec2::ZERO), (5.0, 0.0));
    let inside = format!(
        "<style>.m{{transform:{TILT}}}</style><defs>{}</defs><use class='m' href='#d' x='10'/>",
        RECT.replace("<rect", "<rect id='d'")
    );
    near(only_fill(&inside).transform.project(DVec2::ZERO), (5.0, 0.0));
    // Around an origin, it stays where it is.
    let inside =
        format!("<rect x='20' width='10' height='10' transform='{TILT}' transform-origin='20 0'/>");
    near(only_fill(&inside).transform.project(DVec2::new(30.0, 10.0)), (25.0, 5.0));
}

#[test]
fn nested_perspectives_stay_exact_however_many() {
    let mut inside = RECT.to_owned();
    for _ in 0..200 {
        inside = format!("<g transform='perspective(100) translate3d(1px,0,0)'>{inside}</g>");
    }
    near(only_fill(&inside).transform.project(DVec2::ZERO), (200.0, 0.0));
}

#[test]
fn quads() {
    let quad = "sc:quad='20,10 60,15 55,45 25,40'";
    let corners = [(20.0, 10.0), (60.0, 15.0), (55.0, 45.0), (25.0, 40.0)];
    let maps_box = |inside: &str, rect: Rect| {
        let parsed = svg(inside);
        let map = match &parsed.scene.commands[..] {
            [Command::Fill(fill)] => fill.transform,
            [Command::Textured(triangle)] => triangle.transform,
            other => panic!("{other:?}"),
        };
        for (corner, expected) in rect.corners().into_iter().zip(corners) {
            near(map.project(corner), expected);
        }
    };
    let square = Rect::new(0.0, 0.0, 10.0, 10.0);
    maps_box(&format!("<rect width='10' height='10' {quad}/>"), square);
    maps_box(&format!("<rect width='3' height='3' {quad} sc:box='0 0 10 10'/>"), square);
    maps_box(&format!("<g {quad} sc:box='0 0 10 10'>{RECT}</g>"), square);
    maps_box(&format!("<g {quad}>{RECT}</g>"), Rect::new(0.0, 0.0, 100.0, 50.0));
    maps_box(&format!("<circle cx='5' cy='5' r='5' {quad}/>"), square);
    maps_box(&format!("{TEXTURE}{}", TEXTRI.replace("/>", &format!(" {quad}/>"))), square);
    maps_box(&format!("<defs><g id='d'>{RECT}</g></defs><use href='#d' {quad}/>"), square);
    let nested = format!("<svg viewBox='1 2 3 4'><g {quad}>{RECT}</g></svg>");
    let fill = only_fill(&nested);
    assert!(!fill.transform.is_affine());
    // The quad lies inside the element's own transform.
    let fill =
        only_fill(&format!("<rect width='10' height='10' transform='translate(7 8)' {quad}/>"));
    near(fill.transform.project(DVec2::ZERO), (27.0, 18.0));
    // An image's box is its own.
    let image = only_image(&format!(
        "<image width='10' height='10' preserveAspectRatio='none' href='a.png' {quad}/>"
    ));
    near(image.transform.project(DVec2::new(4.0, 2.0)), (55.0, 45.0));
}

#[test]
fn extension_elements_take_part_in_svg() {
    let triangle = only_textured(&format!("{TEXTRI}{TEXTURE}"));
    assert_eq!(triangle.uvs[1], DVec2::X);
    assert_eq!(triangle.points[2], DVec2::new(0.0, 10.0));
    for text in [
        "<g transform='translate(3 4)'>T</g>",
        "<defs><g id='d'>T</g></defs><use href='#d' x='3' y='4'/>",
        "<style>path{fill:none;stroke:red;marker-mid:url(#m)}</style><marker id='m'><rect width='1' height='1'/></marker><g transform='translate(3 4)' fill='none' stroke='red'>T</g>",
    ] {
        let triangle = only_textured(&(TEXTURE.to_owned() + &text.replace('T', TEXTRI)));
        near(triangle.transform.project(DVec2::ZERO), (3.0, 4.0));
    }
    let faded = TEXTRI.replace("/>", " opacity='.5' class='a' style='transform:scale(2)'/>");
    let triangle = only_textured(&format!("{TEXTURE}{faded}"));
    assert_eq!(triangle.opacity, 0.5);
    near(triangle.transform.project(DVec2::ONE), (2.0, 2.0));
    let parsed =
        svg("<colortri points='0 0 1 0 0 1' colors='1 0 0 1 0 1 0 1 0 0 1 1' opacity='.5'/>");
    let [Command::Gouraud(triangle)] = &parsed.scene.commands[..] else { panic!("{parsed:?}") };
    assert_eq!(triangle.colors[1].0, [0.0, 1.0, 0.0, 0.5]);
    let wrapped = TEXTURE.replace("/>", " sc:wrap='repeat'/>");
    assert_eq!(svg(&(wrapped + TEXTRI)).scene.images[0].wrap, ImageWrap::Repeat);
}

#[test]
fn opacity_makes_layers_only_where_it_must() {
    let two = format!("{RECT}{RECT}");
    let of = |inside: &str| names(&svg(inside));
    assert_eq!(of(&format!("<g opacity='.5'>{two}</g>")), ["push", "fill", "fill", "pop"]);
    assert_eq!(of(&format!("<g opacity='.5'>{RECT}</g>")), ["fill"]);
    assert_eq!(of("<g opacity='.5'/>"), [""; 0]);
    assert_eq!(of(&format!("<g opacity='.5'><g opacity='.5'>{RECT}</g></g>")), ["fill"]);
    assert_eq!(
        of(&format!("<g opacity='.5'><g opacity='.5'>{two}</g></g>")),
        ["push", "push", "fill", "fill", "pop", "pop"]
    );
    assert_eq!(
        of("<rect width='1' height='1' stroke='red' opacity='.5'/>"),
        ["push", "fill", "stroke", "pop"]
    );
    let fill =
        only_fill(&format!("<g opacity='.5'><g opacity='.5' fill-opacity='.5'>{RECT}</g></g>"));
    assert_eq!(fill.color.0[3], 0.125);
}

#[test]
fn images_are_placed_as_their_aspect_says() {
    // The picture is 4 × 2.
    let place = |attributes: &str| {
        let image = only_image(&format!("<image href='a.png' {attributes}/>"));
        let [a, _, b, _] = image.rect.corners().map(|p| image.transform.project(p).unwrap());
        let round = |p: DVec2| [p.x.round(), p.y.round()];
        let s = image.source;
        (round(a), round(b), [s.x0, s.y0, s.x1, s.y1])
    };
    let all = [0.0, 0.0, 1.0, 1.0];
    assert_eq!(place(""), ([0.0, 0.0], [4.0, 2.0], all));
    assert_eq!(place("width='8'"), ([0.0, 0.0], [8.0, 4.0], all));
    assert_eq!(place("x='1' y='2' width='8' height='8'"), ([1.0, 4.0], [9.0, 8.0], all));
    assert_eq!(
        place("width='8' height='8' preserveAspectRatio='none'"),
        ([0.0, 0.0], [8.0, 8.0], all)
    );
    assert_eq!(
        place("width='8' height='8' preserveAspectRatio='xMidYMax'"),
        ([0.0, 4.0], [8.0, 8.0], all)
    );
    assert_eq!(
        place("width='8' height='8' preserveAspectRatio='xMidYMid slice'"),
        ([0.0, 0.0], [8.0, 8.0], [0.25, 0.0, 0.75, 1.0])
    );
    assert_eq!(
        place("x='10' width='8' height='8' preserveAspectRatio='xMinYMid slice'"),
        ([10.0, 0.0], [18.0, 8.0], [0.0, 0.0, 0.5, 1.0])
    );
    assert_eq!(
        place("width='50%' height='100%' preserveAspectRatio='none'"),
        ([0.0, 0.0], [50.0, 50.0], all)
    );
}

#[test]
fn images_of_every_format_and_their_rendering() {
    use image::ImageFormat;
    let picture = image::load_from_memory(&png(4, 2)).unwrap();
    for (format, mime) in [
        (ImageFormat::Png, "image/png"),
        (ImageFormat::Jpeg, "image/jpeg"),
        (ImageFormat::Gif, "image/gif"),
        (ImageFormat::WebP, "image/webp"),
        (ImageFormat::Png, "text/plain"),
    ] {
        let mut bytes = std::io::Cursor::new(Vec::new());
        let plain =
            if format == ImageFormat::Jpeg { picture.to_rgb8().into() } else { picture.clone() };
        plain.write_to(&mut bytes, format).unwrap();
        let uri = data_uri(mime, &bytes.into_inner());
        let parsed = svg(&format!("<image href='{uri}'/>"));
        let size = (parsed.scene.images[0].pixels.width(), parsed.scene.images[0].pixels.height());
        assert_eq!(size, (4, 2), "{mime}");
    }
    for (attribute, pixelated) in [
        ("", false),
        ("image-rendering='optimizeQuality'", false),
        ("image-rendering='optimizeSpeed'", true),
        ("image-rendering='pixelated'", true),
        ("style='image-rendering:pixelated'", true),
        ("style='image-rendering:crisp-edges'", true),
    ] {
        let image = only_image(&format!("<image href='a.png' {attribute}/>"));
        assert_eq!(image.pixelated, pixelated, "{attribute}");
    }
    // One picture for all of its uses.
    let parsed = svg("<image href='a.png'/><image href='a.png' opacity='.5'/>");
    assert_eq!((names(&parsed), parsed.scene.images.len()), (vec!["image"; 2], 1));
    let inside = "<defs><image id='i' href='a.png'/></defs><use href='#i'/><use href='#i' x='9'/>";
    assert_eq!(names(&svg(inside)), ["image"; 2]);
}

#[test]
fn what_is_not_drawn_is_named() {
    for (inside, message) in [
        ("\n<text>a</text>", "2:1: `text` is not drawn"),
        ("\n<foreignObject/>", "2:1: `foreignObject` is not drawn"),
        (
            "\n<g clip-path='url(#c)'/>",
            "2:1: `clip-path` is not applied: all of the element is drawn",
        ),
        ("\n<g style='mask:url(#c)'/>", "2:1: `mask` is not applied: all of the element is drawn"),
        (
            "\n<style>g{filter:blur(3px)}</style>",
            "2:1: `filter` is not applied: the element is drawn without",
        ),
        (
            "\n<g style='mix-blend-mode:multiply'/>",
            "2:1: `mix-blend-mode` is not applied: normal is taken",
        ),
        (
            "\n<path vector-effect='non-scaling-stroke'/>",
            "2:1: `vector-effect` is not applied: strokes scale",
        ),
        ("\n<pattern id='p'/>", "2:1: `pattern` is not drawn: mid-grey stands for it"),
        ("\n<animate/>", "2:1: `animate` is not played"),
        ("\n<mesh/>", "2:1: `mesh` is not drawn: it is not known"),
        ("\n<image href='a.svg'/>", "2:1: `image` of a picture in SVG is not drawn"),
        (
            "\n<g transform='turn(1)'/>",
            "2:1: `transform` is ignored: `turn` with 1 arguments is not known",
        ),
        (
            "\n<svg width='5' height='5'><rect width='9' height='9'/></svg>",
            "2:1: what leaves a nested viewport is drawn too: clips are not applied",
        ),
    ] {
        assert_eq!(warnings(&svg(inside)), [message]);
    }
    for quiet in [
        "<title/><desc/><metadata><a/></metadata><script/><x:y xmlns:x='u'><rect/></x:y>",
        "<g clip-path='none' mask='none' filter='none' style='mix-blend-mode:normal'/>",
        "<svg width='5' height='5'><rect width='5' height='5'/></svg>",
        "<defs><text>a</text></defs><g display='none'><text>a</text></g>",
        "<mask><rect mask='none'/></mask><clipPath/><filter/>",
    ] {
        assert_eq!(warnings(&svg(quiet)), [""; 0], "{quiet}");
    }
}

#[test]
fn stand_ins_for_gradients_and_patterns() {
    let stops = "<stop stop-color='#fff'/><stop offset='1' stop-color='#000'/>";
    let parsed = svg(&format!(
        "\n<linearGradient id='g'>{stops}</linearGradient>\
        <rect width='1' height='1' fill='url(#g)' fill-opacity='.5'/><rect width='1' height='1' fill='url(#g)'/>"
    ));
    assert_eq!(fills(&parsed)[0].color.0, [0.5, 0.5, 0.5, 0.5]);
    assert_eq!(
        warnings(&parsed),
        ["2:1: a gradient is not drawn: its mean colour stands for it (2 times)"]
    );
    // The stops end half-way; what comes after has the last colour.
    let stops = "<stop stop-color='#fff'/><stop offset='.5' stop-color='#000'/>";
    let parsed = svg(&format!(
        "<radialGradient id='g'>{stops}</radialGradient><rect width='1' height='1' fill='url(#g)'/>"
    ));
    assert_eq!(fills(&parsed)[0].color.0, [0.25, 0.25, 0.25, 1.0]);
    let parsed = svg("<pattern id='p'/><rect width='1' height='1' fill='url(#p)'/>");
    let grey = 128.0 / 255.0;
    assert_eq!(fills(&parsed)[0].color.0, [grey, grey, grey, 1.0]);
}

#[test]
fn markers_are_drawn() {
    let inside = "<marker id='m'><rect width='1' height='1'/></marker>\
        <path d='M0 0h9v9' fill='none' stroke='red' marker-start='url(#m)' marker-mid='url(#m)' marker-end='url(#m)'/>";
    assert_eq!(names(&svg(inside)), ["stroke", "fill", "fill", "fill"]);
}

#[test]
fn documents_without_a_namespace_and_with_a_prefix() {
    let plain = "<svg width='9' height='9'><rect width='3' height='3'/></svg>";
    assert_eq!(names(&read(ProfileChoice::Svg, plain).unwrap()), ["fill"]);
    let prefixed = "<s:svg xmlns:s='http://www.w3.org/2000/svg' width='9' height='9'>\
        <s:rect width='3' height='3'/></s:svg>";
    assert_eq!(names(&read(ProfileChoice::Svg, prefixed).unwrap()), ["fill"]);
    let text = svg_text(
        "<g id='a&amp;&lt;&quot;'><rect width='3' height='3'/></g><style><![CDATA[rect{fill:red}]]></style>",
    );
    assert_eq!(fills(&read(ProfileChoice::Svg, &text).unwrap())[0].color.0[0], 1.0);
}
