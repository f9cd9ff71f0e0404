//! Strokes: width, join, cap, dash.

use super::Scene;
use super::ordinary::plain;
use crate::svg::number;

pub(crate) fn all() -> Vec<Scene> {
    vec![
        (
            "stroke_width",
            plain(400, 300, "stroke-width: from a tenth of a pixel to thirty", &widths()),
        ),
        (
            "stroke_join",
            plain(420, 300, "stroke-linejoin and stroke-miterlimit over falling angles", &joins()),
        ),
        (
            "stroke_cap",
            plain(
                400,
                240,
                "stroke-linecap: butt, round, square, and on chains of no length",
                CAPS,
            ),
        ),
        ("stroke_dash", plain(400, 300, "stroke-dasharray and stroke-dashoffset", DASHES)),
    ]
}

fn widths() -> String {
    let mut body = String::from("<rect width=\"400\" height=\"300\" fill=\"#fbfaf6\"/>\n");
    let widths = [0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 9.0, 14.0, 20.0];
    let mut x = 14.0;
    for w in widths {
        let path = format!("M{0},20 l6,70 q8,40 -6,80", number(x, 2));
        body += &format!(
            "<path d=\"{path}\" fill=\"none\" stroke=\"#28536b\" stroke-width=\"{w}\"/>\n"
        );
        x += 18.0 + w;
    }
    body += "<circle cx=\"330\" cy=\"80\" r=\"40\" fill=\"#f2c14e\" stroke=\"#c8553d\" stroke-width=\"30\"/>\n";
    body += "<!-- wider than the shape: the middle is closed -->\n";
    body += "<circle cx=\"345\" cy=\"185\" r=\"8\" fill=\"none\" stroke=\"#588b3a\" stroke-width=\"30\"/>\n";
    for i in 0..24 {
        let y = 195.0 + f64::from(i) * 4.0;
        let width = number(0.15 + 0.1 * f64::from(i), 2);
        body += &format!(
            "<path d=\"M15,{0} L300,{1}\" stroke=\"#331a40\" stroke-width=\"{width}\"/>\n",
            number(y, 1),
            number(y + 3.0, 1)
        );
    }
    body
}

fn joins() -> String {
    let mut body = String::from("<rect width=\"420\" height=\"300\" fill=\"#f3efe6\"/>\n");
    let joins = [("miter", "#28536b"), ("round", "#c8553d"), ("bevel", "#588b3a")];
    for (row, (join, color)) in joins.iter().enumerate() {
        for column in 0..6 {
            let (x, y) = (22.0 + 66.0 * f64::from(column), 28.0 + 88.0 * row as f64);
            let spread = number(26.0 - 4.6 * f64::from(column), 2);
            let limit = if column == 5 { " stroke-miterlimit=\"20\"" } else { "" };
            body += &format!(
                "<path d=\"M{x},{} l{spread},-44 l{spread},44\" fill=\"none\" stroke=\"{color}\" stroke-width=\"12\" stroke-linejoin=\"{join}\"{limit}/>\n",
                y + 50.0
            );
        }
    }
    body + "<path d=\"M20,285 h60 h-30 M110,275 c60,-20 60,30 0,10 z M200,290 l40,-20 l40,20 z M310,270 l45,0 l-45,20 l45,0 z\" fill=\"none\" stroke=\"#331a40\" stroke-width=\"6\" stroke-linejoin=\"round\"/>"
}

const CAPS: &str = r##"
<rect width="400" height="240" fill="#fbfaf6"/>
<g stroke="#00798c" stroke-width="22" fill="none">
  <path d="M40,40 H220" stroke-linecap="butt"/>
  <path d="M40,85 H220" stroke-linecap="round"/>
  <path d="M40,130 H220" stroke-linecap="square"/>
  <path d="M250,140 L300,40 L350,140" stroke-linecap="round" stroke-linejoin="round"/>
</g>
<path d="M40,40 H220 M40,85 H220 M40,130 H220 M250,140 L300,40 L350,140" stroke="#ffffff" fill="none"/>
<!-- no length: nothing with butt, a disc with round, a square with square -->
<g stroke="#d1495b" stroke-width="26">
  <path d="M60,195 h0" stroke-linecap="butt"/>
  <path d="M130,195 h0" stroke-linecap="round"/>
  <path d="M200,195 h0" stroke-linecap="square"/>
  <path d="M270,195 z" stroke-linecap="round"/>
  <path d="M325,180 L365,210" stroke-linecap="square" stroke-width="14"/>
</g>
"##;

const DASHES: &str = r##"
<rect width="400" height="300" fill="#fdf8ee"/>
<g fill="none" stroke="#28536b" stroke-width="5">
  <path d="M20,25 H380" stroke-dasharray="20 10"/>
  <path d="M20,45 H380" stroke-dasharray="20 10" stroke-dashoffset="10"/>
  <path d="M20,65 H380" stroke-dasharray="20 10" stroke-dashoffset="-5"/>
  <path d="M20,85 H380" stroke-dasharray="12"/>
  <path d="M20,105 H380" stroke-dasharray="24 6 4"/>
  <path d="M20,125 H380" stroke-dasharray="0 12" stroke-linecap="round" stroke-width="8"/>
  <path d="M20,145 H380" stroke-dasharray="1 3" stroke-width="2"/>
</g>
<circle cx="80" cy="225" r="50" fill="#f2c14e" stroke="#c8553d" stroke-width="10" stroke-dasharray="15.708"/>
<rect x="160" y="175" width="100" height="100" rx="20" fill="none" stroke="#588b3a" stroke-width="6" stroke-dasharray="18 8 4 8" stroke-linecap="square"/>
<path d="M280,275 C300,120 360,330 385,180" fill="none" stroke="#7a5195" stroke-width="9" stroke-dasharray="3 13" stroke-linecap="round"/>
<!-- one dash longer than the path, and a pattern of zeros: both solid -->
<path d="M20,288 H190" stroke="#222222" stroke-dasharray="1000"/>
<path d="M210,288 H380" stroke="#222222" stroke-dasharray="0 0"/>
"##;
