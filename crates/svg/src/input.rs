//! From bytes to a checked XML tree: everything that could make later steps slow, deep or large
//! is refused here.

use crate::error::{ErrorKind, Fault};
use crate::{Limits, Position, SvgError};
use roxmltree::{Document, Node, ParsingOptions};

/// The text of a document, or why it is none.
pub(crate) fn text<'a>(bytes: &'a [u8], limits: &Limits) -> Result<&'a str, SvgError> {
    let encoding = |message: &str| SvgError::new(ErrorKind::Encoding(message.into()));
    if bytes.len() > limits.max_document_bytes {
        return Err(SvgError::new(ErrorKind::Limit(format!(
            "the document has {} bytes, more than {}",
            bytes.len(),
            limits.max_document_bytes
        ))));
    }
    match bytes {
        [0x1f, 0x8b, ..] => {
            return Err(encoding("the document is compressed (svgz); decompress it first"));
        }
        [0xff, 0xfe, ..] | [0xfe, 0xff, ..] | [b'<', 0, ..] | [0, b'<', ..] => {
            return Err(encoding("the document is UTF-16; only UTF-8 is read"));
        }
        _ => {}
    }
    core::str::from_utf8(bytes).map_err(|e| {
        let valid = core::str::from_utf8(&bytes[..e.valid_up_to()]).unwrap_or_default();
        let kind = ErrorKind::Encoding("a byte is not UTF-8, and only UTF-8 is read".into());
        SvgError::at(Position::at(valid, valid.len()), kind)
    })
}

/// The XML tree of a text.
pub(crate) fn tree<'a>(text: &'a str, limits: &Limits) -> Result<Document<'a>, SvgError> {
    check_attributes(text, limits).map_err(|fault| fault.locate(text))?;
    check_entities(text, limits)?;
    // Text, comments and the root are nodes too.
    let nodes = limits.max_elements.saturating_mul(4).saturating_add(64);
    let options = ParsingOptions {
        allow_dtd: true,
        nodes_limit: u32::try_from(nodes).unwrap_or(u32::MAX),
        entity_resolver: None,
    };
    let document = Document::parse_with_options(text, options).map_err(|e| xml_error(&e))?;
    check_tree(&document, limits).map_err(|fault| fault.locate(text))?;
    Ok(document)
}

fn xml_error(error: &roxmltree::Error) -> SvgError {
    let pos = error.pos();
    let kind = match error {
        roxmltree::Error::NodesLimitReached => {
            ErrorKind::Limit("the document has too many elements, texts and comments".into())
        }
        _ => {
            // The position stands in front of our message; do not say it twice.
            let message = error.to_string();
            let said = format!(" at {}:{}", pos.row, pos.col);
            ErrorKind::Xml(message.replace(&said, ""))
        }
    };
    SvgError::at(Position { line: pos.row as usize, column: pos.col as usize }, kind)
}

/// Refuses tags with too many attributes, because the XML parser compares each with each. Every
/// `=` outside quotes counts as an attribute; in a document type, also those inside.
fn check_attributes(text: &str, limits: &Limits) -> Result<(), Fault> {
    let bytes = text.as_bytes();
    let mut at = 0;
    while let Some(start) = text[at..].find('<').map(|i| at + i) {
        let tail = &text[start..];
        let skip_to = |end: &str| tail.find(end).map_or(bytes.len(), |i| start + i + end.len());
        if tail.starts_with("<!--") {
            at = skip_to("-->");
        } else if tail.starts_with("<![CDATA[") {
            at = skip_to("]]>");
        } else {
            let count_quoted = tail.starts_with("<!DOCTYPE");
            let (length, equals) = measure_tag(&bytes[start..], count_quoted);
            if equals > limits.max_attributes {
                let message = format!(
                    "an element has {equals} attributes, more than {}",
                    limits.max_attributes
                );
                return Err(Fault::at(start, ErrorKind::Limit(message)));
            }
            at = start + length;
        }
    }
    Ok(())
}

/// The length of a tag in bytes and the number of `=` in it. The brackets of a document type's
/// internal subset nest.
fn measure_tag(bytes: &[u8], count_quoted: bool) -> (usize, usize) {
    let (mut quote, mut brackets, mut equals) = (None, 0_usize, 0);
    for (i, &c) in bytes.iter().enumerate() {
        match (quote, c) {
            (Some(q), c) if c == q => quote = None,
            (Some(_), b'=') if count_quoted => equals += 1,
            (Some(_), _) => {}
            (None, b'"' | b'\'') => quote = Some(c),
            (None, b'=') => equals += 1,
            (None, b'[') if count_quoted => brackets += 1,
            (None, b']') if count_quoted => brackets = brackets.saturating_sub(1),
            (None, b'>') if brackets == 0 => return (i + 1, equals),
            (None, _) => {}
        }
    }
    (bytes.len(), equals)
}

/// Most references that the XML parser follows for the sake of one.
const NESTED_REFERENCES: usize = 256;

/// Refuses documents whose entities could multiply beyond the limit: no reference can bring more
/// than the longest value times the number of references that the parser follows for it.
fn check_entities(text: &str, limits: &Limits) -> Result<(), SvgError> {
    let mut longest = 0;
    let mut nested = false;
    for declaration in text.split("<!ENTITY").skip(1) {
        // From quote to quote; what follows a declaration does not matter.
        let value = declaration
            .find(['"', '\''])
            .and_then(|i| declaration[i + 1..].split(&declaration[i..=i]).next())
            .unwrap_or(declaration);
        longest = longest.max(value.len());
        nested |= value.contains('&');
    }
    if longest == 0 {
        return Ok(());
    }
    let per_reference = longest.saturating_mul(if nested { NESTED_REFERENCES } else { 1 });
    let references = text.bytes().filter(|&c| c == b'&').count();
    if references.saturating_mul(per_reference) > limits.max_entity_bytes {
        let message = format!("entities may add more than {} bytes", limits.max_entity_bytes);
        return Err(SvgError::new(ErrorKind::Limit(message)));
    }
    Ok(())
}

/// Refuses trees that are too deep or too large.
fn check_tree(document: &Document<'_>, limits: &Limits) -> Result<(), Fault> {
    let mut elements = 0_usize;
    let mut depth = 0_usize;
    let mut node = document.root();
    let limit = |node: Node<'_, '_>, message: String| {
        Err(Fault::at(node.range().start, ErrorKind::Limit(message)))
    };
    // A walk without recursion, so that depth costs no stack.
    loop {
        if node.is_element() {
            elements += 1;
            if elements > limits.max_elements {
                return limit(node, format!("more than {} elements", limits.max_elements));
            }
        }
        if let Some(child) = node.first_child() {
            depth += 1;
            if depth > limits.max_depth {
                return limit(
                    child,
                    format!("elements are nested deeper than {}", limits.max_depth),
                );
            }
            node = child;
            continue;
        }
        loop {
            if let Some(next) = node.next_sibling() {
                node = next;
                break;
            }
            match node.parent() {
                Some(parent) => node = parent,
                None => return Ok(()),
            }
            depth -= 1;
        }
    }
}
