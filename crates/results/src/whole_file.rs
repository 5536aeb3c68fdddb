//! Files that appear whole or not at all.
//!
//! A file is written beside its place, under a name that ends in `.part`, and takes its place when it is
//! finished: whoever reads meanwhile has the old one or the new one, and where a link was the file is
//! afterwards, not what the link led to. The part is locked while it is written, and the system lets the lock
//! go however the program ends; so a part that nobody holds was left by a program that was killed, and goes
//! when the next file is written into that folder, or into one of ours within it.

use std::{
    collections::BTreeSet,
    ffi::OsString,
    fs::{self, File},
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};

/// Why a file is not there.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {source}", path.display())]
pub struct WriteError {
    /// The file.
    pub path: PathBuf,
    /// What the machine says.
    pub source: io::Error,
}

impl WriteError {
    /// Whether the user named a place where no file can be, as opposed to a disk that is full or fails.
    #[must_use]
    pub fn is_wrong_place(&self) -> bool {
        is_wrong_place(&self.source)
    }
}

/// Whether an error says that a path is wrong, as opposed to a disk that is full or fails.
pub fn is_wrong_place(error: &io::Error) -> bool {
    use io::ErrorKind::{
        AlreadyExists, InvalidFilename, InvalidInput, IsADirectory, NotADirectory, NotFound,
        PermissionDenied, ReadOnlyFilesystem,
    };
    matches!(
        error.kind(),
        AlreadyExists
            | InvalidFilename
            | InvalidInput
            | IsADirectory
            | NotADirectory
            | NotFound
            | PermissionDenied
            | ReadOnlyFilesystem
    )
}

