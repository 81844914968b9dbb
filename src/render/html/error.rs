//! What can go wrong: a user's template or style file, or two pages at the same path.

use std::fmt;

/// Why there is no site.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// A template cannot be read, or fails on a page.
    Template {
        /// Its name, such as `templates/html/entity.html`.
        file: String,
        /// Line, from 1; 0 where the template as a whole is at fault.
        line: usize,
        /// Column, from 1; 0 where unknown.
        column: usize,
        /// What is wrong.
        message: String,
    },
    /// The syntax definition for highlighting cannot be read.
    Syntax {
        /// Its name.
        file: String,
        /// What is wrong.
        message: String,
    },
    /// Two pages claim the same path.
    Collision {
        /// The path.
        path: String,
    },
}

impl Error {
    /// From an error of Tera's that came up with the template `name`.
    pub(super) fn from_tera(name: &str, error: &tera::Error) -> Self {
        use tera::ErrorKind::{CircularExtend, CircularInclude, MissingParent, RenderingError, SyntaxError};
        let whole = |name: &str| (name.to_owned(), 0, 0, error.to_string());
        let (name, line, column, message) = match error.kind() {
            SyntaxError(report) | RenderingError(report) => {
                let span = report.span();
                (report.filename().to_owned(), span.start_line, span.start_col + 1, report.message().to_owned())
            }
            CircularExtend { tpl, .. } | CircularInclude { tpl, .. } => whole(tpl),
            MissingParent { current, .. } => whole(current),
            _ => whole(name),
        };
        Self::Template { file: format!("templates/html/{name}"), line, column, message: one_line(&message) }
    }
}

fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Template { file, line: 0, message, .. } => write!(f, "{file}: {message}"),
            Self::Template { file, line, column, message } => write!(f, "{file}:{line}:{column}: {message}"),
            Self::Syntax { file, message } => write!(f, "{file}: {message}"),
            Self::Collision { path } => write!(f, "two pages have the path `{path}`"),
        }
    }
}

impl std::error::Error for Error {}
