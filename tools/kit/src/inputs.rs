//! Several inputs that are one body together.

use crate::{Failure, InputFile, Session};
use heal::{HealError, Healing, Imported, Part, assemble, read_part};
use std::collections::BTreeMap;
use std::fs::File;
use tmesh::Document;

impl Session {
    /// Fails where several inputs cannot be one body whatever they hold: standard input is named twice, or a region.
    pub(crate) fn check_names(&self) -> Result<(), Failure> {
        let mut known = BTreeMap::new();
        let mut streams = 0;
        for input in &self.inputs {
            streams += usize::from(input.is_standard_input());
            if streams > 1 {
                let text = "standard input is named twice, and can be read only once";
                return Err(Failure::Usage(text.to_owned()));
            }
            let name = input.naming().name().to_owned();
            if let Some(other) = known.insert(name.clone(), input) {
                return Err(Failure::Usage(format!(
                    "{} and {} would both be region '{name}'; name one of them otherwise with --region NAME=FILE",
                    other.label(),
                    input.label()
                )));
            }
        }
        Ok(())
    }

    /// Reads all inputs as one body.
    pub(crate) fn read_several(&self, healing: Healing) -> Result<Document, Failure> {
        let mut parts = Vec::new();
        let mut notices = Vec::new();
        for input in &self.inputs {
            let mut part = self.read_one(input, healing)?;
            let label = input.label();
            let told = part.take_notices().into_iter();
            notices.extend(told.map(|notice| format!("{label}: {notice}")));
            parts.push(part);
        }
        let together = |e: HealError| match &self.inputs[..] {
            [input] => Failure::Input(format!("{}: {e}", input.label())),
            all => Failure::Input(format!("the {} inputs together: {e}", all.len())),
        };
        let imported = assemble(parts, healing.repairing).map_err(together)?;
        notices.extend(imported.notices);
        Ok(self.accept(Imported {
            notices,
            ..imported
        }))
    }

    fn read_one(&self, input: &InputFile, healing: Healing) -> Result<Part, Failure> {
        let label = input.label();
        let fail = |text: String| Failure::Input(format!("{label}: {text}"));
        let read = if input.is_standard_input() {
            self.read_all(std::io::stdin().lock(), None).map_err(fail)?
        } else {
            let file: File = self.open(&input.path)?;
            self.read_all(file, Some(&input.path)).map_err(fail)?
        };
        let (bytes, format) = read;
        read_part(&bytes, format, input.naming(), healing).map_err(|error| {
            let text = error.to_string();
            if let HealError::NotClosed { edges, .. } = error {
                let _ = self.odd_edges.set(*edges);
            }
            fail(text)
        })
    }
}
