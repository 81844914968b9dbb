//! Plain Structured Text, whose vendor and nesting follow from what lies around it.

use rungbook::source::Memory;
use rungbook::text::{Encoding, Vendor};

use super::{codes_of, declaration, read, unit};

#[test]
fn a_plain_file_is_one_object_whose_declaration_is_the_text() {
    let text = "PROGRAM p\nEND_PROGRAM\n";
    let unit = unit("a/p.ST", text);
    assert_eq!(unit.objects.len(), 1);
    assert_eq!(declaration(&unit.objects[0]), text);
    assert_eq!((unit.vendor, unit.nested_comments), (Vendor::Standard, None));
}

#[test]
fn the_nearest_tool_decides_the_dialect() {
    let memory = Memory::new()
        .with("ax/apax.yml", "name: x\n")
        .with("ax/src/deep/a.st", "A")
        .with("br/Machine.apj", "<Project/>")
        .with("br/Logical/Lib/a.st", "B")
        .with("br/Logical/ax/apax.yml", "name: y\n")
        .with("br/Logical/ax/a.st", "C")
        .with("none/a.st", "D");
    let tree = read(&memory);
    let vendors: Vec<_> = tree
        .units
        .iter()
        .map(|unit| (tree.files.get(unit.file).path.as_str(), unit.vendor, unit.nested_comments))
        .collect();
    let expected = [
        ("ax/src/deep/a.st", Vendor::SimaticAx, None),
        ("br/Logical/Lib/a.st", Vendor::BAndR, Some(false)),
        ("br/Logical/ax/a.st", Vendor::SimaticAx, None),
        ("none/a.st", Vendor::Standard, None),
    ];
    assert_eq!(vendors, expected);
}

#[test]
fn an_old_encoding_is_told_and_utf_16_is_read() {
    let memory = Memory::new()
        .with("old.st", b"(* \xD6lpumpe f\xFCr das Getriebe, Temperatur in \xB0C *)")
        .with("wide.st", b"\xFF\xFEP\0\r\0\n\0\xFC\0");
    let tree = read(&memory);
    assert_eq!(codes_of(&tree.findings), ["encoding-guessed"]);
    assert!(declaration(&tree.units[0].objects[0]).contains("Ölpumpe für"));
    assert_eq!(declaration(&tree.units[1].objects[0]), "P\r\nü");
    assert_eq!(tree.files.get(tree.units[1].file).encoding, Encoding::Utf16Le);
}

#[test]
fn a_binary_file_called_st_is_a_finding_and_no_unit() {
    let tree = read(&Memory::new().with("bad.st", b"\x00\x01\x02\xFF").with("good.st", "A"));
    assert_eq!(codes_of(&tree.findings), ["not-decodable"]);
    assert_eq!(tree.units.len(), 1);
    assert_eq!(tree.skipped[0].code.map(|code| code.name), Some("not-decodable"));
}
