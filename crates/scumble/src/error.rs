use scumble_texture::TextureError;

/// Why a picture was not rendered. `E` is the sink's own error.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError<E> {
    /// The canvas has no pixels, or more than 2³⁰ − 1 on a side.
    #[error("a canvas of {width} by {height} pixels cannot be rendered")]
    Canvas {
        /// Columns asked for.
        width: u32,
        /// Rows asked for.
        height: u32,
    },
    /// The crop holds no pixel of the canvas.
    #[error("the crop lies outside the canvas of {width} by {height} pixels")]
    Crop {
        /// Columns of the canvas.
        width: u32,
        /// Rows of the canvas.
        height: u32,
    },
    /// The size of a tile is not in 8…256.
    #[error("tiles of {0} pixels are not supported: 8 to 256 are")]
    TileSize(u32),
    /// The memory limit would be passed.
    #[error("{needed} bytes of memory are needed, the limit is {limit}")]
    Memory {
        /// Bytes needed, at least.
        needed: u64,
        /// The limit of the settings.
        limit: u64,
    },
    /// An image of the scene cannot become a texture.
    #[error("image {index}: {source}")]
    Texture {
        /// Which image of the scene.
        index: usize,
        /// Why.
        source: TextureError,
    },
    /// The textures that were given are of another scene, or were made for other settings.
    #[error("the textures were made for another scene or for other settings")]
    Textures,
    /// The threads could not be started.
    #[error("cannot start the threads: {0}")]
    Threads(String),
    /// The caller's flag was set.
    #[error("cancelled")]
    Cancelled,
    /// The sink failed.
    #[error(transparent)]
    Sink(E),
}
