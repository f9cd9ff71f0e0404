//! Links in Markdown lead to files that exist.

use super::Violation;

/// Checks every relative link and image; `exists` answers for paths relative to the root.
pub(super) fn check(file: &str, content: &str, exists: &dyn Fn(&str) -> bool) -> Vec<Violation> {
    let mut found = Vec::new();
    let mut fenced = false;
    for (index, line) in content.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
        }
        if fenced {
            continue;
        }
        for target in targets(line) {
            match resolve(file, target) {
                None => {}
                Some(Ok(path)) if exists(&path) => {}
                Some(Ok(path)) => {
                    found.push(Violation::new(file, index + 1, format!("no {path} to link to")));
                }
                Some(Err(())) => {
                    let message = format!("{target} leads out of the project");
                    found.push(Violation::new(file, index + 1, message));
                }
            }
        }
    }
    found
}

/// What stands in `](…)`, `src="…"` and `href="…"`, inline code apart.
fn targets(line: &str) -> Vec<&str> {
    let mut found = Vec::new();
    for prose in line.split('`').step_by(2) {
        for (open, close) in [("](", ')'), ("src=\"", '"'), ("href=\"", '"')] {
            let starts = prose.match_indices(open).map(|(at, _)| &prose[at + open.len()..]);
            found.extend(starts.filter_map(|rest| rest.split(close).next()));
        }
    }
    found
}

/// The path from the root that a link means; `None` if it leads to the web or within the page.
fn resolve(file: &str, target: &str) -> Option<Result<String, ()>> {
    let target = target.split(['#', ' ']).next().unwrap_or_default();
    if target.is_empty() || target.contains("://") || target.starts_with("mailto:") {
        return None;
    }
    let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
    let mut path: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in target.split('/') {
        match part {
            "" | "." => {}
            ".." if path.pop().is_none() => return Some(Err(())),
            ".." => {}
            name => path.push(name),
        }
    }
    Some(Ok(path.join("/")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn messages(content: &str) -> Vec<String> {
        let exists = |path: &str| ["docs/a.md", "assets/b.png", "README.md"].contains(&path);
        check("docs/a.md", content, &exists).iter().map(Violation::to_string).collect()
    }

    #[test]
    fn links_that_lead_somewhere_pass() {
        let text = "[a](a.md) [a](./a.md#part) ![b](../assets/b.png \"title\") [w](https://x.org/y)\n\
                    [in](#part) <img src=\"../assets/b.png\"> `[code](nowhere)`\n\
                    ```\n[code](nowhere)\n```\n[readme](../README.md)\n";
        assert_eq!(messages(text), Vec::<String>::new());
    }

    #[test]
    fn links_that_lead_nowhere_are_found() {
        assert_eq!(messages("\n[a](c.md)\n"), ["docs/a.md:2: no docs/c.md to link to"]);
        assert_eq!(messages("![a](b.png)\n"), ["docs/a.md:1: no docs/b.png to link to"]);
        assert_eq!(
            messages("[a](../../x.md)\n"),
            ["docs/a.md:1: ../../x.md leads out of the project"]
        );
    }
}
