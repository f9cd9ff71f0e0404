//! `transform` lists: SVG's functions in SVG's spelling, CSS's two- and three-dimensional ones in
//! CSS's.

use crate::matrix4::Matrix4;
use crate::numbers::Cursor;
use scumble_geometry::{Affine, Homography};

/// Most arguments that a function takes: `matrix3d`.
const MAX_ARGUMENTS: usize = 16;

/// The map that a `transform` list makes, left to right, composed in space and then restricted to
/// the plane z = 0; or what is wrong with it, in words.
pub(crate) fn parse(text: &str) -> Result<Homography, String> {
    if text.trim().eq_ignore_ascii_case("none") {
        return Ok(Homography::IDENTITY);
    }
    let mut cursor = Cursor::new(text);
    let mut product = Matrix4::IDENTITY;
    loop {
        cursor.skip_separators();
        if cursor.rest.is_empty() {
            break;
        }
        product = product * parse_function(&mut cursor)?;
    }
    let map = product.restrict();
    if map.is_finite() { Ok(map) } else { Err("its numbers are too large".into()) }
}

/// A number with its unit, which is empty for a plain number.
#[derive(Debug, Clone, Copy, Default)]
struct Argument<'a> {
    number: f64,
    unit: &'a str,
}

/// `name(argument, …)`.
fn parse_function(cursor: &mut Cursor<'_>) -> Result<Matrix4, String> {
    let start = cursor.rest;
    let name = cursor.take_while(|c| c.is_ascii_alphanumeric());
    cursor.skip_spaces();
    if name.is_empty() || !cursor.eat("(") {
        return Err(format!("`{}` is not a function", excerpt(start)));
    }
    let mut arguments = [Argument::default(); MAX_ARGUMENTS];
    let mut count = 0;
    loop {
        cursor.skip_separators();
        if cursor.rest.is_empty() {
            return Err(format!("`{}(` is not closed", excerpt(name)));
        }
        if cursor.eat(")") {
            break;
        }
        if count == MAX_ARGUMENTS {
            return Err(format!("`{}` has too many arguments", excerpt(name)));
        }
        arguments[count] = parse_argument(cursor, name)?;
        count += 1;
    }
    Call { name, arguments: &arguments[..count] }.matrix()
}

fn parse_argument<'a>(cursor: &mut Cursor<'a>, function: &str) -> Result<Argument<'a>, String> {
    if function.eq_ignore_ascii_case("perspective") && cursor.eat("none") {
        return Ok(Argument { number: f64::INFINITY, unit: "" });
    }
    let not_a_number = || format!("`{}` has an argument that is not a number", excerpt(function));
    let number = cursor.number().ok_or_else(not_a_number)?;
    let unit = cursor.take_while(|c| c.is_ascii_alphabetic() || c == '%');
    Ok(Argument { number, unit })
}

/// The start of a text, for a message.
fn excerpt(text: &str) -> String {
    text.chars().take(16).collect()
}

struct Call<'a> {
    name: &'a str,
    arguments: &'a [Argument<'a>],
}

