//! Bad input: one clear error or a documented substitute, never a panic, in bounded time.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests")]

mod common;

use common::{OnePicture, course, course_text, data_uri, png, read, svg, svg_text, warnings};
use scumble_svg::{ErrorKind, Limits, Options, Profile, ProfileChoice, SvgError, parse};
use std::time::{Duration, Instant};

const BOTH: [ProfileChoice; 2] = [ProfileChoice::Svg, ProfileChoice::Course];

/// Runs on a small stack, as an embedder's thread may have, and against the clock.
fn bounded<T: Send + 'static>(run: impl FnOnce() -> T + Send + 'static) -> T {
    let start = Instant::now();
    let thread = std::thread::Builder::new().stack_size(1 << 20).spawn(run).unwrap();
    let result = thread.join().unwrap();
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
    result
}

#[track_caller]
fn error(profile: ProfileChoice, text: &str) -> SvgError {
    let text = text.to_owned();
    bounded(move || read(profile, &text)).unwrap_err()
}

#[test]
fn bytes_that_are_no_text() {
    let of = |bytes: &[u8]| parse(bytes, &Options::default()).unwrap_err().to_string();
    assert!(of(b"\x1f\x8b\x08").contains("svgz"));
    assert!(of(b"\xff\xfe<\0s\0").contains("UTF-16"));
    assert!(of(b"<\0s\0v\0g\0").contains("UTF-16"));
    assert!(of(b"<svg>\n  \xff</svg>").starts_with("2:3: "));
    assert!(of(b"").contains("malformed XML"));
    assert!(of(b"hello").starts_with("1:1: malformed XML"));
    let with_mark = [b"\xef\xbb\xbf".as_slice(), svg_text("").as_bytes()].concat();
    assert!(parse(&with_mark, &Options::default()).is_ok());
}

#[test]
fn malformed_xml_has_a_place() {
    for text in ["<svg>\n<g></svg>", "<svg>\n<g a=1/></svg>", "<svg>\n&nope;</svg>", "<svg>\n<"] {
        let e = error(ProfileChoice::Auto, text);
        assert_eq!(e.position().map(|p| p.line), Some(2), "{e}");
        assert!(matches!(e.kind(), ErrorKind::Xml(_)), "{e}");
    }
}

#[test]
fn roots_and_sizes() {
    let e = error(ProfileChoice::Auto, "<html/>");
    assert_eq!(e.to_string(), "1:1: the root element is `html`, not `svg`");
    for size in ["width='0' height='5'", "width='-1' height='5'", "width='9' height='-1e30'"] {
        for profile in BOTH {
            let e = error(profile, &format!("<svg {size}><rect width='3' height='3'/></svg>"));
            assert!(matches!(e.kind(), ErrorKind::Size(_)), "{e}");
        }
    }
    let e = error(ProfileChoice::Svg, "<svg/>");
    assert!(matches!(e.kind(), ErrorKind::Size(_)), "{e}");
    let e = error(ProfileChoice::Course, "<svg viewBox='0 0 1 1'/>");
    assert!(matches!(e.kind(), ErrorKind::Size(_)), "{e}");
}

#[test]
fn coordinates_beyond_reason() {
    let values = ["nan", "inf", "-inf", "1e30", "-1e30", "1e308", "1e999", "1e-300", "", "x", "0"];
    for v in values {
        for w in values {
            let inside = format!(
                "<rect x='{v}' y='1' width='{w}' height='3' stroke='red'/>\
                 <line x1='{v}' y2='{w}' stroke='red' stroke-width='{w}'/>\
                 <polygon points='{v},{w} 1,2 3,{v}' stroke='red' stroke-dasharray='{v} {w}'/>\
                 <circle cx='{v}' r='{w}' stroke='red'/>\
                 <path d='M{v} {w}C{w} {v} {v} {v} 1 1A{v} {w} 0 0 1 {w} 3z' stroke='red'/>\
                 <g transform='scale({v}) translate({w})'><rect width='1' height='1'/></g>\
                 <g transform='perspective({v}) rotateX({w})'><rect width='1' height='1'/></g>\
                 <image x='{v}' width='{w}' height='{w}' href='a.png'/>\
                 <svg width='{v}' height='{w}' viewBox='{v} {v} {w} {w}'><circle r='1'/></svg>"
            );
            for profile in BOTH {
                let text = course_text(&inside);
                let parsed = bounded(move || read(profile, &text)).unwrap();
                assert!(parsed.scene.commands.len() < 100);
            }
        }
    }
}

