//! Every command, where its output goes nowhere.

use crate::common::{Desk, rgba_png};
use std::fs;

/// Two pictures of noise, which no encoder makes small enough for a pipe to hold.
fn desk() -> Desk {
    let noise = |seed: u32| {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let [r, g, b, _] = state.to_be_bytes();
            [r, g, b, 255]
        };
        rgba_png(300, &(0..300 * 300).map(|_| next()).collect::<Vec<_>>())
    };
    let desk = Desk::with("a.png", noise(1));
    desk.put("b.png", noise(2));
    desk
}

const TO_A_STREAM: [&str; 4] = [
    "warp a.png OUT --matrix 1,0,0,0,1,0,0,0,1",
    "diff a.png b.png -o OUT",
    "spectrum a.png OUT",
    "filter a.png OUT --kernel box:1",
];

#[test]
fn a_reader_that_leaves_is_told_in_a_line() {
    let desk = desk();
    for arguments in TO_A_STREAM {
        desk.run_unread(&arguments.replace("OUT", "-")).failed(1, "standard output: ", &[]);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_in_a_line() {
    let desk = desk();
    for arguments in TO_A_STREAM {
        let full = arguments.replace("OUT", "/dev/full --force");
        desk.run(&full).failed(1, "/dev/full: ", &["space"]);
    }
    for report in ["info a.png", "info a.png --json", "diff a.png b.png", "diff a.png b.png --json"]
    {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = desk.command(report).stdout(full).output().unwrap();
        let err = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{report}: {err}");
        assert!(err.starts_with("scumble: standard output: "), "{report}: {err}");
    }
    assert_eq!(desk.names(), ["a.png", "b.png"]);
}
