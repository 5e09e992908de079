//! The mesh as one file, or as several side by side.

use interchange::{Format, MeshStream, WriteError, WriteOptions, Writer, file_parts, write_part};
use kit::{Failure, Progress, Session};
use std::io::{self, Write};
use std::path::Path;

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
    let several = !matches!(format.entry().writer, Writer::Mesh(..));
    if several {
        let path = output_path(session, format)?;
        let paths = file_parts(format, path);
        let write = || session.write_files(&paths, |i, out| write_part(mesh, format, i, out));
        return match format.is_folder() {
            true => in_folder(path, write),
            false => write(),
        };
    }
    write_stream(session, format, size, |out| {
        interchange::write(mesh, format, options, out)
    })
}

/// Writes files into a folder, which is made where it is missing, and taken away again where that fails.
///
/// # Errors
/// Folders that cannot be made, and those of `write`.
pub fn in_folder(
    folder: &Path,
    write: impl FnOnce() -> Result<(), Failure>,
) -> Result<(), Failure> {
    let fresh = !folder.exists();
    std::fs::create_dir_all(folder)
        .map_err(|e| Failure::writing(&folder.display().to_string(), &e))?;
    let written = write();
    if written.is_err() && fresh {
        // Empty unless something else put files there.
        let _ = std::fs::remove_dir(folder);
    }
    written
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
