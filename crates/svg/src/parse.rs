use crate::error::ErrorKind;
use crate::extension::{NAMESPACE, svg_name};
use crate::images::{Images, shorten};
use crate::warning::Warnings;
use crate::{Options, Position, Profile, ProfileChoice, SvgError, Warning, course, input, svg};
use roxmltree::Node;
use scumble_scene::Scene;

/// What came out of a document.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Parsed {
    /// What to draw.
    pub scene: Scene,
    /// The profile that the document was read with.
    pub profile: Profile,
    /// What is not drawn as the document says, in order of first appearance.
    pub warnings: Vec<Warning>,
}

/// Reads a document.
///
/// # Errors
/// [`SvgError`] if it is no well-formed UTF-8 document with an `svg` root of usable size, if an
/// extension element lacks what it needs, if an image cannot be had or read, or if it exceeds the
/// limits.
pub fn parse(document: &[u8], options: &Options<'_>) -> Result<Parsed, SvgError> {
    let text = input::text(document, &options.limits)?;
    let tree = input::tree(text, &options.limits)?;
    let root = tree.root_element();
    if svg_name(root) != Some("svg") {
        let name = shorten(root.tag_name().name());
        return Err(SvgError::at(Position::at(text, root.range().start), ErrorKind::NotSvg(name)));
    }
    let mut warnings = Warnings::default();
    let profile = choose_profile(root, options.profile, &mut warnings);
    let images = Images::new(options.resources, options.limits);
    let scene = match profile {
        Profile::Course => course::read(root, images, &mut warnings),
        Profile::Svg => svg::read(root, &options.limits, images, &mut warnings),
    };
    let scene = scene.map_err(|fault| fault.locate(text))?;
    Ok(Parsed { scene, profile, warnings: warnings.finish(text) })
}

fn choose_profile(root: Node<'_, '_>, choice: ProfileChoice, warnings: &mut Warnings) -> Profile {
    match (choice, root.attribute((NAMESPACE, "profile")).map(str::trim)) {
        (ProfileChoice::Svg, _) | (ProfileChoice::Auto, None | Some("svg")) => Profile::Svg,
        (ProfileChoice::Course, _) | (ProfileChoice::Auto, Some("course")) => Profile::Course,
        (ProfileChoice::Auto, Some(other)) => {
            let message = format!("there is no profile `{}`: svg is taken", shorten(other));
            warnings.add(root.range().start, message);
            Profile::Svg
        }
    }
}
