//! The commented `rungbook.toml` that `rungbook init` writes.

/// Every key, commented out, with its default.
pub const TEMPLATE: &str = r##"# rungbook.toml: how the manual of this tree is made.
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

[tables]
# cycle = "10ms"         # the length of a cycle, for test tables that state none

# [[tables.sheet]]       # what the columns of a spreadsheet are, where its own header does not say so
# files = ["tests/*.xlsx"]
# header = 4             # the line of the header
# columns = { A = "#", B = "in Start", "Motor on" = "out Motor", F = "dur ms", G = "remark" }

[verify]
# timeout = 60           # seconds for one table
# memory = 4096          # MiB for one table
# jobs = 0               # threads, a table each; 0 is one for each core
# strict = false         # strict conformance for every table: its end is reached
# coverage = true        # find out what each proof covered
# loop-limit = 1000      # how often a loop without constant bounds may be done
# fixed = { digits = 3, width = 32 }   # REAL and LREAL in fixed point, for proofs; the verdict says so
# stubs = { "FB_Vendor" = "arbitrary", "FB_Other" = "stubs/FB_Other.st" }

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
# no-vacuous = true      # no verified table proves nothing
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
# standard = "pdf-1.7"   # pdf-1.7, pdf-a-1b, pdf-a-2b, pdf-a-3b, pdf-a-3a, pdf-ua-1, pdf-a-3a-ua-1
# tagged = false         # structure for screen readers; several times as large
# source = false         # show the source in the PDF, too
"##;
