//! Real trees, where `RUNGBOOK_CORPUS` names a folder of them: nothing that a declaration opens is lost.
//!
//! `RUNGBOOK_CORPUS=… cargo test --test it source::corpus -- --ignored`

use rungbook::source::{Disk, Options, read_tree};

use super::fragments;

#[test]
#[ignore = "needs a folder of real trees"]
fn every_header_of_a_twincat_declaration_is_in_a_fragment() {
    let root = std::env::var("RUNGBOOK_CORPUS").expect("RUNGBOOK_CORPUS names a folder");
    let tree = read_tree(&Disk::new(root).expect("the folder is there"), &Options::default(), &|_| {});
    let mut headers = 0;
    for unit in tree.units.iter().filter(|unit| unit.format == "TwinCAT 3") {
        let file = tree.files.get(unit.file);
        let fragments = fragments(unit);
        for line in file.text.lines() {
            let line = line.trim().trim_start_matches("<Declaration>").trim_start_matches("<![CDATA[");
            let line = line.trim_end_matches("</Declaration>").trim_end_matches("]]>");
            let opens = ["FUNCTION_BLOCK ", "FUNCTION ", "PROGRAM ", "INTERFACE ", "METHOD ", "PROPERTY ", "TYPE "];
            if opens.iter().any(|word| line.starts_with(word)) {
                headers += 1;
                assert!(fragments.iter().any(|fragment| fragment.text.contains(line)), "{}: {line}", file.path);
            }
        }
    }
    assert!(headers > 0, "there is a TwinCAT tree");
}
