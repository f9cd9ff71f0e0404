use super::*;
use crate::input::Source;
use crate::interrupt::tests::unheard;
use crate::resources::Folders;
use std::path::PathBuf;
use tempfile::TempDir;

const PNG: &[u8] = b"\x89PNG\r\n\x1a\nrest";

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn scene(folder: &TempDir) -> Source {
    let path = folder.path().join("scene.svg");
    fs::write(&path, "<svg/>").unwrap();
    Source::File(path)
}

fn target(path: &Path, force: bool, source: &Source) -> Result<Target, Failure> {
    Target::new(&Request { out: Some(path), force, json: false }, source)
}

fn names(folder: &TempDir) -> Vec<String> {
    let entries = fs::read_dir(folder.path()).unwrap();
    let mut names: Vec<_> =
        entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_named_picture_is_replaced_but_nothing_else_is() {
    let folder = folder();
    let source = scene(&folder);
    let path = folder.path().join("out.png");
    assert!(target(&path, false, &source).is_ok());
    fs::write(&path, PNG).unwrap();
    assert!(target(&path, false, &source).is_ok());
    fs::write(&path, "").unwrap();
    assert!(target(&path, false, &source).is_ok());
    fs::write(&path, "a letter").unwrap();
    assert!(target(&path, false, &source).is_err());
    assert!(target(&path, true, &source).is_ok());
}

#[test]
fn the_scene_and_its_images_are_safe() {
    let folder = folder();
    let source = scene(&folder);
    let Source::File(scene) = &source else { unreachable!() };
    assert!(target(scene, false, &source).is_err());
    assert!(target(scene, true, &source).is_ok());

    let image = folder.path().join("image.png");
    fs::write(&image, PNG).unwrap();
    let folders = Folders::new(folder.path(), &[], 100).unwrap();
    let picture = target(&image, false, &source).unwrap();
    assert!(picture.check_unused(&folders, false).is_ok());
    folders.read("image.png").unwrap();
    assert!(picture.check_unused(&folders, false).is_err());
    assert!(picture.check_unused(&folders, true).is_ok());
}

#[test]
fn folders_and_missing_folders_are_refused_before_any_work() {
    let folder = folder();
    let source = scene(&folder);
    assert!(target(folder.path(), true, &source).is_err());
    assert!(target(&folder.path().join("none/out.png"), false, &source).is_err());
}

#[cfg(unix)]
#[test]
fn a_device_is_written_to_only_by_force() {
    let folder = folder();
    let source = scene(&folder);
    let null = Path::new("/dev/null");
    assert!(target(null, false, &source).is_err());
    assert_eq!(target(null, true, &source).unwrap(), Target::Device(null.to_owned()));
}

#[cfg(unix)]
#[test]
fn a_link_is_followed_and_kept() {
    use std::os::unix::fs::symlink;
    let folder = folder();
    let source = scene(&folder);
    let (real, link) = (folder.path().join("real.png"), folder.path().join("link.png"));
    fs::write(&real, PNG).unwrap();
    symlink(&real, &link).unwrap();
    write(&target(&link, false, &source).unwrap(), b"new").unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::read(&real).unwrap(), b"new");
    fs::remove_file(&real).unwrap();
    assert!(target(&link, false, &source).is_err());
}

#[test]
fn the_report_and_the_picture_do_not_share_a_stream() {
    let folder = folder();
    let request = Request { out: Some(Path::new("-")), force: false, json: true };
    assert!(matches!(Target::new(&request, &scene(&folder)), Err(Failure::Usage(_))));
    let request = Request { out: None, force: false, json: true };
    assert!(matches!(Target::new(&request, &Source::Stdin), Err(Failure::Usage(_))));
}

#[test]
fn a_picture_without_a_name_takes_the_scenes() {
    let request = Request { out: None, force: false, json: false };
    let source = Source::File(PathBuf::from("some/where/no such name 7.svg"));
    let Target::File(file) = Target::new(&request, &source).unwrap() else { panic!("not a file") };
    assert_eq!(file.shown, PathBuf::from("no such name 7.png"));
    assert!(!file.may_replace);
}

