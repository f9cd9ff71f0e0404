//! What anybody means by SVG: shapes, paths, groups, transforms, views, opacity, style, images.

use super::Scene;
use crate::svg::{Profile, Svg, number};

/// Name, width, height, what it is about, and the body.
type Written = (&'static str, u32, u32, &'static str, &'static str);

const WRITTEN: [Written; 10] = [
    ("shapes", 400, 300, "rect, rounded rect, circle, ellipse, line, polyline, polygon", SHAPES),
    (
        "path_fill",
        420,
        220,
        "the two fill rules on the same outlines, shapes with holes",
        PATH_FILL,
    ),
    (
        "path_curves",
        420,
        300,
        "quadratic and cubic curves, smooth, relative, absolute",
        PATH_CURVES,
    ),
    ("use", 400, 300, "g, defs, use and symbol: one drawing in many places", USE),
    ("transform", 420, 300, "transforms nested, listed, about a centre, mirrored", TRANSFORM),
    ("opacity", 400, 300, "of fill, of stroke, and of a group, which is thinned as one", OPACITY),
    (
        "css",
        400,
        300,
        "attributes, a style sheet, style attributes, in rising order of weight",
        CSS,
    ),
    ("image_file", 420, 300, "pictures beside the file, shrunk and magnified", IMAGE_FILE),
    ("viewbox", 360, 240, "a nested view shows 10×10 units of its own, and clips", VIEWBOX),
    ("hidden", 300, 200, "display, visibility, none, zero sizes: the red must not show", HIDDEN),
];

pub(crate) fn all(data: &str) -> Vec<Scene> {
    let written = |&(name, width, height, about, body): &Written| {
        (name, plain(width, height, &format!("{name}: {about}"), body))
    };
    let mut scenes: Vec<Scene> = WRITTEN.iter().map(written).collect();
    let about = "path_arcs: elliptical arcs, all four of the flags, turned and squeezed";
    scenes.push(("path_arcs", plain(420, 300, about, &arcs())));
    let about = "aspect: preserveAspectRatio, one drawing in nine views";
    scenes.push(("aspect", plain(480, 330, about, &aspect())));
    let about = "image_data: a picture inside the file, turned, thinned and squeezed";
    scenes.push(("image_data", plain(400, 300, about, &IMAGE_DATA.replace("DATA", data))));
    scenes
}

/// A document whose body is written out by hand.
pub(super) fn plain(width: u32, height: u32, about: &str, body: &str) -> String {
    let mut svg = Svg::new(Profile::Svg, width, height, about);
    for line in body.trim_matches('\n').lines() {
        svg.line(line);
    }
    svg.finish()
}

const SHAPES: &str = r##"
<rect width="400" height="300" fill="#f3efe6"/>
<rect x="20" y="20" width="100" height="70" fill="#d1495b"/>
<rect x="140" y="20" width="100" height="70" rx="22" fill="#edae49"/>
<rect x="260" y="20" width="120" height="70" rx="50" ry="18" fill="#00798c" stroke="#003d5b" stroke-width="4"/>
<circle cx="65" cy="150" r="42" fill="#30638e"/>
<circle cx="65" cy="150" r="24.5" fill="none" stroke="#f3efe6" stroke-width="5"/>
<ellipse cx="190" cy="150" rx="58" ry="34" fill="#5f8f4e" stroke="#24402a" stroke-width="3"/>
<ellipse cx="190" cy="150" rx="8" ry="28" fill="#f3efe6"/>
<line x1="270" y1="115" x2="380" y2="185" stroke="#8a3ffc" stroke-width="7" stroke-linecap="round"/>
<line x1="270" y1="185" x2="380" y2="115" stroke="#1f1f1f"/>
<polyline points="20,270 50,215 80,262 110,222 140,270" fill="none" stroke="#d1495b" stroke-width="5" stroke-linejoin="round"/>
<polyline points="160 270 180 215 215 245 240 210 255 270" fill="#edae49" fill-opacity="0.6" stroke="#6b4a00" stroke-width="2"/>
<polygon points="330,205 345,240 383,243 354,267 363,292 330,277 297,292 306,267 277,243 315,240" fill="#003d5b"/>
"##;

const PATH_FILL: &str = r##"
<rect width="420" height="220" fill="#ffffff"/>
<!-- a star that crosses itself, nonzero and evenodd -->
<path d="M75,15 L116,141 L9,63 L141,63 L34,141 Z" fill="#c8553d"/>
<path d="M215,15 L256,141 L149,63 L281,63 L174,141 Z" fill="#c8553d" fill-rule="evenodd"/>
<!-- three rings: the middle one runs the other way -->
<path d="M290,20 H400 V140 H290 Z M305,35 V125 H385 V35 Z M320,50 H370 V110 H320 Z" fill="#28536b"/>
<!-- letters with holes; both spellings of a closed outline -->
<path d="M20,205 L45,155 L70,205 H58 L53,194 H37 L32,205 Z M41,186 H49 L45,176 Z" fill="#222222"/>
<path d="M85,155 h30 q14,0 14,13 q0,10 -8,12 q11,2 11,13 q0,12 -16,12 h-31 z m12,9 v11 h14 q6,0 6,-5.5 q0,-5.5 -6,-5.5 z m0,20 v12 h16 q7,0 7,-6 q0,-6 -7,-6 z" fill="#222222" fill-rule="evenodd"/>
<path d="M190,150 a28,28 0 1 0 0.01,0 z M190,164 a14,14 0 1 1 -0.01,0 z" fill="#6c9a8b"/>
<!-- an outline left open is filled as if closed -->
<path d="M240,205 L270,155 L300,205" fill="#e8a33d"/>
<path d="M320,205 C320,140 400,140 400,205 C400,160 320,160 320,205" fill="#7a5195"/>
"##;

const PATH_CURVES: &str = r##"
<rect width="420" height="300" fill="#fdf8ee"/>
<path d="M20,100 Q60,10 100,100 T180,100 T260,100 T340,100 T400,70" fill="none" stroke="#28536b" stroke-width="6"/>
<path d="M20,150 C60,60 100,240 140,150 S220,60 260,150 S340,240 400,130" fill="none" stroke="#c8553d" stroke-width="4"/>
<path d="m20 240c40-80 80-80 100-20s60 60 80 0 60-60 80 0 60 40 120 10" fill="none" stroke="#588b3a" stroke-width="3"/>
<!-- a cusp, a loop, a curve whose controls coincide with its ends -->
<path d="M30,290 C130,200 -30,200 70,290" fill="#e8a33d" stroke="#6b4a00" stroke-width="2"/>
<path d="M100,290 C240,190 60,190 200,290" fill="#7a5195" fill-opacity="0.7" stroke="#331a40" stroke-width="2"/>
<path d="M220,280 C220,280 300,280 300,280 C300,230 220,230 220,280" fill="#6c9a8b"/>
<path d="M330,290 q-30,-40 0,-60 q30,-20 40,10 q20,-30 30,0 q10,30 -70,50" fill="#d1495b"/>
"##;

fn arcs() -> String {
    let mut body = String::from("<rect width=\"420\" height=\"300\" fill=\"#eef3f4\"/>\n");
    let flags = [(0, 0, "#c8553d"), (0, 1, "#28536b"), (1, 0, "#588b3a"), (1, 1, "#e8a33d")];
    for (large, sweep, color) in flags {
        body += &format!(
            "<path d=\"M70,100 A60,36 0 {large} {sweep} 130,64\" fill=\"none\" stroke=\"{color}\" stroke-width=\"5\"/>\n"
        );
    }
    for i in 0..6 {
        let angle = i * 30;
        body += &format!(
            "<path d=\"M240,105 a46,16 {angle} 1 1 0.1,0\" fill=\"#7a5195\" fill-opacity=\"0.25\" stroke=\"#331a40\"/>\n"
        );
    }
    body += "<!-- radii too small are scaled up; a zero radius is a line -->\n";
    body += "<path d=\"M350,60 A5,5 0 0 1 410,60 Z\" fill=\"#d1495b\"/>\n";
    body += "<path d=\"M350,100 A0,20 0 0 1 410,130\" fill=\"none\" stroke=\"#222222\" stroke-width=\"3\"/>\n";
    body += "<!-- a pie from sectors, numbers run together as they may be -->\n";
    let colors = ["#d1495b", "#edae49", "#00798c", "#30638e", "#5f8f4e"];
    let shares = [0.30, 0.24, 0.19, 0.15, 0.12];
    let mut turn = -0.25;
    for (share, color) in shares.iter().zip(colors) {
        let a = crate::svg::polar(0.0, 0.0, 70.0, turn);
        turn += share;
        let b = crate::svg::polar(0.0, 0.0, 70.0, turn);
        let n = |v| number(v, 2);
        body += &format!(
            "<path transform=\"translate(110 215)\" d=\"M0,0L{} {}A70 70 0 01{} {}z\" fill=\"{color}\" stroke=\"#eef3f4\" stroke-width=\"2\"/>\n",
            n(a.0),
            n(a.1),
            n(b.0),
            n(b.1)
        );
    }
    body + "<path d=\"M220,220 a30,45 0 0 1 60,0 a30,45 0 0 0 60,0 a20,60 20 0 1 40,-20\" fill=\"none\" stroke=\"#00798c\" stroke-width=\"8\" stroke-linejoin=\"round\"/>"
}

const USE: &str = r##"
<rect width="400" height="300" fill="#dcebf2"/>
<defs>
  <g id="tree">
    <rect x="-4" y="-12" width="8" height="14" fill="#7a4f2a"/>
    <polygon points="0,-70 22,-30 -22,-30"/>
    <polygon points="0,-50 26,-10 -26,-10"/>
  </g>
  <symbol id="house" viewBox="0 0 100 100">
    <rect x="15" y="45" width="70" height="50" fill="#e9c46a"/>
    <polygon points="50,8 95,48 5,48" fill="#a4392b"/>
    <rect x="42" y="65" width="18" height="30" fill="#5b3a29"/>
    <rect x="22" y="56" width="14" height="14" fill="#ffffff" stroke="#5b3a29" stroke-width="2"/>
  </symbol>
  <circle id="flake" r="3" fill="#ffffff"/>
  <g id="flakes"><use href="#flake"/><use href="#flake" x="60" y="22"/><use href="#flake" x="24" y="48"/></g>
</defs>
<path d="M0,215 Q100,165 200,205 T400,190 V300 H0 Z" fill="#f7fafb"/>
<use href="#house" x="230" y="120" width="110" height="110"/>
<use href="#house" x="320" y="150" width="60" height="60"/>
<!-- the colour comes from the place of use -->
<use href="#tree" x="60" y="225" fill="#2f6b4f"/>
<use xlink:href="#tree" x="110" y="250" fill="#3f8f63"/>
<use href="#tree" transform="translate(165 270) scale(1.4)" fill="#24513c"/>
<use href="#tree" transform="translate(215 235) scale(0.7)" fill="#5aa27c"/>
<use href="#tree" transform="translate(370 285) rotate(12)" fill="#2f6b4f"/>
<use href="#flakes" x="20" y="20"/><use href="#flakes" x="120" y="45"/><use href="#flakes" x="220" y="15"/>
<use href="#flakes" x="310" y="60"/><use href="#flakes" x="60" y="95"/><use href="#flakes" x="180" y="105"/>
"##;

const TRANSFORM: &str = r##"
<rect width="420" height="300" fill="#faf5ec"/>
<defs>
  <g id="f">
    <path d="M0,0 H60 V16 H18 V34 H48 V50 H18 V90 H0 Z"/>
  </g>
</defs>
<use href="#f" x="20" y="20" fill="#28536b"/>
<use href="#f" transform="translate(180 20) scale(-1 1)" fill="#c8553d"/>
<use href="#f" transform="rotate(30 240 60) translate(210 15)" fill="#588b3a"/>
<use href="#f" transform="translate(330,20) skewX(-20)" fill="#7a5195"/>
<use href="#f" transform="matrix(.7 .3 -.2 .8 370 20)" fill="#e8a33d"/>
<g transform="translate(110 210)">
  <g transform="rotate(0)"><use href="#f" x="14" transform="scale(.8)" fill="#d1495b"/>
    <g transform="rotate(72)"><use href="#f" x="14" transform="scale(.8)" fill="#edae49"/>
      <g transform="rotate(72)"><use href="#f" x="14" transform="scale(.8)" fill="#00798c"/>
        <g transform="rotate(72)"><use href="#f" x="14" transform="scale(.8)" fill="#30638e"/>
          <g transform="rotate(72)"><use href="#f" x="14" transform="scale(.8)" fill="#5f8f4e"/></g>
        </g>
      </g>
    </g>
  </g>
</g>
<!-- a stroke takes part in the transform -->
<g fill="none" stroke="#222222" stroke-width="4">
  <circle r="20" transform="translate(250 200) scale(2 1)"/>
  <rect x="-20" y="-20" width="40" height="40" transform="translate(350 190) rotate(20) skewY(15) scale(1.2 .8)"/>
  <path d="M0,0 c20,-60 60,60 80,0" transform="translate(220 260) scale(2 .5)"/>
</g>
"##;

const VIEWBOX: &str = r##"
<rect width="360" height="240" fill="#1d2b38"/>
<svg x="20" y="20" width="200" height="200" viewBox="-5 -5 10 10">
  <circle r="5" fill="#f2c14e"/>
  <path d="M0,-4 L1,-1 L4,0 L1,1 L0,4 L-1,1 L-4,0 L-1,-1 Z" fill="#1d2b38"/>
  <circle r=".8" fill="#f78154"/>
</svg>
<svg x="240" y="20" width="100" height="90" viewBox="0 0 10 9">
  <!-- reaches over the right edge and is cut there -->
  <circle cx="10" cy="4.5" r="4" fill="#5fad56"/>
  <rect width="10" height="9" fill="none" stroke="#ffffff" stroke-width=".2"/>
</svg>
<svg x="240" y="130" width="100" height="90" viewBox="0 0 10 9" overflow="visible">
  <circle cx="9" cy="4.5" r="3" fill="#4d9078"/>
  <rect width="10" height="9" fill="none" stroke="#ffffff" stroke-width=".2"/>
</svg>
"##;

fn aspect() -> String {
    let ways = [
        "xMinYMin meet",
        "xMidYMid meet",
        "xMaxYMax meet",
        "xMinYMid slice",
        "xMidYMid slice",
        "xMaxYMid slice",
        "xMidYMin slice",
        "xMidYMax slice",
        "none",
    ];
    let mut body = String::from("<rect width=\"480\" height=\"330\" fill=\"#f3efe6\"/>\n");
    for (i, way) in ways.iter().enumerate() {
        let (x, y) = (15 + (i % 3) * 155, 15 + (i / 3) * 105);
        // The first and last rows are wide boxes, the middle ones tall enough for both cuts.
        let (w, h) = if i < 6 { (140, 90) } else { (60, 90) };
        body += &format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" fill=\"#ffffff\" stroke=\"#b9b19f\"/>\n\
             <svg x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 60 60\" preserveAspectRatio=\"{way}\">\n  \
               <rect width=\"60\" height=\"60\" fill=\"#9cc5a1\"/>\n  \
               <circle cx=\"30\" cy=\"30\" r=\"29\" fill=\"#49a078\"/>\n  \
               <path d=\"M18,22 h6 v6 h-6 z m18,0 h6 v6 h-6 z m-20,14 q14,14 28,0\" fill=\"#216869\"/>\n\
             </svg>\n"
        );
    }
    body
}

