use crate::{NoResources, Resources};

/// How a document is to be understood.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Profile {
    /// SVG with the extension elements.
    Svg,
    /// The course's dialect, its view and its conventions.
    Course,
}

/// Which profile to read with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ProfileChoice {
    /// The course's only if the root says `sc:profile="course"`, else SVG.
    #[default]
    Auto,
    /// SVG, whatever the root says.
    Svg,
    /// The course's dialect, whatever the root says.
    Course,
}

/// Everything that a run of [`parse`](crate::parse) may be told.
#[derive(Clone, Copy)]
#[non_exhaustive]
pub struct Options<'a> {
    /// How to understand the document.
    pub profile: ProfileChoice,
    /// Where images come from.
    pub resources: &'a dyn Resources,
    /// What a document may cost.
    pub limits: Limits,
}

impl Default for Options<'_> {
    /// Profile by the root element, no resources, default limits.
    fn default() -> Self {
        Self { profile: ProfileChoice::Auto, resources: &NoResources, limits: Limits::default() }
    }
}

impl<'a> Options<'a> {
    /// The same with another profile.
    #[must_use]
    pub fn with_profile(self, profile: ProfileChoice) -> Self {
        Self { profile, ..self }
    }

    /// The same with another source of images.
    #[must_use]
    pub fn with_resources<'b>(self, resources: &'b dyn Resources) -> Options<'b>
    where
        'a: 'b,
    {
        Options { resources, ..self }
    }

    /// The same with other limits.
    #[must_use]
    pub fn with_limits(self, limits: Limits) -> Self {
        Self { limits, ..self }
    }
}

impl core::fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Options")
            .field("profile", &self.profile)
            .field("limits", &self.limits)
            .finish_non_exhaustive()
    }
}

/// What a document may cost before reading stops with an error. The defaults let every sensible
/// document pass and keep a hostile one within some seconds and about two gigabytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct Limits {
    /// Bytes of the document. Default 256 MiB.
    pub max_document_bytes: usize,
    /// Elements of the document after `use` and markers are expanded. Default 1 000 000, beyond
    /// which the SVG profile cannot go.
    pub max_elements: usize,
    /// Elements inside one another, `use` included. Default 256; the SVG profile needs stack in
    /// proportion, about 2 KiB an element.
    pub max_depth: usize,
    /// Attributes of one element; checking them for duplicates takes the square of their number.
    /// Default 2 000.
    pub max_attributes: usize,
    /// Bytes that entities may add to the document. Default 16 MiB.
    pub max_entity_bytes: usize,
    /// Bytes of one image as it is stored, in a data URI or a file. Default 256 MiB.
    pub max_file_bytes: usize,
    /// Pixels of one image. Default 100 million.
    pub max_image_pixels: u64,
    /// Bytes of all decoded images of a scene together, four a pixel. Default 1 GiB.
    pub max_image_bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            max_document_bytes: 256 << 20,
            max_elements: 1_000_000,
            max_depth: 256,
            max_attributes: 2_000,
            max_entity_bytes: 16 << 20,
            max_file_bytes: 256 << 20,
            max_image_pixels: 100_000_000,
            max_image_bytes: 1 << 30,
        }
    }
}
