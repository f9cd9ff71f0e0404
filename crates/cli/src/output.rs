//! Where the picture goes: decided before anything is drawn, filled while it is drawn, and given
//! its name once it is whole.

mod target;

pub(crate) use target::{FileTarget, Request, Target};

use crate::error::Failure;
use crate::interrupt::Interrupt;
use std::ffi::OsString;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::sync::{Arc, Mutex};
use tempfile::{NamedTempFile, TempPath};

/// A picture being written. Dropped before [`Output::commit`], it leaves no file, and what its
/// pipes still write goes nowhere. After a signal, writing fails.
#[derive(Debug)]
pub(crate) struct Output {
    name: String,
    interrupt: Interrupt,
    channel: Arc<Mutex<Channel>>,
    temporary: Option<(TempPath, FileTarget)>,
}

/// A handle to write into an [`Output`] with. An encoder may own it and drop it at any time: no
/// error is lost with it, the output keeps the first.
#[derive(Debug, Clone)]
pub(crate) struct Pipe {
    channel: Arc<Mutex<Channel>>,
    interrupt: Interrupt,
}

enum Channel {
    Open(BufWriter<Box<dyn Write + Send>>),
    Broken(io::Error),
    Closed,
}

impl std::fmt::Debug for Channel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Open(_) => f.write_str("Open"),
            Self::Broken(e) => f.debug_tuple("Broken").field(e).finish(),
            Self::Closed => f.write_str("Closed"),
        }
    }
}

impl Output {
    /// Opens the target. A file's temporary stands beside it, so that it can be renamed.
    pub(crate) fn open(target: &Target, interrupt: &Interrupt) -> Result<Self, Failure> {
        let name = target.name();
        let failed = |e: io::Error| Failure::io(&name, &e);
        let (writer, temporary): (Box<dyn Write + Send>, _) = match target {
            Target::Stdout => (Box::new(io::stdout()), None),
            Target::Device(path) => {
                let file = OpenOptions::new().write(true).open(path).map_err(failed)?;
                (Box::new(file), None)
            }
            Target::File(target) => {
                interrupt.hold();
                let (file, path) = temporary(target).map_err(failed)?.into_parts();
                (Box::new(file), Some((path, target.clone())))
            }
        };
        let channel = Arc::new(Mutex::new(Channel::Open(BufWriter::new(writer))));
        Ok(Self { name, interrupt: interrupt.clone(), channel, temporary })
    }

    /// A handle to write with.
    pub(crate) fn pipe(&self) -> Pipe {
        Pipe { channel: Arc::clone(&self.channel), interrupt: self.interrupt.clone() }
    }

    /// Writes out what is buffered and gives the file its name.
    pub(crate) fn commit(mut self) -> Result<(), Failure> {
        if self.interrupt.is_heard() {
            return Err(self.interrupt.failure());
        }
        match self.close() {
            Channel::Open(mut writer) => writer.flush(),
            Channel::Broken(e) => Err(e),
            Channel::Closed => Ok(()),
        }
        .map_err(|e| Failure::io(&self.name, &e))?;
        match self.temporary.take() {
            Some((path, target)) => rename(path, &target),
            None => Ok(()),
        }
    }

    /// The failure behind an error that a user of a pipe reports.
    pub(crate) fn failure(&self, reported: &dyn std::fmt::Display) -> Failure {
        match self.channel.lock().as_deref() {
            _ if self.interrupt.is_heard() => self.interrupt.failure(),
            Ok(Channel::Broken(e)) => Failure::io(&self.name, e),
            _ => Failure::Failed(format!("{}: {reported}", self.name)),
        }
    }

    fn close(&self) -> Channel {
        match self.channel.lock() {
            Ok(mut channel) => std::mem::replace(&mut *channel, Channel::Closed),
            Err(_) => Channel::Closed,
        }
    }
}

impl Drop for Output {
    fn drop(&mut self) {
        if let Channel::Open(writer) = self.close() {
            // Its buffer must not be written out, as dropping it would do.
            let _ = writer.into_parts();
        }
    }
}

impl Pipe {
    fn with<T>(
        &self,
        work: impl FnOnce(&mut BufWriter<Box<dyn Write + Send>>) -> io::Result<T>,
    ) -> io::Result<T> {
        if self.interrupt.is_heard() {
            return Err(io::Error::other("interrupted"));
        }
        let mut channel = self.channel.lock().map_err(|_| io::Error::other("a writer panicked"))?;
        match &mut *channel {
            Channel::Open(writer) => work(writer).map_err(|e| {
                let reported = io::Error::from(e.kind());
                *channel = Channel::Broken(e);
                reported
            }),
            Channel::Broken(e) => Err(io::Error::from(e.kind())),
            Channel::Closed => Err(io::Error::other("the output is closed")),
        }
    }
}

impl Write for Pipe {
    fn write(&mut self, data: &[u8]) -> io::Result<usize> {
        // All of it: an interrupted write is no error, and no other part-way stop is of use here.
        self.with(|writer| writer.write_all(data)).map(|()| data.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.with(Write::flush)
    }
}

/// A file beside the target, hidden, with the permissions that the target has or will have.
fn temporary(target: &FileTarget) -> io::Result<NamedTempFile<File>> {
    let mut prefix = OsString::from(".");
    prefix.push(target.path.file_name().unwrap_or_default());
    prefix.push(".");
    let folder = target.path.parent().filter(|p| !p.as_os_str().is_empty());
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".tmp");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(folder.unwrap_or(Path::new(".")))?;
    if let Ok(old) = fs::metadata(&target.path) {
        file.as_file().set_permissions(old.permissions())?;
    }
    Ok(file)
}

fn rename(path: TempPath, target: &FileTarget) -> Result<(), Failure> {
    let renamed = if target.may_replace {
        path.persist(&target.path)
    } else {
        path.persist_noclobber(&target.path)
    };
    renamed.map_err(|e| Failure::file(&target.shown, &e.error))
}

#[cfg(test)]
mod tests;
