//! Pages in Markdown.

use super::Page;
use crate::Asset;
use std::fmt::Write;

const INTRO: &str = "# Gallery\n\n\
What the documents that this project was built from draw, drawn by Scumble, with what is to be seen on \
it. `cargo xtask gallery` draws everything here anew, to the same bytes; [performance](../performance.md) \
has what things cost, [quality](../quality.md) the filters in numbers, and the [errata](../errata.md) \
where the documents err.\n";

/// The list of the pages.
pub(super) fn index(pages: &[&Page]) -> Asset {
    let mut out = INTRO.to_owned();
    for page in pages {
        let count = page.figures.len();
        let _ = write!(out, "\n- [{}]({}.md), {count} pictures", page.title, page.name);
    }
    out.push_str("\n- [Errata of the literature](../errata.md): what errs in the documents, and where that is shown\n");
    Asset { path: "README.md".to_owned(), bytes: out.into_bytes() }
}

/// One page.
pub(super) fn page(page: &Page) -> Asset {
    let mut out = format!("# {}\n\n{}\n", page.title, page.intro);
    let name = page.name;
    let _ = write!(
        out,
        "\n`cargo xtask gallery {name}` draws the pictures of this page anew, and `cargo xtask gallery \
         {name}/NAME` one of them, NAME being that of its file.\n"
    );
    for figure in page.figures {
        let (title, name) = (figure.title, figure.name);
        let _ = write!(out, "\n## {title}\n\n![{title}]({}/{name}.png)\n", page.name);
        let _ = write!(out, "\n{}\n", figure.look);
    }
    Asset { path: format!("{}.md", page.name), bytes: out.into_bytes() }
}
