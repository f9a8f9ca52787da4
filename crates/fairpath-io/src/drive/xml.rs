//! XML as it is written here: elements with attributes in order.

use crate::error::Error;
use crate::xml::legal;
use quick_xml::Writer;
use quick_xml::events::{BytesCData, BytesDecl, BytesEnd, BytesStart, BytesText, Event};
use std::io;

/// A document that is being written.
pub(crate) struct Xml {
    writer: Writer<Vec<u8>>,
    failed: Option<io::Error>,
}

impl Default for Xml {
    fn default() -> Self {
        let mut xml = Self { writer: Writer::new_with_indent(Vec::new(), b' ', 1), failed: None };
        xml.event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)));
        xml
    }
}

impl Xml {
    fn event(&mut self, event: Event<'_>) {
        if let Err(error) = self.writer.write_event(event) {
            self.failed.get_or_insert(error);
        }
    }

    /// Begins an element.
    pub(crate) fn open(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.event(Event::Start(element(name, attributes)));
    }

    /// Ends an element.
    pub(crate) fn close(&mut self, name: &str) {
        self.event(Event::End(BytesEnd::new(name)));
    }

    /// An element without content.
    pub(crate) fn empty(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.event(Event::Empty(element(name, attributes)));
    }

    /// Text.
    pub(crate) fn text(&mut self, text: &str) {
        self.event(Event::Text(BytesText::new(&legal(text))));
    }

    /// An element with nothing but a text in it.
    pub(crate) fn leaf(&mut self, name: &str, attributes: &[(&str, &str)], text: &str) {
        self.open(name, attributes);
        self.text(text);
        self.close(name);
    }

    /// Text that is taken as it stands.
    pub(crate) fn cdata(&mut self, text: &str) {
        self.event(Event::CData(BytesCData::new(text)));
    }

    /// The text.
    pub(crate) fn finish(self) -> Result<Vec<u8>, Error> {
        match self.failed {
            Some(error) => {
                Err(Error::Unwritable { format: "XML", place: "the document".to_owned(), problem: error.to_string() })
            }
            None => {
                let mut bytes = self.writer.into_inner();
                bytes.push(b'\n');
                Ok(bytes)
            }
        }
    }
}

/// A tag; of its attributes, characters that XML has no way to write become the sign for what is unknown.
fn element<'a>(name: &'a str, attributes: &[(&str, &str)]) -> BytesStart<'a> {
    let mut element = BytesStart::new(name);
    for (key, value) in attributes {
        element.push_attribute((*key, legal(value).as_ref()));
    }
    element
}

/// A number so that it reads back to the same bits.
pub(crate) fn number(x: f64) -> String {
    // The minus of a zero means nothing here.
    format!("{}", if x == 0.0 { 0.0 } else { x })
}
