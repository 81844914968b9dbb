//! The commented `rungbook.toml` that `rungbook init` writes.

/// Every key, commented out, with its default.
pub const TEMPLATE: &str = r#"# rungbook.toml: how the manual of this tree is made.
# Every key is optional; what is commented out shows the default.

# title = "…"            # the project's title, or the folder's name
# subtitle = ""
# version = "…"          # the project's version
# author = "…"           # the project's company or author
# language = "en"        # BCP 47 tag of the prose

[source]
# exclude = []           # globs of files to leave out: ["**/Tests/**", "*.bak.st"]
# include = []           # globs of files to read; empty: all that rungbook reads
# max-file-size = 134217728   # bytes; a larger file is reported and left out

[docs]
# profile = "auto"       # the comment convention: auto, or one of those in the manual
# manual = "manual"      # folder of narrative pages (*.md), below the root

[audit]
# deny = "warning"       # `rungbook check` fails from this severity on: info, warning, error

[audit.rules]            # severity of a finding by its code: off, info, warning, error
# block-without-table = "off"
# undocumented-member = "warning"

[gate]                   # `rungbook check` fails where one is not reached; without a key nothing is asked for
# documented = 100       # at least so many percent of the entities are documented
# verified = 100         # at least so many percent of the test tables are verified
# no-violated = true     # no table is violated
# no-stale = true        # no verdict is older than its block, its table or its options
# no-suppressed-without-owner = true   # every `@allow` names an owner and a last day
# no-breaking = true     # `rungbook diff`: no incompatible change
# no-lost-evidence = true              # `rungbook diff`: no table that was verified and is not any more
# baseline = "rungbook-baseline.json"  # findings in this file are allowed; `rungbook check --write-baseline` makes it

[evidence]
# store = "target/rungbook/evidence"   # the folder of records, below the root
# sources = "full"       # what a bundle holds of the sources: full, digests
# requirements = []      # lists of requirements: ["requirements.csv", "spec.reqif", "spec.sdoc"]
# results = []           # results of other tools, never shown as verified: ["reports/junit.xml"]
# sign-off = []          # names and roles on the sign-off page: ["Author: J. Doe", "Reviewer:"]

[html]
# enabled = true

[pdf]
# enabled = true
# paper = "a4"           # a4, b5, us-letter
# standard = "pdf-1.7"   # pdf-1.7, pdf-a-2b, pdf-a-3b, pdf-a-3a, pdf-ua-1, pdf-a-3a-ua-1
# tagged = false         # structure for screen readers; several times as large
# source = false         # show the source in the PDF, too
"#;
