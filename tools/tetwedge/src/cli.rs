//! The command line of `tetwedge`.

use crate::document::tetrahedralize_shaped;
use crate::forecast::forecast;
use crate::settle::Shaped;
use crate::{MemoryArgs, watched};
use kit::{
    Command, CommonArgs, Failure, Session, StrictArgs, ThreadArgs, WishArgs, about, duration,
};
use mesher::Params;
use surface::failure;
use tmesh::Wishes;

/// Fills a wedge, or any closed surface, with tetrahedra
///
/// The mesher is TetGen. Mirror walls may be refined. Faces that copies share by a rotation or a half turn get the surface mesh
/// that the elements need, as periodic-surf makes it, unless that was there before. Regions come from the surface's
/// triangles. At a terminal it says before it starts about how many tetrahedra there will be, and then how far it is.
#[derive(clap::Parser, Debug)]
#[command(
    name = "tetwedge",
    version,
    after_help = "Examples:\n  \
        symdetect a.stl | wedgecut | tetwedge | rotassemble > a.vtk\n  \
        tetwedge wedge.tmesh --max-volume 0.01 --region copper:max-volume=1e-4 -o meshed.tmesh\n  \
        tetwedge -v --timeout 60 --edge-length 0.05 wedge.tmesh -o meshed.tmesh\n  \
        tetwedge --size-field background.vtu:length wedge.tmesh -o meshed.tmesh"
)]
pub struct Cli {
    #[command(flatten)]
    common: CommonArgs,

    #[command(flatten)]
    wishes: WishArgs,

    #[command(flatten)]
    memory: MemoryArgs,

    /// Keep the faces that copies share by a rotation or a half turn as they are, and the surface beside them; without
    /// this they are remeshed, unless periodic-surf has done so
    #[arg(long)]
    keep_surface: bool,

    /// TetGen switches to append to ours
    #[arg(long, value_name = "STR", default_value = "", value_parser = switches, allow_hyphen_values = true, hide_default_value = true)]
    switches: String,

    #[command(flatten)]
    strict: StrictArgs,

    #[command(flatten)]
    threads: ThreadArgs,
}

fn switches(text: &str) -> Result<String, String> {
    let text = text.trim().trim_start_matches('-');
    if let Some(odd) = text.chars().find(|c| !c.is_ascii_graphic()) {
        return Err(format!("{odd:?} is not part of a TetGen switch"));
    }
    Ok(text.to_owned())
}

impl Cli {
    fn params(&self, wishes: &Wishes) -> Params {
        Params {
            switches: self.switches.clone(),
            ..self.memory.params(wishes)
        }
    }

    /// What to expect of the work, in tetrahedra and in words, where somebody watches it.
    fn expected(
        &self,
        session: &Session,
        shaped: &Shaped,
        params: &Params,
    ) -> Option<(f64, String)> {
        if !session.is_watched() && !session.is_verbose() {
            return None;
        }
        let expected = forecast(shaped, params, self.threads.count())?;
        let text = format!(
            "about {} tetrahedra, about {}",
            about(expected.tetrahedra),
            duration(expected.time)
        );
        Some((expected.tetrahedra, text))
    }
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
        if self.keep_surface {
            document.wishes.keep_surface = Some(true);
        }
        let params = self.params(&document.wishes);
        let meshed = watched(session, |log, expect| {
            let shaped = |shaped: &Shaped| {
                if let Some((tetrahedra, text)) = self.expected(session, shaped, &params) {
                    expect(tetrahedra, &text);
                }
            };
            on_threads(self.threads.count(), || {
                tetrahedralize_shaped(document, &params, log, &shaped).map_err(|e| failure(&e))
            })
        })?;
        for sentence in &meshed.advice {
            session.note(sentence);
        }
        let mut document = meshed.document;
        let short = self.strict.judge(session, &document)?;
        let notes = [meshed.advice, short, meshed.facts].concat();
        document.history.push(session.history_entry(notes));
        session.write(&document)
    }
}

/// Does something with so many threads at hand.
fn on_threads<T: Send>(
    threads: usize,
    work: impl FnOnce() -> Result<T, Failure> + Send,
) -> Result<T, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    match pool {
        Ok(pool) => pool.install(work),
        // Where no threads are to be had, it goes without.
        Err(_) => work(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{CommandFactory, Parser};
    use tmesh::{Document, Template};

    fn parse(arguments: &[&str]) -> Result<Params, clap::Error> {
        let all = std::iter::once("tetwedge").chain(arguments.iter().copied());
        let cli = Cli::try_parse_from(all)?;
        let mut document = Document::single(Template::default());
        cli.wishes.apply(&mut document).unwrap();
        Ok(cli.params(&document.wishes))
    }

    #[test]
    fn options_become_parameters() {
        Cli::command().debug_assert();
        assert_eq!(parse(&[]).unwrap(), Params::default());
        let params = parse(&[
            "--optimize",
            "off",
            "--switches",
            "-T1e-10",
            "--timeout",
            "0.5",
        ]);
        let params = params.unwrap();
        assert_eq!(params.optimize, None);
        assert_eq!(params.switches, "T1e-10");
        assert_eq!(params.timeout, Some(std::time::Duration::from_millis(500)));
        for (size, bytes) in [("64", 64 << 20), ("1.5g", 3 << 29), ("2M", 2 << 20)] {
            let params = parse(&["--max-memory", size]).unwrap();
            assert_eq!(params.max_memory, Some(bytes));
        }
    }

    #[test]
    fn impossible_numbers_are_usage_errors() {
        for bad in [
            ["--radius-edge", "nan"],
            ["--radius-edge", "0.5"],
            ["--radius-edge", "-1"],
            ["--min-dihedral", "71"],
            ["--min-dihedral", "-1"],
            ["--max-volume", "0"],
            ["--max-volume", "inf"],
            ["--edge-length", "-2"],
            ["--optimize", "180"],
            ["--optimize", "on"],
            ["--region", "copper"],
            ["--region", ":max-volume=1"],
            ["--region", "copper:max-volume=x"],
            ["--timeout", "0"],
            ["--max-memory", "0"],
            ["--max-memory", "G"],
            ["--max-memory", "1e300G"],
            ["--switches", "a b"],
            ["--threads", "0"],
        ] {
            let error = parse(&bad).unwrap_err();
            assert_eq!(error.exit_code(), 2, "{bad:?}");
        }
    }
}
