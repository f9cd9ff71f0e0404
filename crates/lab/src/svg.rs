//! Writing SVG by hand: numbers, points, and a document that indents itself.

/// A point, x right and y down.
pub(crate) type Point = (f64, f64);

/// An SVG document under construction.
pub(crate) struct Svg {
    text: String,
    depth: usize,
}

/// How a document is to be read.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Profile {
    /// SVG with the extension elements.
    Svg,
    /// The course's dialect: its view, margins and frame.
    Course,
}

impl Svg {
    /// An open document of the given size; `about` becomes the comment at its head.
    pub(crate) fn new(profile: Profile, width: u32, height: u32, about: &str) -> Self {
        let mut svg = Self { text: String::new(), depth: 0 };
        svg.line(&format!("<!-- {about} -->"));
        let spaces = "xmlns=\"http://www.w3.org/2000/svg\" \
                      xmlns:xlink=\"http://www.w3.org/1999/xlink\" \
                      xmlns:sc=\"https://scumble.rs/ns/1\"";
        let view = match profile {
            Profile::Svg => format!("viewBox=\"0 0 {width} {height}\""),
            Profile::Course => "sc:profile=\"course\"".to_owned(),
        };
        svg.open(&format!("svg {spaces} width=\"{width}\" height=\"{height}\" {view}"));
        svg
    }

    /// One line as it is.
    pub(crate) fn line(&mut self, text: &str) {
        for _ in 0..self.depth {
            self.text.push_str("  ");
        }
        self.text.push_str(text);
        self.text.push('\n');
    }

    /// An empty element: `<tag/>` with its attributes.
    pub(crate) fn element(&mut self, tag: &str) {
        self.line(&format!("<{tag}/>"));
    }

    /// An opening tag with its attributes; what follows is indented until [`Svg::close`].
    pub(crate) fn open(&mut self, tag: &str) {
        self.line(&format!("<{tag}>"));
        self.depth += 1;
    }

    /// Closes the element of that name.
    pub(crate) fn close(&mut self, name: &str) {
        self.depth -= 1;
        self.line(&format!("</{name}>"));
    }

    /// `<texture>` for one of our own textures, its name the id. `wrap` is `clamp`, `repeat` or
    /// `mirror`.
    pub(crate) fn texture(&mut self, name: &str, wrap: &str) {
        let wrap = if wrap == "clamp" { String::new() } else { format!(" sc:wrap=\"{wrap}\"") };
        self.element(&format!("texture filename=\"textures/{name}.png\" texid=\"{name}\"{wrap}"));
    }

    /// A filled polygon with further attributes.
    pub(crate) fn polygon(&mut self, corners: &[Point], attributes: &str) {
        self.element(&format!("polygon points=\"{}\" {attributes}", points(corners)));
    }

    /// A textured triangle.
    pub(crate) fn textri(&mut self, corners: &[Point; 3], uvs: &[Point; 3], texture: &str) {
        self.element(&format!(
            "textri points=\"{}\" uvs=\"{}\" texid=\"{texture}\"",
            points(corners),
            uv_list(uvs)
        ));
    }

    /// A textured quad as two triangles, corners clockwise from the top left of the texture.
    pub(crate) fn texquad(&mut self, corners: &[Point; 4], uvs: &[Point; 4], texture: &str) {
        for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
            let corner = [corners[a], corners[b], corners[c]];
            self.textri(&corner, &[uvs[a], uvs[b], uvs[c]], texture);
        }
    }

    /// A triangle with a colour at each corner, blended between.
    pub(crate) fn colortri(&mut self, corners: &[Point; 3], colors: &[[f64; 4]; 3]) {
        let flat: Vec<String> = colors.iter().map(|c| c.map(|v| number(v, 3)).join(" ")).collect();
        self.element(&format!(
            "colortri points=\"{}\" colors=\"{}\"",
            points(corners),
            flat.join("  ")
        ));
    }

    /// The finished text.
    pub(crate) fn finish(mut self) -> String {
        self.close("svg");
        self.text
    }
}

/// A number with at most `digits` decimals and no trailing zeros.
pub(crate) fn number(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// `x,y x,y …` to a hundredth of a pixel.
pub(crate) fn points(list: &[Point]) -> String {
    pairs(list, 2)
}

/// `u,v u,v …` to a hundred-thousandth.
fn uv_list(list: &[Point]) -> String {
    pairs(list, 5)
}

fn pairs(list: &[Point], digits: usize) -> String {
    let one = |&(x, y): &Point| format!("{},{}", number(x, digits), number(y, digits));
    list.iter().map(one).collect::<Vec<_>>().join(" ")
}

/// `#rrggbb` of a colour in 0…1.
pub(crate) fn css(color: [f64; 3]) -> String {
    let [r, g, b] = color.map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5).floor() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A saturated colour of the wheel, `turn` in turns from red over green and blue.
pub(crate) fn hue(turn: f64) -> [f64; 3] {
    [0.0, 2.0, 4.0].map(|offset: f64| {
        let t = (turn * 6.0 - offset).rem_euclid(6.0);
        // Distance from this channel's own peak, in sixths of the wheel.
        let d = t.min(6.0 - t);
        (2.0 - d).clamp(0.0, 1.0)
    })
}

/// Bytes as base64 with padding (RFC 4648, section 4).
pub(crate) fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let at = |i: usize| u32::from(chunk.get(i).copied().unwrap_or(0));
        let word = at(0) << 16 | at(1) << 8 | at(2);
        for k in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * k)) as usize & 63] as char;
            out.push(if k <= chunk.len() as u32 { digit } else { '=' });
        }
    }
    out
}

/// n points of a regular polygon, the first at `phase` turns from the +x axis, clockwise.
pub(crate) fn regular(n: u32, cx: f64, cy: f64, radius: f64, phase: f64) -> Vec<Point> {
    (0..n).map(|i| polar(cx, cy, radius, phase + f64::from(i) / f64::from(n))).collect()
}

/// The point at `turn` turns clockwise from the +x axis, `radius` away from (cx, cy).
pub(crate) fn polar(cx: f64, cy: f64, radius: f64, turn: f64) -> Point {
    let angle = turn * std::f64::consts::TAU;
    (cx + radius * crate::math::cos(angle), cy + radius * crate::math::sin(angle))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(number(1.0, 3), "1");
        assert_eq!(number(-0.0001, 3), "0");
        assert_eq!(number(100.0, 0), "100");
        assert_eq!(number(2.53, 3), "2.53");
    }

    #[test]
    fn base64_follows_the_rfc() {
        let pairs =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")];
        for (plain, coded) in pairs {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn the_wheel_has_its_primaries() {
        assert_eq!(hue(0.0), [1.0, 0.0, 0.0]);
        assert_eq!(hue(1.0 / 3.0), [0.0, 1.0, 0.0]);
        assert_eq!(hue(2.0 / 3.0), [0.0, 0.0, 1.0]);
        assert_eq!(hue(0.5), [0.0, 1.0, 1.0]);
    }
}
