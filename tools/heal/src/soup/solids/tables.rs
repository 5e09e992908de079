//! Tables of regions and markers.

use super::label::Labels;
use crate::document::Labelled;
use crate::soup::surface::{NONE, Surface};
use tmesh::{OUTSIDE, Region, Template, Triangle};

/// Regions and markers from labels.
///
/// Leaves the precision and the notices to be filled in.
pub fn tables(surface: Surface, labels: Labels) -> Labelled {
    let region = |solid: u32| if solid == NONE { OUTSIDE } else { solid + 1 };
    // Interfaces are markers of their own, after those of the groups.
    let mut pairs: Vec<[u32; 2]> = (0..surface.triangles.len())
        .filter(|&t| surface.partner[t] != NONE)
        .map(|t| sorted(surface.solid[t], surface.partner[t]))
        .collect();
    pairs.sort_unstable();
    pairs.dedup();
    let groups = surface.groups.len();
    let triangles = (0..surface.triangles.len())
        .map(|t| {
            let [a, b, c] = surface.triangles[t];
            let marker = match surface.partner[t] {
                NONE => surface.group[t] as usize,
                partner => {
                    let pair = sorted(surface.solid[t], partner);
                    groups + pairs.partition_point(|p| *p < pair)
                }
            };
            let turned = labels.turned[t];
            Triangle {
                vertices: if turned { [a, c, b] } else { [a, b, c] },
                marker: marker as u32 + 1,
                front: region(labels.front[t]),
                back: region(labels.back[t]),
            }
        })
        .collect();
    let name = |solid: u32| surface.solids[solid as usize].as_str();
    let interfaces = pairs
        .iter()
        .map(|&[a, b]| format!("{}/{}", name(a), name(b)));
    let interfaces: Vec<String> = interfaces.collect();
    let markers = (1..).zip(surface.groups.into_iter().chain(interfaces));
    let regions = (1..).zip(surface.solids).map(|(id, name)| Region {
        id,
        name,
        size: None,
        volume: None,
    });
    Labelled {
        regions: regions.collect(),
        markers: markers.collect(),
        template: Template {
            triangles,
            vertices: surface.points,
            ..Template::default()
        },
        relative_precision: 0.0,
        notices: Vec::new(),
        repairs: Vec::new(),
    }
}

fn sorted(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
