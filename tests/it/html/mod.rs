//! Tests of `render::html`.

mod browser;
pub(crate) mod crawl;
pub(crate) mod fixture;
mod pages;
mod source;

use rungbook::book::view::Book;
use rungbook::render::html::{Options, Page, render};

/// The site of a book with the embedded theme.
pub(crate) fn site(book: &Book) -> Vec<Page> {
    render(book, &Options::default(), &|_| {}).expect("the embedded theme is right")
}

/// A page's text.
pub(crate) fn text<'a>(pages: &'a [Page], path: &str) -> &'a str {
    let page = pages.iter().find(|page| page.path == path).unwrap_or_else(|| panic!("no page {path}"));
    std::str::from_utf8(&page.bytes).expect("pages are UTF-8")
}
