//! The checked-in assets are what the code draws, and the check can tell.

use lab::{Asset, LabError};
use std::path::{Path, PathBuf};

fn assets_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets")
}

#[test]
fn the_assets_folder_holds_what_the_code_draws() {
    let files = lab::assets().expect("drawing in memory");
    lab::check(&assets_folder(), &files).expect("`cargo xtask assets` draws them anew");
    let total: usize = files.iter().map(|f| f.bytes.len()).sum();
    assert!(total < 3 << 20, "{total} bytes");
}

#[test]
fn paths_are_unique_and_scenes_read_only_their_own_folder() {
    let files = lab::assets().expect("drawing in memory");
    for pair in files.windows(2) {
        assert!(pair[0].path < pair[1].path, "{}", pair[1].path);
    }
    for scene in files.iter().filter(|f| f.path.ends_with(".svg")) {
        let text = std::str::from_utf8(&scene.bytes).expect("UTF-8");
        assert!(!text.contains(".."), "{} climbs out of its folder", scene.path);
        for name in text.split("textures/").skip(1) {
            let path = format!("scenes/textures/{}", name.split('"').next().expect("a quote"));
            assert!(files.iter().any(|f| f.path == path), "{}: no {path}", scene.path);
        }
    }
}

#[test]
fn a_changed_a_missing_and_a_foreign_file_are_found() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("assets_check");
    let _ = std::fs::remove_dir_all(&folder);
    let file = |path: &str| Asset { path: path.to_owned(), bytes: path.as_bytes().to_vec() };
    let files = [file("a/one"), file("a/two"), file("three")];
    lab::write(&folder, &files).expect("writing");
    lab::check(&folder, &files).expect("just written");

    std::fs::write(folder.join("a/one"), "changed").expect("writing");
    std::fs::remove_file(folder.join("three")).expect("removing");
    std::fs::write(folder.join("a/four"), "foreign").expect("writing");
    let Err(LabError::Different(lines)) = lab::check(&folder, &files) else {
        panic!("the differences went unseen");
    };
    assert_eq!(lines, ["a/one: stale", "three: missing", "a/four: nothing draws it"]);
}
