use super::{Frame, component, side};
use scumble_geometry::{Cap, DVec2, FillRule, Homography, Join, Path, StrokeStyle};
use scumble_pixel::Straight;
use scumble_scene::{Command, Fill, Scene, Stroke, View};
use std::sync::Arc;

/// Reads a display list.
///
/// # Errors
/// One line that says which line of the text is wrong, and why.
pub fn parse(text: &str) -> Result<Frame, String> {
    let mut list = List::default();
    for (number, line) in (1..).zip(text.lines()) {
        list.line(line).map_err(|message| format!("line {number}: {message}"))?;
    }
    list.finish()
}

/// How the path that is being read is painted.
enum Painter {
    Fill(FillRule),
    Stroke(StrokeStyle),
}

#[derive(Default)]
struct List {
    size: Option<(u32, u32)>,
    background: Option<Straight>,
    /// The path that no `.` has ended yet.
    open: Option<(Painter, Straight, Path)>,
    commands: Vec<Command>,
}

impl List {
    fn line(&mut self, line: &str) -> Result<(), String> {
        let mut words = line.split_ascii_whitespace();
        let Some(step) = words.next() else { return Ok(()) };
        let words: Vec<&str> = words.collect();
        match step {
            "size" => {
                let [width, height] = numbers(&words)?;
                self.size = Some((side(width, "the width")?, side(height, "the height")?));
            }
            "bg" => self.background = Some(color(numbers(&words)?)?),
            "f" | "s" => self.begin(step == "s", &words)?,
            "M" | "L" | "C" | "Z" => self.step(step, &words)?,
            "." => {
                let Some(open) = self.open.take() else { return Err("no path to end".into()) };
                self.commands.push(command(open));
            }
            other => return Err(format!("unknown step {other:?}")),
        }
        Ok(())
    }

    fn begin(&mut self, stroked: bool, words: &[&str]) -> Result<(), String> {
        if self.open.is_some() {
            return Err("the path before has no end".into());
        }
        let (rgba, rest) = words.split_at_checked(4).ok_or("a paint begins with four numbers")?;
        let painter = if stroked {
            Painter::Stroke(style(numbers(rest)?)?)
        } else {
            match rest {
                ["nz"] => Painter::Fill(FillRule::NonZero),
                ["eo"] => Painter::Fill(FillRule::EvenOdd),
                _ => return Err("a fill ends with nz or eo".into()),
            }
        };
        self.open = Some((painter, color(numbers(rgba)?)?, Path::new()));
        Ok(())
    }

    fn step(&mut self, step: &str, words: &[&str]) -> Result<(), String> {
        let Some((_, _, path)) = &mut self.open else {
            return Err(format!("{step} outside a path"));
        };
        if step != "M" && path.elements().is_empty() {
            return Err("a path begins with M".into());
        }
        match step {
            "M" => path.move_to(point(numbers(words)?)),
            "L" => path.line_to(point(numbers(words)?)),
            "C" => {
                let [x1, y1, x2, y2, x, y] = numbers(words)?;
                path.cubic_to(point([x1, y1]), point([x2, y2]), point([x, y]))
            }
            _ => {
                let [] = numbers(words)?;
                path.close()
            }
        };
        Ok(())
    }

    fn finish(self) -> Result<Frame, String> {
        if self.open.is_some() {
            return Err("the last path has no end".into());
        }
        let (width, height) = self.size.ok_or("it has no size")?;
        let size = DVec2::new(f64::from(width), f64::from(height));
        let scene = Scene {
            view: View::Fit { size },
            background: self.background,
            images: Vec::new(),
            commands: self.commands,
        };
        Ok(Frame { width, height, scene })
    }
}

fn command((painter, color, path): (Painter, Straight, Path)) -> Command {
    let (path, transform) = (Arc::new(path), Homography::IDENTITY);
    match painter {
        Painter::Fill(rule) => Command::Fill(Fill { path, rule, transform, color }),
        Painter::Stroke(style) => Command::Stroke(Stroke { path, style, transform, color }),
    }
}

fn style([width, cap, join, miter_limit]: [f64; 4]) -> Result<StrokeStyle, String> {
    let cap = match cap {
        0.0 => Cap::Butt,
        1.0 => Cap::Round,
        2.0 => Cap::Square,
        _ => return Err(format!("no cap {cap}: 0, 1 and 2 are")),
    };
    let join = match join {
        0.0 => Join::Miter,
        1.0 => Join::Round,
        2.0 => Join::Bevel,
        _ => return Err(format!("no join {join}: 0, 1 and 2 are")),
    };
    Ok(StrokeStyle { width, join, cap, miter_limit, ..StrokeStyle::default() })
}

fn point([x, y]: [f64; 2]) -> DVec2 {
    DVec2::new(x, y)
}

fn color(rgba: [f64; 4]) -> Result<Straight, String> {
    let [r, g, b, a] = rgba.map(component);
    Ok(Straight([r?, g?, b?, a?]))
}

/// Exactly `N` finite numbers.
fn numbers<const N: usize>(words: &[&str]) -> Result<[f64; N], String> {
    let words: [&str; N] =
        words.try_into().map_err(|_| format!("{N} numbers belong here, not {}", words.len()))?;
    let mut numbers = [0.0; N];
    for (number, word) in numbers.iter_mut().zip(words) {
        *number = match word.parse::<f64>() {
            Ok(value) if value.is_finite() => value,
            _ => return Err(format!("{word:?} is not a number")),
        };
    }
    Ok(numbers)
}