#[test]
fn transforms_that_overflow_draw_nothing_and_say_so() {
    let mut inside = "<rect width='1' height='1'/>".to_owned();
    for _ in 0..9 {
        inside = format!("<g transform='scale(1e37)'>{inside}</g>");
    }
    let parsed = course(&inside);
    assert!(parsed.scene.commands.is_empty());
    assert!(warnings(&parsed)[0].contains("beyond the range of numbers"));
    assert!(svg(&inside).scene.commands.is_empty());
}

#[test]
fn depth_is_bounded() {
    for profile in BOTH {
        for (open, close) in
            [("<g>", "</g>"), ("<svg>", "</svg>"), ("<g transform='rotateX(3)'>", "</g>")]
        {
            let deep = |n: usize| course_text(&(open.repeat(n) + &close.repeat(n)));
            let e = error(profile, &deep(100_000));
            assert!(e.is_limit() && e.to_string().contains("nested"), "{e}");
            let text = deep(250);
            assert!(bounded(move || read(profile, &text)).is_ok());
        }
    }
}

#[test]
fn however_deep_the_limit_allows_the_stack_suffices() {
    let mut limits = Limits::default();
    limits.max_depth = 10_000;
    for open in ["<g opacity='.5'>", "<svg width='9' height='9' viewBox='0 0 2 2'>"] {
        let close = if open.starts_with("<g") { "</g>" } else { "</svg>" };
        let text =
            svg_text(&(open.repeat(505) + "<rect width='1' height='1'/>" + &close.repeat(505)));
        let run = move || {
            let options = Options::default().with_profile(ProfileChoice::Svg).with_limits(limits);
            parse(text.as_bytes(), &options)
        };
        // What a spawned thread gets.
        let thread = std::thread::Builder::new().stack_size(2 << 20).spawn(run).unwrap();
        assert!(thread.join().unwrap().is_ok());
    }
    let deep = "<g>".repeat(600) + &"</g>".repeat(600);
    let options = Options::default().with_limits(limits);
    assert!(parse(svg_text(&deep).as_bytes(), &options).unwrap_err().is_limit());
    let course = parse(course_text(&deep).as_bytes(), &options.with_profile(ProfileChoice::Course));
    assert!(course.is_ok());
}

#[test]
fn use_that_refers_to_itself() {
    for inside in [
        "<use id='a' href='#a'/>",
        "<g id='a'><use href='#a'/></g>",
        "<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>",
        "<defs><symbol id='a'><g><use href='#b'/></g></symbol><use id='b' href='#a'/></defs>",
        "<g id='a'><use href='#b'/></g><g id='b'><use href='#c'/></g><g id='c'><use xlink:href='#a'/></g>",
    ] {
        let e = error(ProfileChoice::Svg, &svg_text(inside));
        assert!(e.position().is_some() && e.to_string().contains("refers to itself"), "{e}");
    }
    assert!(svg("<use href='#nothing'/><use/>").scene.commands.is_empty());
}

#[test]
fn use_that_multiplies() {
    let mut inside = "<rect id='a0' width='1' height='1'/>".to_owned();
    for i in 1..40 {
        let (this, last) = (i, i - 1);
        inside += &format!("<g id='a{this}'>{}</g>", format!("<use href='#a{last}'/>").repeat(10));
    }
    let e = error(ProfileChoice::Svg, &svg_text(&inside));
    assert!(e.is_limit(), "{e}");
    // A chain multiplies nothing, but goes deep.
    let mut inside = "<rect id='a0' width='1' height='1'/>".to_owned();
    for i in 1..600 {
        inside += &format!("<use id='a{i}' href='#a{}'/>", i - 1);
    }
    let e = error(ProfileChoice::Svg, &svg_text(&inside));
    assert!(e.is_limit() && e.to_string().contains("nested"), "{e}");
}

