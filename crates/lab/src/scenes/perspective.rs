//! The extensions: homographies in the transform stack, textures and colours by the corner.

use super::Scene;
use super::ordinary::plain;
use crate::svg::{Profile, Svg, number};

pub(crate) fn all() -> Vec<Scene> {
    vec![
        (
            "quad",
            plain(
                480,
                360,
                "sc:quad on an image: its box goes to four points, clockwise from the top left",
                QUAD,
            ),
        ),
        ("quad_group", quad_group()),
        (
            "matrix3d",
            plain(
                420,
                300,
                "transform=\"matrix3d(…)\": sixteen numbers by columns, restricted to the plane z = 0",
                MATRIX3D,
            ),
        ),
        (
            "css3d",
            plain(
                480,
                320,
                "CSS transforms of space: perspective, rotateX, rotateY, rotateZ, rotate3d, translate3d, scale3d",
                CSS3D,
            ),
        ),
        ("behind", behind()),
        ("wrap", wrap()),
        ("colortri", colortri()),
        ("textri", textri()),
    ]
}

const QUAD: &str = r##"
<rect width="480" height="360" fill="#39424a"/>
<polygon points="0,230 480,190 480,360 0,360" fill="#6b5a48"/>
<!-- on the wall, from the left; on the wall, from the right; on the table -->
<image width="384" height="512" href="textures/portrait.png" sc:quad="30,20 190,55 190,245 30,275"/>
<image width="512" height="512" href="textures/chart.png" sc:quad="235,60 455,15 455,225 235,205"/>
<image width="1024" height="512" href="textures/world.png" sc:quad="170,250 390,235 470,335 40,350"/>
"##;

fn quad_group() -> String {
    let mut svg = Svg::new(
        Profile::Svg,
        480,
        360,
        "sc:quad and sc:box on groups: a drawing with curves and strokes goes to a quad as a whole",
    );
    svg.element("rect width=\"480\" height=\"360\" fill=\"#dfe7ea\"");
    let card = r##"
<rect width="100" height="60" rx="6" fill="#fffdf7" stroke="#203040" stroke-width="2"/>
<circle cx="22" cy="30" r="14" fill="#c8553d"/>
<path d="M45,18 H90 M45,28 H90 M45,38 H75" stroke="#203040" stroke-width="4" stroke-linecap="round"/>
<path d="M45,50 q6,-8 12,0 t12,0 t12,0" fill="none" stroke="#588b3a" stroke-width="2.5"/>
"##;
    let quads = [
        ("the box is given", " sc:box=\"0 0 100 60\"", "40,40 220,20 240,150 25,130"),
        ("mirrored", " sc:box=\"0 0 100 60\"", "450,30 280,50 270,160 460,140"),
        (
            "the box is larger than the drawing",
            " sc:box=\"-50 -30 200 120\"",
            "60,170 430,200 470,350 10,330",
        ),
    ];
    for (what, sc_box, quad) in quads {
        svg.line(&format!("<!-- {what} -->"));
        svg.open(&format!("g{sc_box} sc:quad=\"{quad}\""));
        for line in card.trim_matches('\n').lines() {
            svg.line(line);
        }
        svg.close("g");
    }
    svg.line("<!-- without sc:box an element's own bounding box, a group's the viewBox -->");
    svg.element("rect x=\"5\" y=\"5\" width=\"10\" height=\"10\" fill=\"#7a5195\" sc:quad=\"200,160 270,165 280,205 190,200\"");
    svg.open("g sc:quad=\"240,260 300,255 310,300 235,305\"");
    svg.element("rect width=\"480\" height=\"360\" fill=\"#edae49\"");
    svg.element("circle cx=\"240\" cy=\"180\" r=\"160\" fill=\"#203040\"");
    svg.close("g");
    svg.finish()
}

const MATRIX3D: &str = r##"
<rect width="420" height="300" fill="#20303c"/>
<defs>
  <g id="board">
    <rect width="100" height="100" fill="#efe6d2"/>
    <path d="M0,0h25v25h-25z m50,0h25v25h-25z M25,25h25v25h-25z m50,0h25v25h-25z M0,50h25v25h-25z m50,0h25v25h-25z M25,75h25v25h-25z m50,0h25v25h-25z" fill="#8a4b3a"/>
  </g>
