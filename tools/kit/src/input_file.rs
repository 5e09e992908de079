//! A file to read, and what it is called.

use heal::Naming;
use interchange::text::plain;
use std::path::{Path, PathBuf};

/// A file to read, by `-` standard input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputFile {
    /// Where it is.
    pub path: PathBuf,
    /// What all of it is called as a region, if the user says so.
    pub region: Option<String>,
}

impl InputFile {
    /// A file whose regions have names of their own, or the file's.
    pub fn unnamed(path: PathBuf) -> Self {
        Self { path, region: None }
    }

    /// From `NAME=FILE`.
    ///
    /// # Errors
    /// Says what is missing.
    pub fn named(text: &str) -> Result<Self, String> {
        let Some((name, path)) = text.split_once('=') else {
            return Err("NAME=FILE is wanted, the region's name before the file's".to_owned());
        };
        if name.ends_with(":max-volume") {
            return Err("NAME=FILE is wanted; sizes are for the stages after this one".to_owned());
        }
        if name.is_empty() || plain(name) != name {
            return Err("the region's name must have printable characters".to_owned());
        }
        if path.is_empty() {
            return Err(format!("region '{name}' needs a file after the ="));
        }
        Ok(Self {
            path: path.into(),
            region: Some(name.to_owned()),
        })
    }

    /// Whether it is standard input.
    pub fn is_standard_input(&self) -> bool {
        self.path == Path::new("-")
    }

    /// What it is called in messages.
    pub fn label(&self) -> String {
        match self.is_standard_input() {
            true => "standard input".to_owned(),
            false => self.path.display().to_string(),
        }
    }

    /// What its regions are called.
    pub(crate) fn naming(&self) -> Naming {
        match &self.region {
            Some(name) => Naming::Region(name.clone()),
            None if self.is_standard_input() => Naming::File("stdin".to_owned()),
            None => {
                let stem = self.path.file_stem().unwrap_or_default();
                Naming::File(plain(&stem.to_string_lossy()))
            }
        }
    }
}
