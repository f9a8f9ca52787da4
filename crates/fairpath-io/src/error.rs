//! What can go wrong with a file, said so that a person can repair it.

use fairpath_curve::SplineError;
use std::fmt::Display;
use std::io;
use thiserror::Error;

/// Why a file could not be read or written.
///
/// Every text names the file, the place in it, what is wrong or was expected, and where it is not plain, what to do.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The operating system refused to open or read the file.
    #[error("{file}: cannot be read: {source}")]
    Read {
        /// The file's name, or `-` for standard input.
        file: String,
        /// What the system says.
        source: io::Error,
    },
    /// The operating system refused to create, write or replace the file; what was there before is untouched.
    #[error("{file}: cannot be written: {source}; what was there before is unchanged")]
    Write {
        /// The file's name.
        file: String,
        /// What the system says.
        source: io::Error,
    },
    /// Neither the name nor the content tells the format.
    #[error("{file}: {problem}; expected {expected}")]
    UnknownFormat {
        /// The file's name.
        file: String,
        /// What was seen instead.
        problem: String,
        /// The formats that would do.
        expected: &'static str,
    },
    /// The file breaks the rules of its format.
    #[error("{file}: {place}: {problem}")]
    Malformed {
        /// The file's name.
        file: String,
        /// Line, element, stroke or spline.
        place: String,
        /// What is wrong, what was expected and what to do.
        problem: String,
    },
    /// The file is larger than the caller allows (see [`Limits`](crate::Limits)).
    #[error("{file}: {place}: more than {max} {what}; split the file, or raise `{limit}` if it is trusted")]
    OverLimit {
        /// The file's name.
        file: String,
        /// Where the limit was reached.
        place: String,
        /// What there is too much of, such as `bytes`.
        what: &'static str,
        /// How much is allowed.
        max: u64,
        /// The field of [`Limits`](crate::Limits) that says so.
        limit: &'static str,
    },
    /// The segments of a spline in the file do not make a spline.
    #[error("{file}: spline {name:?}: {source}; the file was changed after it was written, or its writer is faulty")]
    Spline {
        /// The file's name.
        file: String,
        /// The spline's name.
        name: String,
        /// What does not fit.
        source: SplineError,
    },
    /// Shapes in the file cannot be French curves; all that are wrong are named, each with its place.
    #[error("{file}: {}", listed(.problems))]
    Templates {
        /// The file's name.
        file: String,
        /// Place, what is wrong and what to do, in the order of the file.
        problems: Vec<String>,
    },
    /// What is to be written cannot be expressed in the format.
    #[error("{format}: {place}: {problem}")]
    Unwritable {
        /// The format.
        format: &'static str,
        /// Stroke or spline.
        place: String,
        /// Why not, and what to do.
        problem: String,
    },
}

/// Lines of a text beyond this many are only counted.
const MOST_LISTED: usize = 30;

/// All problems in one text, a line each if there are several.
fn listed(problems: &[String]) -> String {
    if let [problem] = problems {
        return problem.clone();
    }
    let mut text = format!("{} problems:", problems.len());
    for problem in problems.iter().take(MOST_LISTED) {
        text.push_str("\n  ");
        text.push_str(problem);
    }
    if problems.len() > MOST_LISTED {
        text.push_str(&format!("\n  … and {} more", problems.len() - MOST_LISTED));
    }
    text
}

/// An error of a parser, which does not know the file's name.
#[derive(Debug)]
pub(crate) enum Fault {
    Malformed { place: String, problem: String },
    OverLimit { place: String, what: &'static str, max: u64, limit: &'static str },
    Spline { name: String, source: SplineError },
    Templates(Vec<String>),
    Io(io::Error),
}

impl Fault {
    pub(crate) fn new(place: impl Display, problem: impl Display) -> Self {
        Self::Malformed { place: place.to_string(), problem: problem.to_string() }
    }

    pub(crate) fn in_file(self, file: &str) -> Error {
        let file = file.to_owned();
        match self {
            Self::Malformed { place, problem } => Error::Malformed { file, place, problem },
            Self::OverLimit { place, what, max, limit } => Error::OverLimit { file, place, what, max, limit },
            Self::Spline { name, source } => Error::Spline { file, name, source },
            Self::Templates(problems) => Error::Templates { file, problems },
            Self::Io(source) => Error::Read { file, source },
        }
    }
}
