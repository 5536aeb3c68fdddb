//! Files as they are drawn: each written whole or not at all, on several threads.

use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
};

use hammerbeam_figure::{Figure, FigureError, FrequencyUnit, Style};
use hammerbeam_results::whole_file::{WriteError, replace};

use super::RESOLUTION;
use crate::{
    args::FigureFormat,
    crew::{Crew, Pending},
    failure::Failure,
    interrupt::Interrupt,
    output::tell,
    ticker::Ticker,
};

/// What figures are put into: files, or the page.
pub trait Album {
    /// Takes a figure, or the reason why there is none.
    fn add(&mut self, name: &str, figure: Result<Figure, FigureError>);

    /// Takes a figure, or does without it where there is nothing to draw: contacts of a structure without
    /// stops, say.
    fn add_unless_empty(&mut self, name: &str, figure: Result<Figure, FigureError>) {
        if !matches!(figure, Err(FigureError::Empty { .. })) {
            self.add(name, figure);
        }
    }

    /// Unit in which frequencies are shown.
    fn frequency_unit(&self) -> FrequencyUnit;

    /// The style of a figure over two columns.
    fn wide(&self) -> Style {
        Style::double_column().showing(self.frequency_unit())
    }

    /// The style of a figure over one column.
    fn narrow(&self) -> Style {
        Style::single_column().showing(self.frequency_unit())
    }

    /// Whether the rest is left out, since the user has asked to stop.
    fn is_stopped(&mut self) -> bool;
}

/// Files as they are drawn, and what cannot be.
///
/// What is added is drawn at any time until [`Self::finish`], in whatever order; its bytes and the list of
/// files do not depend on that.
pub struct Drawn<'a> {
    folder: &'a Path,
    /// Resolution of the PNG files, in pixels per inch.
    pub resolution: f64,
    /// Unit in which frequencies are shown.
    pub frequency_unit: FrequencyUnit,
    /// Formats of the figures.
    pub formats: Vec<FigureFormat>,
    /// Names of the files.
    pub files: Vec<String>,
    refused: Vec<(String, String)>,
    /// Characters that the font lacks.
    lacking: BTreeSet<char>,
    crew: Crew,
    interrupt: Option<Interrupt>,
    /// Whether something was left out since the user has asked to stop.
    is_cut: bool,
    pending: Vec<Pending<anyhow::Result<bool>>>,
    /// Files that are there.
    written: Arc<AtomicU64>,
    ticker: Ticker,
}

/// What was drawn.
#[derive(Debug)]
pub struct Files {
    /// Names of the files.
    pub names: Vec<String>,
    /// Names of figures that cannot be drawn, each with the reason.
    pub refused: Vec<(String, String)>,
    /// Characters of their texts that the font lacks.
    pub lacking: Vec<String>,
}

impl<'a> Drawn<'a> {
    /// Into a folder, made if it is not there, one file after the other.
    pub fn into(folder: &'a Path) -> anyhow::Result<Self> {
        let cannot = |source| WriteError { path: folder.to_owned(), source };
        fs::create_dir_all(folder).map_err(cannot)?;
        Ok(Self {
            folder,
            resolution: RESOLUTION,
            frequency_unit: FrequencyUnit::Hertz,
            formats: FigureFormat::USUAL.to_vec(),
            files: Vec::new(),
            refused: Vec::new(),
            lacking: BTreeSet::new(),
            crew: Crew::of(1),
            interrupt: None,
            is_cut: false,
            pending: Vec::new(),
            written: Arc::default(),
            ticker: Ticker::counting("files drawn"),
        })
    }

    /// On so many threads, until Ctrl-C.
    pub fn on(self, threads: usize, interrupt: Interrupt) -> Self {
        interrupt.is_in_order();
        Self { crew: Crew::of(threads), interrupt: Some(interrupt), ..self }
    }

    /// The threads that draw.
    pub fn crew(&self) -> &Crew {
        &self.crew
    }

    /// What to look at while drawing.
    pub fn interrupt(&self) -> Option<Interrupt> {
        self.interrupt.clone()
    }

