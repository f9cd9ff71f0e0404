//! ICC profiles, as far as light goes: the curve of each channel, and the name.

use super::Channels;
use super::curve::Curve;
use moxcms::{ColorProfile, DataColorSpace, ProfileText, ToneReprCurve};
use scumble::pixel::srgb;
use std::sync::Arc;

/// How a picture's numbers are related to light, on the scale where white is 1.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Tone {
    /// By the curve of sRGB.
    Srgb,
    /// They are proportional to it.
    Linear,
    /// By the curves of a profile, for red, green and blue.
    Curves(Arc<[Curve; 3]>),
}

/// What a profile says.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Profile {
    /// Its name.
    pub(super) name: Option<String>,
    /// Its curves, if it has any: profiles of printers and of some scanners have tables instead.
    pub(super) tone: Option<Tone>,
    /// Whether its primaries are those of sRGB, to the accuracy that profiles have.
    pub(super) srgb_primaries: bool,
}

/// Curves that differ from sRGB's by less than this part of white count as sRGB's, and those that differ
/// so little from the diagonal as linear: profiles round their numbers to 16 bits, and some store the
/// curve as a table.
const SAME: f32 = 1.0 / 4096.0;

/// The largest difference of primaries, as XYZ, that is only rounding.
const SAME_PRIMARY: f64 = 0.002;

/// What is said of a profile that cannot be read.
pub(super) const DAMAGED: &str = "its ICC profile is damaged and was left out";

/// Reads a profile for a picture of these channels; a sentence on why it cannot be used otherwise.
pub(super) fn parse(icc: &[u8], channels: Channels) -> Result<Profile, String> {
    let unreadable = |_| DAMAGED.to_owned();
    let profile = ColorProfile::new_from_slice(icc).map_err(unreadable)?;
    let fits = match profile.color_space {
        DataColorSpace::Rgb => !channels.is_gray(),
        DataColorSpace::Gray => channels.is_gray(),
        _ => false,
    };
    if !fits {
        return Err("its ICC profile is for another kind of colours and was left out".to_owned());
    }
    let curves = match profile.color_space {
        DataColorSpace::Gray => [&profile.gray_trc; 3],
        _ => [&profile.red_trc, &profile.green_trc, &profile.blue_trc],
    };
    Ok(Profile {
        name: profile.description.as_ref().and_then(text),
        tone: tone(curves),
        srgb_primaries: channels.is_gray() || has_srgb_primaries(&profile),
    })
}

fn tone(curves: [&Option<ToneReprCurve>; 3]) -> Option<Tone> {
    let [r, g, b] = curves.map(|c| c.as_ref().and_then(Curve::new));
    let curves = [r?, g?, b?];
    let all = |like: fn(f32) -> f32| curves.iter().all(|c| c.is_like(like, SAME));
    Some(if all(srgb::decode) {
        Tone::Srgb
    } else if all(|v| v) {
        Tone::Linear
    } else {
        Tone::Curves(Arc::new(curves))
    })
}

fn has_srgb_primaries(profile: &ColorProfile) -> bool {
    let own = [profile.red_colorant, profile.green_colorant, profile.blue_colorant];
    // Adapted to D50, as every profile has them (IEC 61966-2-1, Bradford).
    let srgb = [[0.4360, 0.2225, 0.0139], [0.3851, 0.7169, 0.0971], [0.1431, 0.0606, 0.7141]];
    own.iter().zip(srgb).all(|(own, [x, y, z])| {
        [own.x - x, own.y - y, own.z - z].iter().all(|d| d.abs() < SAME_PRIMARY)
    })
}

/// The text, in English if it is there in several languages.
fn text(text: &ProfileText) -> Option<String> {
    let text = match text {
        ProfileText::PlainString(text) => text.clone(),
        ProfileText::Localizable(all) => {
            let english = all.iter().find(|t| t.language == "en");
            english.or(all.first())?.value.clone()
        }
        ProfileText::Description(text) => text.ascii_string.clone(),
    };
    let text = text.trim_end_matches('\0').trim();
    (!text.is_empty()).then(|| text.to_owned())
}

impl Tone {
    /// A number of channel `channel` as light.
    pub(crate) fn decode(&self, channel: usize, value: f32) -> f32 {
        match self {
            Self::Srgb => srgb::decode(value),
            Self::Linear => value,
            Self::Curves(curves) => curves[channel.min(2)].decode(value),
        }
    }

    /// Light as a number of channel `channel`.
    pub(crate) fn encode(&self, channel: usize, light: f32) -> f32 {
        match self {
            Self::Srgb => srgb::encode(light),
            Self::Linear => light,
            Self::Curves(curves) => curves[channel.min(2)].encode(light),
        }
    }
}
