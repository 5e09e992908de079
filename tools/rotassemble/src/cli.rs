//! The command line of `rotassemble`.

use crate::{
    Assembled, MirrorWish, NumberingError, Piece, TableFormat, conditions, sector, sort_by_region,
    write_expanded, write_pairs,
};
use clap::ValueEnum;
use interchange::{
    Format, MeshStream, Middles, Plain, Surface, WriteError, WriteOptions, Writer, file_parts,
    second_order, write_part, write_pieces,
};
use kit::{Command, CommonArgs, Failure, Progress, Session};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tmesh::Document;

/// Assemble the whole mesh from the instances of a meshed wedge
///
/// Reads a document of templates and instances, as `tetwedge` writes it, places every instance,
/// welds them along their walls and writes the whole mesh. The weld is index arithmetic on the
/// stored walls: no coordinates are compared. The mesh is written as it is made, in the memory of
/// the wedge.
///
/// The default output is a legacy VTK file (binary, unstructured grid) with the cell array
/// `region`; its title names the symmetry that the mesh has by construction. A document without
/// tetrahedra gives the whole surface.
#[derive(clap::Parser, Debug)]
#[command(name = "rotassemble", version, after_help = EXAMPLES)]
pub struct Cli {
    #[command(flatten)]
    common: CommonArgs,

    /// Write the wedge alone, every template once, with its walls; as tmesh with its pairs
    #[arg(long, conflicts_with = "instances")]
    sector: bool,

    /// Keep the instances as they are instead of expanding them (tmesh, or txt to list them)
    #[arg(long)]
    instances: bool,

    /// Add the surface triangles to a VTK or VTU file that has tetrahedra, and to all cells the
    /// arrays `instance`, `marker`, `wall`, `front` and `back`
    #[arg(long)]
    boundary: bool,

    /// Which triangles an STL file gets: the boundary of the body, or the interfaces between
    /// regions as well
    #[arg(long, value_name = "WHICH", default_value = "boundary")]
    surface: SurfaceArg,

    /// Elements with a point in the middle of each edge; edges stay straight (vtk, vtu, pvtu, msh,
    /// msh2, inp)
    #[arg(long, conflicts_with = "instances")]
    second_order: bool,

    /// Write numbers as text (msh, msh2)
    #[arg(long)]
    ascii: bool,

    /// Compress the arrays (vtu, pvtu)
    #[arg(long)]
    compress: bool,

    /// Of a sector, also write the table of coupled nodes and faces: JSON, or CSV by the extension
    #[arg(long, value_name = "PATH", requires = "sector")]
    pairs: Option<PathBuf>,

    /// Of a sector, also write the conditions on displacements at its mirror planes, or at the wall named:
    /// `symmetric` (nothing moves out of the plane), `antisymmetric` (nothing moves within it) or
    /// `none`, which is right for heat; repeatable (inp)
    #[arg(long, value_name = "[WALL=]HOW", requires = "sector")]
    mirror: Vec<MirrorWish>,
}

const EXAMPLES: &str = "\
Examples:
  symdetect a.stl | wedgecut | tetwedge | rotassemble > a.vtk
      The whole pipe.
  rotassemble a.tet.tmesh -o a.vtu --boundary
      For ParaView: tetrahedra and the surface, with regions, markers and instances.
  rotassemble a.tet.tmesh --to tmesh | meshqual --check
      The whole mesh as one template, checked.
  rotassemble a.tet.tmesh --sector -o wedge.vtk --boundary
      One wedge, in its place, with its walls labelled.
  rotassemble a.tet.tmesh --sector -o wedge.inp --pairs pairs.json
      For cyclic-symmetric analysis: one wedge with sets, tie and number of sectors, and the table
      of coupled nodes, counted as in the mesh file.
  rotassemble a.tet.tmesh --sector --mirror symmetric -o wedge.inp
      For solutions that are symmetric at all mirror planes of the wedge.
  rotassemble a.tet.tmesh -o a.msh
      For Gmsh and what reads its files: regions and markers are physical groups.
  rotassemble a.tet.tmesh -o a.pvtu
      For parallel readers: a file per instance in the folder a, with ids of the whole mesh.
  rotassemble a.wedge.tmesh -o whole.stl
      Before meshing: the surface, as its wedges make it up.
  rotassemble a.tet.tmesh --to txt
      What is in the document.";

#[derive(ValueEnum, Clone, Copy, Debug)]
enum SurfaceArg {
    Boundary,
    All,
}

impl Command for Cli {
    fn common(&self) -> &CommonArgs {
        &self.common
    }

