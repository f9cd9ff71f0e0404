//! How large and deep a document becomes when `use` and markers are expanded, found without
//! expanding them.

use super::{selectors, sheet};
use crate::Limits;
use crate::course::href;
use crate::error::{ErrorKind, Fault};
use crate::extension::svg_name;
use roxmltree::Node;
use std::collections::HashMap;

/// usvg works with recursion; deeper than this, a thread of 2 MiB may not be enough for it.
const MAX_DEPTH: usize = 512;

/// Steps for trying all selectors on all elements, at most: seconds.
const MAX_STYLE_STEPS: u64 = 500_000_000;

/// References from gradient to gradient that are followed, at most.
const MAX_GRADIENT_STEPS: usize = 2_000_000;

/// What an element costs with everything inside it.
#[derive(Debug, Clone, Copy, Default)]
struct Weight {
    elements: u64,
    depth: usize,
    /// Vertices of all shapes, an upper bound.
    vertices: u64,
    /// Vertices of those shapes that have markers at each.
    marked: u64,
}

/// Refuses documents that refer to themselves or grow beyond the limits.
pub(super) fn check(root: Node<'_, '_>, limits: &Limits) -> Result<(), Fault> {
    let graph = Graph::new(root);
    graph.check_gradients(root)?;
    let weight = graph.weigh(root)?;
    let refuse = |message: String| Err(Fault::at(root.range().start, ErrorKind::Limit(message)));
    if weight.elements > limits.max_elements as u64 {
        return refuse(format!("`use` makes it more than {} elements", limits.max_elements));
    }
    let max_depth = limits.max_depth.min(MAX_DEPTH);
    if weight.depth > max_depth {
        return refuse(format!("elements are nested deeper than {max_depth}, `use` included"));
    }
    let marker = largest_marker(root);
    if weight.marked.saturating_mul(marker) > limits.max_elements as u64 {
        return refuse(format!("markers make it more than {} elements", limits.max_elements));
    }
    let depth = weight.depth as u64;
    let steps = style_sheets(root).map(|css| selectors::steps(css, depth));
    let steps = steps.fold(0, u64::saturating_add).saturating_mul(weight.elements);
    if steps > MAX_STYLE_STEPS {
        return refuse("its style selectors could take too long for so many elements".into());
    }
    Ok(())
}

/// The texts of all `style` elements.
fn style_sheets<'a>(root: Node<'a, '_>) -> impl Iterator<Item = &'a str> {
    root.descendants().filter(|&n| svg_name(n) == Some("style")).flat_map(sheet::texts)
}

/// Elements of the largest marker.
fn largest_marker(root: Node<'_, '_>) -> u64 {
    root.descendants()
        .filter(|&n| svg_name(n) == Some("marker"))
        .map(|n| n.descendants().filter(Node::is_element).count() as u64)
        .max()
        .unwrap_or(0)
}

/// Whether a style text puts markers at every vertex.
fn marks_vertices(css: &str) -> bool {
    css.contains("marker-mid") || css.contains("marker:")
}

/// What is not expanded further, because it is not drawn.
pub(super) fn is_dropped(name: &str) -> bool {
    matches!(name, "pattern" | "mask" | "clipPath" | "filter")
}

struct Graph<'a, 'input> {
    by_id: HashMap<&'a str, Node<'a, 'input>>,
    /// By node: nothing for one that was not met yet.
    states: Vec<State>,
    /// Whether a style sheet may put markers on any shape.
    all_marked: bool,
}

/// How far the weighing of an element is.
#[derive(Debug, Clone, Copy, Default)]
enum State {
    #[default]
    Unseen,
    /// On the way from the root to the element at work: meeting it again is recursion.
    Open,
    Weighed(Weight),
}

/// An element whose inside is being weighed.
struct Open<'a, 'input> {
    node: Node<'a, 'input>,
    marked: bool,
    next: Option<Node<'a, 'input>>,
    target: Option<Node<'a, 'input>>,
    weight: Weight,
}

impl<'a, 'input> Graph<'a, 'input> {
    fn new(root: Node<'a, 'input>) -> Self {
        let mut by_id = HashMap::new();
        for node in root.descendants() {
            if let Some(id) = node.attribute("id") {
                by_id.entry(id).or_insert(node);
            }
        }
        let all_marked = style_sheets(root).any(marks_vertices);
        // Nodes are numbered from the document on, without gaps.
        let last = root.document().descendants().next_back().map_or(0, |n| n.id().get_usize());
        Self { by_id, states: vec![State::Unseen; last + 1], all_marked }
    }