</defs>
<!-- an affine one, written with commas -->
<g transform="matrix3d(1,0.2,0,0, -0.3,1,0,0, 0,0,1,0, 50,20,0,1)"><use href="#board"/></g>
<!-- w grows to the right; w grows downwards; both -->
<g transform="matrix3d(1.6 0.1 0 0.006  0 1.1 0 0  0 0 1 0  170 25 0 1)"><use href="#board"/></g>
<g transform="translate(300 20) matrix3d(1.2 0 0 0  0.4 1.6 0 0.008  0 0 1 0  0 0 0 1)"><use href="#board"/></g>
<g style="transform: translate(60px, 170px) matrix3d(2, 0.3, 0, 0.004, 0.6, 1.6, 0, 0.006, 0, 0, 1, 0, 0, 0, 0, 1)"><use href="#board"/></g>
<g transform="translate(250 160)"><g transform="matrix3d(1 0 0 0.003 0 1 0 0 0 0 1 0 0 0 0 1)"><g transform="scale(1.3) rotate(10)"><use href="#board"/></g></g></g>
"##;

const CSS3D: &str = r##"
<rect width="480" height="320" fill="#f0ebe0"/>
<g transform="translate(100 90)"><g style="transform: perspective(300px) rotateY(50deg)">
  <image x="-80" y="-60" width="160" height="120" preserveAspectRatio="none" href="textures/brick.png"/>
  <circle r="40" fill="none" stroke="#ffffff" stroke-width="6"/>
</g></g>
<g transform="translate(260 90)"><g style="transform: perspective(300px) rotateX(-55deg)">
  <image x="-70" y="-70" width="140" height="140" href="textures/checker.png"/>
</g></g>
<g transform="translate(400 90)"><g style="transform: perspective(260px) rotate3d(1, 1, 0, 60deg) scale3d(1.2, 0.9, 1)">
  <image x="-50" y="-67" width="100" height="133" href="textures/portrait.png"/>
</g></g>
<g transform="translate(130 230)"><g style="transform: perspective(400px) translate3d(0, 0, 120px) rotateZ(-8deg)">
  <rect x="-60" y="-35" width="120" height="70" rx="14" fill="#00798c" stroke="#003d5b" stroke-width="5"/>
  <path d="M-40,10 l20,-25 l20,25 l20,-25 l20,25" fill="none" stroke="#ffffff" stroke-width="6" stroke-linejoin="round"/>
</g></g>
<g transform="translate(340 240)"><g style="transform: perspective(240px) rotateX(55deg) rotateZ(20deg)">
  <image x="-100" y="-50" width="200" height="100" href="textures/world.png"/>
</g></g>
"##;

/// A floor and a ceiling whose planes run on behind the eye.
fn behind() -> String {
    let mut svg = Svg::new(
        Profile::Svg,
        480,
        320,
        "behind: planes that reach behind the eye (w ≤ 0); what lies there is cut off, not folded over",
    );
    svg.texture("tile", "repeat");
    svg.element("rect width=\"480\" height=\"320\" fill=\"#b8c9d4\"");
    let square = [(-40.0, -20.0), (40.0, -20.0), (40.0, 60.0), (-40.0, 60.0)];
    let planes = [("the floor", 300.0, "#28536b"), ("the ceiling", -260.0, "#c8553d")];
    for (what, height, color) in planes {
        svg.line(&format!("<!-- {what}: z from -20 behind the eye to 60 before it -->"));
        svg.open(&format!(
            "g transform=\"matrix3d(300 0 0 0  240 150 0 1  0 0 1 0  0 {} 0 0)\"",
            number(height, 0)
        ));
        if height > 0.0 {
            svg.texquad(&square, &square, "tile");
        } else {
            svg.polygon(&square, &format!("fill=\"{color}\""));
            for i in -20..=20 {
                svg.element(&format!(
                    "path d=\"M{0},-20 L{0},60\" fill=\"none\" stroke=\"#f3efe6\" stroke-width=\"0.06\"",
                    i * 2
                ));
            }
        }
        svg.element("circle cx=\"1.5\" cy=\"2\" r=\"3\" fill=\"#f2c14e\" fill-opacity=\"0.6\"");
        svg.close("g");
    }
    svg.finish()
}

