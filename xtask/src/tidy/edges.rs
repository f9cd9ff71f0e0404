//! Which crate may depend on which: the table of docs/architecture.md, as data.

use super::Violation;
use serde_json::Value;

/// A crate of ours and what its normal and build dependencies may be.
struct Room {
    package: &'static str,
    /// Crates of ours.
    ours: Ours,
    /// Crates of others; thiserror is allowed everywhere and not listed.
    outside: Outside,
    published: bool,
}

enum Ours {
    Only(&'static [&'static str]),
    /// Every published crate.
    Published,
    Any,
}

enum Outside {
    Only(&'static [&'static str]),
    Any,
}

const fn library(
    package: &'static str,
    ours: &'static [&'static str],
    outside: &'static [&'static str],
) -> Room {
    Room { package, ours: Ours::Only(ours), outside: Outside::Only(outside), published: true }
}

const ROOMS: [Room; 14] = [
    library("scumble-geometry", &[], &["fearless_simd", "glam"]),
    library("scumble-pixel", &[], &[]),
    library("scumble-coverage", &["scumble-geometry"], &["fearless_simd", "glam"]),
    library(
        "scumble-texture",
        &["scumble-geometry", "scumble-pixel"],
        &["bytemuck", "fearless_simd", "glam", "image", "libm", "memmap2", "rayon"],
    ),
    library("scumble-framebuffer", &["scumble-pixel"], &["fearless_simd"]),
    library("scumble-scene", &["scumble-geometry", "scumble-pixel"], &["glam"]),
    library(
        "scumble-svg",
        &["scumble-scene", "scumble-geometry", "scumble-pixel"],
        &["glam", "image", "roxmltree", "svgtypes", "usvg"],
    ),
    library("scumble-signal", &["scumble-pixel"], &["rustfft"]),
    library("scumble-sheet", &["scumble-geometry", "scumble-pixel", "scumble-scene"], &[]),
    library(
        "scumble",
        &[
            "scumble-geometry",
            "scumble-pixel",
            "scumble-coverage",
            "scumble-texture",
            "scumble-framebuffer",
            "scumble-scene",
        ],
        &["glam", "rayon"],
    ),
    Room { package: "scumble-cli", ours: Ours::Published, outside: Outside::Any, published: true },
    Room { package: "lab", ours: Ours::Published, outside: Outside::Any, published: false },
    Room { package: "scumble-tests", ours: Ours::Any, outside: Outside::Any, published: false },
    Room {
        package: "xtask",
        ours: Ours::Only(&[]),
        outside: Outside::Only(&["serde_json"]),
        published: false,
    },
];

const EVERYWHERE: [&str; 1] = ["thiserror"];

/// Holds every member of the workspace to its row of the table.
pub(super) fn check(metadata: &Value) -> Vec<Violation> {
    let root = metadata["workspace_root"].as_str().unwrap_or_default();
    let packages = list(&metadata["packages"]);
    let mut found = Vec::new();
    for package in packages {
        let name = package["name"].as_str().unwrap_or_default();
        let path = package["manifest_path"].as_str().unwrap_or_default();
        let file = path.strip_prefix(root).unwrap_or(path).replace('\\', "/");
        let file = file.trim_start_matches('/');
        match ROOMS.iter().find(|room| room.package == name) {
            None => {
                let message = format!("{name} has no row in the table of the architecture");
                found.push(Violation::new(file, 0, message));
            }
            Some(room) => found.extend(check_room(room, package, file)),
        }
    }
    found
}

fn check_room(room: &Room, package: &Value, file: &str) -> Vec<Violation> {
    let mut found = Vec::new();
    // `publish` is null for "anywhere" and an empty list for "nowhere".
    if package["publish"].is_null() != room.published {
        let message = if room.published { "is to be published" } else { "needs `publish = false`" };
        found.push(Violation::new(file, 0, message));
    }
    for dependency in list(&package["dependencies"]) {
        let name = dependency["name"].as_str().unwrap_or_default();
        if dependency["kind"] == "dev" || EVERYWHERE.contains(&name) {
            continue;
        }
        if !allows(room, name) {
            let message = format!("{} may not depend on {name}", room.package);
            found.push(Violation::new(file, 0, message));
        }
    }
    found
}

