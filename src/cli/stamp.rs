//! The one `Stamp`: date, commit and tool version, found out here and nowhere else.

use std::path::Path;
use std::process::Command;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use crate::pipeline::Stamp;

/// The stamp of a run over `dir`.
///
/// The date is that of `SOURCE_DATE_EPOCH`, or else of the commit, or else today; so an unchanged
/// checkout gives the same bytes on every day.
pub(crate) fn stamp(dir: &Path) -> Stamp {
    let commit = git(dir, &["log", "-1", "--format=%h", "--", "."]);
    let dirty = commit.is_some() && git(dir, &["status", "--porcelain", "--", "."]).is_some_and(|s| !s.is_empty());
    let epoch = std::env::var("SOURCE_DATE_EPOCH").ok().and_then(|value| value.trim().parse().ok());
    let committed = || git(dir, &["log", "-1", "--format=%ct", "--", "."])?.parse().ok();
    let seconds: u64 = epoch.or_else(committed).unwrap_or_else(now);
    let mark = if dirty { "+" } else { "" };
    Stamp {
        date: date(seconds),
        commit: commit.map_or(String::new(), |hash| format!("{hash}{mark}")),
        tool: concat!("rungbook ", env!("CARGO_PKG_VERSION")).to_owned(),
        author: author(dir),
    }
}

/// Who runs the tool: as said in `RUNGBOOK_AUTHOR`, or by the pipeline that runs it, or by git's configuration.
fn author(dir: &Path) -> String {
    let variables = ["RUNGBOOK_AUTHOR", "GITLAB_USER_NAME", "GITHUB_ACTOR"];
    let said = variables.iter().find_map(|name| std::env::var(name).ok().filter(|value| !value.trim().is_empty()));
    said.or_else(|| git(dir, &["config", "user.name"])).map_or_else(String::new, |name| name.trim().to_owned())
}

fn git(dir: &Path, args: &[&str]) -> Option<String> {
    let output = Command::new("git").arg("-C").arg(dir).args(args).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?.trim().to_owned();
    (output.status.success() && !(text.is_empty() && args[0] == "log")).then_some(text)
}

fn now() -> u64 {
    #[expect(clippy::disallowed_methods, reason = "this is where the clock is read")]
    let now = SystemTime::now();
    now.duration_since(UNIX_EPOCH).unwrap_or(Duration::ZERO).as_secs()
}

/// The UTC date of a Unix time as `2026-11-22` (Howard Hinnant, *chrono-Compatible Low-Level Date
/// Algorithms*, `civil_from_days`).
fn date(seconds: u64) -> String {
    let days = seconds / 86_400 + 719_468;
    let era = days / 146_097;
    let day_of_era = days % 146_097;
    let year_of_era = (day_of_era - day_of_era / 1_460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let shifted = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * shifted + 2) / 5 + 1;
    let month = if shifted < 10 { shifted + 3 } else { shifted - 9 };
    let year = year_of_era + era * 400 + u64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02}")
}

#[cfg(test)]
mod tests {
    use super::date;

    #[test]
    fn dates_are_those_of_the_calendar() {
        let cases = [
            (0, "1970-01-01"),
            (951_782_400, "2000-02-29"),
            (1_795_305_600, "2026-11-22"),
            (4_107_542_399, "2100-02-28"),
        ];
        for (seconds, expected) in cases {
            assert_eq!(date(seconds), expected);
        }
    }
}
