//! The command line of `periodic-surf`.

use crate::prepare;
use kit::{Command, CommonArgs, Failure, Session};

const EXAMPLES: &str = "Examples:
  symdetect fan.stl | wedgecut | periodic-surf | tetwedge | rotassemble > fan.vtk
  periodic-surf fan.wedge.tmesh --to stl -o fan.wedge.stl";

/// Prepare the surface of a wedge for the mesher.
///
/// Wedges between mirror walls pass as they are. On wedges whose sides match under the rotation, the
/// triangulation of both sides is kept as it was cut.
#[derive(clap::Parser, Debug)]
#[command(name = "periodic-surf", version, after_help = EXAMPLES)]
pub struct Cli {
    #[command(flatten)]
    common: CommonArgs,
}

impl Command for Cli {
    fn common(&self) -> &CommonArgs {
        &self.common
    }

    fn run(self, session: &Session) -> Result<(), Failure> {
        let document = session.read()?;
        let (mut document, report) =
            prepare(document).map_err(|error| Failure::Input(error.to_string()))?;
        let note = if report.seam_vertices == 0 {
            "no seam: the mesher may refine all walls".to_owned()
        } else {
            format!(
                "seam kept as cut: {} vertex pairs, {} triangle pairs",
                report.seam_vertices, report.seam_triangles
            )
        };
        session.info(&note);
        document.history.push(session.history_entry(vec![note]));
        session.write(&document)
    }
}
