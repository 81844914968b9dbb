//! Progress on stderr: a bar where that is a terminal, nothing where it is not.

use std::io::IsTerminal;
use std::sync::Mutex;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::pipeline::Event;

/// Draws events of the pipeline.
pub(crate) struct Progress {
    bar: Option<Mutex<ProgressBar>>,
}

impl Progress {
    /// A bar, unless `quiet` or stderr is no terminal.
    pub(crate) fn new(quiet: bool) -> Self {
        let show = !quiet && std::io::stderr().is_terminal();
        Self { bar: show.then(|| Mutex::new(ProgressBar::new(0))) }
    }

    /// Says what is being tried.
    pub(crate) fn message(&self, text: &str) {
        if let Some(Ok(bar)) = self.bar.as_ref().map(Mutex::lock) {
            bar.set_message(text.to_owned());
        }
    }

    /// Takes an event.
    pub(crate) fn event(&self, event: Event) {
        let Some(bar) = &self.bar else { return };
        let Ok(mut bar) = bar.lock() else { return };
        match event {
            Event::Stage { name, total } => {
                bar.finish_and_clear();
                *bar = stage(name, total);
            }
            Event::Advance(n) => bar.inc(n as u64),
            Event::Done => bar.finish_and_clear(),
        }
    }
}

fn stage(name: &'static str, total: usize) -> ProgressBar {
    let (bar, form) = if total == 0 {
        (ProgressBar::new_spinner(), "{spinner} {msg:<16} {elapsed_precise}")
    } else {
        (ProgressBar::new(total as u64), "  {msg:<16} [{bar:30}] {pos}/{len} {elapsed_precise}")
    };
    // The form is ours; were it wrong, the default one would still draw a bar.
    if let Ok(style) = ProgressStyle::with_template(form) {
        bar.set_style(style.progress_chars("=> "));
    }
    bar.set_message(name);
    bar.enable_steady_tick(Duration::from_millis(100));
    bar
}
