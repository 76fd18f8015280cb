//! Files that appear whole or not at all.
//!
//! A file is written under a temporary name beside its target and renamed over it
//! at the end: readers, and runs that are stopped half way, see the old file or
//! the new one, never a part. The temporary lies in the target's own folder
//! because a rename is only atomic within one file system.
//!
//! Limits: a process killed outright leaves its `.pelage-….tmp` behind. Devices
//! and pipes cannot be renamed over and are refused.

use std::fs;
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::{NamedTempFile, TempPath};

/// Bytes gathered before they go to the system: large enough that the calls do not
/// show beside formatting, small enough to stay in cache.
const BUFFER_BYTES: usize = 1 << 18;

/// A file being written that takes its name only at [`commit`](AtomicFile::commit).
///
/// Buffered. Dropped before `commit`, it leaves nothing behind and an older file of
/// that name untouched.
///
/// ```
/// use pelage_io::AtomicFile;
/// use std::io::Write;
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("hair.txt");
/// let mut file = AtomicFile::create(&path)?;
/// file.write_all(b"one curl")?;
/// assert!(!path.exists());
/// file.commit()?;
/// assert_eq!(std::fs::read(&path)?, b"one curl");
/// # Ok::<(), std::io::Error>(())
/// ```
#[derive(Debug)]
pub struct AtomicFile {
    path: PathBuf,
    /// `path` with links followed: a link stays a link, the file behind it changes.
    target: PathBuf,
    temporary: BufWriter<NamedTempFile>,
}

impl AtomicFile {
    /// Starts the file that will be `path`.
    ///
    /// The folder must exist; `path` must not be a folder, device or pipe.
    pub fn create(path: &Path) -> io::Result<Self> {
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        if path.file_name().is_none() {
            return Err(plain(
                io::ErrorKind::InvalidInput,
                "this path names no file".into(),
            ));
        }
        let old = fs::metadata(&target).ok();
        if let Some(old) = &old {
            refuse_what_is_no_file(old)?;
        }
        let folder = folder_of(&target);
        refuse_missing_folder(folder)?;
        let temporary = new_temporary(folder, old.map(|old| old.permissions()))?;
        Ok(Self {
            path: path.to_path_buf(),
            target,
            temporary: BufWriter::with_capacity(BUFFER_BYTES, temporary),
        })
    }

    /// The path asked for.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Another handle on the bytes, past this one's buffer.
    pub(crate) fn handle(&self) -> io::Result<Arc<fs::File>> {
        Ok(Arc::new(self.temporary.get_ref().as_file().try_clone()?))
    }

    /// Lets the file end at `length` bytes, whatever was written behind that.
    pub(crate) fn end_at(&mut self, length: u64) -> io::Result<()> {
        self.flush()?;
        self.temporary.get_ref().as_file().set_len(length)
    }

    /// Hands all bytes to the disk and gives the file its name.
    pub fn commit(self) -> io::Result<()> {
        self.close()?.publish()
    }

    /// Hands all bytes to the disk and lets go of the file, not yet of its
    /// temporary name: for sequences whose files should appear together, and may be
    /// more than a process can hold open.
    pub(crate) fn close(self) -> io::Result<Closed> {
        let temporary = self.temporary.into_inner().map_err(|e| e.into_error())?;
        temporary.as_file().sync_all()?;
        Ok(Closed {
            temporary: temporary.into_temp_path(),
            target: self.target,
        })
    }
}

/// A whole file that only lacks its name; dropped, it goes away.
#[derive(Debug)]
pub(crate) struct Closed {
    temporary: TempPath,
    target: PathBuf,
}

impl Closed {
    /// Gives the file its name.
    pub(crate) fn publish(self) -> io::Result<()> {
        self.temporary.persist(&self.target).map_err(|e| e.error)
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.temporary.write(bytes)
    }

    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.temporary.write_all(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.temporary.flush()
    }
}

impl Seek for AtomicFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.temporary.seek(to)
    }
}

/// The folder that holds `path`; a bare name lies in the current one.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

fn refuse_what_is_no_file(old: &fs::Metadata) -> io::Result<()> {
    if old.is_dir() {
        return Err(plain(
            io::ErrorKind::IsADirectory,
            "this is a folder, not a file; add a file name".into(),
        ));
    }
    if !old.is_file() {
        return Err(plain(
            io::ErrorKind::InvalidInput,
            "this is a device or pipe; only regular files can be written whole".into(),
        ));
    }
    Ok(())
}

fn refuse_missing_folder(folder: &Path) -> io::Result<()> {
    match fs::metadata(folder) {
        Ok(found) if found.is_dir() => Ok(()),
        Ok(_) => Err(plain(
            io::ErrorKind::NotADirectory,
            format!("{} is a file, not a folder", folder.display()),
        )),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Err(plain(
            io::ErrorKind::NotFound,
            format!("the folder {} does not exist", folder.display()),
        )),
        Err(error) => Err(error),
    }
}

/// A new empty file in `folder` with `permissions`, or those the system gives to
/// any new file (temporary files are private otherwise).
fn new_temporary(folder: &Path, permissions: Option<fs::Permissions>) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".pelage-").suffix(".tmp");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let temporary = builder.tempfile_in(folder)?;
    if let Some(permissions) = permissions {
        temporary.as_file().set_permissions(permissions)?;
    }
    Ok(temporary)
}

fn plain(kind: io::ErrorKind, message: String) -> io::Error {
    io::Error::new(kind, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_committed_file_replaces_the_old_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, "old").unwrap();
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(b"newer").unwrap();
        file.seek(SeekFrom::Start(0)).unwrap();
        file.write_all(b"N").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(file.path(), path);
        file.commit().unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"Newer");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_dropped_file_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        let mut file = AtomicFile::create(&path).unwrap();
        file.write_all(b"half").unwrap();
        file.flush().unwrap();
        assert_eq!(names(folder.path()).len(), 1);
        drop(file);
        assert!(names(folder.path()).is_empty());
    }

    #[test]
    fn folders_and_missing_folders_are_named_in_plain_words() {
        let folder = tempfile::tempdir().unwrap();
        let error = AtomicFile::create(folder.path()).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::IsADirectory);
        assert!(error.to_string().contains("is a folder"), "{error}");
        let error = AtomicFile::create(&folder.path().join("no/a.txt")).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
        assert!(error.to_string().contains("does not exist"), "{error}");
        let file = folder.path().join("file");
        fs::write(&file, "x").unwrap();
        let error = AtomicFile::create(&file.join("a.txt")).unwrap_err();
        assert!(error.to_string().contains("not a folder"), "{error}");
        assert!(AtomicFile::create(Path::new("")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link_and_a_device_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let (path, link) = (folder.path().join("a"), folder.path().join("b"));
        fs::write(&path, "old").unwrap();
        std::os::unix::fs::symlink(&path, &link).unwrap();
        let mut file = AtomicFile::create(&link).unwrap();
        file.write_all(b"new").unwrap();
        file.commit().unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert!(AtomicFile::create(Path::new("/dev/null")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_new_file_is_as_readable_as_any_other() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (path, other) = (folder.path().join("a"), folder.path().join("b"));
        fs::write(&other, "x").unwrap();
        AtomicFile::create(&path).unwrap().commit().unwrap();
        let mode = |p| fs::metadata(p).unwrap().permissions().mode();
        assert_eq!(mode(&path), mode(&other));
    }
}
