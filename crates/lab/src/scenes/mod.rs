//! The scenes, by name. Each is about one element or one rule.

mod course;
mod degenerate;
mod ground;
mod maps;
mod ordinary;
mod perspective;
mod solid;
mod strokes;

/// A scene: its name and its text.
pub(crate) type Scene = (&'static str, String);

/// Every scene. `emblem` is the PNG that some of them carry inside.
pub(crate) fn all(emblem: &[u8]) -> Vec<Scene> {
    let data = format!("data:image/png;base64,{}", crate::svg::base64(emblem));
    let mut scenes = course::all(&data);
    scenes.extend(degenerate::all());
    scenes.extend(solid::all());
    scenes.extend(maps::all());
    scenes.extend(ordinary::all(&data));
    scenes.extend(strokes::all());
    scenes.extend(perspective::all());
    scenes.push(("ground", ground::draw()));
    scenes
}
