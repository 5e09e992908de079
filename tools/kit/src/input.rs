//! Reading the one input document.

use crate::args::inputs;
use crate::{Failure, Session};
use heal::{HealError, Imported, Repairing};
use interchange::{Format, sniff};
use std::fs::File;
use std::io::{BufReader, IsTerminal, Read};
use std::path::Path;
use tmesh::{DecodeError, Document};

impl Session {
    /// Fails where there is nothing to read: no file is named, and standard input is a terminal.
    pub(crate) fn check_input(&self) -> Result<(), Failure> {
        if self.input_path().is_none() && std::io::stdin().is_terminal() {
            return Err(Failure::Usage(
                "no input: name a file, or pipe a mesh into standard input (see --help)".to_owned(),
            ));
        }
        Ok(())
    }

    fn input_path(&self) -> Option<&Path> {
        let path = self.common.input.as_deref();
        path.filter(|p| *p != Path::new("-"))
    }

    /// Reads the input named on the command line, whatever its format.
    pub fn read(&self) -> Result<Document, Failure> {
        self.read_with(Repairing::default())
    }

    /// The same, where the caller says whether a surface may be repaired.
    pub fn read_with(&self, repairing: Repairing) -> Result<Document, Failure> {
        self.check_input()?;
        let document = match self.input_path() {
            Some(path) => self.read_file(path, self.common.from, repairing)?,
            None => self
                .read_from(std::io::stdin().lock(), (None, self.common.from), repairing)
                .map_err(|text| Failure::Input(format!("standard input: {text}")))?,
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
        self.read_file(path, None, Repairing::default())
    }

    fn read_file(
        &self,
        path: &Path,
        from: Option<Format>,
        repairing: Repairing,
    ) -> Result<Document, Failure> {
        let name = path.display();
        let open = |e: std::io::Error| Failure::Input(format!("cannot read {name}: {e}"));
        let file = File::open(path).map_err(open)?;
        if file.metadata().is_ok_and(|m| m.is_dir()) {
            return Err(Failure::Input(format!(
                "cannot read {name}: it is a directory"
            )));
        }
        self.read_from(file, (Some(path), from), repairing)
            .map_err(|text| Failure::Input(format!("{name}: {text}")))
    }

    fn read_from(
        &self,
        input: impl Read,
        (path, from): (Option<&Path>, Option<Format>),
        repairing: Repairing,
    ) -> Result<Document, String> {
        let mut input = BufReader::new(input);
        let mut head = Vec::new();
        let read = |e: std::io::Error| format!("cannot read: {e}");
        // What the buffer holds tells the format: it is more than the comments before the first telling line of text.
        let buffer = input.capacity() as u64;
        (&mut input)
            .take(buffer)
            .read_to_end(&mut head)
            .map_err(read)?;
        if head.is_empty() {
            return Err(DecodeError::Empty.to_string());
        }
        let format = match from.or_else(|| sniff(&head, path)) {
            Some(format) => format,
            None => {
                return Err(unrecognized(&head, path));
            }
        };
        if format == Format::Tmesh {
            let (document, chunks) =
                tmesh::read_with_chunks(head.as_slice().chain(input)).map_err(|e| e.to_string())?;
            // A second read keeps the first one's list; no tool reads twice.
            let _ = self.read.set(chunks);
            return Ok(document);
        }
        input.read_to_end(&mut head).map_err(read)?;
        let imported = heal::read_with(&head, format, repairing).map_err(|error| {
            let text = error.to_string();
            if let HealError::NotClosed { edges, .. } = error {
                let _ = self.odd_edges.set(*edges);
            }
            text
        })?;
        let Imported {
            document,
            notices,
            repairs,
            joined,
        } = imported;
        for notice in &notices {
            self.note(notice);
        }
        let _ = self.notices.set(notices);
        let _ = self.repairs.set(repairs);
        if let Some(joined) = joined {
            let _ = self.joined.set(joined);
        }
        Ok(document)
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
