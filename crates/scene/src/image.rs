use scumble_pixel::Image;

/// Which of a scene's images: an index into [`crate::Scene::images`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct ImageId(pub usize);

/// What lies beyond the border of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ImageWrap {
    /// The nearest texel of the border.
    #[default]
    Clamp,
    /// The image again.
    Repeat,
    /// The image mirrored.
    Mirror,
}

/// An image that commands refer to.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneImage {
    /// sRGB-encoded red, green, blue and straight alpha, eight bits each.
    pub pixels: Image<[u8; 4]>,
    /// What lies beyond the border.
    pub wrap: ImageWrap,
}
