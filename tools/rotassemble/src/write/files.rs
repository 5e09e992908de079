//! The mesh as one file, or as several side by side.

use interchange::{Format, MeshStream, WriteError, WriteOptions, file_parts, write_part};
use kit::{Failure, Progress, Session};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The path to write several files beside.
pub fn output_path(session: &Session, format: Format) -> Result<&Path, Failure> {
    let path = session.common().output.as_deref();
    let path = path.filter(|p| *p != Path::new("-") && p.file_name().is_some());
    path.ok_or_else(|| Failure::Usage(WriteError::SeveralFiles(format.name()).to_string()))
}

/// Writes a mesh in a format of one file or several.
///
/// # Errors
/// Outputs that cannot be written.
pub fn write_mesh(
    session: &Session,
    mesh: &dyn MeshStream,
    format: Format,
    options: &WriteOptions,
) -> Result<(), Failure> {
    let size = interchange::size_estimate(mesh, format, options);
    let parts = file_parts(format);
    if !parts.is_empty() {
        let path = output_path(session, format)?;
        let paths: Vec<PathBuf> = parts.iter().map(|p| path.with_extension(p)).collect();
        return session.write_files(&paths, |i, out| write_part(mesh, format, i, out));
    }
    write_stream(session, format, size, |out| {
        interchange::write(mesh, format, options, out)
    })
}

/// Writes with a progress bar; `size` is the number of bytes expected.
pub fn write_stream(
    session: &Session,
    format: Format,
    size: u64,
    fill: impl FnOnce(&mut dyn Write) -> Result<(), WriteError>,
) -> Result<(), Failure> {
    session.write_as(format, |out| {
        let progress = session.progress(size, "writing");
        fill(&mut Watched {
            out,
            progress,
            done: 0,
        })
    })
}

/// Moves a progress bar along with the bytes that pass.
struct Watched<'a> {
    out: &'a mut dyn Write,
    progress: Progress,
    done: u64,
}

impl Write for Watched<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.done += written as u64;
        self.progress.set(self.done);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
