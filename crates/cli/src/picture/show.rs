//! What people see of a picture in reports made of pictures.

use super::Picture;
use super::profile;
use scumble::pixel::unorm8;

/// What lies under pictures with alpha: squares of this side, in these two greys of sRGB.
const SQUARE: usize = 8;
const GREYS: [f32; 2] = [0.6, 0.4];

/// A colour of sRGB, multiplied by its alpha, on a checkerboard at column `x` of row `y`.
pub(crate) fn on_checkerboard(color: [f32; 3], alpha: f32, x: usize, y: usize) -> [u8; 3] {
    let ground = GREYS[(x / SQUARE + y / SQUARE) % 2] * (1.0 - alpha.clamp(0.0, 1.0));
    color.map(|v| unorm8(v + ground))
}

impl Picture {
    /// The name of its profile; an empty one for a profile that has none.
    pub(crate) fn profile_name(&self) -> Option<String> {
        let profile = profile::parse(self.icc.as_ref()?, self.channels).ok()?;
        Some(profile.name.unwrap_or_default())
    }

    /// Whether its profile has other primaries than sRGB.
    pub(crate) fn has_other_primaries(&self) -> bool {
        let profile = self.icc.as_ref().and_then(|icc| profile::parse(icc, self.channels).ok());
        profile.is_some_and(|p| !p.srgb_primaries)
    }

    /// Whether no pixel has an alpha below 1.
    pub(crate) fn is_opaque(&self) -> bool {
        let n = self.channels.count();
        let mut alphas = (n - 1..self.pixels.len()).step_by(n).map(|i| self.pixels.at(i));
        !self.channels.has_alpha() || alphas.all(|a| a >= 1.0)
    }
}