#[test]
fn markers_that_multiply() {
    let marker = |id: &str, inside: &str| format!("<marker id='{id}'>{inside}</marker>");
    let path = "<path d='M0 0h1v1h1v1h1v1h1v1' style='marker:url(#b)'/>".repeat(1000);
    let many = "1,2 ".repeat(10_000);
    let inside = marker("b", &"<rect width='1' height='1'/>".repeat(1000))
        + &marker("a", &path)
        + &format!("<polyline points='{many}' marker-mid='url(#a)'/>");
    let e = error(ProfileChoice::Svg, &svg_text(&inside));
    assert!(e.is_limit() && e.to_string().contains("markers"), "{e}");
    // Markers on markers, by inheritance, by style sheet and by `use`, come to an end.
    let inside = "<style>path{marker-start:url(#m) !important}</style>\
        <g marker-mid='url(#m)' marker-end='url(#n)'><marker id='m'><path id='p' d='M0 0h1v1'/>\
        <use href='#q'/></marker><marker id='n'><path d='M0 0h1v1'/></marker>\
        <path id='q' d='M0 0h1v1h1'/></g>";
    let text = svg_text(inside);
    bounded(move || read(ProfileChoice::Svg, &text)).unwrap();
}

#[test]
fn entities_that_multiply() {
    let mut text = "<!DOCTYPE svg [<!ENTITY a0 'aaaaaaaaaa'>".to_owned();
    for i in 1..12 {
        text += &format!("<!ENTITY a{i} '{}'>", format!("&a{};", i - 1).repeat(10));
    }
    text += "]><svg width='1' height='1'><desc>&a11;</desc></svg>";
    let long = format!(
        "<!DOCTYPE svg [<!ENTITY a '{}'>]><svg width='1' height='1'><desc>{}</desc></svg>",
        "a".repeat(100_000),
        "&a;".repeat(100_000)
    );
    for profile in BOTH {
        assert!(matches!(error(profile, &text).kind(), ErrorKind::Xml(_) | ErrorKind::Limit(_)));
        assert!(error(profile, &long).is_limit());
    }
    let plain = "<!DOCTYPE svg [<!ENTITY red '#f00'>]><svg width='9' height='9'>\
        <rect width='3' height='3' fill='&red;'/></svg>";
    let parsed = read(ProfileChoice::Svg, plain).unwrap();
    assert_eq!(parsed.scene.commands.len(), 1);
}

#[test]
fn attributes_and_elements_without_end() {
    let attributes: String = (0..100_000).map(|i| format!(" a{i}=''")).collect();
    for profile in BOTH {
        assert!(error(profile, &course_text(&format!("<g{attributes}/>"))).is_limit());
        assert!(error(profile, &course_text(&"<g/>".repeat(1_000_001))).is_limit());
    }
}

#[test]
fn selectors_that_take_forever() {
    let many = svg_text(&format!(
        "<style>{}</style>{}",
        "g q{fill:red}".repeat(40_000),
        "<g/>".repeat(40_000)
    ));
    let deep = svg_text(&format!(
        "<style>nothing {} {{fill:red}}</style>{}{}",
        "* ".repeat(20),
        "<g>".repeat(200),
        "</g>".repeat(200)
    ));
    let long =
        svg_text(&format!("<style>{} *{{}}</style>{}", "*+".repeat(9_999), "<g/>".repeat(9_999)));
    for text in [many, deep, long] {
        assert!(error(ProfileChoice::Svg, &text).is_limit());
    }
    // What is allowed comes back in time.
    let text = svg_text(&format!(
        "<style>{}</style>{}{}{}",
        "nothing * * * *{fill:red}".repeat(60),
        "<g>".repeat(30),
        "<g/>".repeat(100),
        "</g>".repeat(30)
    ));
    assert!(bounded(move || read(ProfileChoice::Svg, &text)).is_ok());
}

