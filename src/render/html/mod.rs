//! The manual as a static site that works from `file://`, asks no other host for anything, and needs no JavaScript to
//! be read.
//!
//! Layout is Tera's: a page is a template filled with plain values. Everything from the tree is text until this room
//! makes markup of it ([`escape`], [`prose`], [`highlight`], [`listing`]); a template escapes whatever was not made
//! here, so a name or a comment cannot become markup. Pages are independent of each other and rendered in parallel.

mod context;
mod entity;
mod error;
mod escape;
mod highlight;
mod listing;
mod lists;
mod prose;
mod run;
mod script;
mod site;
mod table;
mod value;

use std::collections::BTreeMap;
use std::collections::BTreeSet;

use rayon::prelude::*;

use crate::book::view::Book;

pub use error::Error;
use site::{Job, Site};

/// How the site is made.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The user's templates and style files: name, such as `templates/html/entity.html`, and text.
    pub overrides: BTreeMap<String, String>,
}

/// A file of the site.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// Path below the site's root, with `/`.
    pub path: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

/// How many times [`render`] will report progress.
#[must_use]
pub fn steps(book: &Book) -> usize {
    Job::all(book).len()
}

/// The site, its files in a fixed order. `progress` is called once for each page as it is finished, with 1, from any
/// thread; [`steps`] tells how often.
///
/// # Errors
///
/// A template or style file that cannot be read or fails, and two pages at the same path.
pub fn render(book: &Book, options: &Options, progress: &(dyn Fn(usize) + Sync)) -> Result<Vec<Page>, Error> {
    let site = Site::new(book, options)?;
    let jobs = Job::all(book);
    let rendered: Vec<Result<Page, Error>> = jobs
        .par_iter()
        .map(|job| {
            let page = site.page(job);
            progress(1);
            page
        })
        .collect();
    let mut pages = rendered.into_iter().collect::<Result<Vec<_>, _>>()?;
    pages.extend(site.assets());
    refuse_collisions(&pages)?;
    Ok(pages)
}

/// Paths must differ by more than case, since some file systems do not tell case apart.
fn refuse_collisions(pages: &[Page]) -> Result<(), Error> {
    let mut seen = BTreeSet::new();
    match pages.iter().find(|page| !seen.insert(page.path.to_lowercase())) {
        Some(page) => Err(Error::Collision { path: page.path.clone() }),
        None => Ok(()),
    }
}
