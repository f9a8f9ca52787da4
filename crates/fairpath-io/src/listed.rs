//! Files that list what is to be done, as JSON: `{"format": …, "version": 1, LIST: [{"do": …}, …]}`. Each thing that cannot be read is named, not the first alone.

use crate::error::Fault;
use crate::input::Budget;
use crate::limits::Limits;
use crate::strokes_json::{check_format, check_version, json_fault};
use serde::Deserialize;
use serde_json::{Error, Map, Value};

/// The words of such a format.
pub(crate) struct Listed {
    /// In the file's `format`.
    pub(crate) format: &'static str,
    /// The name of the list.
    pub(crate) list: &'static str,
    /// What one thing of it is called.
    pub(crate) one: &'static str,
}

#[derive(Deserialize)]
struct Head {
    format: String,
    version: u64,
    #[serde(flatten)]
    rest: Map<String, Value>,
}

impl Listed {
    /// All things of the list; `read` gets each with the word in its `do`.
    pub(crate) fn parse<T>(
        &self,
        text: &str,
        limits: &Limits,
        read: impl Fn(Value, Option<&str>) -> Result<T, Error>,
    ) -> Result<Vec<T>, Fault> {
        let Head { format, version, mut rest } = serde_json::from_str(text).map_err(|e| json_fault(&e))?;
        let told = |e: Error| Fault::new("the head of the file", e);
        check_format(&format, self.format).map_err(told)?;
        check_version(version).map_err(told)?;
        let Some(Value::Array(list)) = rest.remove(self.list) else {
            return Err(Fault::new("the file as a whole", format_args!("there is no list `{}`", self.list)));
        };
        let mut items = Budget::items(limits);
        let (mut good, mut problems) = (Vec::with_capacity(list.len()), Vec::new());
        for (i, value) in list.into_iter().enumerate() {
            let number = i + 1;
            items.spend(|| format!("{} {number}", self.one))?;
            let word = value.get("do").and_then(Value::as_str).map(str::to_owned);
            match read(value, word.as_deref()) {
                Ok(thing) => good.push(thing),
                Err(e) => {
                    let word = word.map(|word| format!(" ({word})")).unwrap_or_default();
                    problems.push(format!("{} {number}{word}: {e}", self.one));
                }
            }
        }
        if problems.is_empty() {
            return Ok(good);
        }
        let place = match problems.len() {
            1 => format!("one {}", self.one),
            count => format!("{count} {}s", self.one),
        };
        Err(Fault::new(place, problems.join("; ")))
    }
}