#[test]
fn very_many_elements_are_read() {
    let text = course_text(&"<rect x='1' y='2' width='3' height='4'/>".repeat(200_000));
    for profile in BOTH {
        let text = text.clone();
        let parsed = bounded(move || read(profile, &text)).unwrap();
        assert_eq!(parsed.scene.commands.len(), 200_000);
    }
    let text = course_text(&format!("<polygon points='{}'/>", "1,2 30 40,".repeat(250_000)));
    for profile in BOTH {
        let text = text.clone();
        assert_eq!(bounded(move || read(profile, &text)).unwrap().scene.commands.len(), 1);
    }
}

#[test]
fn gradients_in_a_chain() {
    let chain = |n: usize| -> String {
        let link = |i: usize| {
            format!(
                "<linearGradient id='g{i}' href='#g{}'/><rect width='1' height='1' fill='url(#g{i})'/>",
                i + 1
            )
        };
        (0..n).map(link).collect::<String>()
            + &format!("<linearGradient id='g{n}'><stop stop-color='red'/></linearGradient>")
    };
    assert!(error(ProfileChoice::Svg, &svg_text(&chain(20_000))).is_limit());
    let text = svg_text(&chain(1_500));
    let parsed = bounded(move || read(ProfileChoice::Svg, &text)).unwrap();
    assert_eq!(parsed.scene.commands.len(), 1_500);
    let circle = "<linearGradient id='a' href='#b'/><linearGradient id='b' href='#a'/>";
    let circles = circle.to_owned() + "<rect width='1' height='1' fill='url(#a)'/>";
    assert!(svg(&circles).scene.commands.is_empty());
}

#[test]
fn many_uses_of_a_large_texture() {
    let texture = |filename: &str| format!("<texture texid='t' filename='{filename}'/>");
    let large = texture(&(data_uri("image/png", &png(4, 2)) + &" ".repeat(300_000)));
    let triangles = "<textri texid='t' points='0 0 1 0 0 1' uvs='0 0 1 0 0 1'/>".repeat(50_000);
    let text = course_text(&(triangles + &large + &texture("a.png").repeat(50_000)));
    for profile in BOTH {
        let text = text.clone();
        let parsed = bounded(move || read(profile, &text)).unwrap();
        assert_eq!((parsed.scene.commands.len(), parsed.scene.images.len()), (50_000, 1));
    }
}

#[test]
fn many_kinds_of_warning_are_cut_short() {
    let inside: String = (0..5_000).map(|i| format!("<kind{i}/>")).collect();
    for profile in BOTH {
        let parsed = read(profile, &svg_text(&inside)).unwrap();
        assert!(parsed.warnings.len() <= 101);
        assert_eq!(parsed.warnings.iter().map(|w| w.count).sum::<usize>(), 5_000);
    }
}

#[test]
fn dashes_without_end() {
    let refused = |length: &str, dash: &str| {
        let parsed =
            svg(&format!("<path d='M0 0H{length}' stroke='red' stroke-dasharray='{dash}'/>"));
        warnings(&parsed).iter().any(|warning| warning.contains("too many dashes"))
    };
    assert!(refused("1e7", "1e-4"));
    // Whatever geometry would leave whole is named.
    assert!(refused("65537", "1"));
    assert!(!refused("65536", "1"));
}

#[test]
fn images_that_are_missing_or_broken() {
    for (href, what) in [
        ("none.png", "cannot load `none.png`: not found"),
        ("../secret.png", "cannot load `../secret.png`: refused: it is outside"),
        ("text.png", "cannot read image `text.png`: it is not PNG, JPEG, GIF or WebP"),
        ("broken.png", "cannot read image `broken.png`: "),
        ("data:image/png;base64,AAAA", "cannot read image `data:image/png;base64,AAAA`: "),
        ("data:image/png;base64,!", "a character is not base64"),
        ("data:image/png", "no comma"),
        ("", "cannot load ``: not found"),
    ] {
        for profile in BOTH {
            for inside in [
                format!("\n <image width='9' height='9' href='{href}'/>"),
                format!(
                    "<texture texid='t' filename='{href}'/>\n \
                     <textri texid='t' points='0 0 1 0 0 1' uvs='0 0 1 0 0 1'/>"
                ),
            ] {
                let e = error(profile, &course_text(&inside));
                assert!(e.to_string().starts_with("2:2: "), "{e}");
                assert!(e.to_string().contains(what), "{e}");
            }
        }
    }
}

