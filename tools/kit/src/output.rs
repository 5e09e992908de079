//! Writing the one output: to standard output, or to a file that appears only when it is whole.

use crate::args::outputs;
use crate::{Failure, Session, unfinished};
use interchange::{Format, WriteError, write_document, write_text};
use std::fs::File;
use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::{Path, PathBuf};
use tempfile::{NamedTempFile, TempPath};
use tmesh::Document;

/// Where a tool writes. Nothing appears under a file's name before [`Output::commit`].
pub struct Output {
    target: Target,
    name: String,
}

enum Target {
    /// Standard output, past the line buffer that the standard library puts before it.
    Stdout(BufWriter<File>),
    File {
        file: BufWriter<NamedTempFile>,
        path: PathBuf,
    },
    /// A device or pipe that a path names: written in place.
    Special(BufWriter<File>),
}

impl Output {
    /// Opens `path`, or standard output; refuses binary output to a terminal.
    pub fn create(path: Option<&Path>, binary: bool) -> Result<Self, Failure> {
        let Some(path) = path.filter(|p| *p != Path::new("-")) else {
            refuse_terminal(binary)?;
            let name = "standard output".to_owned();
            let file = unbuffered(&io::stdout()).map_err(|e| Failure::writing(&name, &e))?;
            let target = Target::Stdout(BufWriter::new(file));
            return Ok(Self { target, name });
        };
        let name = path.display().to_string();
        let fail = |e: io::Error| Failure::writing(&name, &e);
        let special = path.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir());
        let target = if special {
            let file = std::fs::OpenOptions::new()
                .write(true)
                .open(path)
                .map_err(fail)?;
            Target::Special(BufWriter::new(file))
        } else {
            refuse_folder(path)?;
            let folder = folder_of(path);
            let stem = path.file_name().unwrap_or_default().to_string_lossy();
            let file = unfinished::create(|| {
                tempfile::Builder::new()
                    .prefix(&format!(".{stem}."))
                    .suffix(".part")
                    .permissions(default_permissions())
                    .tempfile_in(folder)
            })
            .map_err(fail)?;
            let file = BufWriter::new(file);
            Target::File {
                file,
                path: path.to_owned(),
            }
        };
        Ok(Self { target, name })
    }

    /// Flushes, and moves a file to its final name.
    pub fn commit(self) -> Result<(), Failure> {
        self.close()?.publish()
    }

    /// Flushes and closes, and leaves it to [`Closed::publish`] to move a file to its final name.
    pub fn close(self) -> Result<Closed, Failure> {
        let fail = |e: io::Error| Failure::writing(&self.name, &e);
        let file = match self.target {
            Target::Stdout(mut out) => {
                out.flush().map_err(fail)?;
                None
            }
            Target::Special(mut out) => {
                out.flush().map_err(fail)?;
                None
            }
            Target::File { file, path } => {
                let file = file.into_inner().map_err(|e| fail(e.into_error()))?;
                Some((file.into_temp_path(), path))
            }
        };
        Ok(Closed {
            file,
            name: self.name,
        })
    }

    /// The failure that an error while writing here means.
    pub fn failure(&self, error: &io::Error) -> Failure {
        Failure::writing(&self.name, error)
    }
}

/// An output that is whole, but not yet seen under its name.
pub struct Closed {
    file: Option<(TempPath, PathBuf)>,
    name: String,
}

impl Closed {
    /// Moves a file to its final name.
    pub fn publish(self) -> Result<(), Failure> {
        match self.file {
            Some((file, path)) => {
                unfinished::persist(file, path).map_err(|e| Failure::writing(&self.name, &e))
            }
            None => Ok(()),
        }
    }
}

fn refuse_terminal(binary: bool) -> Result<(), Failure> {
    if binary && io::stdout().is_terminal() {
        return Err(Failure::Usage(
            "binary output goes to a file or a pipe, not to a terminal; use -o PATH, or \
             --to txt for a readable listing"
                .to_owned(),
        ));
    }
    Ok(())
}

fn refuse_folder(path: &Path) -> Result<(), Failure> {
    if path.is_dir() {
        return Err(Failure::Output(format!(
            "cannot write {}: it is a directory",
            path.display()
        )));
    }
    Ok(())
}

fn refuse_file(path: &Path) -> Result<(), Failure> {
    if path.exists() && !path.is_dir() {
        return Err(Failure::Output(format!(
            "cannot write {}: the format is a folder, and this is a file",
            path.display()
        )));
    }
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(p) if !p.as_os_str().is_empty() => p,
        _ => Path::new("."),
    }
}

#[cfg(unix)]
fn unbuffered(stdout: &io::Stdout) -> io::Result<File> {
    use std::os::fd::AsFd;
    Ok(stdout.as_fd().try_clone_to_owned()?.into())
}

#[cfg(unix)]
fn default_permissions() -> std::fs::Permissions {
    use std::os::unix::fs::PermissionsExt;
    // As any newly created file: the process's umask takes away from this.
    std::fs::Permissions::from_mode(0o666)
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match &mut self.target {
            Target::Stdout(out) => out.write(bytes),
            Target::Special(out) => out.write(bytes),
            Target::File { file, .. } => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match &mut self.target {
            Target::Stdout(out) => out.flush(),
            Target::Special(out) => out.flush(),
            Target::File { file, .. } => file.flush(),
        }
    }
}

