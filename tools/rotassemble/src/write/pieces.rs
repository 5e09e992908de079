//! A file that lists pieces, and a file per instance.

use super::files::{in_folder, output_path};
use crate::mesh::{Assembled, Piece};
use interchange::{Format, WriteOptions, write_pieces};
use kit::{Failure, Session};
use std::path::{Path, PathBuf};
use tmesh::Document;

/// Where the pieces of a file go: into a folder named as the file is without its extension.
struct Pieces {
    folder: PathBuf,
    /// The files of the instances, then the one that lists them.
    paths: Vec<PathBuf>,
    /// What the list calls the pieces, in its order.
    sources: Vec<String>,
}

impl Pieces {
    fn of(document: &Document, path: &Path) -> Result<Self, Failure> {
        let folder = path.with_extension("");
        let stem = folder.file_name().unwrap_or_default().to_string_lossy();
        if folder == path {
            return Err(Failure::Usage(format!(
                "the pieces of {} go into a folder named as it is without extension; give it the \
                 extension .pvtu",
                path.display()
            )));
        }
        if document.instances.is_empty() {
            let sentence = "the document has no instances, so there are no pieces to write";
            return Err(Failure::Impossible(sentence.to_owned()));
        }
        let name = |i: usize| format!("{stem}_{i}.vtu");
        let instances = 0..document.instances.len();
        let mut paths: Vec<PathBuf> = instances.map(|i| folder.join(name(i))).collect();
        paths.push(path.to_owned());
        let order = evenly(document).into_iter();
        let sources = order.map(|i| format!("{stem}/{}", name(i))).collect();
        Ok(Self {
            folder,
            paths,
            sources,
        })
    }
}

/// Writes a file that lists the pieces, and in the folder beside it a piece for each instance.
///
/// # Errors
/// Outputs that cannot be written, and documents without instances.
pub fn write_pvtu(
    session: &Session,
    mesh: &Assembled<'_>,
    document: &Document,
    options: &WriteOptions,
) -> Result<(), Failure> {
    let pieces = Pieces::of(document, output_path(session, Format::Pvtu)?)?;
    let count = pieces.sources.len();
    let progress = session.progress(pieces.paths.len() as u64, "writing");
    in_folder(&pieces.folder, || {
        session.write_files(&pieces.paths, |i, out| {
            progress.set(i as u64);
            let piece = Piece::new(mesh, i.min(count - 1));
            if i < count {
                interchange::write(&piece, Format::Vtu, options, out)
            } else {
                write_pieces(&piece, options.boundary, &pieces.sources, out)
            }
        })
    })
}

/// Instances in an order in which those of each template are spread evenly: parallel readers give
/// every rank a stretch of the list.
fn evenly(document: &Document) -> Vec<usize> {
    let mut of_template = vec![0_u64; document.templates.len()];
    let mut before = Vec::new();
    for instance in &document.instances {
        let count = &mut of_template[instance.template as usize];
        before.push(*count);
        *count += 1;
    }
    let mut order: Vec<usize> = (0..before.len()).collect();
    // The middle of its share of the list, a fraction: (2 k + 1) of (2 n).
    let place = |i: usize| {
        let count = of_template[document.instances[i].template as usize];
        (u128::from(2 * before[i] + 1), u128::from(2 * count))
    };
    order.sort_by(|&i, &j| {
        let ((a, b), (c, d)) = (place(i), place(j));
        (a * d).cmp(&(c * b)).then(i.cmp(&j))
    });
    order
}