const OPACITY: &str = r##"
<rect width="400" height="300" fill="#ffffff"/>
<path d="M0,50 H400 M0,150 H400 M0,250 H400" stroke="#222222" stroke-width="12"/>
<g fill-opacity="0.5">
  <circle cx="60" cy="50" r="38" fill="#ff0000"/>
  <circle cx="95" cy="50" r="38" fill="#00a000"/>
  <circle cx="77" cy="80" r="38" fill="#0000ff"/>
</g>
<!-- the stroke straddles the edge, so half of it lies on the fill -->
<circle cx="200" cy="60" r="38" fill="#edae49" stroke="#003d5b" stroke-width="20" stroke-opacity="0.5"/>
<circle cx="320" cy="60" r="38" fill="#edae49" fill-opacity="0.5" stroke="#003d5b" stroke-width="20"/>
<!-- left: every circle thinned; right: the group thinned, its circles do not show through one another -->
<g>
  <circle cx="60" cy="170" r="40" fill="#d1495b" opacity="0.5"/>
  <circle cx="110" cy="170" r="40" fill="#00798c" opacity="0.5"/>
</g>
<g opacity="0.5">
  <circle cx="220" cy="170" r="40" fill="#d1495b"/>
  <circle cx="270" cy="170" r="40" fill="#00798c"/>
