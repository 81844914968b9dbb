//! Every code has a name of its own and a page with a title, an example and a cure.

use std::collections::BTreeSet;

use rungbook::source::codes::ALL;

#[test]
fn every_code_has_its_own_name_and_a_page() {
    let names: BTreeSet<_> = ALL.iter().map(|code| code.name).collect();
    assert_eq!(names.len(), ALL.len());
    for code in ALL {
        let page = code.page;
        assert!(page.starts_with("# "), "{}", code.name);
        assert_eq!(page.matches("```").count(), 2, "{} shows one example", code.name);
        let after = page.rsplit("```").next().unwrap_or("");
        assert!(after.trim().len() > 20, "{} says what to do", code.name);
    }
}
