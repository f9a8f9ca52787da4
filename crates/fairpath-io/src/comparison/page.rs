//! The page: markup, style and script that lie beside this file, with the data between them.

use super::Comparison;
use super::data::Data;

const MARKUP: &str = include_str!("page.html");
const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

pub(super) fn html(comparison: &Comparison) -> String {
    let data = serde_json::to_string(&Data::of(comparison)).unwrap_or_else(|_| "null".into());
    // A name that contains the end of a script must not end it.
    let data = data.replace('<', "\\u003c");
    // One pass, so that what is put in is not searched for places in turn.
    let mut out = String::with_capacity(MARKUP.len() + STYLE.len() + SCRIPT.len() + data.len());
    let mut rest = MARKUP;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, after) = after.split_once("}}").unwrap_or(("", after));
        out.push_str(before);
        out.push_str(match name {
            "style" => STYLE,
            "script" => SCRIPT,
            "data" => &data,
            _ => "",
        });
        rest = after;
    }
    out.push_str(rest);
    out
}
