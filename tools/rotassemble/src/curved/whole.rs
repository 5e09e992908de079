//! All copies of a wedge, also of one that stands alone.

use rustc_hash::FxHashSet;
use tmesh::{Document, Instance, Template};

/// The vertices, gluings and instances of a document, with all instances that its gluings lead to from these.
pub fn whole(document: &Document) -> Document {
    let templates = document.templates.iter().map(|t| Template {
        vertices: t.vertices.clone(),
        gluings: t.gluings.clone(),
        ..Template::default()
    });
    let mut instances = document.instances.clone();
    let mut seen: FxHashSet<_> = instances.iter().map(|i| (i.template, i.isometry)).collect();
    let mut next = 0;
    while let Some(&Instance {
        template, isometry, ..
    }) = instances.get(next)
    {
        next += 1;
        // Not back: a wedge has neighbours that state where they meet it, and not every copy of it has one.
        for gluing in &document.templates[template as usize].gluings {
            let isometry = isometry.compose(gluing.step);
            if seen.insert((gluing.other, isometry)) {
                instances.push(Instance {
                    template: gluing.other,
                    isometry,
                    region_map: 0,
                });
            }
        }
    }
    Document {
        templates: templates.collect(),
        instances,
        ..Document::default()
    }
}