    /// What the `href` of an element refers to.
    fn target(&self, node: Node<'a, 'input>) -> Option<Node<'a, 'input>> {
        let id = href(node)?.trim().strip_prefix('#')?;
        self.by_id.get(id).copied()
    }

    /// Refuses long chains of gradients, because each is followed to its end from every link.
    fn check_gradients(&self, root: Node<'a, 'input>) -> Result<(), Fault> {
        let is_gradient =
            |n: &Node<'_, '_>| matches!(svg_name(*n), Some("linearGradient" | "radialGradient"));
        let count = root.descendants().filter(is_gradient).count();
        let mut steps = 0;
        for gradient in root.descendants().filter(is_gradient) {
            let chain = core::iter::successors(Some(gradient), |&n| self.target(n));
            // A chain that is longer than there are gradients goes in circles.
            steps += chain.take(count).count();
            if steps > MAX_GRADIENT_STEPS {
                let message = "gradients refer to each other in too long chains".into();
                return Err(Fault::at(gradient.range().start, ErrorKind::Limit(message)));
            }
        }
        Ok(())
    }

    /// The weight of `root`, depth first with an explicit stack.
    fn weigh(mut self, root: Node<'a, 'input>) -> Result<Weight, Fault> {
        let mut stack = vec![self.open(root, false)];
        let mut total = Weight::default();
        while let Some(top) = stack.last_mut() {
            let Some(child) = top.next_inside() else {
                let Open { node, weight, .. } = *top;
                self.states[node.id().get_usize()] = State::Weighed(weight);
                stack.pop();
                match stack.last_mut() {
                    Some(parent) => parent.add(weight),
                    None => total = weight,
                }
                continue;
            };
            if !child.is_element() {
                continue;
            }
            match self.states[child.id().get_usize()] {
                State::Unseen => {}
                State::Weighed(weight) => {
                    top.add(weight);
                    continue;
                }
                State::Open => {
                    let kind = ErrorKind::Element {
                        element: "use".into(),
                        message: "it refers to itself, directly or through others".into(),
                    };
                    return Err(Fault::at(top.node.range().start, kind));
                }
            }
            let marked = top.marked;
            stack.push(self.open(child, marked));
        }
        Ok(total)
    }

    fn open(&mut self, node: Node<'a, 'input>, outer_marked: bool) -> Open<'a, 'input> {
        self.states[node.id().get_usize()] = State::Open;
        let name = svg_name(node).unwrap_or_default();
        let marked = outer_marked
            || self.all_marked
            || node.has_attribute("marker-mid")
            || node.attribute("style").is_some_and(marks_vertices);
        let vertices = vertices(node, name);
        let weight =
            Weight { elements: 1, depth: 1, vertices, marked: if marked { vertices } else { 0 } };
        let target = if name == "use" { self.target(node) } else { None };
        let next =
            if is_dropped(name) || svg_name(node).is_none() { None } else { node.first_child() };
        Open { node, marked, next, target, weight }
    }
}

impl<'a, 'input> Open<'a, 'input> {
    /// The next of the children, and at last what a `use` refers to.
    fn next_inside(&mut self) -> Option<Node<'a, 'input>> {
        let Some(child) = self.next else { return self.target.take() };
        self.next = child.next_sibling();
        Some(child)
    }

    /// Takes in what one inside weighs. Under our markers all its vertices count as marked, even
    /// if it was weighed elsewhere.
    fn add(&mut self, inner: Weight) {
        let own = &mut self.weight;
        own.elements = own.elements.saturating_add(inner.elements);
        own.depth = own.depth.max(inner.depth.saturating_add(1));
        own.vertices = own.vertices.saturating_add(inner.vertices);
        let marked = if self.marked { inner.vertices } else { inner.marked };
        own.marked = own.marked.saturating_add(marked);
    }
}

/// An upper bound of a shape's vertices: each takes at least two characters.
fn vertices(node: Node<'_, '_>, name: &str) -> u64 {
    let text = match name {
        "path" => node.attribute("d"),
        "polyline" | "polygon" => node.attribute("points"),
        "line" => return 2,
        _ => None,
    };
    text.map_or(0, |t| t.len() as u64 / 2 + 1)
}
