//! `rungbook export`.

use super::{rungbook, tree};

const BLOCK: &str = "\
FUNCTION_BLOCK Counter VAR_INPUT up : BOOL; END_VAR VAR_OUTPUT n : INT(0..100); END_VAR
IF up THEN n := n + 1; END_IF
END_FUNCTION_BLOCK
FUNCTION_BLOCK Vendor VAR x : Unknown; END_VAR x(); END_FUNCTION_BLOCK
";

#[test]
fn a_block_is_written_in_every_form() {
    let dir = tree(&[("a.st", BLOCK)]);
    let run = |block: &str, file: &str| {
        let mut command = rungbook();
        command.current_dir(dir.path()).args(["export", block, "-o", file]);
        command
    };
    let begins = [("c.btor2", "1 sort "), ("c.aag", "aag "), ("c.aig", "aig "), ("c.smv", "MODULE main")];
    for (file, begin) in begins {
        run("counter", file).assert().code(0);
        let bytes = std::fs::read(dir.path().join(file)).expect("the file is written");
        assert!(bytes.starts_with(begin.as_bytes()), "{file}: {}", String::from_utf8_lossy(&bytes[..40]));
    }
    run("Counter", "c.txt").assert().code(2);
    run("Nothing", "c.smv").assert().code(2);
    let refused = run("Vendor", "v.smv").output().expect("it runs");
    assert_eq!(refused.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("a.st:4:"));
    assert!(!dir.path().join("v.smv").exists());
}