    /// Notes why there is no figure.
    pub fn refuse(&mut self, name: &str, reason: String) {
        self.refused.push((name.to_owned(), reason));
    }

    /// Writes a file that is no figure.
    pub fn write(&mut self, name: &str, content: impl FnOnce() -> String + Send + 'static) {
        self.hand(vec![name.to_owned()], move |paths| Ok(replace(&paths[0], content().as_bytes())?));
    }

    /// Hands over what writes these files.
    fn hand(
        &mut self,
        names: Vec<String>,
        write: impl FnOnce(&[PathBuf]) -> anyhow::Result<()> + Send + 'static,
    ) {
        if self.is_stopped() {
            return;
        }
        let paths: Vec<PathBuf> = names.iter().map(|name| self.folder.join(name)).collect();
        self.files.extend(names);
        let (interrupt, written) = (self.interrupt.clone(), Arc::clone(&self.written));
        self.pending.push(self.crew.hand(move || {
            if is_raised(interrupt.as_ref()) {
                return Ok(false);
            }
            write(&paths)?;
            written.fetch_add(paths.len() as u64, Ordering::Relaxed);
            Ok(true)
        }));
        self.ticker.at(self.written.load(Ordering::Relaxed), String::new);
    }

    /// Waits for all that was added, and says on standard error what could not be drawn.
    ///
    /// # Errors
    /// The first file that could not be written; an interruption, with how far it has come.
    pub fn finish(mut self) -> Result<Files, Failure> {
        let mut refusal = None;
        for pending in std::mem::take(&mut self.pending) {
            match self.crew.wait(&pending) {
                Ok(is_written) => self.is_cut |= !is_written,
                Err(error) => refusal = refusal.or(Some(error)),
            }
            self.ticker.at(self.written.load(Ordering::Relaxed), String::new);
        }
        self.ticker.clear();
        if let Some(error) = refusal {
            return Err(error.into());
        }
        if self.is_cut {
            let (written, folder) = (self.written.load(Ordering::Relaxed), self.folder.display());
            return Err(Failure::Interrupted(format!(
                "interrupted while drawing; {written} files are drawn anew in {folder}, the others are as they were"
            )));
        }
        for (name, reason) in &self.refused {
            tell(&format!("{name}: {reason}"));
        }
        let lacking: Vec<String> = self.lacking.iter().map(char::to_string).collect();
        if !lacking.is_empty() {
            let all = lacking.join(" ");
            tell(&format!("the font of the figures lacks these characters, \u{fffd} stands for each: {all}"));
        }
        Ok(Files { names: self.files, refused: self.refused, lacking })
    }
}

impl Album for Drawn<'_> {
    /// Draws a figure in each format, or notes why there is none.
    fn add(&mut self, name: &str, figure: Result<Figure, FigureError>) {
        match figure {
            Ok(figure) => {
                self.lacking.extend(figure.characters_lacking());
                let (resolution, formats) = (self.resolution, self.formats.clone());
                let names: Vec<String> =
                    formats.iter().map(|format| format!("{name}.{}", format.suffix())).collect();
                self.hand(names, move |paths| {
                    formats.iter().zip(paths).try_for_each(|(format, path)| match format {
                        FigureFormat::Svg => Ok(replace(path, figure.svg().as_bytes())?),
                        FigureFormat::Png => Ok(replace(path, &figure.png(resolution)?)?),
                        FigureFormat::Pdf => Ok(replace(path, &figure.pdf()?)?),
                    })
                });
            }
            Err(reason) => self.refuse(name, reason.to_string()),
        }
    }

    fn frequency_unit(&self) -> FrequencyUnit {
        self.frequency_unit
    }

    fn is_stopped(&mut self) -> bool {
        self.is_cut |= is_raised(self.interrupt.as_ref());
        self.is_cut
    }
}

fn is_raised(interrupt: Option<&Interrupt>) -> bool {
    interrupt.is_some_and(Interrupt::raised)
}
