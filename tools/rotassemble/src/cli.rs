//! The command line of `rotassemble`.

use crate::{Assembled, NumberingError, sector, write_expanded};
use clap::ValueEnum;
use interchange::{Format, MeshStream, Plain, Surface, WriteError, WriteOptions};
use kit::{Command, CommonArgs, Failure, Progress, Session};
use std::io::{self, Write};

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
        let as_is = matches!(format, Format::Tmesh | Format::Text);
        if self.instances && !as_is {
            return Err(Failure::Usage(format!(
                "{} has no instances; --instances goes with --to tmesh or --to txt",
                format.name()
            )));
        }
        let options = WriteOptions {
            boundary: self.boundary,
            surface: match self.surface {
                SurfaceArg::Boundary => Surface::Boundary,
                SurfaceArg::All => Surface::All,
            },
        };
        let mut document = session.read()?;
        document.history.push(session.history_entry(Vec::new()));
        if self.sector {
            document = sector(document);
        }
        let listed = self.instances || format == Format::Text;
        if listed || (self.sector && as_is) {
            return session.write_in(&document, format);
        }
        let mesh = Assembled::new(&document).map_err(|error| match error {
            NumberingError::TooManyPoints { .. } => Failure::Impossible(error.to_string()),
            error => Failure::Input(error.to_string()),
        })?;
        // Nothing to assemble: the walls are worth keeping.
        if document.instances.len() <= document.templates.len() && !mesh.is_welded() {
            if as_is {
                return session.write_in(&document, format);
            }
            let plain = Plain::new(&document).map_err(|e| Failure::Impossible(e.to_string()))?;
            return write_mesh(session, &plain, format, &options);
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

fn write_mesh(
    session: &Session,
    mesh: &dyn MeshStream,
    format: Format,
    options: &WriteOptions,
) -> Result<(), Failure> {
    let size = interchange::size_estimate(mesh, format, options);
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
