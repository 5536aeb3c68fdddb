//! Files as they are drawn: each written whole or not at all, on several threads.

use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
};

use hammerbeam_figure::{Figure, FigureError, FrequencyUnit, Style};
use hammerbeam_jobs::{
    CountedProgress, Observer,
    pool::{PATIENCE, Pending, Pool, with_pool},
};
use hammerbeam_results::whole_file::{WriteError, ensure_written, replace};

use crate::{DrawingError, FigureFormat};

/// Resolution of the PNG files, in pixels per inch, where none is asked for.
pub const RESOLUTION: f64 = 300.0;

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

    /// Whether the rest is left out, since the observer has said stop.
    fn is_stopped(&mut self) -> bool;
}

/// How files are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawSettings {
    /// Number of threads; the files do not depend on it.
    pub threads: usize,
    /// Resolution of the PNG files, in pixels per inch.
    pub resolution: f64,
    /// Unit in which frequencies are shown.
    pub frequency_unit: FrequencyUnit,
    /// Formats of the figures.
    pub formats: Vec<FigureFormat>,
}

impl Default for DrawSettings {
    /// SVG and PNG with 300 pixels per inch, on one thread, with frequencies in hertz.
    fn default() -> Self {
        Self {
            threads: 1,
            resolution: RESOLUTION,
            frequency_unit: FrequencyUnit::Hertz,
            formats: FigureFormat::USUAL.to_vec(),
        }
    }
}

/// Files as they are drawn, and what cannot be.
///
/// What is added is drawn at any time, in whatever order; its bytes and the list of files do not depend on
/// that.
pub struct Drawn<'a> {
    folder: &'a Path,
    settings: DrawSettings,
    /// Names of the files.
    pub files: Vec<String>,
    refused: Vec<(String, String)>,
    /// Characters that the font lacks.
    lacking: BTreeSet<char>,
    pool: &'a Pool<'static>,
    observer: &'a mut dyn Observer,
    /// Raised when the observer has said stop.
    stop: Arc<AtomicBool>,
    /// Whether something was left out since then.
    is_cut: bool,
    pending: Vec<Pending<Result<bool, DrawingError>>>,
    /// Files that are there.
    written: Arc<AtomicU64>,
}

/// What was drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DrawnFiles {
    /// Names of the files.
    pub names: Vec<String>,
    /// Names of figures that cannot be drawn, each with the reason.
    pub refused: Vec<(String, String)>,
    /// Characters of their texts that the font lacks.
    pub lacking: Vec<String>,
}

