//! Numbers at the nodes of a Gmsh mesh.

use super::scan::Scanner;
use crate::ReadError;
use crate::parsed::{PointArray, PointMesh};
use crate::text::plain;
use rustc_hash::FxHashMap;

/// Numbers at nodes, as a section `NodeData` lists them.
pub struct View {
    /// Its first text.
    pub name: String,
    /// Number of its time step.
    pub step: i64,
    /// Numbers at each node.
    pub components: usize,
    /// Numbers of the nodes, as in the file.
    pub nodes: Vec<u64>,
    /// As many numbers for each.
    pub values: Vec<f64>,
}

/// A view that has numbers at fewer than this share of all nodes is left out: it is no field over the mesh, and a file could name
/// any number of such views for every one of its nodes.
const LEAST: usize = 8;

/// Numbers at nodes: texts, the first of them a name; real numbers, the first of them a time; integers: a step, the number of
/// components, the number of nodes, perhaps a partition; then a line for each node.
///
/// # Errors
/// Bytes that do not follow the format.
pub fn node_data(scan: &mut Scanner<'_>) -> Result<View, ReadError> {
    let texts = scan.tokens.count("the number of texts")?;
    let mut name = String::new();
    for i in 0..texts {
        scan.end_line();
        let line = scan.tokens.rest_of_line();
        if line.is_empty() && scan.tokens.left() == 0 {
            return Err(scan.error("a text expected, but the file ends here"));
        }
        if i == 0 {
            let text = String::from_utf8_lossy(line);
            name = plain(text.trim_matches('"'));
        }
    }
    for _ in 0..scan.tokens.count("the number of real numbers")? {
        scan.tokens.number()?;
    }
    let integers = scan.tokens.count("the number of integers")?;
    let mut known = [0, 1, 0];
    for i in 0..integers {
        let value = scan.tokens.integer("an integer of a view")?;
        if let Some(known) = known.get_mut(i) {
            *known = value;
        }
    }
    let [step, components, count] = known;
    let (Ok(components), Ok(count)) = (usize::try_from(components), u64::try_from(count)) else {
        return Err(scan.error(format!("{components} numbers at {count} nodes")));
    };
    scan.end_line();
    let each = 1 + components as u64;
    scan.fits(count, "the number of nodes", 2 * each, 8 * each - 4)?;
    let mut view = View {
        name,
        step,
        components,
        nodes: Vec::with_capacity(count as usize),
        values: Vec::with_capacity(count as usize * components),
    };
    for _ in 0..count {
        let node = scan.int("the number of a node")?;
        view.nodes.push(u64::try_from(node).unwrap_or(u64::MAX));
        for _ in 0..components {
            let value = match scan.binary {
                true => {
                    let bytes = scan.raw::<8>("a number at a node")?;
                    match scan.big {
                        true => f64::from_be_bytes(bytes),
                        false => f64::from_le_bytes(bytes),
                    }
                }
                false => scan.tokens.number()?,
            };
            view.values.push(value);
        }
    }
    Ok(view)
}

/// Gives a mesh the numbers of views at its points; `index` has the point of each node, unless nodes are numbered 1, 2, 3, ... Of the
/// time steps of a view the last one counts.
pub fn point_mesh(
    mut mesh: PointMesh,
    index: Option<&FxHashMap<u64, u32>>,
    views: Vec<View>,
) -> PointMesh {
    let count = mesh.points.len();
    let point = |node: u64| match index {
        Some(index) => index.get(&node).map(|&i| i as usize),
        None => (1..=count as u64)
            .contains(&node)
            .then(|| node as usize - 1),
    };
    let mut steps = Vec::new();
    for view in views {
        if view.components == 0 || view.nodes.len() < count / LEAST {
            continue;
        }
        let mut values = vec![f64::NAN; count * view.components];
        let each = view.values.chunks_exact(view.components);
        for (&node, numbers) in view.nodes.iter().zip(each) {
            if let Some(at) = point(node) {
                let at = at * view.components;
                values[at..at + view.components].copy_from_slice(numbers);
            }
        }
        let array = PointArray {
            name: view.name,
            components: view.components,
            values,
        };
        match mesh.arrays.iter().position(|a| a.name == array.name) {
            None => {
                mesh.arrays.push(array);
                steps.push(view.step);
            }
            Some(known) if view.step >= steps[known] => {
                mesh.arrays[known] = array;
                steps[known] = view.step;
            }
            Some(_) => {}
        }
    }
    mesh
}
