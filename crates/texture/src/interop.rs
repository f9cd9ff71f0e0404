//! From other crates' types.

#[cfg(feature = "glam")]
mod glam {
    use crate::Footprint;
    use glam::{DMat2, DVec2};
    use scumble_geometry::Matrix2;

    /// A centre and the Jacobian, whose columns are ∂(u, v)/∂x and ∂(u, v)/∂y.
    impl From<(DVec2, DMat2)> for Footprint {
        fn from((centre, jacobian): (DVec2, DMat2)) -> Self {
            let (x, y) = (jacobian.x_axis, jacobian.y_axis);
            Self { u: centre.x, v: centre.y, jacobian: Matrix2::new(x.x, y.x, x.y, y.y) }
        }
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn columns_are_columns() {
            let f = Footprint::from((
                DVec2::new(7.0, 8.0),
                DMat2::from_cols_array(&[1.0, 2.0, 3.0, 4.0]),
            ));
            assert_eq!((f.u, f.v), (7.0, 8.0));
            assert_eq!(f.jacobian, Matrix2::new(1.0, 3.0, 2.0, 4.0));
        }
    }
}

#[cfg(feature = "image")]
mod image {
    use crate::{Channels, Texels, Texture, TextureError, TextureOptions};
    use alloc::vec::Vec;
    use image::{DynamicImage, ImageBuffer, Pixel};
    use scumble_pixel::ImageView;

    impl Texture {
        /// A texture from a decoded image of the crate `image`, without a copy of it in between.
        ///
        /// Whole numbers are taken for sRGB-encoded, floats for linear light; alpha is straight, as in
        /// that crate.
        ///
        /// # Errors
        /// As for [`Texture::new`]; [`TextureError::Format`] for a kind of pixel that this crate does
        /// not know.
        pub fn from_image(
            image: &DynamicImage,
            options: &TextureOptions,
        ) -> Result<Self, TextureError> {
            match image {
                DynamicImage::ImageLuma8(b) => make::<_, 1, _>(b, options),
                DynamicImage::ImageLumaA8(b) => make::<_, 2, _>(b, options),
                DynamicImage::ImageRgb8(b) => make::<_, 3, _>(b, options),
                DynamicImage::ImageRgba8(b) => make::<_, 4, _>(b, options),
                DynamicImage::ImageLuma16(b) => make::<_, 1, _>(b, options),
                DynamicImage::ImageLumaA16(b) => make::<_, 2, _>(b, options),
                DynamicImage::ImageRgb16(b) => make::<_, 3, _>(b, options),
                DynamicImage::ImageRgba16(b) => make::<_, 4, _>(b, options),
                DynamicImage::ImageRgb32F(b) => make::<_, 3, _>(b, options),
                DynamicImage::ImageRgba32F(b) => make::<_, 4, _>(b, options),
                _ => Err(TextureError::Format),
            }
        }
    }

    /// A texture from a buffer of `N` channels.
    fn make<P, const N: usize, C>(
        buffer: &ImageBuffer<P, Vec<C>>,
        options: &TextureOptions,
    ) -> Result<Texture, TextureError>
    where
        P: Pixel<Subpixel = C>,
        [C; N]: Channels,
    {
        let (width, height) = (buffer.width() as usize, buffer.height() as usize);
        let (pixels, _) = buffer.as_raw().as_chunks::<N>();
        // The buffer is as long as its size says, so this does not fail.
        let view =
            ImageView::new(width, height, width, pixels).map_err(|_| TextureError::Format)?;
        Texture::from_texels(&Texels::straight(view), options)
    }

    #[cfg(test)]
    mod tests {
        use super::*;

        #[test]
        fn every_kind_of_image_becomes_a_texture() {
            let options = TextureOptions::default();
            let image = DynamicImage::ImageRgba8(::image::RgbaImage::from_fn(5, 3, |x, y| {
                ::image::Rgba([(x * 50) as u8, (y * 80) as u8, 30, 255])
            }));
            let texel = |image: &DynamicImage| {
                let t = Texture::from_image(image, &options).unwrap();
                t.level(0).unwrap().row(2)[4]
            };
            let expected = texel(&image);
            assert!((expected[0] - 200.0 / 255.0).abs() < 1e-4);
            for other in [
                DynamicImage::ImageRgb8(image.to_rgb8()),
                DynamicImage::ImageRgba16(image.to_rgba16()),
                DynamicImage::ImageRgb16(image.to_rgb16()),
            ] {
                let found = texel(&other);
                assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4), "{other:?}");
            }
            let grey = texel(&DynamicImage::ImageLumaA16(image.to_luma_alpha16()));
            assert!(grey[0] == grey[1] && grey[1] == grey[2] && grey[3] == 1.0);
            // In linear light a float is what it is.
            let float =
                ::image::Rgba32FImage::from_pixel(2, 2, ::image::Rgba([0.25, 0.5, 1.0, 1.0]));
            let linear = TextureOptions { space: scumble_pixel::WorkingSpace::Linear, ..options };
            let t = Texture::from_image(&DynamicImage::ImageRgba32F(float), &linear).unwrap();
            assert_eq!(t.level(0).unwrap().row(0)[0], [0.25, 0.5, 1.0, 1.0]);
            let empty = DynamicImage::new_rgb8(0, 4);
            assert_eq!(Texture::from_image(&empty, &options).unwrap_err(), TextureError::Empty);
        }
    }
}
