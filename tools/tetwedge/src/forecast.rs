//! What filling a document is expected to take, before it begins.

use crate::settle::Shaped;
use estimate::{CostModel, Cut, Estimate, Wedge, edge_of_volume, needles};
use geom::measure::volume_of_region;
use mesher::{IN_CUBE, Params, Sizes, mean_volume};
use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::time::Duration;
use tmesh::{Instance, OUTSIDE, Template, Triangle};

/// Length of elements over the thickness of a part where that limits it, and nobody asks for a number of elements across. Measured on 14 bodies of
/// `body`, most of them thin, with a length asked for and without: the tetrahedra are 0.57 to 1.17 times those of the forecast; with 1, down to 0.25 of it.
const LAYER: f64 = 1.4;

/// What filling a document is expected to take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forecast {
    /// Tetrahedra of all templates.
    pub tetrahedra: f64,
    /// Time.
    pub time: Duration,
}

/// The forecast for surfaces that follow the shape; `None` where there is nothing to tell it by: no quality is asked for, or a template
/// has neither a section through its axis nor sizes for all of its regions.
pub fn forecast(shaped: &Shaped, params: &Params, threads: usize) -> Option<Forecast> {
    if !params.quality {
        return None;
    }
    let model = CostModel::CALIBRATED;
    let document = shaped.document();
    let sizes = Sizes::of_regions(document);
    let mut tetrahedra = 0.0;
    let mut seconds = 0.0;
    for index in 0..document.templates.len() {
        let count = expected(shaped, index, &sizes, threads)?;
        // As of a hub: what copies share is meshed first, and everything within it then.
        let mut gluings = document.templates[index].gluings.iter();
        let passes = match gluings.any(|g| g.is_seam(index) || g.other_than(index).is_some()) {
            true => model.hub_time,
            false => 1.0,
        };
        tetrahedra += count;
        seconds += passes * count * model.seconds;
    }
    Some(Forecast {
        tetrahedra,
        time: Duration::try_from_secs_f64(seconds).ok()?,
    })
}

/// Tetrahedra that a template is expected to get.
fn expected(shaped: &Shaped, index: usize, sizes: &Sizes, threads: usize) -> Option<f64> {
    let document = shaped.document();
    let template = &document.templates[index];
    let volume_of = |region: u32| volume_of_region(&template.vertices, template.faces(), region);
    // Elements that are too large are split, so that they have half of the volume that is allowed, in the mean.
    let by_field = mean_volume((document, index), regions(template).map(volume_of).sum());
    let cube = |region: u32| {
        let number = document.regions.iter().position(|r| r.id == region)?;
        let volumes = sizes.of_region[number].into_iter().chain(by_field);
        Some(0.5 * IN_CUBE * volumes.reduce(f64::min)?)
    };
    // Those that are turned over are beyond the sections of this one.
    let upright = |i: &&Instance| i.template as usize == index && !i.isometry.flipped();
    let copies = document.instances.iter().filter(upright).count();
    let mut wedge = Wedge::new(template, index, copies);
    wedge.layers = document.wishes.layers_across.map_or(1.0 / LAYER, f64::from);
    if wedge.sections.is_empty() {
        let by_size = regions(template).map(|region| Some(volume_of(region) / cube(region)?));
        return by_size.sum::<Option<f64>>().map(|cubes| IN_CUBE * cubes);
    }
    // The estimate takes an element for a regular tetrahedron, whose edge is that of the cube.
    let volume = |region: u32| Some(cube(region)? / edge_of_volume(1.0).powi(3));
    let estimate = Estimate::new(CostModel::CALIBRATED, &wedge, 0.0, volume, threads);
    let copies = copies as f64;
    let gluings = || template.gluings.iter();
    let cut = Cut {
        order: document.symmetry.as_ref().map_or(1, |s| s.group.order),
        angle: TAU / copies,
        copies,
        hub_copies: copies,
        reach: 1.0,
        free: !gluings().any(|g| g.is_seam(index)),
        across: gluings().any(|g| g.is_mirror(index) && g.step.flipped()),
        harm: 0.0,
        hub: false,
    };
    let [wedges, _] = estimate.parts(&cut, None);
    // The sections stand for all directions between them, where the body may be wider or narrower.
    let share = regions(template).map(volume_of).sum::<f64>() / estimate.volume();
    let size = |t: &Triangle| {
        let of_sides = [t.front, t.back].into_iter().filter_map(cube);
        of_sides.fold(f64::INFINITY, f64::min).cbrt()
    };
    let model = &estimate.model;
    // Remeshing leaves no needles of what surfaces are drawn with.
    let thin = match shaped.is_remeshed() {
        true => 0.0,
        false => model.tetrahedra * needles(template, size, None),
    };
    Some(IN_CUBE * share * wedges.elements(model) + thin)
}

/// The regions that a template has.
fn regions(template: &Template) -> impl Iterator<Item = u32> {
    let sides = template.triangles.iter().flat_map(|t| [t.front, t.back]);
    let regions: BTreeSet<u32> = sides.filter(|&region| region != OUTSIDE).collect();
    regions.into_iter()
}