fn write(target: &Target, data: &[u8]) -> Result<(), Failure> {
    let output = Output::open(target, &unheard())?;
    output.pipe().write_all(data).map_err(|e| output.failure(&e))?;
    output.commit()
}

#[test]
fn a_picture_appears_whole() {
    let folder = folder();
    let source = scene(&folder);
    let path = folder.path().join("out.png");
    let target = target(&path, false, &source).unwrap();
    let output = Output::open(&target, &unheard()).unwrap();
    output.pipe().write_all(b"half").unwrap();
    assert!(!path.exists());
    assert_eq!(names(&folder).len(), 2, "the temporary and the scene");
    output.pipe().write_all(b" and half").unwrap();
    output.commit().unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"half and half");
    assert_eq!(names(&folder), ["out.png", "scene.svg"]);
}

#[test]
fn an_abandoned_picture_leaves_nothing() {
    let folder = folder();
    let source = scene(&folder);
    let path = folder.path().join("out.png");
    fs::write(&path, PNG).unwrap();
    let output = Output::open(&target(&path, false, &source).unwrap(), &unheard()).unwrap();
    let mut pipe = output.pipe();
    pipe.write_all(b"half").unwrap();
    drop(output);
    assert!(pipe.write_all(b"more").is_err());
    assert_eq!(names(&folder), ["out.png", "scene.svg"]);
    assert_eq!(fs::read(&path).unwrap(), PNG);
}

#[test]
fn a_file_that_appeared_meanwhile_is_kept() {
    let folder = folder();
    let path = folder.path().join("out.png");
    let target = FileTarget { shown: path.clone(), path: path.clone(), may_replace: false };
    let output = Output::open(&Target::File(target), &unheard()).unwrap();
    fs::write(&path, "theirs").unwrap();
    assert!(output.commit().is_err());
    assert_eq!(fs::read(&path).unwrap(), b"theirs");
    assert_eq!(names(&folder), ["out.png"]);
}

#[cfg(unix)]
#[test]
fn permissions_are_those_of_any_new_file_or_of_the_old_one() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let source = scene(&folder);
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
    let path = folder.path().join("out.png");
    write(&target(&path, false, &source).unwrap(), b"x").unwrap();
    assert_eq!(mode(&path), mode(&folder.path().join("scene.svg")));
    fs::write(&path, PNG).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
    write(&target(&path, false, &source).unwrap(), b"x").unwrap();
    assert_eq!(mode(&path), 0o640);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_reported_even_at_the_last_byte() {
    let target = Target::Device(PathBuf::from("/dev/full"));
    let failure = write(&target, b"a few bytes").unwrap_err();
    assert!(failure.to_string().starts_with("/dev/full: "), "{failure}");
    let failure = write(&target, &[0; 100_000]).unwrap_err();
    assert!(failure.to_string().contains("space"), "{failure}");
}

#[test]
fn after_a_signal_nothing_is_written() {
    let folder = folder();
    let source = scene(&folder);
    let path = folder.path().join("out.png");
    let interrupt = unheard();
    for early in [true, false] {
        interrupt.cancel().store(false, std::sync::atomic::Ordering::SeqCst);
        let output = Output::open(&target(&path, false, &source).unwrap(), &interrupt).unwrap();
        output.pipe().write_all(b"the start").unwrap();
        interrupt.cancel().store(true, std::sync::atomic::Ordering::SeqCst);
        if early {
            let error = output.pipe().write_all(b"the rest").unwrap_err();
            assert!(matches!(output.failure(&error), Failure::Interrupted { .. }));
        } else {
            assert!(matches!(output.commit(), Err(Failure::Interrupted { .. })));
        }
    }
    assert_eq!(names(&folder), ["scene.svg"]);
}
