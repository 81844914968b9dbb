//! The walk-through of the manual, followed as a new user would: every command on the page runs, in its order.

use std::path::Path;
use std::process::Command;

use super::{rungbook, tree, write};

const PAGE: &str = include_str!("../../../manual/pipelines.md");

/// The commands of rungbook on the page, one a line, with quotes taken off.
fn commands() -> Vec<Vec<String>> {
    let line = |line: &str| {
        let rest = line.trim().trim_start_matches("- ");
        let words = rest.strip_prefix("rungbook ")?;
        let words: Vec<String> = words.split_whitespace().map(|word| word.trim_matches('"').to_owned()).collect();
        words.iter().all(|word| !word.contains('`')).then_some(words)
    };
    PAGE.lines().filter_map(line).collect()
}

fn git(dir: &Path, args: &[&str]) -> bool {
    let mut command = Command::new("git");
    command.current_dir(dir).args(["-c", "user.name=T", "-c", "user.email=t@example.com"]).args(args);
    command.output().is_ok_and(|output| output.status.success())
}

#[test]
fn every_command_of_the_walk_through_runs() {
    let source =
        "// Opens and closes.\nFUNCTION_BLOCK FB_Valve\nVAR_INPUT\n    Open : BOOL;\nEND_VAR\nEND_FUNCTION_BLOCK\n";
    let dir = tree(&[("FB_Valve.st", source), (".gitignore", "target\n*.key\n*.zip\nrungbook.*\n!rungbook.toml\n")]);
    let at = dir.path();
    let run = |words: &[String]| {
        let words = words.iter().map(|word| match word.as_str() {
            "$RELEASE_KEY" | "$RUNNER_TEMP/release.key" => "release.key",
            word => word,
        });
        let output = rungbook().current_dir(at).args(words.clone()).output().expect("it runs");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "rungbook {}: {said}", words.collect::<Vec<_>>().join(" "));
    };
    let words = |text: &str| text.split(' ').map(str::to_owned).collect::<Vec<_>>();
    // The three steps at the top of the page.
    run(&words("init"));
    run(&words("check --verify --write-baseline"));
    write(at, "rungbook.toml", "[gate]\nbaseline = \"rungbook-baseline.json\"\n");
    run(&words("evidence keygen release.key"));
    for step in
        ["`rungbook init`", "`rungbook check --verify --write-baseline`", "`rungbook evidence keygen release.key`"]
    {
        assert!(PAGE.contains(step), "{step} is not on the page any more");
    }
    if !(git(at, &["init", "-q"])
        && git(at, &["add", "."])
        && git(at, &["commit", "-qm", "one"])
        && git(at, &["tag", "v1.0"]))
    {
        println!("skipped: git does not run");
        return;
    }
    let commands = commands();
    assert!(commands.len() >= 7, "{commands:?}");
    commands.iter().for_each(|words| run(words));
    run(&words("evidence bundle --key release.key -o release.zip --previous v1.0"));
}
