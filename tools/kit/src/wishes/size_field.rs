//! A background mesh whose point array says how long edges are to be from place to place.

use crate::Failure;
use crate::input::recognized;
use glam::DVec3;
use interchange::Format;
use interchange::parsed::{PointArray, PointMesh};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use tmesh::{Document, SizeField, SizePoint};

/// A file with a mesh, and which of its point arrays is meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SizeFieldFile(String);

/// What a body may stand out of its size field on each side, relative to its diagonal, before that is worth a word. A choice: what
/// chords and another program's tessellation cut off is less.
const BEYOND: f64 = 0.01;

/// Vertices that are looked at to know where a body is, about.
const LOOKED_AT: usize = 1 << 20;

impl SizeFieldFile {
    /// From `FILE` or `FILE:ARRAY`.
    ///
    /// # Errors
    /// Says what is missing.
    pub fn parse(text: &str) -> Result<Self, String> {
        match text {
            "" => Err("a file is wanted".to_owned()),
            "-" => Err("standard input is the body".to_owned()),
            _ => Ok(Self(text.to_owned())),
        }
    }

    /// The path, and the name of the array if there is one: a file whose name has a colon goes first.
    fn parts(&self) -> (PathBuf, Option<&str>) {
        let whole = PathBuf::from(&self.0);
        match self.0.rsplit_once(':') {
            Some((path, array)) if !whole.exists() && !path.is_empty() => {
                (path.into(), Some(array))
            }
            _ => (whole, None),
        }
    }

    /// Reads the field.
    ///
    /// # Errors
    /// A file that cannot be read or holds no such field, as malformed input; an array that is not there, or none named where there
    /// are several, as wrong usage.
    pub fn read(&self) -> Result<SizeField, Failure> {
        let (path, array) = self.parts();
        let label = path.display().to_string();
        let input = |text: String| Failure::Input(format!("{label}: {text}"));
        let (bytes, format) = bytes_of(&path)?;
        let mesh = interchange::parse_points(&bytes, format).map_err(|e| input(e.to_string()))?;
        let array = chosen(&mesh, array, &label)?;
        field(&mesh, array, format.entry().first_id).map_err(input)
    }

    /// Gives a document the field; returns what there is to say about how both fit.
    ///
    /// # Errors
    /// As [`SizeFieldFile::read`]; and a field that is nowhere near the body, as what cannot be done.
    pub fn apply(&self, document: &mut Document) -> Result<Option<String>, Failure> {
        let field = self.read()?;
        let note = beyond(document, &field)
            .map_err(|text| Failure::Impossible(format!("{}: {text}", self.parts().0.display())))?;
        document.size_field = Some(field);
        Ok(note)
    }
}

fn bytes_of(path: &Path) -> Result<(Vec<u8>, Format), Failure> {
    let name = path.display();
    let unreadable = |e: std::io::Error| Failure::Input(format!("cannot read {name}: {e}"));
    let file = File::open(path).map_err(unreadable)?;
    if file.metadata().is_ok_and(|m| m.is_dir()) {
        return Err(Failure::Input(format!(
            "cannot read {name}: it is a directory"
        )));
    }
    let mut input = BufReader::new(file);
    let (mut bytes, format) = recognized(&mut input, (Some(path), None))
        .map_err(|text| Failure::Input(format!("{name}: {text}")))?;
    input.read_to_end(&mut bytes).map_err(unreadable)?;
    Ok((bytes, format))
}

/// The array that is named, or the only one with one number at each point.
fn chosen<'a>(
    mesh: &'a PointMesh,
    name: Option<&str>,
    label: &str,
) -> Result<&'a PointArray, Failure> {
    let scalars = || mesh.arrays.iter().filter(|a| a.components == 1);
    let names: Vec<String> = scalars().map(|a| format!("'{}'", a.name)).collect();
    let names = names.join(", ");
    if let Some(name) = name {
        let known = scalars().find(|a| a.name == name);
        return known.ok_or_else(|| {
            Failure::Usage(match names.as_str() {
                "" => format!("{label} has no array with one number at each point"),
                _ => format!(
                    "{label} has no array '{name}' with one number at each point; it has {names}"
                ),
            })
        });
    }
    let mut all = scalars();
    match (all.next(), all.next()) {
        (Some(only), None) => Ok(only),
        (None, _) => Err(Failure::Input(format!(
            "{label}: it has no array with one number at each point, so it says no lengths of edges"
        ))),
        _ => Err(Failure::Usage(format!(
            "{label} has several arrays with one number at each point; name one of {names} as {label}:NAME"
        ))),
    }
}

