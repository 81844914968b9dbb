//! One suite for each rule: what it finds, where, and what it lets pass.

mod block_without_table;
mod broken_link;
mod conditional_pragma;
mod missing_brief;
mod placeholder_documentation;
mod proves_nothing;
mod undocumented;
mod undocumented_member;
mod unknown_parameter;
mod unread_body;
mod unverified_table;
mod violated_table;