    fn run(self, session: &Session) -> Result<(), Failure> {
        let default = if self.instances {
            Format::Tmesh
        } else {
            Format::Vtk
        };
        let format = session.output_format(default)?;
        let as_is = format.holds_document();
        if self.instances && !as_is {
            return Err(Failure::Usage(format!(
                "{} has no instances; --instances goes with --to tmesh or --to txt",
                format.name()
            )));
        }
        if !self.mirror.is_empty() && !format.entry().conditions {
            return Err(Failure::Usage(format!(
                "{} has no conditions; --mirror goes with --to inp",
                format.name()
            )));
        }
        let mut options = WriteOptions {
            boundary: self.boundary,
            surface: match self.surface {
                SurfaceArg::Boundary => Surface::Boundary,
                SurfaceArg::All => Surface::All,
            },
            ascii: self.ascii,
            compress: self.compress,
            parities: Vec::new(),
        };
        let listed = self.instances || format == Format::Text;
        if self.second_order && (as_is || listed) {
            return Err(Failure::Usage(format!(
                "{} has first-order elements only; --second-order goes with other formats",
                format.name()
            )));
        }
        session.check_output_in(format)?;
        let mut document = session.read()?;
        document.history.push(session.history_entry(Vec::new()));
        if self.sector {
            document = sector(document);
        }
        if format.entry().by_region {
            sort_by_region(&mut document);
        }
        let mut middles = None;
        if self.second_order {
            let added = second_order(document).map_err(|e| Failure::Impossible(e.to_string()))?;
            (document, middles) = (added.0, Some(added.1));
        }
        let middles = middles.as_ref();
        if listed && self.pairs.is_none() {
            return session.write_in(&document, format);
        }
        let mesh = Assembled::of_order(&document, middles).map_err(|error| match error {
            NumberingError::TooManyPoints { .. } => Failure::Impossible(error.to_string()),
            error => Failure::Input(error.to_string()),
        })?;
        if matches!(format.entry().writer, Writer::Pieces) {
            return write_pvtu(session, &mesh, &document, &options);
        }
        // Nothing to assemble: each template as it is, with all its walls.
        let apart = document.instances.len() <= document.templates.len() && !mesh.is_welded();
        let plain = if apart || self.pairs.is_some() {
            Some(plain(&document, middles)?)
        } else {
            None
        };
        let shown: &dyn MeshStream = match &plain {
            Some(plain) if apart => plain,
            _ => &mesh,
        };
        if self.sector && format.entry().conditions {
            let settled = conditions(shown, &self.mirror)?;
            settled.note.iter().for_each(|note| session.note(note));
            options.parities = settled.parities;
        }
        if let Some(path) = &self.pairs {
            let table = match path.extension() {
                Some(e) if e.eq_ignore_ascii_case("csv") => TableFormat::Csv,
                _ => TableFormat::Json,
            };
            session.write_files(std::slice::from_ref(path), |_, out| {
                let first = format.entry().first_id;
                Ok(write_pairs(shown, &document, first, table, out)?)
            })?;
        }
        if self.sector && as_is {
            return session.write_in(&document, format);
        }
        if apart {
            if as_is {
                return session.write_in(&document, format);
            }
            return write_mesh(session, shown, format, &options);
        }
        session.info(&format!(
            "{} instances make {} points, {} tetrahedra",
            document.instances.len(),
            mesh.point_count(),
            mesh.tet_count()
        ));
        if format == Format::Tmesh {
            let size = 24 * (mesh.point_count() + mesh.triangle_count()) + 20 * mesh.tet_count();
            return write_stream(session, format, size, |out| {
                Ok(write_expanded(&mesh, &document, out)?)
            });
        }
        write_mesh(session, &mesh, format, &options)
    }
}

fn plain<'a>(document: &'a Document, middles: Option<&'a Middles>) -> Result<Plain<'a>, Failure> {
    Plain::of_order(document, middles).map_err(|e| Failure::Impossible(e.to_string()))
}

/// The path to write several files beside.
fn output_path(session: &Session, format: Format) -> Result<&Path, Failure> {
    let path = session.common().output.as_deref();
    let path = path.filter(|p| *p != Path::new("-") && p.file_name().is_some());
    path.ok_or_else(|| Failure::Usage(WriteError::SeveralFiles(format.name()).to_string()))
}

/// A file that lists the pieces, and in the folder beside it a piece for each instance.
fn write_pvtu(
    session: &Session,
    mesh: &Assembled<'_>,
    document: &Document,
    options: &WriteOptions,
) -> Result<(), Failure> {
    let path = output_path(session, Format::Pvtu)?;
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
    let mut sources = Vec::new();
    let mut paths = Vec::new();
    for i in 0..document.instances.len() {
        let name = format!("{stem}_{i}.vtu");
        paths.push(folder.join(&name));
        sources.push(format!("{stem}/{name}"));
    }
    let sources: Vec<String> = evenly(document)
        .into_iter()
        .map(|i| std::mem::take(&mut sources[i]))
        .collect();
    paths.push(path.to_owned());
    let fresh = !folder.exists();
    std::fs::create_dir_all(&folder)
        .map_err(|e| Failure::writing(&folder.display().to_string(), &e))?;
    let progress = session.progress(paths.len() as u64, "writing");
    let written = session.write_files(&paths, |i, out| {
        progress.set(i as u64);
        let piece = Piece::new(mesh, i.min(sources.len().saturating_sub(1)));
        if i < sources.len() {
            interchange::write(&piece, Format::Vtu, options, out)
        } else {
            write_pieces(&piece, options.boundary, &sources, out)
        }
    });
    if written.is_err() && fresh {
        // Empty unless something else put files there.
        let _ = std::fs::remove_dir(&folder);
    }
    written
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

fn write_mesh(
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
fn write_stream(
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