#[test]
fn an_image_too_large_for_its_decoder_meets_a_limit() {
    // The decoder refuses such a header before we see how large it claims to be.
    let mut bomb = png(1, 1);
    bomb[16..20].copy_from_slice(&i32::MAX.to_be_bytes());
    bomb[20..24].copy_from_slice(&i32::MAX.to_be_bytes());
    let crc = crc32(&bomb[12..29]);
    bomb[29..33].copy_from_slice(&crc.to_be_bytes());
    let uri = data_uri("image/png", &bomb);
    for profile in BOTH {
        let e =
            error(profile, &course_text(&format!("<image width='9' height='9' href='{uri}'/>")));
        assert!(e.is_limit() && e.to_string().starts_with("1:65: "), "{e}");
    }
}

#[test]
fn images_larger_than_allowed() {
    // A header that promises 60 000 × 60 000 pixels; none of them follows.
    let mut bomb = png(1, 1);
    bomb[16..20].copy_from_slice(&60_000_u32.to_be_bytes());
    bomb[20..24].copy_from_slice(&60_000_u32.to_be_bytes());
    let crc = crc32(&bomb[12..29]);
    bomb[29..33].copy_from_slice(&crc.to_be_bytes());
    let uri = data_uri("image/png", &bomb);
    let mut limits = Limits::default();
    limits.max_image_bytes = 4 * 8 * 3;
    let file = {
        let mut l = Limits::default();
        l.max_file_bytes = 40;
        l
    };
    for profile in BOTH {
        let e =
            error(profile, &course_text(&format!("<image width='9' height='9' href='{uri}'/>")));
        assert!(e.is_limit() && e.to_string().contains("60000 × 60000"), "{e}");
        // Three pictures fit, the fourth does not; the same one again costs nothing.
        let all = |n: usize| -> String {
            let hrefs = (0..n).map(|i| data_uri(&format!("image/png;n={i}"), &png(4, 2)));
            hrefs
                .map(|href| format!("<image width='9' height='9' href='{href}'/>").repeat(2))
                .collect()
        };
        let options = Options::default().with_profile(profile).with_resources(&OnePicture);
        let of = |limits, text: String| parse(text.as_bytes(), &options.with_limits(limits));
        assert!(of(limits, course_text(&all(3))).is_ok());
        assert!(of(limits, course_text(&all(4))).unwrap_err().is_limit());
        let image = "<image width='9' height='9' href='a.png'/>";
        assert!(of(file, course_text(image)).unwrap_err().is_limit());
        assert!(of(file, course_text(&all(1))).unwrap_err().is_limit());
        let mut document = Limits::default();
        document.max_document_bytes = 20;
        assert!(of(document, course_text("")).unwrap_err().is_limit());
    }
}

/// CRC-32 of PNG chunks.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |crc, &b| {
        (0..8)
            .fold(crc ^ u32::from(b), |c, _| if c & 1 == 1 { c >> 1 ^ 0xedb8_8320 } else { c >> 1 })
    })
}

