use scumble_pixel::{Image, ImageView, Premul};

/// Which number of a colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Channel {
    /// Red, the alpha multiplied in.
    Red,
    /// Green, the alpha multiplied in.
    Green,
    /// Blue, the alpha multiplied in.
    Blue,
    /// Alpha.
    Alpha,
    /// 0.2126 red + 0.7152 green + 0.0722 blue (Rec. 709): luminance in linear light, luma in encoded
    /// values.
    #[default]
    Luminance,
}

impl Channel {
    fn of(self, color: Premul) -> f64 {
        let [r, g, b, a] = color.0.map(f64::from);
        match self {
            Self::Red => r,
            Self::Green => g,
            Self::Blue => b,
            Self::Alpha => a,
            Self::Luminance => 0.2126 * r + 0.7152 * g + 0.0722 * b,
        }
    }
}

/// One channel of a picture.
#[must_use]
pub fn plane(image: ImageView<'_, Premul>, channel: Channel) -> Image<f64> {
    let values = image.rows().flatten().map(|&color| channel.of(color)).collect();
    Image::from_vec(image.width(), image.height(), values).unwrap_or_default()
}

/// A picture whose channels, alpha included, are what `filter` makes of its channels.
///
/// The result has the size of the first channel's; what others lack is 0. Components are not
/// clamped: a filter with negative weights leads beyond 0…1.
///
/// # Errors
/// Those of `filter`.
pub fn map_channels<E>(
    image: ImageView<'_, Premul>,
    mut filter: impl FnMut(&Image<f64>) -> Result<Image<f64>, E>,
) -> Result<Image<Premul>, E> {
    let mut channel = |channel| filter(&plane(image, channel));
    let [r, g, b, a] = [
        channel(Channel::Red)?,
        channel(Channel::Green)?,
        channel(Channel::Blue)?,
        channel(Channel::Alpha)?,
    ];
    let at = |plane: &Image<f64>, i: usize| plane.pixels().get(i).map_or(0.0, |&v| v as f32);
    let colors =
        (0..r.pixels().len()).map(|i| Premul([at(&r, i), at(&g, i), at(&b, i), at(&a, i)]));
    Ok(Image::from_vec(r.width(), r.height(), colors.collect()).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    #[test]
    fn channels_come_apart_and_together() {
        let picture = Image::from_fn(3, 2, |x, y| Premul([x as f32, y as f32, 0.25, 1.0])).unwrap();
        let same = map_channels(picture.view(), |p| Ok::<_, Infallible>(p.clone())).unwrap();
        assert_eq!(same, picture);
        assert_eq!(plane(picture.view(), Channel::Green).row(1), [1.0; 3]);
        let white = Image::filled(1, 1, Premul([1.0; 4])).unwrap();
        assert!((plane(white.view(), Channel::Luminance).pixels()[0] - 1.0).abs() < 1e-15);
    }
}