/// The field of an array, without points that no element names. Points are numbered from `first` in messages. Of a mesh that has volume
/// the triangles are left out: they are its border, or within it.
fn field(mesh: &PointMesh, array: &PointArray, first: u64) -> Result<SizeField, String> {
    let mut field = SizeField {
        points: Vec::new(),
        tets: mesh.tets.clone(),
        triangles: match mesh.tets.is_empty() {
            true => mesh.triangles.clone(),
            false => Vec::new(),
        },
    };
    if field.tets.is_empty() && field.triangles.is_empty() {
        return Err("its mesh has no elements: neither volume nor faces".to_owned());
    }
    let mut used = vec![false; mesh.points.len()];
    let named = field.tets.as_flattened().iter();
    let named = named.chain(field.triangles.as_flattened());
    named.for_each(|&v| used[v as usize] = true);
    let mut new = vec![u32::MAX; used.len()];
    for (v, _) in used.iter().enumerate().filter(|(_, used)| **used) {
        let (position, size) = (mesh.points[v], array.values[v]);
        if !(size.is_finite() && size > 0.0) {
            let what = match size.is_nan() {
                true => "no number".to_owned(),
                false => format!("{size}"),
            };
            let DVec3 { x, y, z } = position;
            return Err(format!(
                "array '{}' has {what} at point {} at ({x}, {y}, {z}); lengths of edges must be finite and above 0",
                array.name,
                v as u64 + first,
            ));
        }
        new[v] = field.points.len() as u32;
        field.points.push(SizePoint { position, size });
    }
    let named = field.tets.as_flattened_mut().iter_mut();
    let named = named.chain(field.triangles.as_flattened_mut());
    named.for_each(|v| *v = new[*v as usize]);
    Ok(field)
}

/// What there is to say where a body stands out of its field.
///
/// # Errors
/// The field is elsewhere.
fn beyond(document: &Document, field: &SizeField) -> Result<Option<String>, String> {
    let ends = |points: &mut dyn Iterator<Item = DVec3>| {
        points.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[l, h], p| {
            [l.min(p), h.max(p)]
        })
    };
    let placed = document.instances.iter().map(|instance| {
        let vertices = &document.templates[instance.template as usize].vertices;
        (instance.isometry.placed(), vertices)
    });
    let all: usize = placed.clone().map(|(_, vertices)| vertices.len()).sum();
    let mut in_world = placed
        .flat_map(|(place, vertices)| vertices.iter().map(move |&p| place.apply(p)))
        .step_by(all.div_ceil(LOOKED_AT).max(1))
        .map(|p| document.frame.to_world(p));
    let body = ends(&mut in_world);
    let known = ends(&mut field.points.iter().map(|p| p.position));
    let out = (known[0] - body[0]).max(body[1] - known[1]).max_element();
    let diagonal = body[0].distance(body[1]);
    let text = |[low, high]: [DVec3; 2]| {
        format!(
            "({:.4e}, {:.4e}, {:.4e}) to ({:.4e}, {:.4e}, {:.4e})",
            low.x, low.y, low.z, high.x, high.y, high.z
        )
    };
    let is_apart = (body[0] - known[1]).max(known[0] - body[1]).max_element() > BEYOND * diagonal;
    if is_apart {
        return Err(format!(
            "the size field reaches from {}, the body from {}: they do not meet; have they the same unit of length?",
            text(known),
            text(body)
        ));
    }
    let is_out = out > BEYOND * diagonal;
    Ok(is_out.then(|| {
        format!(
            "the body stands out of its size field, by {out:.3e} at most: there lengths grow from those at the border of the field \
             by the gradation"
        )
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(arrays: &[(&str, usize)]) -> PointMesh {
        PointMesh {
            points: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE],
            tets: vec![[0, 1, 2, 4]],
            triangles: vec![[0, 1, 2]],
            arrays: arrays
                .iter()
                .map(|&(name, components)| PointArray {
                    name: name.to_owned(),
                    components,
                    values: vec![0.5; 5 * components],
                })
                .collect(),
        }
    }

    #[test]
    fn the_array_is_the_only_one_or_named() {
        let one = mesh(&[("h", 1), ("velocity", 3)]);
        assert_eq!(chosen(&one, None, "f").unwrap().name, "h");
        assert_eq!(chosen(&one, Some("h"), "f").unwrap().name, "h");
        let error = chosen(&one, Some("velocity"), "f").unwrap_err();
        assert_eq!(error.code(), 2);
        let two = mesh(&[("h", 1), ("T", 1)]);
        let error = chosen(&two, None, "f.vtk").unwrap_err();
        assert_eq!(error.code(), 2);
        assert!(
            error
                .to_string()
                .contains("name one of 'h', 'T' as f.vtk:NAME")
        );
        let error = chosen(&mesh(&[("velocity", 3)]), None, "f").unwrap_err();
        assert_eq!(error.code(), 3);
    }

    #[test]
    fn lengths_are_checked_at_the_points_of_elements() {
        let mut mesh = mesh(&[("h", 1)]);
        // No element has this one.
        mesh.arrays[0].values[3] = f64::NAN;
        let found = field(&mesh, &mesh.arrays[0], 0).unwrap();
        assert_eq!(found.tets, [[0, 1, 2, 3]]);
        assert_eq!(found.points[3].position, DVec3::ONE);
        assert_eq!(found.triangles.len(), 0);
        for (value, what) in [
            (0.0, "0"),
            (-2.0, "-2"),
            (f64::NAN, "no number"),
            (f64::INFINITY, "inf"),
        ] {
            mesh.arrays[0].values[4] = value;
            let text = field(&mesh, &mesh.arrays[0], 1).unwrap_err();
            let start = format!("array 'h' has {what} at point 5 at (1, 1, 1)");
            assert!(text.starts_with(&start), "{text}");
        }
        mesh.tets.clear();
        mesh.triangles.clear();
        let text = field(&mesh, &mesh.arrays[0], 0).unwrap_err();
        assert!(text.contains("no elements"), "{text}");
    }
}