impl Call<'_> {
    fn matrix(&self) -> Result<Matrix4, String> {
        let n = self.arguments.len();
        match (self.name.to_ascii_lowercase().as_str(), n) {
            ("matrix", 6) => {
                let [a, b, c, d] = self.numbers()?;
                Ok(Affine::new(a, b, c, d, self.length(4)?, self.length(5)?).into())
            }
            ("matrix3d", 16) => Ok(Matrix4::from_columns(&self.numbers()?)),
            ("translate", 1) | ("translatex", 1) => self.translation([Some(0), None, None]),
            ("translate", 2) => self.translation([Some(0), Some(1), None]),
            ("translatey", 1) => self.translation([None, Some(0), None]),
            ("translatez", 1) => self.translation([None, None, Some(0)]),
            ("translate3d", 3) => self.translation([Some(0), Some(1), Some(2)]),
            ("scale", 1) => self.number(0).map(|s| Matrix4::scale(s, s, 1.0)),
            ("scale", 2) => self.numbers().map(|[x, y]| Matrix4::scale(x, y, 1.0)),
            ("scalex", 1) => self.number(0).map(|s| Matrix4::scale(s, 1.0, 1.0)),
            ("scaley", 1) => self.number(0).map(|s| Matrix4::scale(1.0, s, 1.0)),
            ("scalez", 1) => self.number(0).map(|s| Matrix4::scale(1.0, 1.0, s)),
            ("scale3d", 3) => self.numbers().map(|[x, y, z]| Matrix4::scale(x, y, z)),
            ("rotate", 1) | ("rotatez", 1) => self.rotation(0.0, 0.0, 1.0),
            ("rotatex", 1) => self.rotation(1.0, 0.0, 0.0),
            ("rotatey", 1) => self.rotation(0.0, 1.0, 0.0),
            ("rotate", 3) => {
                let (x, y) = (self.length(1)?, self.length(2)?);
                Ok(Matrix4::translate(x, y, 0.0)
                    * self.rotation(0.0, 0.0, 1.0)?
                    * Matrix4::translate(-x, -y, 0.0))
            }
            ("rotate3d", 4) => {
                let [x, y, z] = self.numbers()?;
                Ok(Matrix4::rotate(x, y, z, self.angle(3)?))
            }
            ("skewx", 1) | ("skew", 1) => Ok(Matrix4::skew(self.angle(0)?, 0.0)),
            ("skewy", 1) => Ok(Matrix4::skew(0.0, self.angle(0)?)),
            ("skew", 2) => Ok(Matrix4::skew(self.angle(0)?, self.angle(1)?)),
            ("perspective", 1) => self.length(0).map(Matrix4::perspective),
            _ => Err(format!("`{}` with {n} arguments is not known", excerpt(self.name))),
        }
    }

    /// The first N arguments as plain numbers.
    fn numbers<const N: usize>(&self) -> Result<[f64; N], String> {
        let mut out = [0.0; N];
        for (i, slot) in out.iter_mut().enumerate() {
            *slot = self.number(i)?;
        }
        Ok(out)
    }

    fn number(&self, i: usize) -> Result<f64, String> {
        match self.arguments[i] {
            Argument { number, unit: "" } => Ok(number),
            Argument { number, unit: "%" } if !self.name.starts_with("matrix") => {
                Ok(number / 100.0)
            }
            Argument { unit, .. } => Err(self.bad_unit(unit)),
        }
    }

    /// A length in user units.
    fn length(&self, i: usize) -> Result<f64, String> {
        let Argument { number, unit } = self.arguments[i];
        let scale = match unit {
            "" | "px" => 1.0,
            "in" => 96.0,
            "cm" => 96.0 / 2.54,
            "mm" => 96.0 / 25.4,
            "Q" | "q" => 96.0 / 101.6,
            "pt" => 96.0 / 72.0,
            "pc" => 16.0,
            _ => return Err(self.bad_unit(unit)),
        };
        Ok(number * scale)
    }

    /// An angle in degrees.
    fn angle(&self, i: usize) -> Result<f64, String> {
        let Argument { number, unit } = self.arguments[i];
        let scale = match unit {
            "" | "deg" => 1.0,
            "rad" => 180.0 / core::f64::consts::PI,
            "grad" => 0.9,
            "turn" => 360.0,
            _ => return Err(self.bad_unit(unit)),
        };
        Ok(number * scale)
    }

    fn translation(&self, axes: [Option<usize>; 3]) -> Result<Matrix4, String> {
        let mut by = [0.0; 3];
        for (slot, axis) in by.iter_mut().zip(axes) {
            if let Some(i) = axis {
                *slot = self.length(i)?;
            }
        }
        Ok(Matrix4::translate(by[0], by[1], by[2]))
    }

    fn rotation(&self, x: f64, y: f64, z: f64) -> Result<Matrix4, String> {
        Ok(Matrix4::rotate(x, y, z, self.angle(0)?))
    }

    fn bad_unit(&self, unit: &str) -> String {
        format!("`{}` has an argument in `{}`", excerpt(self.name), excerpt(unit))
    }
}

#[cfg(test)]
mod tests;
