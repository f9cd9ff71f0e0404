use super::{Frame, ReadError, bytes, component, side};
use scumble_geometry::{DVec2, DVec3, Homography};
use scumble_pixel::{Image, Straight};
use scumble_scene::{
    Command, GouraudTriangle, ImageId, ImageWrap, Scene, SceneImage, TexturedTriangle, View,
};
use serde_json::Value;
use std::path::Path;

/// Numbers of a vertex: clip-space position, colour, place in the texture.
const LANES: usize = 10;

/// Reads a list of triangles: the JSON file, and what it names beside it.
///
/// # Errors
/// [`ReadError`] names the file and what is wrong with it.
pub fn read(path: &Path) -> Result<Frame, ReadError> {
    let wrong = |message: String| ReadError::malformed(path, message);
    let root: Value =
        serde_json::from_slice(&bytes(path)?).map_err(|error| wrong(error.to_string()))?;
    let head = Head::new(&root).map_err(wrong)?;
    let beside = |name: &str| path.with_file_name(name);
    let vertices_path = beside(head.vertices);
    let vertices = vertices(&bytes(&vertices_path)?, head.count)
        .map_err(|message| ReadError::malformed(&vertices_path, message))?;
    let images = match head.texture {
        Some(name) => vec![picture(&beside(name), head.wrap)?],
        None => Vec::new(),
    };
    let size = DVec2::new(f64::from(head.width), f64::from(head.height));
    let textured = !images.is_empty();
    let commands =
        vertices.as_chunks::<3>().0.iter().map(|corners| command(corners, size, textured));
    let scene = Scene {
        view: View::Fit { size },
        background: Some(head.clear),
        commands: commands.collect(),
        images,
    };
    Ok(Frame { width: head.width, height: head.height, scene })
}

/// What the JSON file says.
struct Head<'a> {
    width: u32,
    height: u32,
    clear: Straight,
    vertices: &'a str,
    count: usize,
    texture: Option<&'a str>,
    wrap: ImageWrap,
}

impl<'a> Head<'a> {
    fn new(root: &'a Value) -> Result<Self, String> {
        let number = |key: &str| {
            root[key].as_f64().ok_or_else(|| format!("`{key}` is missing or not a number"))
        };
        let clear: Option<Vec<f64>> = root["clear"]
            .as_array()
            .filter(|values| values.len() == 4)
            .and_then(|values| values.iter().map(Value::as_f64).collect());
        let clear = clear.ok_or("`clear` should be four numbers")?;
        let mut color = [0.0; 4];
        for (to, from) in color.iter_mut().zip(clear) {
            *to = component(from)?;
        }
        let texture = match &root["texture"] {
            Value::Null => None,
            Value::String(name) => Some(name.as_str()),
            _ => return Err("`texture` should be a file's name or null".into()),
        };
        let wrap = match &root["wrap"] {
            Value::Null => ImageWrap::Repeat,
            Value::String(wrap) if wrap == "repeat" => ImageWrap::Repeat,
            Value::String(wrap) if wrap == "clamp" => ImageWrap::Clamp,
            other => return Err(format!("`wrap` is {other}: \"repeat\" and \"clamp\" are")),
        };
        Ok(Self {
            width: side(number("width")?, "`width`")?,
            height: side(number("height")?, "`height`")?,
            clear: Straight(color),
            vertices: root["vertices"].as_str().ok_or("`vertices` should be a file's name")?,
            count: root["count"].as_u64().ok_or("`count` should be a whole number")? as usize,
            texture,
            wrap,
        })
    }
}

/// A corner of a triangle.
struct Vertex {
    /// (x, y, w) in clip space.
    position: DVec3,
    color: Straight,
    uv: DVec2,
}

fn vertices(bytes: &[u8], count: usize) -> Result<Vec<Vertex>, String> {
    if count.checked_mul(LANES * 4) != Some(bytes.len()) {
        return Err(format!("{count} vertices were announced, {} bytes are there", bytes.len()));
    }
    if !count.is_multiple_of(3) {
        return Err(format!("{count} vertices are not whole triangles"));
    }
    let numbers: Vec<f32> =
        bytes.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
    if let Some(at) = numbers.iter().position(|number| !number.is_finite()) {
        return Err(format!("vertex {} has a number that is not finite", at / LANES));
    }
    let vertex = |v: &[f32; LANES]| Vertex {
        position: DVec3::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[3])),
        color: Straight([4, 5, 6, 7].map(|lane| v[lane].clamp(0.0, 1.0))),
        uv: DVec2::new(f64::from(v[8]), f64::from(v[9])),
    };
    Ok(numbers.as_chunks::<LANES>().0.iter().map(vertex).collect())
}

fn picture(path: &Path, wrap: ImageWrap) -> Result<SceneImage, ReadError> {
    let decoded = image::load_from_memory(&bytes(path)?)
        .map_err(|source| ReadError::Picture { path: path.to_owned(), source })?
        .into_rgba8();
    let (width, height) = (decoded.width() as usize, decoded.height() as usize);
    let texels = decoded.into_raw().as_chunks::<4>().0.to_vec();
    let pixels = Image::from_vec(width, height, texels)
        .map_err(|error| ReadError::malformed(path, error.to_string()))?;
    Ok(SceneImage { pixels, wrap })
}

fn command(corners: &[Vertex; 3], size: DVec2, textured: bool) -> Command {
    let (points, transform) = place(corners, size);
    if textured {
        let uvs = [0, 1, 2].map(|i: usize| corners[i].uv);
        let image = ImageId(0);
        Command::Textured(TexturedTriangle { points, uvs, image, opacity: 1.0, transform })
    } else {
        let colors = [0, 1, 2].map(|i: usize| corners[i].color);
        Command::Gouraud(GouraudTriangle { points, colors, transform })
    }
}

/// The corners in a plane, and the plane's map to the canvas. What is parallel to the screen stays
/// in pixels; else the plane is that of the triangle's own two first edges, and the columns of the
/// map are what they are on the canvas before the division by w.
fn place(corners: &[Vertex; 3], size: DVec2) -> ([DVec2; 3], Homography) {
    let pixels = |v: &Vertex| {
        let DVec3 { x, y, z: w } = v.position;
        DVec3::new((x + w) * (size.x / 2.0), (w - y) * (size.y / 2.0), w)
    };
    let [a, b, c] = [0, 1, 2].map(|i: usize| pixels(&corners[i]));
    if a.z == b.z && b.z == c.z && a.z > 0.0 {
        return ([a, b, c].map(|p| DVec2::new(p.x / p.z, p.y / p.z)), Homography::IDENTITY);
    }
    let (u, v) = (b - a, c - a);
    let map = Homography::new([[u.x, v.x, a.x], [u.y, v.y, a.y], [u.z, v.z, a.z]]);
    ([DVec2::ZERO, DVec2::X, DVec2::Y], map)
}
