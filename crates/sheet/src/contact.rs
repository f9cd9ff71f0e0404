use crate::font::{CAPITALS, text_width};
use crate::{Anchor, Drawing, INK};
use scumble_geometry::DVec2;
use scumble_pixel::Image;

/// Pixels around and between the cells.
const GAP: u32 = 12;
/// Size of the words.
const TEXT: u32 = 14;
/// Pixels from line to line.
const LINE: u32 = 17;
/// Pixels between a picture and its words.
const SPACE: u32 = 6;

/// A picture and the lines under it.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// The picture.
    pub picture: Image<[u8; 4]>,
    /// Lines of text, in order.
    pub lines: Vec<String>,
}

impl Cell {
    /// A picture with lines under it.
    pub fn new<S: Into<String>>(
        picture: Image<[u8; 4]>,
        lines: impl IntoIterator<Item = S>,
    ) -> Self {
        Self { picture, lines: lines.into_iter().map(Into::into).collect() }
    }
}

/// Cells side by side, `columns` to a row, each pixel of their pictures a square of `scale` pixels.
///
/// Every column is as wide as its widest picture or line, every row as high as its highest cell.
/// 0 columns and a scale of 0 count as 1.
#[must_use]
pub fn contact_sheet(cells: &[Cell], columns: usize, scale: u32) -> Drawing {
    let (columns, scale) = (columns.clamp(1, cells.len().max(1)), scale.max(1));
    let size = |length: usize| u32::try_from(length).unwrap_or(u32::MAX).saturating_mul(scale);
    let width = |cell: &Cell| {
        let line = |line: &String| text_width(line, f64::from(TEXT)).ceil() as u32;
        cell.lines.iter().map(line).max().unwrap_or(0).max(size(cell.picture.width()))
    };
    let words = |cell: &Cell| match u32::try_from(cell.lines.len()) {
        Ok(lines @ 1..) => SPACE + LINE * lines,
        _ => 0,
    };
    let most = |cells: &mut dyn Iterator<Item = u32>| cells.max().unwrap_or(0);
    let rows: Vec<&[Cell]> = cells.chunks(columns).collect();
    let widths: Vec<u32> = (0..columns)
        .map(|c| most(&mut rows.iter().filter_map(|row| row.get(c)).map(width)))
        .collect();
    let heights: Vec<u32> = rows
        .iter()
        .map(|row| most(&mut row.iter().map(|cell| size(cell.picture.height()) + words(cell))))
        .collect();
    let total = |sizes: &[u32]| sizes.iter().fold(GAP, |sum, size| sum.saturating_add(size + GAP));
    let mut drawing = Drawing::new(total(&widths), total(&heights));
    let mut y = GAP;
    for (row, height) in rows.iter().zip(&heights) {
        let mut x = GAP;
        for (cell, width) in row.iter().zip(&widths) {
            place(&mut drawing, cell, [x, y], scale);
            x += width + GAP;
        }
        y += height + GAP;
    }
    drawing
}

fn place(drawing: &mut Drawing, cell: &Cell, [x, y]: [u32; 2], scale: u32) {
    let below = y + scale * u32::try_from(cell.picture.height()).unwrap_or(0) + SPACE;
    drawing.picture(cell.picture.clone(), x, y, scale);
    // The baseline: capitals are 14 of the 20 units of a line.
    let capitals = f64::from(TEXT) * CAPITALS / 20.0;
    let mut baseline = f64::from(below) + capitals;
    for line in &cell.lines {
        let at = DVec2::new(f64::from(x), baseline);
        drawing.text(at, f64::from(TEXT), Anchor::Start, line, INK);
        baseline += f64::from(LINE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cell(width: usize, height: usize, lines: &[&str]) -> Cell {
        Cell::new(Image::filled(width, height, [7; 4]).unwrap(), lines.iter().copied())
    }

    #[test]
    fn a_sheet_is_as_large_as_what_is_on_it() {
        let cells = [cell(100, 40, &["a"]), cell(80, 60, &["b", "c"]), cell(30, 20, &[])];
        let sheet = contact_sheet(&cells, 2, 1);
        assert_eq!(sheet.width(), 3 * GAP + 100 + 80);
        assert_eq!(sheet.height(), 3 * GAP + 60 + SPACE + 2 * LINE + 20);
        let twice = contact_sheet(&cells, 2, 2);
        assert_eq!(twice.width(), 3 * GAP + 200 + 160);
    }

    #[test]
    fn long_lines_make_room() {
        let words = "a line that is longer than its picture is wide";
        let sheet = contact_sheet(&[cell(10, 10, &[words])], 5, 1);
        assert!(f64::from(sheet.width()) >= text_width(words, f64::from(TEXT)));
    }

    #[test]
    fn odd_numbers_do_no_harm() {
        assert_eq!(contact_sheet(&[], 0, 0).width(), 2 * GAP);
        assert!(contact_sheet(&[cell(3, 3, &[])], 0, 0).width() > 0);
    }
}