/// Refuses a path that is a link: what is written there would be somewhere else.
pub fn refuse_link(path: &Path) -> io::Result<()> {
    if path.is_symlink() {
        let message = "it is a link, and nothing is written through links";
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    Ok(())
}

/// A folder of its own within a results folder, for what is written when no other folder is named. Parts that
/// killed programs have left in the results folder go.
///
/// # Errors
/// [`WriteError`]: it is a link.
pub fn subfolder(results: &Path, name: &str) -> Result<PathBuf, WriteError> {
    let path = results.join(name);
    match refuse_link(&path) {
        Ok(()) => {
            sweep(results);
            Ok(path)
        }
        Err(source) => Err(WriteError { path, source }),
    }
}

/// Whether files that were written into a folder are all there: it may have been removed meanwhile, and made
/// again for the later ones.
///
/// # Errors
/// [`WriteError`] of the first that is not.
pub fn ensure_written<N: AsRef<Path>>(
    folder: &Path,
    names: impl IntoIterator<Item = N>,
) -> Result<(), WriteError> {
    match names.into_iter().map(|name| folder.join(name)).find(|path| !path.exists()) {
        None => Ok(()),
        Some(path) => {
            let source = io::Error::new(io::ErrorKind::NotFound, "it was removed while others were written");
            Err(WriteError { path, source })
        }
    }
}

/// A file that is being written.
#[derive(Debug)]
pub struct WholeFile {
    path: PathBuf,
    /// Closed before its part is removed, as fields are let go in their order.
    writer: BufWriter<File>,
    part: Part,
}

impl WholeFile {
    /// Begins a file; its folder is made if it is not there.
    ///
    /// # Errors
    /// [`WriteError`].
    pub fn begin(path: &Path) -> Result<Self, WriteError> {
        let begin = || {
            // A path without a folder is one in the current folder.
            let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
            let folder = folder.unwrap_or_else(|| Path::new("."));
            fs::create_dir_all(folder)?;
            sweep(folder);
            part_of(path)
        };
        match begin() {
            Ok((file, part)) => Ok(Self { path: path.to_owned(), writer: BufWriter::new(file), part }),
            Err(source) => Err(WriteError { path: path.to_owned(), source }),
        }
    }

    /// Where it will be.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Moves the file to its place, with its bytes on the disk.
    ///
    /// # Errors
    /// [`WriteError`]; nothing is left of the file then.
    pub fn finish(self) -> Result<PathBuf, WriteError> {
        self.place(File::sync_all)
    }

    /// Moves the file to its place, after something is done with it.
    fn place(self, settle: impl FnOnce(&File) -> io::Result<()>) -> Result<PathBuf, WriteError> {
        let Self { path, writer, part } = self;
        let file = writer.into_inner().map_err(io::IntoInnerError::into_error);
        let moved = file.and_then(|file| settle(&file).and_then(|()| part.rename(&path)));
        match moved {
            Ok(()) => Ok(path),
            Err(source) => Err(WriteError { path, source }),
        }
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

/// Replaces a file by these bytes. They are left to the system, which brings them to the disk when it likes:
/// for what can be made again.
///
/// # Errors
/// [`WriteError`]; what was there is as it was then.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let mut file = WholeFile::begin(path)?;
    file.write_all(bytes).map_err(|source| WriteError { path: path.to_owned(), source })?;
    file.place(|_| Ok(())).map(|_| ())
}

/// Makes a file of these bytes where there is none, in the same way.
///
/// # Errors
/// [`WriteError`], with [`io::ErrorKind::AlreadyExists`] if there is something by now; that is as it was
/// then.
pub fn create(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let fail = |source| WriteError { path: path.to_owned(), source };
    let mut file = WholeFile::begin(path)?;
    file.write_all(bytes).and_then(|()| file.flush()).map_err(fail)?;
    file.part.link(path).map_err(fail)
}

/// A file that goes away unless it gets another name.
#[derive(Debug)]
struct Part(Option<PathBuf>);

impl Part {
    fn rename(mut self, to: &Path) -> io::Result<()> {
        if let Some(from) = &self.0 {
            fs::rename(from, to)?;
        }
        self.0 = None;
        Ok(())
    }

    /// Gives it a name that nothing has.
    fn link(self, to: &Path) -> io::Result<()> {
        let Some(from) = &self.0 else { return Ok(()) };
        match fs::hard_link(from, to) {
            // Not every file system has links; there it is as good as can be.
            Err(error) if error.kind() != io::ErrorKind::AlreadyExists && !to.exists() => self.rename(to),
            linked => linked,
        }
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if let Some(path) = &self.0 {
            // Nothing better can be done where that fails.
            fs::remove_file(path).ok();
        }
    }
}

/// The part of a file, locked. Nobody else has its name.
fn part_of(path: &Path) -> io::Result<(File, Part)> {
    static BEGUN: AtomicU64 = AtomicU64::new(0);
    loop {
        let mut name = path.as_os_str().to_owned();
        name.push(format!(".{}-{}.part", std::process::id(), BEGUN.fetch_add(1, Ordering::Relaxed)));
        let file = match File::create_new(&name) {
            // Left by a program that was killed and had our number.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
            other => other?,
        };
        let part = Part(Some(name.into()));
        // Where files cannot be locked, parts of killed programs stay.
        let locked = file.try_lock();
        let swept = part.0.as_ref().is_some_and(|path| !path.exists());
        // Before it was locked another program may have taken it for dead.
        if locked.is_ok() && swept || matches!(locked, Err(fs::TryLockError::WouldBlock)) {
            continue;
        }
        return Ok((file, part));
    }
}

/// Removes the parts that killed programs have left in a folder, once for each folder.
fn sweep(folder: &Path) {
    static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    if SWEPT.lock().unwrap_or_else(PoisonError::into_inner).insert(folder.to_owned()) {
        remove_dead_parts(folder);
    }
}

fn remove_dead_parts(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten().filter(|entry| is_part(&entry.file_name())) {
        // Not through a link.
        if entry.file_type().is_ok_and(|kind| kind.is_file())
            && File::open(entry.path()).is_ok_and(|file| file.try_lock().is_ok())
        {
            fs::remove_file(entry.path()).ok();
        }
    }
}

/// Whether a file has the name of a part: `NAME.PROCESS-NUMBER.part`.
fn is_part(name: &OsString) -> bool {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let numbers = name.to_str().and_then(|name| name.strip_suffix(".part")?.rsplit_once('.'));
    numbers.and_then(|(_, numbers)| numbers.split_once('-')).is_some_and(|(a, b)| digits(a) && digits(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<OsString> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort();
        names
    }

    /// Every writer ends with its own bytes whole or with those of another one, and nothing else is left in
    /// the folder.
    #[test]
    fn one_file_is_written_by_several_at_once_and_nothing_is_left_of_a_failure() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("page.html");
        std::thread::scope(|scope| {
            for writer in 0..8_u8 {
                let path = &path;
                scope.spawn(move || (0..20).for_each(|_| replace(path, &vec![writer; 200_000]).unwrap()));
            }
        });
        let bytes = fs::read(&path).unwrap();
        assert!(bytes.len() == 200_000 && bytes.iter().all(|byte| *byte == bytes[0]));
        fs::create_dir(folder.path().join("taken")).unwrap();
        assert!(replace(&folder.path().join("taken"), b"x").is_err());
        assert_eq!(names(folder.path()), ["page.html", "taken"]);
    }

    #[test]
    fn of_several_that_make_a_file_one_does_and_what_is_there_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("study.toml");
        let made = std::thread::scope(|scope| {
            let makers: Vec<_> = (0..8_u8)
                .map(|maker| {
                    let path = &path;
                    scope.spawn(move || create(path, &vec![maker; 200_000]).map(|()| maker))
                })
                .collect();
            makers.into_iter().map(|maker| maker.join().unwrap()).collect::<Vec<_>>()
        });
        let winners: Vec<u8> = made.iter().filter_map(|made| made.as_ref().ok().copied()).collect();
        assert_eq!(winners.len(), 1, "{made:?}");
        assert_eq!(fs::read(&path).unwrap(), vec![winners[0]; 200_000]);
        let refused = made.into_iter().filter_map(Result::err);
        assert!({ refused }.all(|error| error.source.kind() == io::ErrorKind::AlreadyExists));
        assert_eq!(names(folder.path()), ["study.toml"]);
    }

    #[test]
    fn a_folder_that_went_while_files_were_written_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        let write = |name: &str| replace(&out.join(name), b"x").unwrap();
        write("a");
        fs::remove_dir_all(&out).unwrap();
        write("b");
        let error = ensure_written(&out, ["a", "b"]).unwrap_err();
        assert!(error.path == out.join("a") && error.is_wrong_place(), "{error}");
        write("a");
        ensure_written(&out, ["a", "b"]).unwrap();
    }

    #[test]
    fn what_a_killed_program_left_goes_and_what_is_being_written_stays() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let mut other = WholeFile::begin(&at("slow.csv")).unwrap();
        fs::write(at("dead.csv.4000000-17.part"), "half").unwrap();
        fs::write(at("mine.part"), "not of this program").unwrap();
        // As another program would see the folder, for the first time.
        remove_dead_parts(folder.path());
        other.write_all(b"whole").unwrap();
        other.finish().unwrap();
        assert_eq!(names(folder.path()), ["mine.part", "slow.csv"]);
        assert_eq!(fs::read(at("slow.csv")).unwrap(), b"whole");
    }

    #[cfg(unix)]
    #[test]
    fn where_a_link_was_is_the_file_and_what_it_led_to_is_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let (link, target) = (folder.path().join("a.csv"), folder.path().join("precious"));
        fs::write(&target, "precious").unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        replace(&link, b"new").unwrap();
        assert_eq!(fs::read_to_string(&target).unwrap(), "precious");
        assert!(fs::symlink_metadata(&link).unwrap().is_file());
    }
}
