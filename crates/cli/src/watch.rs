//! Watches a job from the terminal: its progress, its notices, and Ctrl-C.

use std::fmt::Display;

use hammerbeam_jobs::{CountedProgress, Observer};

use crate::{interrupt::Interrupt, output::notify, ticker::Ticker};

/// The terminal of a job whose work is counted.
pub struct Watch {
    interrupt: Interrupt,
    /// What is counted now.
    ticker: Option<Ticker>,
    things: String,
}

impl Watch {
    /// Stops the job on Ctrl-C.
    pub fn new(interrupt: Interrupt) -> Self {
        Self { interrupt, ticker: None, things: String::new() }
    }

    fn clear(&mut self) {
        if let Some(ticker) = self.ticker.take() {
            ticker.clear();
        }
    }
}

impl Observer for Watch {
    fn counted(&mut self, progress: &CountedProgress<'_>) {
        if self.things != progress.things {
            self.clear();
            self.things = progress.things.to_owned();
        }
        let new = || match progress.total {
            Some(total) => Ticker::new(total, progress.things),
            None => Ticker::counting(progress.things),
        };
        self.ticker.get_or_insert_with(new).at(progress.done, || progress.place.to_string());
    }

    fn notice(&mut self, notice: &dyn Display) {
        notify(&notice.to_string());
    }

    fn finishing(&mut self) {
        self.clear();
        self.interrupt.is_in_order();
    }

    fn interrupted(&mut self) -> bool {
        if let Some(ticker) = &mut self.ticker {
            ticker.say();
        }
        self.interrupt.raised()
    }
}

/// Notices of a job that is too short for a progress bar, on standard error.
pub struct Notices;

impl Observer for Notices {
    fn notice(&mut self, notice: &dyn Display) {
        notify(&notice.to_string());
    }
}