fn wrap() -> String {
    let mut svg = Svg::new(
        Profile::Svg,
        480,
        180,
        "sc:wrap on a texture: what lies beyond the unit square of its uvs. clamp (the default), \
         repeat, mirror; the uvs here run from -0.75 to 1.75",
    );
    let modes = ["clamp", "repeat", "mirror"];
    for mode in modes {
        svg.element(&format!(
            "texture filename=\"textures/checker.png\" texid=\"{mode}\" sc:wrap=\"{mode}\""
        ));
    }
    for (i, mode) in modes.iter().enumerate() {
        let x = 15.0 + 155.0 * i as f64;
        let corners = [(x, 20.0), (x + 140.0, 20.0), (x + 140.0, 160.0), (x, 160.0)];
        let uvs = [(-0.75, -0.75), (1.75, -0.75), (1.75, 1.75), (-0.75, 1.75)];
        svg.texquad(&corners, &uvs, mode);
    }
    svg.finish()
}

fn colortri() -> String {
    let mut svg = Svg::new(
        Profile::Svg,
        420,
        300,
        "colortri among ordinary SVG: under a transform, in a group's opacity, under a homography",
    );
    let (r, g, b) = ([1.0, 0.1, 0.1, 1.0], [0.1, 0.8, 0.2, 1.0], [0.1, 0.2, 1.0, 1.0]);
    svg.element("rect width=\"420\" height=\"300\" fill=\"#f6f2e8\"");
    svg.colortri(&[(20.0, 130.0), (80.0, 15.0), (140.0, 130.0)], &[r, g, b]);
    svg.open("g transform=\"translate(220 75) rotate(35) scale(1.3 .8)\" opacity=\"0.6\"");
    svg.colortri(&[(-60.0, 40.0), (0.0, -50.0), (60.0, 40.0)], &[r, g, b]);
    svg.element("circle r=\"25\" fill=\"#222222\"");
    svg.close("g");
    svg.line("<!-- straight alpha is multiplied in before it is blended -->");
    let clear = |c: [f64; 4]| [c[0], c[1], c[2], 0.0];
    svg.element("rect x=\"290\" y=\"60\" width=\"110\" height=\"20\" fill=\"#222222\"");
    svg.colortri(&[(290.0, 130.0), (345.0, 15.0), (400.0, 130.0)], &[r, clear(g), b]);
    svg.line("<!-- under a homography the colours follow the perspective -->");
    svg.open("g sc:box=\"0 0 1 1\" sc:quad=\"150,150 270,150 400,290 20,290\"");
    let n = 8;
    for i in 0..n {
        let at = |k: i32| f64::from(k) / f64::from(n);
        let grey = |k: i32| if k % 2 == 0 { [0.1, 0.2, 0.3, 1.0] } else { [0.95, 0.8, 0.4, 1.0] };
        let (top, low) = ((at(i), at(i + 1)), (grey(i), grey(i + 1)));
        svg.colortri(&[(0.0, top.0), (1.0, top.0), (0.0, top.1)], &[low.0, low.0, low.1]);
        svg.colortri(&[(1.0, top.0), (1.0, top.1), (0.0, top.1)], &[low.0, low.1, low.1]);
    }
    svg.close("g");
    svg.finish()
}

fn textri() -> String {
    let mut svg = Svg::new(
        Profile::Svg,
        420,
        300,
        "textri among ordinary SVG: the unit square of the uvs spans the image edge to edge",
    );
    svg.element("rect width=\"420\" height=\"300\" fill=\"#28333b\"");
    for name in ["world", "chart", "noise"] {
        svg.texture(name, "clamp");
    }
    let unit = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    svg.texquad(&[(20.0, 20.0), (220.0, 20.0), (220.0, 120.0), (20.0, 120.0)], &unit, "world");
    svg.line("<!-- sheared: one map over both triangles -->");
    svg.texquad(&[(270.0, 20.0), (400.0, 40.0), (370.0, 150.0), (240.0, 130.0)], &unit, "chart");
    svg.line(
        "<!-- not a parallelogram: each triangle has a map of its own, and the diagonal shows -->",
    );
    svg.texquad(&[(60.0, 150.0), (160.0, 150.0), (230.0, 285.0), (10.0, 285.0)], &unit, "chart");
    svg.line("<!-- mirrored and magnified -->");
    svg.texquad(
        &[(260.0, 180.0), (330.0, 180.0), (330.0, 280.0), (260.0, 280.0)],
        &[(0.6, 0.2), (0.5, 0.2), (0.5, 0.4), (0.6, 0.4)],
        "world",
    );
    svg.open("g opacity=\"0.7\" transform=\"rotate(12 370 230)\"");
    svg.texquad(&[(345.0, 190.0), (405.0, 190.0), (405.0, 270.0), (345.0, 270.0)], &unit, "noise");
    svg.close("g");
    svg.finish()
}
