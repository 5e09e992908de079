//! The command line of `periodic-surf`.

use kit::{Command, CommonArgs, Failure, Session, StrictArgs, WishArgs};
use tetwedge::{MemoryArgs, surfaces, watched};

const EXAMPLES: &str = "Examples:
  symdetect fan.stl | wedgecut | periodic-surf | tetwedge | rotassemble > fan.vtk
  periodic-surf --edge-length 0.05 fan.wedge.tmesh | tetwedge -o fan.tmesh
  periodic-surf --size-field background.msh fan.wedge.tmesh | tetwedge -o fan.tmesh";

/// Make the surface mesh of a wedge whose cut faces match under the rotation
///
/// The surface is refined as size and quality ask for, thin layers included, and the two faces of a
/// seam stay images of each other; tetwedge then keeps it, and inherits what was asked of the elements.
/// Where lengths of edges are asked for, the wedge is filled to see whether the surface may have just these.
/// Wedges between mirror walls pass as they are.
#[derive(clap::Parser, Debug)]
#[command(name = "periodic-surf", version, after_help = EXAMPLES)]
pub struct Cli {
    #[command(flatten)]
    common: CommonArgs,

    #[command(flatten)]
    wishes: WishArgs,

    #[command(flatten)]
    memory: MemoryArgs,

    #[command(flatten)]
    strict: StrictArgs,
}

impl Command for Cli {
    fn common(&self) -> &CommonArgs {
        &self.common
    }

    fn run(self, session: &Session) -> Result<(), Failure> {
        session.check_output()?;
        let mut document = session.read()?;
        let notes = self.wishes.apply(&mut document)?;
        notes.iter().for_each(|note| session.note(note));
        let params = self.memory.params(&document.wishes);
        let made = watched(session, |log, _| surfaces(document, &params, log));
        let made = made.map_err(|error| error.failure())?;
        made.facts.iter().for_each(|fact| session.info(fact));
        made.advice.iter().for_each(|advice| session.note(advice));
        let mut document = made.document;
        let short = self.strict.judge(session, &document)?;
        let notes = [made.advice, made.facts, short].concat();
        document.history.push(session.history_entry(notes));
        session.write(&document)
    }
}