/// Draws into a folder, made if it is not there, until the observer says stop; reports what could not be
/// drawn.
///
/// * `add`: adds what is drawn.
///
/// # Errors
/// Those of `add`; else the first file that could not be written, or [`DrawingError::Interrupted`] with how
/// far it has come.
pub fn draw_into<E: From<DrawingError>>(
    folder: &Path,
    settings: DrawSettings,
    observer: &mut dyn Observer,
    add: impl FnOnce(&mut Drawn<'_>) -> Result<(), E>,
) -> Result<DrawnFiles, E> {
    let cannot = |source| DrawingError::from(WriteError { path: folder.to_owned(), source });
    fs::create_dir_all(folder).map_err(cannot)?;
    observer.finishing();
    with_pool(settings.threads, |pool| {
        let mut drawn = Drawn {
            folder,
            settings,
            files: Vec::new(),
            refused: Vec::new(),
            lacking: BTreeSet::new(),
            pool,
            observer,
            stop: Arc::default(),
            is_cut: false,
            pending: Vec::new(),
            written: Arc::default(),
        };
        add(&mut drawn)?;
        Ok(drawn.finish()?)
    })
}

impl Drawn<'_> {
    /// The threads that draw.
    pub(crate) fn pool(&self) -> &Pool<'static> {
        self.pool
    }

    /// The flag that is raised when the observer has said stop.
    pub(crate) fn stop(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.stop)
    }

    /// What becomes of a piece of work that was handed over; meanwhile the observer is asked whether to stop.
    pub(crate) fn wait<T>(&mut self, pending: &Pending<T>) -> T {
        loop {
            self.look();
            if let Some(result) = pending.wait(PATIENCE) {
                return result;
            }
        }
    }

    /// Asks the observer whether to stop.
    fn look(&mut self) {
        if self.observer.interrupted() {
            self.stop.store(true, Ordering::Relaxed);
        }
    }

    /// Reports how much of what is counted is done.
    pub(crate) fn count(&mut self, done: u64, total: Option<u64>, things: &str) {
        self.observer.counted(&CountedProgress { done, total, things, place: &"" });
    }

    fn count_files(&mut self) {
        self.count(self.written.load(Ordering::Relaxed), None, "files drawn");
    }

    /// Notes why there is no figure.
    pub fn refuse(&mut self, name: &str, reason: String) {
        self.refused.push((name.to_owned(), reason));
    }

    /// Where a stored solution is missing or cannot be read, the figures that need it are named with the
    /// reason, and the others are drawn.
    pub(crate) fn unless_damaged<T>(
        &mut self,
        result: Result<T, impl Into<DrawingError>>,
        name: &str,
    ) -> Result<Option<T>, DrawingError> {
        match result.map_err(Into::into) {
            Ok(found) => Ok(Some(found)),
            Err(error) if error.is_of_solutions() => {
                self.refuse(name, error.to_string());
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// Writes a file that is no figure.
    pub fn write(&mut self, name: &str, content: impl FnOnce() -> String + Send + 'static) {
        self.hand(vec![name.to_owned()], move |paths| Ok(replace(&paths[0], content().as_bytes())?));
    }

    /// Hands over what writes these files.
    fn hand(
        &mut self,
        names: Vec<String>,
        write: impl FnOnce(&[PathBuf]) -> Result<(), DrawingError> + Send + 'static,
    ) {
        if self.is_stopped() {
            return;
        }
        let paths: Vec<PathBuf> = names.iter().map(|name| self.folder.join(name)).collect();
        self.files.extend(names);
        let (stop, written) = (self.stop(), Arc::clone(&self.written));
        self.pending.push(self.pool.hand(move || {
            if stop.load(Ordering::Relaxed) {
                return Ok(false);
            }
            write(&paths)?;
            written.fetch_add(paths.len() as u64, Ordering::Relaxed);
            Ok(true)
        }));
        self.count_files();
    }

    /// Waits for all that was added, and reports what could not be drawn.
    fn finish(mut self) -> Result<DrawnFiles, DrawingError> {
        let mut refusal = None;
        for pending in std::mem::take(&mut self.pending) {
            match self.wait(&pending) {
                Ok(is_written) => self.is_cut |= !is_written,
                Err(error) => refusal = refusal.or(Some(error)),
            }
            self.count_files();
        }
        self.observer.finishing();
        if let Some(error) = refusal {
            return Err(error);
        }
        if self.is_cut {
            let written = self.written.load(Ordering::Relaxed);
            return Err(DrawingError::Interrupted { written, folder: self.folder.display().to_string() });
        }
        ensure_written(self.folder, &self.files)?;
        for (name, reason) in &self.refused {
            self.observer.notice(&format_args!("{name}: {reason}"));
        }
        let lacking: Vec<String> = self.lacking.iter().map(char::to_string).collect();
        if !lacking.is_empty() {
            let all = lacking.join(" ");
            self.observer.notice(&format_args!(
                "the font of the figures lacks these characters, \u{fffd} stands for each: {all}"
            ));
        }
        Ok(DrawnFiles { names: self.files, refused: self.refused, lacking })
    }
}

impl Album for Drawn<'_> {
    /// Draws a figure in each format, or notes why there is none.
    fn add(&mut self, name: &str, figure: Result<Figure, FigureError>) {
        match figure {
            Ok(figure) => {
                self.lacking.extend(figure.characters_lacking());
                let (resolution, formats) = (self.settings.resolution, self.settings.formats.clone());
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
        self.settings.frequency_unit
    }

    fn is_stopped(&mut self) -> bool {
        self.look();
        self.is_cut |= self.stop.load(Ordering::Relaxed);
        self.is_cut
    }
}
