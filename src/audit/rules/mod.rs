//! The rules. Each file opens with the page that `rungbook explain` prints.

pub mod block_without_table;
pub mod broken_link;
pub mod conditional_pragma;
pub mod missing_brief;
pub mod placeholder_documentation;
pub mod proves_nothing;
pub mod undocumented;
pub mod undocumented_member;
pub mod unknown_parameter;
pub mod unread_body;
pub mod unverified_table;
pub mod violated_table;
