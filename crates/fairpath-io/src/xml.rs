//! XML read into a tree and text made safe for XML, for every format that is XML.

use crate::error::Fault;
use crate::limits::Limits;
use quick_xml::escape;
use roxmltree::{Document, Node, ParsingOptions};
use std::borrow::Cow;

/// The tree of an XML text. Entities that the file declares itself are expanded as far as the size limit goes; nothing outside the
/// file is ever read.
pub(crate) fn parse<'t>(text: &'t str, limits: &Limits) -> Result<Document<'t>, Fault> {
    guard_entities(text, limits)?;
    let nodes_limit = u32::try_from(limits.max_nodes).unwrap_or(u32::MAX);
    let options = ParsingOptions { allow_dtd: true, nodes_limit, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|e| match e {
        roxmltree::Error::NodesLimitReached => {
            let place = "the file as a whole".into();
            Fault::OverLimit { place, what: "elements", max: limits.max_nodes, limit: "max_nodes" }
        }
        e => Fault::new(
            format_args!("line {}, column {}", e.pos().row, e.pos().col),
            format_args!("this is not XML: {e}; the file may be cut off"),
        ),
    })?;
    check_depth(&document, limits)?;
    Ok(document)
}

/// Refuses nesting beyond the limit: what follows walks up and down the tree.
fn check_depth(document: &Document<'_>, limits: &Limits) -> Result<(), Fault> {
    // Parents come before their children, in the order of their ids.
    let mut depths: Vec<u64> = Vec::new();
    for node in document.descendants() {
        let depth = node.parent().map_or(0, |parent| depths[parent.id().get_usize()] + 1);
        if depth > limits.max_depth {
            let max = limits.max_depth;
            return Err(Fault::OverLimit { place: place(node), what: "levels of nesting", max, limit: "max_depth" });
        }
        depths.push(depth);
    }
    Ok(())
}

/// Refuses entities that could expand beyond the size limit: nested ones, and large ones referred to often.
fn guard_entities(text: &str, limits: &Limits) -> Result<(), Fault> {
    let mut longest = 0_u64;
    for (at, mark) in text.match_indices("<!ENTITY") {
        let rest = &text[at + mark.len()..];
        let Some(open) = rest.find(['"', '\'']) else { continue };
        let quote = if rest[open..].starts_with('"') { '"' } else { '\'' };
        let value = rest[open + 1..].split(quote).next().unwrap_or_default();
        let nested = value.match_indices('&').any(|(i, _)| !value[i + 1..].starts_with('#'));
        if nested {
            let line = 1 + text[..at].matches('\n').count();
            return Err(Fault::new(
                format_args!("line {line}"),
                "an entity refers to another entity; write its text out, such files are refused for safety",
            ));
        }
        longest = longest.max(value.len() as u64);
    }
    if longest == 0 {
        return Ok(());
    }
    let references = text.matches('&').count() as u64;
    if references.saturating_mul(longest) > limits.max_bytes {
        let place = "the entities of the file".into();
        return Err(Fault::OverLimit { place, what: "bytes", max: limits.max_bytes, limit: "max_bytes" });
    }
    Ok(())
}

/// The line, the element and its id, for messages.
pub(crate) fn place(node: Node<'_, '_>) -> String {
    let line = node.document().text_pos_at(node.range().start).row;
    let tag = node.tag_name().name();
    let id = node.attribute("id").or_else(|| node.attribute(("http://www.w3.org/XML/1998/namespace", "id")));
    match id {
        Some(id) => format!("line {line}, <{tag} id={id:?}>"),
        None => format!("line {line}, <{tag}>"),
    }
}

/// All text directly inside an element, comments left out.
pub(crate) fn inner_text(node: Node<'_, '_>) -> String {
    node.children().filter(Node::is_text).filter_map(|n| n.text()).collect()
}

/// `text` as an attribute's value. Characters that XML cannot hold at all become U+FFFD.
pub(crate) fn attribute(text: &str) -> String {
    escape::escape(legal(text)).replace('\n', "&#10;").replace('\t', "&#9;")
}

/// `text` as an element's content. Characters that XML cannot hold at all become U+FFFD.
pub(crate) fn content(text: &str) -> String {
    escape::escape(legal(text)).into_owned()
}

/// Whether XML 1.0 can hold the character.
pub(crate) fn is_legal(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..)
}

pub(crate) fn legal(text: &str) -> Cow<'_, str> {
    if text.chars().all(is_legal) {
        Cow::Borrowed(text)
    } else {
        Cow::Owned(text.chars().map(|c| if is_legal(c) { c } else { '\u{fffd}' }).collect())
    }
}