#[test]
fn extension_elements_that_lack_something() {
    for (inside, what) in [
        ("<textri/>", "`textri`: it has no `points`"),
        ("<textri points='1 2 3' uvs='' texid='t'/>", "`points` is not 6 numbers"),
        ("<textri points='1 2 3 4 5 nan' uvs='' texid='t'/>", "`points` is not 6 numbers"),
        (
            "<textri points='0 0 1 0 0 1' uvs='0 0 1 0 0 1' texid='t'/>",
            "no `texture` has the texid `t`",
        ),
        ("<colortri points='0 0 1 0 0 1' colors='1 1 1'/>", "`colors` is not 12 numbers"),
        ("<texture texid='t'/>", "`texture`: it has no `filename`"),
        ("<texture filename='t'/>", "`texture`: it has no `texid`"),
        ("<texture filename='t' texid='t' sc:wrap='twist'/>", "`wrap` is not"),
    ] {
        for profile in BOTH {
            let e = error(profile, &course_text(&format!("\n{inside}")));
            assert!(e.to_string().starts_with("2:1: ") && e.to_string().contains(what), "{e}");
        }
    }
    for (attributes, what) in [
        ("sc:quad='0 0 1 0 1 1'", "`sc:quad` is not four points"),
        ("sc:quad='0 0 1 0 2 0 0 1'", "degenerate"),
        ("sc:quad='0 0 1 0 1 1 0 1' sc:box='0 0 0 5'", "`sc:box` has no area"),
        ("sc:quad='0 0 1 0 1 1 0 1' sc:box='0 0'", "`sc:box` is not four numbers"),
    ] {
        let e = error(
            ProfileChoice::Svg,
            &svg_text(&format!("\n<rect width='3' height='4' {attributes}/>")),
        );
        assert!(e.to_string().starts_with("2:1: ") && e.to_string().contains(what), "{e}");
    }
    let e = error(
        ProfileChoice::Svg,
        &svg_text("<line x2='9' stroke='red' sc:quad='0 0 1 0 1 1 0 1'/>"),
    );
    assert!(e.to_string().contains("give an `sc:box`"), "{e}");
}

#[test]
fn broken_references_of_every_kind() {
    let inside = "<rect width='3' height='3' fill='url(#none)'/>\
        <rect width='3' height='3' fill='url(#none) red'/>\
        <rect width='3' height='3' fill='url(#g)' stroke='url(#p)'/>\
        <linearGradient id='g' href='#h'/><linearGradient id='h' href='#g'/>\
        <pattern id='p' href='#p'><rect fill='url(#p)' width='1' height='1'/></pattern>\
        <mask id='m' mask='url(#m)'><rect mask='url(#m)'/></mask>\
        <clipPath id='c' clip-path='url(#c)'><use href='#c'/></clipPath>\
        <filter id='f'><feImage href='#r'/></filter>\
        <g id='r' filter='url(#f)' mask='url(#m)' clip-path='url(#c)'><rect width='1' height='1'/></g>\
        <g clip-path='url(#none)' filter='url(#none)' mask='none'><rect width='1' height='1'/></g>";
    let parsed = svg(inside);
    assert_eq!(parsed.profile, Profile::Svg);
    assert!(parsed.scene.commands.len() >= 3);
}

#[test]
fn styles_of_every_oddity() {
    for selector in [
        "> g",
        "+ g",
        ", g",
        "g >",
        "g > > g",
        "*",
        "",
        ":first-child",
        ".",
        "#",
        "[",
        "[a",
        "[a=",
        "g:",
        "g::before",
        "g:lang(en)",
        ":not(g)",
        "~ g",
        "g ~ g",
        "g > + g",
        "@media",
        "é",
        "\\",
        "g,,g",
        "{",
        "} g",
        "!",
        "--a",
        "g/**/g",
        "<!--",
        "|g",
        "*|g",
        "a|b",
        "&amp;",
        "1",
        "%",
    ] {
        for declarations in [
            "fill:red",
            "",
            ":",
            ";",
            "fill",
            "fill:",
            "fill:;",
            "a:b!important;c",
            "*fill:red",
            "fill:'",
            "fill:url(",
            "fill:(",
            "font:x",
            "font:",
            "font:12px a",
            "marker:x",
            "{}",
            "@a;",
        ] {
            let inside = format!(
                "<style>{} {{ {declarations} }} g{{fill:blue}}</style><g><g style=\"{declarations}\"><rect width='1' height='1'/></g></g>",
                selector.replace('<', "&lt;")
            );
            svg(&inside);
        }
    }
}
