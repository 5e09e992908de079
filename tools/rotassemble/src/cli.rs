//! The command line of `rotassemble`.

use crate::curved::follow_shape;
use crate::mesh::Assembled;
use crate::numbering::NumberingError;
use crate::sector::{sector, sort_by_region};
use crate::solver::{MirrorWish, conditions};
use crate::write::{
    TableFormat, write_expanded, write_mesh, write_pairs, write_pvtu, write_stream,
};
use clap::ValueEnum;
use interchange::{
    Format, MeshStream, Middles, Plain, Surface, WriteOptions, Writer, second_order,
};
use kit::{Command, CommonArgs, Failure, Session, StrictArgs};
use std::path::{Path, PathBuf};
use tmesh::Document;

/// Assemble the whole mesh from the instances of a meshed wedge
///
/// Reads a document of templates and instances, as `tetwedge` writes it, places every instance,
/// welds them along their walls and writes the whole mesh. The weld is index arithmetic on the
/// stored walls: no coordinates are compared. The mesh is written as it is made, in the memory of
/// the wedge.
///
/// The default output, and that of standard output whatever file it goes to, is a legacy VTK file
/// (binary, unstructured grid) with the cell array `region`; its title names the symmetry that the mesh
/// has by construction. Other formats are chosen by the extension of `-o` or by `--to`. A document without
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

    /// Elements with a point on each edge, on the smooth shape that the facets of curved faces stand for; edges at
    /// the feature angle and more, and flat faces, stay as they are (vtk, vtu, pvtu, msh, msh2, inp, bdf)
    #[arg(long, conflicts_with = "instances")]
    second_order: bool,

    /// With `--second-order`, the points are in the middle of straight edges, and the surface stays that of the facets
    #[arg(long, requires = "second_order")]
    straight_edges: bool,

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

    #[command(flatten)]
    strict: StrictArgs,
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
  rotassemble a.tet.tmesh --sector -o case/constant/polyMesh
      For OpenFOAM: a folder, with patches, cell zones, and cyclic or symmetry patches of a sector.
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
        self.check_usage(format)?;
        session.check_output_in(format)?;
        let mut document = session.read()?;
        let short = self.strict.judge(session, &document)?;
        document.history.push(session.history_entry(short));
        if format.entry().by_region {
            sort_by_region(&mut document);
        }
        let mut middles = None;
        if self.second_order {
            let added = self.of_second_order(session, document)?;
            (document, middles) = (added.0, Some(added.1));
        }
        if self.sector {
            document = sector(document);
        }
        if self.is_listed(format) && self.pairs.is_none() {
            return session.write_in(&document, format);
        }
        self.assemble(session, format, &document, middles.as_ref())
    }
}

impl Cli {
    /// Adds points on edges, on the shape unless edges are to be straight.
    fn of_second_order(
        &self,
        session: &Session,
        document: Document,
    ) -> Result<(Document, Middles), Failure> {
        let added = second_order(document).map_err(|e| Failure::Impossible(e.to_string()))?;
        let (mut document, middles) = added;
        if !self.straight_edges {
            let bends = follow_shape(&mut document, &middles).map_err(numbering)?;
            if let Some(told) = bends.told() {
                session.note(&told);
            }
        }
        Ok((document, middles))
    }

    /// Whether the document is written as it is, without being assembled.
    fn is_listed(&self, format: Format) -> bool {
        self.instances || format == Format::Text
    }

    /// Refuses options that a format has no place for.
    fn check_usage(&self, format: Format) -> Result<(), Failure> {
        let as_is = format.holds_document();
        let misplaced = [
            (
                self.instances && !as_is,
                "has no instances; --instances goes with --to tmesh or --to txt",
            ),
            (
                !self.mirror.is_empty() && !format.entry().conditions,
                "has no conditions; --mirror goes with --to inp",
            ),
            (
                self.second_order && (as_is || self.is_listed(format)),
                "has first-order elements only; --second-order goes with other formats",
            ),
        ];
        match misplaced.into_iter().find(|m| m.0) {
            Some((_, why)) => Err(Failure::Usage(format!("{} {why}", format.name()))),
            None => Ok(()),
        }
    }

    fn write_options(&self) -> WriteOptions {
        WriteOptions {
            boundary: self.boundary,
            surface: match self.surface {
                SurfaceArg::Boundary => Surface::Boundary,
                SurfaceArg::All => Surface::All,
            },
            ascii: self.ascii,
            compress: self.compress,
            parities: Vec::new(),
        }
    }

    /// Writes the mesh that a document stands for.
    fn assemble(
        &self,
        session: &Session,
        format: Format,
        document: &Document,
        middles: Option<&Middles>,
    ) -> Result<(), Failure> {
        let mesh = Assembled::of_order(document, middles).map_err(numbering)?;
        let mut options = self.write_options();
        if matches!(format.entry().writer, Writer::Pieces) {
            return write_pvtu(session, &mesh, document, &options);
        }
        // Nothing to assemble: each template as it is, with all its walls.
        let apart = document.instances.len() <= document.templates.len() && !mesh.is_welded();
        let plain = if apart || self.pairs.is_some() {
            Some(plain(document, middles)?)
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
            write_table(session, path, shown, document, format.entry().first_id)?;
        }
        if (self.sector || apart) && format.holds_document() {
            return session.write_in(document, format);
        }
        if apart {
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
                Ok(write_expanded(&mesh, document, out)?)
            });
        }
        write_mesh(session, &mesh, format, &options)
    }
}

/// What points that cannot be numbered are.
fn numbering(error: NumberingError) -> Failure {
    match error {
        NumberingError::TooManyPoints { .. } => Failure::Impossible(error.to_string()),
        error => Failure::Input(error.to_string()),
    }
}

/// Writes the table of coupled nodes and faces.
fn write_table(
    session: &Session,
    path: &Path,
    mesh: &dyn MeshStream,
    document: &Document,
    first_id: u64,
) -> Result<(), Failure> {
    let table = match path.extension() {
        Some(e) if e.eq_ignore_ascii_case("csv") => TableFormat::Csv,
        _ => TableFormat::Json,
    };
    session.write_files(&[path.to_owned()], |_, out| {
        Ok(write_pairs(mesh, document, first_id, table, out)?)
    })
}

fn plain<'a>(document: &'a Document, middles: Option<&'a Middles>) -> Result<Plain<'a>, Failure> {
    Plain::of_order(document, middles).map_err(|e| Failure::Impossible(e.to_string()))
}