impl Session {
    /// The output's format: `--to`, else the output's extension, else `default`.
    pub fn output_format(&self, default: Format) -> Result<Format, Failure> {
        if let Some(format) = self.common.to {
            return Ok(format);
        }
        match self
            .common
            .output
            .as_deref()
            .filter(|p| *p != Path::new("-"))
        {
            None => Ok(default),
            Some(path) => match Format::from_path(path) {
                Some(format) if format.is_output() => Ok(format),
                Some(format) => Err(Failure::Usage(format!(
                    "{} is not an output format; add --to with one of {}",
                    format.name(),
                    outputs()
                ))),
                None if path.extension().is_none() => Ok(default),
                None if !path.is_file() && path.exists() => Ok(default),
                None => Err(Failure::Usage(format!(
                    "the extension of {} names no known format; add --to with one of {}",
                    path.display(),
                    outputs()
                ))),
            },
        }
    }

    /// Fails where [`Session::write`] could not write whatever the document is: before the work, not after it.
    pub fn check_output(&self) -> Result<(), Failure> {
        self.check_output_in(self.output_format(Format::Tmesh)?)
    }

    /// The same for [`Session::write_in`] and [`Session::write_as`]. Where there is no input either, that is what is said:
    /// whoever tries a tool on its own wants to know what it reads.
    pub fn check_output_in(&self, format: Format) -> Result<(), Failure> {
        self.check_input()?;
        let path = self.common.output.as_deref();
        let Some(path) = path.filter(|p| *p != Path::new("-")) else {
            self.note_other_format(format);
            return refuse_terminal(format.is_binary());
        };
        if format.is_folder() {
            return refuse_file(path);
        }
        refuse_folder(path)?;
        let folder = folder_of(path).metadata();
        folder
            .map(|_| ())
            .map_err(|e| Failure::writing(&path.display().to_string(), &e))
    }

    /// Says which format standard output gets where the shell sends it to a file that is named after another
    /// one: `rotassemble > a.vtu`.
    fn note_other_format(&self, format: Format) {
        // The name is known where the system shows open files as links.
        let path =
            std::fs::read_link("/proc/self/fd/1").or_else(|_| std::fs::read_link("/dev/fd/1"));
        let Ok(path) = path else { return };
        let named = Format::from_path(&path).filter(|named| *named != format && path.is_file());
        if let Some(named) = named {
            let (name, own) = (path.display(), format.name());
            let other = named.name();
            self.note(&format!(
                "{name} gets {own}: standard output is {own} whatever the file is called; add --to {other}, or \
                 use -o"
            ));
        }
    }

    /// Says what a document loses in a foreign format that the next tool would look for.
    fn note_what_is_lost(&self, document: &Document, format: Format) {
        if format.holds_document() {
            return;
        }
        let name = format.name();
        if document.instances.len() > 1 {
            self.note(&format!(
                "{name} holds the pieces, not how they are placed and glued: it is for looking at, and the next \
                 tool needs tmesh"
            ));
        } else if let Some(symmetry) = &document.symmetry {
            if format.keeps_symmetry() && document.is_plain() {
                let sized = document.regions.iter().any(|r| r.size.is_some());
                if sized || !document.wishes.is_empty() {
                    self.note(&format!(
                        "{name} holds the mesh and its symmetry, not what is asked of the elements: the next tool \
                         is to be told, or to get tmesh"
                    ));
                }
                return;
            }
            self.note(&format!(
                "{name} holds the mesh, not the symmetry {} that was found: it is for looking at, and the next \
                 tool needs tmesh",
                symmetry.group
            ));
        }
    }

    /// Opens the output named on the command line.
    pub fn create_output(&self, format: Format) -> Result<Output, Failure> {
        Output::create(self.common.output.as_deref(), format.is_binary())
    }

    /// Writes a document as the command line asks, `tmesh` by default. Foreign formats get each
    /// template once, with its walls: what is seen is what the next tool would read.
    pub fn write(&self, document: &Document) -> Result<(), Failure> {
        let format = self.output_format(Format::Tmesh)?;
        self.note_what_is_lost(document, format);
        self.write_in(document, format)
    }

    /// As [`Session::write`], in the given format.
    pub fn write_in(&self, document: &Document, format: Format) -> Result<(), Failure> {
        self.write_as(format, |out| match format {
            Format::Text => Ok(write_text(document, self.chunks(), out)?),
            format => write_document(document, format, out),
        })
    }

    /// Opens the output, has `fill` write to it, and makes it appear under its name.
    pub fn write_as(
        &self,
        format: Format,
        fill: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
    ) -> Result<(), Failure> {
        let mut out = self.create_output(format)?;
        fill(&mut out).map_err(|error| write_failure(error, &out))?;
        out.commit()?;
        self.info("written");
        Ok(())
    }

    /// Writes several files, one after another, and makes them appear under their names when all are
    /// whole; `fill` gets their positions.
    pub fn write_files(
        &self,
        paths: &[PathBuf],
        mut fill: impl FnMut(usize, &mut dyn Write) -> Result<(), WriteError>,
    ) -> Result<(), Failure> {
        let mut closed = Vec::with_capacity(paths.len());
        for (i, path) in paths.iter().enumerate() {
            let mut out = Output::create(Some(path), false)?;
            fill(i, &mut out).map_err(|error| write_failure(error, &out))?;
            closed.push(out.close()?);
        }
        closed.into_iter().try_for_each(Closed::publish)?;
        self.info(&format!("{} files written", paths.len()));
        Ok(())
    }
}

fn write_failure(error: WriteError, out: &Output) -> Failure {
    match error {
        WriteError::Io(error) => out.failure(&error),
        WriteError::NotAnOutput(_) | WriteError::SeveralFiles(_) | WriteError::NoSecondOrder(_) => {
            Failure::Usage(error.to_string())
        }
        error => Failure::Impossible(error.to_string()),
    }
}
