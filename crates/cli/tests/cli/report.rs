use crate::common::{Desk, SQUARE};
use serde_json::Value;

/// A scene that is drawn but for one element.
const ODD: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="10" height="8">
  <text x="1" y="1">not drawn yet</text>
</svg>
"#;

fn parse(out: &[u8]) -> Value {
    assert_eq!(out.iter().filter(|&&b| b == b'\n').count(), 1, "one line");
    serde_json::from_slice(out).expect("JSON")
}

#[test]
fn a_report_says_what_was_done() {
    let desk = Desk::with("a.svg", SQUARE);
    let run = desk.run("render a.svg b.png --json -j 2 --crop 1,2,3,4 --samples 4").succeeded();
    let report = parse(&run.out);
    assert_eq!(report["scene"], "a.svg");
    assert_eq!(report["output"], "b.png");
    assert_eq!(report["profile"], "svg");
    assert_eq!((report["width"].as_u64(), report["height"].as_u64()), (Some(3), Some(4)));
    assert_eq!(report["canvas"]["width"], 10);
    assert_eq!(report["crop"]["y"], 2);
    assert_eq!(report["samples"], 4);
    assert_eq!(report["threads"], 2);
    assert!(report["warnings"].as_array().unwrap().is_empty());
    for time in ["parse_ms", "render_ms", "encode_ms"] {
        let ms = report[time].as_f64().unwrap();
        assert!((0.0..60_000.0).contains(&ms), "{time}: {ms}");
    }
}

#[test]
fn warnings_are_told_with_their_place() {
    let desk = Desk::with("a.svg", ODD);
    let run = desk.run("render a.svg b.png --json");
    assert_eq!(run.code, Some(0));
    assert!(run.err.starts_with("scumble: a.svg:2:"), "{}", run.err);
    assert!(run.err.contains("warning: ") && run.err.contains("text"), "{}", run.err);
    let warnings = &parse(&run.out)["warnings"];
    assert_eq!(warnings[0]["line"], 2);
    assert!(warnings[0]["message"].as_str().unwrap().contains("text"));
    assert_eq!(warnings[0]["count"], 1);
}

#[test]
fn quiet_is_quiet_but_the_report_stays_complete() {
    let desk = Desk::with("a.svg", ODD);
    let run = desk.run("render a.svg b.png --json -q").succeeded();
    assert_eq!(parse(&run.out)["warnings"].as_array().unwrap().len(), 1);
    assert!(desk.run("render a.svg b.png -q").succeeded().out.is_empty());
}

#[test]
fn a_failure_prints_no_report() {
    let desk = Desk::with("a.svg", "<svg");
    let run = desk.run("render a.svg b.png --json").failed(1, "a.svg:", &[]);
    assert!(run.out.is_empty());
}
