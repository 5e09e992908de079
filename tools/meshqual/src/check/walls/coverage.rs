//! Walls between templates with different numbers of instances.

use crate::check::findings::{Findings, Kind, at};
use crate::instances::Copies;
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;
use tmesh::Document;

/// Checks that the hub walls together cover each triangle they meet, in each of its instances, exactly
/// once.
pub fn hub_coverage(document: &Document, findings: &mut Findings) {
    let copies = Copies::of(document).of_template;
    let mut met: Vec<FxHashMap<u32, u64>> = vec![FxHashMap::default(); copies.len()];
    let mut order: BTreeSet<(usize, u32)> = BTreeSet::new();
    for (index, template) in document.templates.iter().enumerate() {
        for gluing in &template.gluings {
            let Some(other) = gluing.other_than(index) else {
                continue;
            };
            for &[here, there] in &gluing.triangle_pairs {
                *met[other].entry(there).or_insert(0) += copies[index];
                order.insert((other, there));
                // Each wall meets one neighbour for each own instance.
                *met[index].entry(here).or_insert(0) += copies[index];
                order.insert((index, here));
            }
        }
    }
    for &(template, triangle) in &order {
        let times = met[template][&triangle];
        if times != copies[template] {
            findings.add(Kind::HubCoverage, || {
                let t = &document.templates[template].triangles[triangle as usize];
                format!(
                    "triangle {triangle} meets a hub wall {times} times in {} instances {}",
                    copies[template],
                    at(document, template, &t.vertices)
                )
            });
        }
    }
}