</g>
<g opacity="0.6">
  <g opacity="0.6"><rect x="330" y="130" width="50" height="50" fill="#5f8f4e"/></g>
  <rect x="350" y="160" width="40" height="40" fill="#30638e"/>
</g>
<!-- a stair of eleven steps -->
<g fill="#7a1f5c" transform="translate(15 230)">
  <rect width="33" height="50" fill-opacity="0"/><rect x="34" width="33" height="50" fill-opacity=".1"/>
  <rect x="68" width="33" height="50" fill-opacity=".2"/><rect x="102" width="33" height="50" fill-opacity=".3"/>
  <rect x="136" width="33" height="50" fill-opacity=".4"/><rect x="170" width="33" height="50" fill-opacity=".5"/>
  <rect x="204" width="33" height="50" fill-opacity=".6"/><rect x="238" width="33" height="50" fill-opacity=".7"/>
  <rect x="272" width="33" height="50" fill-opacity=".8"/><rect x="306" width="33" height="50" fill-opacity=".9"/>
  <rect x="340" width="33" height="50"/>
</g>
"##;

const CSS: &str = r##"
<style>
  rect { fill: #dde5e8 }
  .sail { fill: #ffffff; stroke: #33475b; stroke-width: 2 }
  .hull { fill: rgb(164, 57, 43) }
  .red { fill: crimson }
  #flag { fill: gold; stroke: none }
  g.fleet polygon { stroke-linejoin: round }
</style>
<rect width="400" height="300"/>
<path d="M0,230 q25,-14 50,0 t50,0 t50,0 t50,0 t50,0 t50,0 t50,0 t50,0 V300 H0 Z" style="fill:#3f7cac"/>
<g class="fleet">
  <polygon class="sail" points="110,40 110,190 40,190"/>
  <polygon class="sail red" points="122,70 122,190 175,190"/>
  <polygon class="hull" points="25,200 190,200 165,240 50,240"/>
  <polygon id="flag" class="sail" points="110,18 110,38 140,28"/>
  <line x1="113" y1="15" x2="113" y2="200" style="stroke:#5b3a29; stroke-width:5"/>
</g>
<g class="fleet" transform="translate(230 80) scale(.7)">
  <!-- the style attribute outweighs the sheet, the sheet the attribute -->
  <polygon class="sail" fill="#ff0000" style="fill:#f6d8ae" points="110,40 110,190 40,190"/>
  <polygon class="sail" points="122,70 122,190 175,190"/>
  <polygon class="hull" style="fill:#2e4057" points="25,200 190,200 165,240 50,240"/>
  <line x1="113" y1="25" x2="113" y2="200" stroke="#5b3a29" stroke-width="5"/>
</g>
<circle cx="330" cy="50" r="26" style="fill:hsl(42, 100%, 60%)"/>
<path d="M0,262 q25,-14 50,0 t50,0 t50,0 t50,0 t50,0 t50,0 t50,0 t50,0 V300 H0 Z" style="fill:#20639b; fill-opacity:.8"/>
"##;

const IMAGE_DATA: &str = r##"
<rect width="400" height="300" fill="#efe9dc"/>
<defs><image id="boat" width="96" height="96" href="DATA"/></defs>
<use href="#boat" x="15" y="15"/>
<use href="#boat" transform="rotate(20 180 60) translate(135 20)"/>
<use href="#boat" transform="translate(280 12) skewX(-15) scale(1 .8)"/>
<use href="#boat" x="20" y="130" opacity="0.4"/>
<use href="#boat" transform="translate(230 130) scale(-1 1)"/>
<use href="#boat" transform="translate(250 130) scale(.33)"/>
<use href="#boat" transform="translate(300 130) scale(.16)"/>
<use href="#boat" transform="translate(330 130) scale(.08)"/>
<use href="#boat" transform="translate(250 190) scale(1.4 .9)"/>
<!-- every second texel, so to speak: a row of thirty -->
<g transform="translate(15 250)">
  <use href="#boat" transform="scale(.3)"/><use href="#boat" transform="translate(32) scale(.3) rotate(3)"/>
  <use href="#boat" transform="translate(64) scale(.3) rotate(6)"/><use href="#boat" transform="translate(96) scale(.3) rotate(9)"/>
  <use href="#boat" transform="translate(128) scale(.3) rotate(12)"/><use href="#boat" transform="translate(160) scale(.3) rotate(15)"/>
</g>
"##;

const IMAGE_FILE: &str = r##"
<rect width="420" height="300" fill="#26323a"/>
<image x="15" y="15" width="192" height="256" href="textures/portrait.png"/>
<image x="220" y="15" width="185" height="92.5" xlink:href="textures/world.png"/>
<image x="220" y="120" width="80" height="80" href="textures/chart.png"/>
<!-- fitted into the box, then cut to it -->
<image x="310" y="120" width="95" height="80" href="textures/world.png" preserveAspectRatio="xMinYMid slice"/>
<image x="220" y="212" width="60" height="60" href="textures/noise.png" transform="rotate(10 250 242)"/>
<image x="290" y="212" width="60" height="60" href="textures/brick.png" opacity=".7"/>
<!-- without a size it takes its own -->
<image x="360" y="212" href="textures/tile.png" transform="translate(360 212) scale(.35) translate(-360 -212)"/>
"##;

const HIDDEN: &str = r##"
<rect width="300" height="200" fill="#e7f0e4"/>
<g display="none"><rect width="300" height="200" fill="red"/></g>
<rect x="20" y="20" width="260" height="160" fill="red" visibility="hidden"/>
<rect x="20" y="20" width="260" height="160" fill="none"/>
<rect x="20" y="20" width="0" height="160" fill="red"/>
<circle cx="150" cy="100" r="0" fill="red" stroke="red" stroke-width="20"/>
<rect x="20" y="20" width="260" height="160" fill="red" opacity="0"/>
<rect x="20" y="20" width="260" height="160" fill="red" fill-opacity="0"/>
<line x1="20" y1="20" x2="280" y2="180" stroke="red" stroke-width="0"/>
<polygon points="20,20 280,180" fill="red"/>
<path d="M20,20 L280,180 Z" fill="red"/>
<!-- visible within hidden shows -->
<g visibility="hidden"><circle cx="150" cy="100" r="60" fill="#4c956c" visibility="visible"/></g>
<path d="M120,100 l22,24 l42,-52" fill="none" stroke="#ffffff" stroke-width="12" stroke-linecap="round" stroke-linejoin="round"/>
"##;