fn allows(room: &Room, name: &str) -> bool {
    match ROOMS.iter().find(|other| other.package == name) {
        Some(other) => match room.ours {
            Ours::Only(names) => names.contains(&name),
            Ours::Published => other.published,
            Ours::Any => true,
        },
        None => match room.outside {
            Outside::Only(names) => names.contains(&name),
            Outside::Any => true,
        },
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn workspace(name: &str, publish: Value, dependencies: Value) -> Vec<String> {
        let metadata = json!({
            "workspace_root": "/w",
            "packages": [{
                "name": name,
                "manifest_path": "/w/crates/x/Cargo.toml",
                "publish": publish,
                "dependencies": dependencies,
            }],
        });
        check(&metadata).iter().map(Violation::to_string).collect()
    }

    fn on(name: &str, kind: Value) -> Value {
        json!([{ "name": name, "kind": kind }])
    }

    #[test]
    fn an_allowed_edge_passes() {
        let texture = |d| workspace("scumble-texture", Value::Null, d);
        assert!(texture(on("scumble-pixel", Value::Null)).is_empty());
        assert!(texture(on("rayon", Value::Null)).is_empty());
        assert!(texture(on("thiserror", Value::Null)).is_empty());
        assert!(texture(on("scumble-coverage", json!("dev"))).is_empty());
    }

    #[test]
    fn a_forbidden_edge_is_found() {
        let expected =
            ["crates/x/Cargo.toml:0: scumble-texture may not depend on scumble-coverage"];
        for kind in [Value::Null, json!("build")] {
            let found = workspace("scumble-texture", Value::Null, on("scumble-coverage", kind));
            assert_eq!(found, expected);
        }
        assert_eq!(workspace("scumble-pixel", Value::Null, on("rayon", Value::Null)).len(), 1);
        assert_eq!(workspace("xtask", json!([]), on("scumble", Value::Null)).len(), 1);
        assert_eq!(workspace("lab", json!([]), on("scumble-tests", Value::Null)).len(), 1);
    }

    #[test]
    fn strangers_and_wrongly_published_crates_are_found() {
        assert_eq!(workspace("scumble-new", Value::Null, json!([])).len(), 1);
        assert_eq!(workspace("lab", Value::Null, json!([])).len(), 1);
        assert_eq!(workspace("scumble", json!([]), json!([])).len(), 1);
    }

    /// A cell of the page's table as a sorted list of names.
    fn sorted<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
        let mut names: Vec<_> = names.into_iter().filter(|name| *name != "nothing").collect();
        names.sort_unstable();
        names
    }

    #[test]
    fn the_page_on_the_architecture_has_the_same_table() {
        let page = include_str!("../../../docs/architecture.md");
        for room in &ROOMS {
            let start = format!("| `{}` |", room.package);
            let row = page.lines().find(|line| line.starts_with(&start)).unwrap();
            let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
            let [_, _, _, ours, outside] = cells[..] else { panic!("{row}") };
            let expected = match room.ours {
                Ours::Only(names) => sorted(names.iter().map(|n| n.trim_start_matches("scumble-"))),
                Ours::Published => vec!["all that are published"],
                Ours::Any => vec!["anything"],
            };
            assert_eq!(sorted(ours.split(", ")), expected, "{row}");
            let expected = match room.outside {
                Outside::Only(names) => sorted(names.iter().copied()),
                Outside::Any => vec!["anything"],
            };
            assert_eq!(sorted(outside.split(", ")), expected, "{row}");
        }
    }

    #[test]
    fn what_may_never_see_each_other_cannot() {
        let apart = ["scumble-coverage", "scumble-texture", "scumble-framebuffer"];
        for room in ROOMS.iter().filter(|room| apart.contains(&room.package)) {
            for other in apart.iter().filter(|other| **other != room.package) {
                assert!(!allows(room, other), "{} and {other}", room.package);
            }
        }
    }
}
