//! Reading what a tool works on.

use crate::args::inputs;
use crate::{Failure, InputFile, Session};
use heal::{HealError, Healing, Imported};
use interchange::{Format, sniff};
use std::fs::File;
use std::io::{BufReader, IsTerminal, Read};
use std::path::Path;
use tmesh::{DecodeError, Document};

impl Session {
    /// Fails where there is nothing to read: no file is named, and standard input is a terminal.
    pub(crate) fn check_input(&self) -> Result<(), Failure> {
        let from_stream = self.inputs.iter().any(InputFile::is_standard_input);
        if (from_stream || self.inputs.is_empty()) && std::io::stdin().is_terminal() {
            return Err(Failure::Usage(
                "no input: name a file, or pipe a mesh into standard input (see --help)".to_owned(),
            ));
        }
        self.check_names()
    }

    /// Reads the inputs named on the command line, whatever their formats.
    pub fn read(&self) -> Result<Document, Failure> {
        self.read_with(Healing::default())
    }

    /// The same, where the caller says what is made of surfaces.
    pub fn read_with(&self, healing: Healing) -> Result<Document, Failure> {
        self.check_input()?;
        let document = match &self.inputs[..] {
            [] => self.read_stream(healing)?,
            [input] if input.region.is_none() && input.is_standard_input() => {
                self.read_stream(healing)?
            }
            [input] if input.region.is_none() => {
                self.read_file(&input.path, self.common.from, healing)?
            }
            _ => self.read_several(healing)?,
        };
        let (vertices, triangles, tets) = document.templates.iter().fold((0, 0, 0), |n, t| {
            (
                n.0 + t.vertices.len(),
                n.1 + t.triangles.len(),
                n.2 + t.tets.len(),
            )
        });
        self.info(&format!(
            "read {vertices} vertices, {triangles} triangles, {tets} tetrahedra"
        ));
        Ok(document)
    }

    /// Reads a further input, whose format its content shows.
    pub fn read_other(&self, path: &Path) -> Result<Document, Failure> {
        self.read_file(path, None, Healing::default())
    }

    fn read_stream(&self, healing: Healing) -> Result<Document, Failure> {
        self.read_from(std::io::stdin().lock(), (None, self.common.from), healing)
            .map_err(|text| Failure::Input(format!("standard input: {text}")))
    }

    fn read_file(
        &self,
        path: &Path,
        from: Option<Format>,
        healing: Healing,
    ) -> Result<Document, Failure> {
        self.read_from(self.open(path)?, (Some(path), from), healing)
            .map_err(|text| Failure::Input(format!("{}: {text}", path.display())))
    }

    pub(crate) fn open(&self, path: &Path) -> Result<File, Failure> {
        let name = path.display();
        let open = |e: std::io::Error| Failure::Input(format!("cannot read {name}: {e}"));
        let file = File::open(path).map_err(open)?;
        if file.metadata().is_ok_and(|m| m.is_dir()) {
            return Err(Failure::Input(format!(
                "cannot read {name}: it is a directory"
            )));
        }
        Ok(file)
    }

    fn read_from(
        &self,
        input: impl Read,
        (path, from): (Option<&Path>, Option<Format>),
        healing: Healing,
    ) -> Result<Document, String> {
        let mut input = BufReader::new(input);
        let (mut head, format) = recognized(&mut input, (path, from))?;
        if format == Format::Tmesh {
            let (document, chunks) =
                tmesh::read_with_chunks(head.as_slice().chain(input)).map_err(|e| e.to_string())?;
            // A second read keeps the first one's list; no tool reads twice.
            let _ = self.read.set(chunks);
            return Ok(document);
        }
        input.read_to_end(&mut head).map_err(unreadable)?;
        let imported = heal::read_with(&head, format, healing).map_err(|error| {
            let text = error.to_string();
            if let HealError::NotClosed { edges, .. } = error {
                let _ = self.odd_edges.set(*edges);
            }
            text
        })?;
        Ok(self.accept(imported))
    }

    /// All bytes of an input, and its format.
    pub(crate) fn read_all(
        &self,
        input: impl Read,
        path: Option<&Path>,
    ) -> Result<(Vec<u8>, Format), String> {
        let mut input = BufReader::new(input);
        let (mut bytes, format) = recognized(&mut input, (path, self.common.from))?;
        input.read_to_end(&mut bytes).map_err(unreadable)?;
        Ok((bytes, format))
    }

    /// Tells and keeps what there is to say about what was read.
    pub(crate) fn accept(&self, imported: Imported) -> Document {
        let Imported {
            document,
            notices,
            repairs,
            joined,
            undrawn,
            is_apart,
        } = imported;
        for notice in &notices {
            self.note(notice);
        }
        let _ = self.notices.set(notices);
        let _ = self.repairs.set(repairs);
        let _ = self.is_apart.set(is_apart);
        if let Some(joined) = joined {
            let _ = self.joined.set(joined);
        }
        if let Some(undrawn) = undrawn {
            let _ = self.undrawn.set(undrawn);
        }
        document
    }
}

fn unreadable(e: std::io::Error) -> String {
    format!("cannot read: {e}")
}

/// The first bytes of an input, and the format that they or its name show.
pub(crate) fn recognized(
    input: &mut BufReader<impl Read>,
    (path, from): (Option<&Path>, Option<Format>),
) -> Result<(Vec<u8>, Format), String> {
    let mut head = Vec::new();
    // What the buffer holds tells the format: it is more than the comments before the first telling line of text.
    let buffer = input.capacity() as u64;
    input
        .take(buffer)
        .read_to_end(&mut head)
        .map_err(unreadable)?;
    if head.is_empty() {
        return Err(DecodeError::Empty.to_string());
    }
    match from.or_else(|| sniff(&head, path)) {
        Some(format) => Ok((head, format)),
        None => Err(unrecognized(&head, path)),
    }
}

/// What to do about a file of no known format. CAD programs write surfaces of their own kinds, which have to be
/// divided into triangles first.
fn unrecognized(head: &[u8], path: Option<&Path>) -> String {
    let is_step = head.trim_ascii_start().starts_with(b"ISO-10303-21");
    let extension = path.and_then(|p| p.extension()).unwrap_or_default();
    let is_cad = |known: &&&str| extension.eq_ignore_ascii_case(known);
    let named = ["step", "stp", "iges", "igs", "brep"].iter().find(is_cad);
    if is_step || named.is_some() {
        let name = match path {
            Some(path) => path.display().to_string(),
            None => "part.step".to_owned(),
        };
        let mesh = Path::new(&name).with_extension("msh");
        return format!(
            "it holds curved surfaces of a CAD program, not triangles; make some first, as with \
             `gmsh -2 {name} -o {}`",
            mesh.display()
        );
    }
    format!(
        "the format is not recognized from the content; name it with --from: {}",
        inputs()
    )
}
