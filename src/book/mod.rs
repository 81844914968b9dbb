//! Format-neutral pages, addresses, the search index, and the views that templates see.
