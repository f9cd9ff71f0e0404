use crate::pixel::ImageView;
use crate::texture::{Alpha, Channels, Texels, Texture, TextureError, TextureOptions};

/// A picture that can be warped: whatever a [`Texture`] can be made of.
pub trait Source: Sync {
    /// Columns and rows.
    fn size(&self) -> [usize; 2];

    /// Whether every pixel is opaque: then the picture's edge can be as sharp as the output allows.
    fn is_opaque(&self) -> bool;

    /// The texture of it.
    ///
    /// # Errors
    /// As for [`Texture::new`].
    fn texture(&self, options: &TextureOptions) -> Result<Texture, TextureError>;
}

/// sRGB-encoded, straight alpha, eight bits.
impl Source for ImageView<'_, [u8; 4]> {
    fn size(&self) -> [usize; 2] {
        [self.width(), self.height()]
    }

    fn is_opaque(&self) -> bool {
        self.rows().all(|row| row.iter().fold(255, |all, p| all & p[3]) == 255)
    }

    fn texture(&self, options: &TextureOptions) -> Result<Texture, TextureError> {
        Texture::new(*self, options)
    }
}

impl<P: Channels, A: Alpha> Source for Texels<'_, P, A> {
    fn size(&self) -> [usize; 2] {
        Self::size(self)
    }

    fn is_opaque(&self) -> bool {
        Self::is_opaque(self)
    }

    fn texture(&self, options: &TextureOptions) -> Result<Texture, TextureError> {
        Texture::from_texels(self, options)
    }
}
