//! Decoding images, within limits, each once.

use crate::data_uri::{self, DataUriError};
use crate::error::ErrorKind;
use crate::{Limits, ResourceError, Resources};
use image::{ImageDecoder, ImageError, ImageReader};
use scumble_pixel::Image;
use scumble_scene::{ImageId, ImageWrap, SceneImage};
use std::collections::HashMap;
use std::io::Cursor;

/// Memory that decoders may use whatever the limits, in bytes: their tables take some of it.
const LEAST_ALLOWANCE: u64 = 1 << 20;

/// The images of a scene while it is being read.
pub(crate) struct Images<'a> {
    resources: &'a dyn Resources,
    limits: Limits,
    images: Vec<SceneImage>,
    by_name: HashMap<(String, ImageWrap), ImageId>,
    bytes: u64,
}

impl<'a> Images<'a> {
    pub(crate) fn new(resources: &'a dyn Resources, limits: Limits) -> Self {
        Self { resources, limits, images: Vec::new(), by_name: HashMap::new(), bytes: 0 }
    }

    /// The image behind a name or a data URI; decoded when it is first asked for.
    pub(crate) fn load(&mut self, href: &str, wrap: ImageWrap) -> Result<ImageId, ErrorKind> {
        let key = (href.to_owned(), wrap);
        if let Some(&id) = self.by_name.get(&key) {
            return Ok(id);
        }
        let stored = self.fetch(href)?;
        let pixels = self.decode(href, &stored)?;
        let id = ImageId(self.images.len());
        self.images.push(SceneImage { pixels, wrap });
        self.by_name.insert(key, id);
        Ok(id)
    }

    /// Columns and rows of an image.
    pub(crate) fn size(&self, id: ImageId) -> (usize, usize) {
        self.images.get(id.0).map_or((0, 0), |i| (i.pixels.width(), i.pixels.height()))
    }

    pub(crate) fn into_vec(self) -> Vec<SceneImage> {
        self.images
    }

    fn fetch(&self, href: &str) -> Result<Vec<u8>, ErrorKind> {
        let limit = self.limits.max_file_bytes;
        let too_large = || ErrorKind::Resource {
            href: shorten(href),
            source: ResourceError::TooLarge { limit },
        };
        match data_uri::decode(href, limit) {
            Some(Ok(bytes)) => Ok(bytes),
            Some(Err(DataUriError::TooLarge)) => Err(too_large()),
            Some(Err(DataUriError::Malformed(message))) => {
                Err(ErrorKind::Image { href: shorten(href), message: message.into() })
            }
            None => match self.resources.load(href) {
                Ok(bytes) if bytes.len() > limit => Err(too_large()),
                Ok(bytes) => Ok(bytes),
                Err(source) => Err(ErrorKind::Resource { href: shorten(href), source }),
            },
        }
    }

    /// Decodes PNG, JPEG, GIF (the first frame) or WebP, told apart by their first bytes.
    fn decode(&mut self, href: &str, stored: &[u8]) -> Result<Image<[u8; 4]>, ErrorKind> {
        let bad = |message: String| ErrorKind::Image { href: shorten(href), message };
        let refused = |error: ImageError| match error {
            ImageError::Limits(_) => ErrorKind::Limit(format!(
                "image `{}` would take more memory to read than all images may",
                shorten(href)
            )),
            other => bad(other.to_string()),
        };
        let mut reader = ImageReader::new(Cursor::new(stored))
            .with_guessed_format()
            .map_err(|e| bad(e.to_string()))?;
        if reader.format().is_none() {
            return Err(bad("it is not PNG, JPEG, GIF or WebP".into()));
        }
        let mut limits = image::Limits::default();
        // Sixteen bytes a pixel: the widest format that a decoder may hold on the way to RGBA8.
        // Metadata counts too, which a few bytes can swell without end.
        let widest = self.limits.max_image_pixels.saturating_mul(16);
        let all = self.limits.max_image_bytes.saturating_mul(4).max(LEAST_ALLOWANCE);
        limits.max_alloc = Some(widest.max(LEAST_ALLOWANCE).min(all));
        reader.limits(limits);
        let decoder = reader.into_decoder().map_err(refused)?;
        // The header says how large it is: refuse before a byte of pixels is made.
        let (width, height) = decoder.dimensions();
        self.reserve(href, width, height)?;
        let decoded = image::DynamicImage::from_decoder(decoder).map_err(refused)?;
        let rgba = decoded.into_rgba8();
        let (width, height) = (rgba.width() as usize, rgba.height() as usize);
        let pixels = rgba.into_raw().as_chunks::<4>().0.to_vec();
        Image::from_vec(width, height, pixels).map_err(|e| bad(e.to_string()))
    }

    /// Counts an image against the limits.
    fn reserve(&mut self, href: &str, width: u32, height: u32) -> Result<(), ErrorKind> {
        let href = shorten(href);
        let count = u64::from(width) * u64::from(height);
        if count == 0 {
            return Err(ErrorKind::Image { href, message: "it has no pixels".into() });
        }
        let limit = self.limits.max_image_pixels;
        if count > limit {
            return Err(ErrorKind::Limit(format!(
                "image `{href}` has {width} × {height} pixels, more than {limit}"
            )));
        }
        let limit = self.limits.max_image_bytes;
        let bytes = self.bytes.saturating_add(count.saturating_mul(4));
        if bytes > limit {
            return Err(ErrorKind::Limit(format!(
                "with image `{href}` of {width} × {height} pixels all images together take {bytes} bytes, more than {limit}"
            )));
        }
        self.bytes = bytes;
        Ok(())
    }
}

/// A name fit for a message: data URIs can be megabytes.
pub(crate) fn shorten(href: &str) -> String {
    const LONGEST: usize = 60;
    let href = href.trim();
    if href.chars().count() <= LONGEST {
        href.to_owned()
    } else {
        href.chars().take(LONGEST).chain("…".chars()).collect()
    }
}
